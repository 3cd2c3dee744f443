//! Friction from both lines of the constant-velocity method.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::{Friction, LawEstimates};
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::thresholds::CLEARLY_PRESENT;

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
