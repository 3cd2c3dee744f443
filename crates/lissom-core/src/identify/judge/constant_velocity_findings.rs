//! Findings about estimates from constant velocities.

use crate::identify::drive_estimates::Method;
use crate::identify::findings::{Finding, rows};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::constant_velocity::FrictionLine;
use crate::record::Campaign;

/// What a campaign of nothing but constant velocities cannot give.
pub(crate) fn only_constant_velocities(campaign: &Campaign) -> Finding {
    let flexible = !campaign.channels.tips.is_empty();
    Finding::new(rows::ConstantVelocityOnly { flexible })
}

/// That friction is from constant velocities, where it is.
pub(crate) fn taken(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Finding> {
    let found = evidence.methods.constant_velocity.as_ref()?;
    if chosen.method != Some(Method::ConstantVelocity) || chosen.drive.friction.coulomb.is_none() {
        return None;
    }
    let curved = |(_, line): (&str, &FrictionLine)| line.near_rest() != line.coulomb;
    Some(if found.lines().any(curved) {
        Finding::new(rows::SlowestSpeedsTaken {})
    } else {
        Finding::new(rows::ConstantVelocityEstimates {})
    })
}
