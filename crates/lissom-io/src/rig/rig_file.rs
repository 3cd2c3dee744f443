//! The type of `rig.json`: filled from a virtual arm and its runs, written and read.

use lissom_core::beam::Base;
use lissom_core::rig::{JointFriction, Rig};
use serde::{Deserialize, Serialize};

use super::rig_run_entry::RigRunEntry;
use crate::plan::PlanFile;

/// What is known about a virtual campaign in addition to its logs. SI units and rad/s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RigFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Title of the plan.
    pub title: String,
    /// Seed of the plan, a whole number up to 2^63.
    pub seed: String,
    /// Relative tolerance of a step of the simulation if friction is not constant during slip; null if the motion is
    /// exact to rounding.
    pub tolerance: Option<f64>,
    /// Number of point masses that were simulated; a beam with mass along it is simulated as point masses too.
    pub masses: usize,
    /// The arm that was simulated: what identification has to find.
    pub truth: RigTruthEntry,
    /// The runs in the order of the plan.
    pub runs: Vec<RigRunEntry>,
    /// A hash, in hexadecimal, of everything that the logs depend on; only in the rig.json of the campaign's folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub fingerprint: Option<String>,
}

/// The arm that was simulated.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RigTruthEntry {
    /// J: inertia of the motor.
    pub inertia_kg_m2: f64,
    /// V: viscous friction of the motor.
    pub viscous_nm_s_per_rad: f64,
    /// K: torque constant.
    pub torque_constant_nm_per_a: f64,
    /// Dry friction at speed, forward.
    pub forward_nm: f64,
    /// Dry friction at speed, backward, a magnitude.
    pub backward_nm: f64,
    /// Largest torque that friction holds at rest at angle zero, forward.
    pub rest_forward_nm: f64,
    /// Largest torque that friction holds at rest at angle zero, backward, a magnitude.
    pub rest_backward_nm: f64,
    /// Gravity of an unbalanced load on the motor; null if there is none.
    pub gravity: Option<RigGravityEntry>,
    /// h_{n+1} of (15): torque per motor angle with all masses held.
    pub coupling_nm_per_rad: f64,
    /// Natural frequencies of the beam with the motor clamped, ascending.
    pub natural_frequencies_rad_s: Vec<f64>,
}

/// The torque `sine·sin θ + cosine·cos θ` that gravity needs of the motor, θ the motor's angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RigGravityEntry {
    /// Coefficient g_s of sin θ.
    pub sine_nm: f64,
    /// Coefficient g_c of cos θ.
    pub cosine_nm: f64,
}

impl RigFile {
    /// The content that `lissom rig` writes for these runs, without a fingerprint.
    pub fn of(rig: &Rig, plan: &PlanFile, runs: Vec<RigRunEntry>) -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            title: plan.title.clone(),
            seed: plan.seed.to_string(),
            tolerance: rig.scene.tolerance(),
            masses: rig.arm.beam().len(),
            truth: RigTruthEntry::of(rig),
            runs,
            fingerprint: None,
        }
    }
}

impl RigTruthEntry {
    fn of(rig: &Rig) -> Self {
        let (arm, motor) = (&rig.arm, &rig.arm.motor);
        let (sliding, rest) = match &rig.scene.friction {
            JointFriction::Dry(law) => (law.sliding(), law.at(0.0, 0.0)),
            JointFriction::Bristles { law, .. } => (law.coulomb(), law.at_rest()),
            _ => (arm.coulomb, arm.coulomb),
        };
        Self {
            inertia_kg_m2: motor.inertia_kg_m2(),
            viscous_nm_s_per_rad: motor.viscous_nm_s_per_rad(),
            torque_constant_nm_per_a: motor.torque_constant_nm_per_a(),
            forward_nm: sliding.forward(),
            backward_nm: sliding.backward(),
            rest_forward_nm: rest.forward(),
            rest_backward_nm: rest.backward(),
            gravity: rig
                .scene
                .gravity
                .map(|load| RigGravityEntry { sine_nm: load.sine_nm, cosine_nm: load.cosine_nm }),
            coupling_nm_per_rad: arm.dynamics().coupling_motor,
            natural_frequencies_rad_s: arm.beam().frequencies_rad_s(Base::Clamped, usize::MAX),
        }
    }
}
