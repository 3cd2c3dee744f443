//! The campaign.toml for logs of a virtual rig.

use lissom::record::{Hold, TipQuantity};
use lissom::rig::Rig;
use lissom_io::write::{CampaignPlan, PlannedCommand, PlannedRun};

/// Describes a campaign with the drive and sensors of `rig`.
pub(crate) fn described(
    rig: &Rig,
    title: String,
    arm: Option<String>,
    runs: Vec<PlannedRun>,
) -> CampaignPlan {
    let instruments = &rig.instruments;
    // The current is constant between two rows if the controller acts only at rows.
    let held = instruments.control_every.is_multiple_of(instruments.log_every);
    let masses = rig.arm.beam().len();
    CampaignPlan {
        title,
        time_column: "t".to_owned(),
        command: PlannedCommand {
            column: "i".to_owned(),
            hold: if held { Hold::Sampled } else { Hold::Measured },
        },
        motor_column: "theta_m".to_owned(),
        tips: (0..masses)
            .map(|mass| (format!("theta_{}", mass + 1), tip_column(mass), TipQuantity::Angle))
            .collect(),
        torque_constant_nm_per_a: Some(rig.arm.motor.torque_constant_nm_per_a()),
        current_limit_a: instruments.amplifier.limit_a(),
        gravity: rig.scene.gravity.is_some(),
        arm,
        runs,
    }
}

pub(crate) fn tip_column(mass: usize) -> String {
    format!("theta_{}", mass + 1)
}
