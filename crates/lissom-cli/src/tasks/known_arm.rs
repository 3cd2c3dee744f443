//! Parameters that are known beforehand, to compare with the estimates.

use lissom::arm::Arm;
use lissom::identify::{GeometryCheck, Identified, geometry_check};
use lissom::load::GravityLoad;
use lissom_io::{CampaignFile, DriveSpec};

use crate::shared::failure::Failure;

/// Known parameters of the machine, from an `arm.toml` or a virtual rig.
#[derive(Debug, Clone)]
pub(crate) struct Reference {
    /// Name in plots and tables.
    pub(crate) label: &'static str,
    /// Friction forward and backward \[N·m\].
    pub(crate) coulomb_nm: (f64, f64),
    /// Viscous friction \[N·m·s/rad\].
    pub(crate) viscous_nm_s_per_rad: f64,
    /// Inertia \[kg·m²\].
    pub(crate) inertia_kg_m2: f64,
    /// Gravity of an unbalanced load on the motor.
    pub(crate) gravity: Option<GravityLoad>,
    /// The whole arm, if the beam is known too.
    pub(crate) arm: Option<Arm>,
}

impl Reference {
    /// The true parameters of a virtual rig.
    pub(crate) fn truth(arm: &Arm) -> Self {
        Self {
            label: "truth",
            coulomb_nm: (arm.coulomb.forward(), arm.coulomb.backward()),
            viscous_nm_s_per_rad: arm.motor.viscous_nm_s_per_rad(),
            inertia_kg_m2: arm.motor.inertia_kg_m2(),
            gravity: None,
            arm: Some(arm.clone()),
        }
    }

    /// The arm.toml that a campaign gives for comparison; `None` if it gives none, or one without a drive.
    pub(crate) fn of(file: &CampaignFile) -> Result<Option<Self>, Failure> {
        let Some(arm) = &file.known.arm else { return Ok(None) };
        let Some(drive) = &arm.drive else { return Ok(None) };
        let whole = file.described_arm().map_err(lissom_io::Error::from)?;
        let gravity = arm.load.map(|load| load.gravity());
        Ok(Some(Self { gravity, ..Self::drive(drive, whole) }))
    }

    fn drive(drive: &DriveSpec, arm: Option<Arm>) -> Self {
        Self {
            label: "arm.toml",
            coulomb_nm: (drive.coulomb_forward_nm, drive.coulomb_backward_nm),
            viscous_nm_s_per_rad: drive.viscous_nm_s_per_rad,
            inertia_kg_m2: drive.inertia_kg_m2,
            gravity: None,
            arm,
        }
    }
}

/// Compares the identified arm with the arm.toml that a campaign gives.
pub(crate) fn checked(id: &Identified, reference: Option<&Reference>) -> Option<GeometryCheck> {
    let arm = reference?.arm.as_ref()?;
    geometry_check(arm, id.output_error.as_ref().filter(|oe| oe.stands())?)
}
