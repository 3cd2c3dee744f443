//! When the constant-velocity method can be used for the result, and which parameters it does not give.

use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::estimate::Estimate;
use crate::identify::findings::{Finding, rows};
use crate::identify::friction_estimates::{Friction, LawEstimates};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::constant_velocity::line::FrictionLine;
use crate::identify::thresholds::CLEARLY_PRESENT;
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

impl ConstantVelocity {
    /// Friction from both lines; only viscous friction if there is one line.
    pub fn estimates(&self) -> DriveEstimates {
        let viscous_alone = || Friction { viscous: self.viscous, ..Friction::default() };
        let friction = friction_near_rest(self).unwrap_or_else(viscous_alone);
        DriveEstimates { friction, ..DriveEstimates::default() }
    }
}

/// The estimates of both lines, by the slowest speeds where they are curved.
fn friction_near_rest(found: &ConstantVelocity) -> Option<Friction> {
    let (Ok(f), Ok(b)) = (&found.forward, &found.backward) else { return None };
    let (forward, backward) = (f.near_rest(), b.near_rest());
    let std = 0.5 * forward.std.hypot(backward.std);
    let half = |value: f64| Some(Estimate { value: 0.5 * value, std });
    let offset = half(forward.value - backward.value);
    let apart = (f.viscous.value - b.viscous.value).abs();
    let differ = apart > CLEARLY_PRESENT * f.viscous.std.hypot(b.viscous.std);
    let coulomb = half(forward.value + backward.value);
    let (forward, backward) = (Some(forward), Some(backward));
    let law = LawEstimates {
        coulomb,
        forward,
        backward,
        viscous: found.viscous,
        viscous_by_direction: Some((f.viscous, b.viscous)),
        ..LawEstimates::default()
    };
    Some(Friction {
        coulomb,
        forward,
        backward,
        offset,
        viscous: found.viscous,
        law: differ.then_some(law),
    })
}
