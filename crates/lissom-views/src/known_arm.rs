//! Parameters that are known beforehand, to compare with the estimates.

use lissom::arm::Arm;
use lissom::identify::{GeometryCheck, Identified, geometry_check};
use lissom::load::GravityLoad;
use lissom_io::{CampaignFile, DriveSpec};

/// Known parameters of the machine, from an `arm.toml` or a virtual rig.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Name in plots and tables.
    pub label: &'static str,
    /// Friction forward and backward \[N·m\].
    pub coulomb_nm: (f64, f64),
    /// Viscous friction \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// Inertia \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Gravity of an unbalanced load on the motor.
    pub gravity: Option<GravityLoad>,
    /// The whole arm, if the beam is known too.
    pub arm: Option<Arm>,
}

impl Reference {
    /// The true parameters of a virtual rig.
    pub fn truth(arm: &Arm) -> Self {
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
    ///
    /// # Errors
    /// [`lissom_io::Error::Config`] if its numbers do not make an arm.
    pub fn of(file: &CampaignFile) -> Result<Option<Self>, lissom_io::Error> {
        let Some(arm) = &file.known.arm else { return Ok(None) };
        let Some(drive) = &arm.drive else { return Ok(None) };
        let whole = file.described_arm()?;
        let gravity = arm.load.map(|load| load.gravity());
        Ok(Some(Self { gravity, ..Self::drive(drive, whole) }))
    }

    fn drive(drive: &DriveSpec, arm: Option<Arm>) -> Self {
        Self {
            label: "arm.toml",
            coulomb_nm: (drive.coulomb.forward(), drive.coulomb.backward()),
            viscous_nm_s_per_rad: drive.motor.viscous_nm_s_per_rad(),
            inertia_kg_m2: drive.motor.inertia_kg_m2(),
            gravity: None,
            arm,
        }
    }
}

/// Compares the identified arm with the arm.toml that a campaign gives; `None` if it gives none, or if the output-error
/// method has no solution.
pub fn checked(id: &Identified, reference: Option<&Reference>) -> Option<GeometryCheck> {
    let arm = reference?.arm.as_ref()?;
    geometry_check(arm, id.output_error.as_ref().filter(|oe| oe.stands())?)
}
