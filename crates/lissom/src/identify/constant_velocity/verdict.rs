//! When steady velocities stand in for friction, and what they cannot give.

use super::{ConstantVelocity, FrictionLine};
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::identified::{Friction, Identified};
use crate::identify::run_analysis::RunAnalysis;
use crate::identify::{Estimate, verdict::UNCERTAIN};
use crate::record::Campaign;

/// Viscous friction by direction differs from this many deviations on.
const DIRECTIONS_DIFFER: f64 = 4.0;

/// Whether constant velocities are all there is, and give no inertia either.
pub(crate) fn alone(id: &Identified) -> bool {
    let other = |r: &RunAnalysis| r.usable && !r.is_constant_velocity();
    id.regression.is_none() && id.constant_velocity.is_some() && !id.runs.iter().any(other)
}

/// What a campaign of nothing but constant velocities cannot give.
pub(crate) fn only_constant_velocities(campaign: &Campaign) -> Finding {
    let flexible = !campaign.channels.tips.is_empty();
    let affects = [key::INERTIA, key::MODES, key::COUPLING];
    Finding::new(
        "constant-velocity-only",
        Severity::Refusal,
        &affects[..if flexible { 3 } else { 1 }],
        "every run turns at constant velocities: they show friction, and nothing that is accelerated"
            .to_owned(),
        "for the other figures add runs that move back and forth: sines, a sweep, ordinary moves",
    )
}

/// Takes friction from steady velocities, where nothing else gives it or knows it as well.
pub(crate) fn stand_in(id: &mut Identified) {
    let Some(found) = &id.constant_velocity else { return };
    let share = |e: Estimate| e.std / e.value.abs();
    let taken = id.friction.coulomb.map(share).filter(|s| *s < UNCERTAIN);
    if taken.is_none() {
        let classical = friction_near_rest(found);
        let better = |e: Estimate| id.friction.coulomb.is_none_or(|c| share(e) < share(c));
        if classical.coulomb.is_some_and(better) {
            id.friction = classical;
            id.findings.push(Finding::new(
                "classical-figures",
                Severity::Info,
                &[key::COULOMB, key::OFFSET, key::VISCOUS],
                "friction is that of constant velocities, extrapolated to rest".to_owned(),
                "sines or ordinary moves at the speeds you work at show friction without \
                 extrapolating",
            ));
            let curved = |l: &FrictionLine| l.near_rest() != l.coulomb;
            if found.lines().any(|(_, line)| curved(line)) {
                id.findings.push(Finding::new(
                    "slowest-speeds-taken",
                    Severity::Warning,
                    &[key::COULOMB, key::OFFSET, key::VISCOUS],
                    "friction does not lie on a line: Coulomb friction is that of the slowest third \
                     of the speeds, viscous friction the slope over all of them"
                        .to_owned(),
                    "keep to the speeds that you work at",
                ));
            }
        }
    }
    if id.friction.viscous.is_none() {
        id.friction.viscous = id.constant_velocity.as_ref().and_then(|c| c.viscous);
    }
}

/// The figures of both lines, by the slowest speeds where they are curved.
fn friction_near_rest(found: &ConstantVelocity) -> Friction {
    let (Ok(f), Ok(b)) = (&found.forward, &found.backward) else { return Friction::default() };
    let (forward, backward) = (f.near_rest(), b.near_rest());
    let std = 0.5 * forward.std.hypot(backward.std);
    let half = |value: f64| Some(Estimate { value: 0.5 * value, std });
    let apart = (f.viscous.value - b.viscous.value).abs();
    let differ = apart > DIRECTIONS_DIFFER * f.viscous.std.hypot(b.viscous.std);
    Friction {
        coulomb: half(forward.value + backward.value),
        forward: Some(forward),
        backward: Some(backward),
        offset: half(forward.value - backward.value),
        viscous: found.viscous,
        viscous_by_direction: differ.then_some((f.viscous, b.viscous)),
        ..Friction::default()
    }
}
