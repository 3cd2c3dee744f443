//! Findings of the regression in words: missing terms, a mode, an assumed hold, and the estimates that they move.

use crate::identify::findings::number_text::significant;
use crate::identify::findings::result_key as key;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::{MissingKind, MissingTerm, Moved};
use crate::identify::methods::regression::{HiddenMode, OtherHold};
use crate::record::Hold;

/// Digits of a coefficient whose standard error is not given.
pub(super) const DIGITS: usize = 3;
/// Smallest change of an estimate that is reported, in its standard errors.
const FELT: f64 = 1.0;

/// The effect of a missing term, with its coefficient, in words.
pub(super) fn looks_like(term: &MissingTerm, units: EstimateUnits) -> String {
    let size = significant(term.value.abs(), DIGITS);
    let grows = if term.value < 0.0 { "falls" } else { "grows" };
    match term.kind {
        MissingKind::Gravity => format!(
            "the command depends on the angle like gravity, with an amplitude of {size} {}",
            units.torque()
        ),
        MissingKind::Position => {
            format!(
                "a torque {grows} in proportion to the motor's angle, by {size} {}",
                units.stiffness()
            )
        }
        MissingKind::BeamDamping => format!(
            "the beam has internal damping of {} ms times its stiffness",
            significant(1e3 * term.value, DIGITS)
        ),
        MissingKind::CommandBySign => format!(
            "positive commands give {:.1} % {} torque than negative ones",
            200.0 * term.value.abs(),
            if term.value > 0.0 { "more" } else { "less" }
        ),
        MissingKind::WithTorque => {
            format!("friction {grows} with the torque of the motor, by {size} times that torque")
        }
        MissingKind::OverTravel => {
            format!("friction varies over the travel, by up to {size} {}", units.torque())
        }
        MissingKind::CoulombDrift => format!(
            "Coulomb friction {grows} by {size} {} from the beginning of the campaign to its end",
            units.torque()
        ),
        MissingKind::ViscousDrift => format!(
            "viscous friction {grows} by {size} {} from the beginning of the campaign to its end",
            units.viscous()
        ),
    }
}

/// Result keys of the estimates that depend on the hold, and their changes in words.
pub(super) fn moved_by_hold(
    other: &OtherHold,
    units: EstimateUnits,
) -> Vec<(&'static str, String)> {
    let changes = [
        ("Coulomb friction", key::COULOMB, other.coulomb, units.torque().to_owned()),
        ("viscous friction", key::VISCOUS, other.viscous, units.viscous()),
        ("inertia", key::INERTIA, other.inertia, units.inertia()),
    ];
    let changes = changes.into_iter().filter_map(|(name, key, change, unit)| {
        let [now, then] = change?;
        Some((key, format!("{name} {then} instead of {now} {unit}")))
    });
    changes.collect()
}

/// That the hold is assumed, and the estimates that depend on it, in words.
pub(super) fn hold_assumed(other: &OtherHold, units: EstimateUnits) -> String {
    let changes: Vec<String> =
        moved_by_hold(other, units).into_iter().map(|(_, change)| change).collect();
    let (taken, if_it_is) = match other.taken {
        Hold::Measured => ("measured by a sensor", "held"),
        Hold::Sampled => ("held", "measured by a sensor"),
    };
    format!(
        "it is not known whether the command is held between its samples; it is taken as {taken}. If it is {if_it_is}, the \
         regression gives other estimates: {}",
        changes.join(", ")
    )
}

/// Names, result keys and relative changes of the estimates that a term changes by more than their standard errors.
pub(super) fn moved(moves: &[Moved; 3]) -> Vec<(&'static str, &'static str, f64)> {
    let names = [
        ("inertia", key::INERTIA),
        ("viscous friction", key::VISCOUS),
        ("Coulomb friction", key::COULOMB),
    ];
    let felt = names.into_iter().zip(moves);
    let felt = felt.filter(|(_, moved)| moved.standard_errors.abs() > FELT);
    felt.map(|((name, key), moved)| (name, key, moved.share)).collect()
}

/// Relative changes of estimates, in words; `None` if there are none.
fn changed(shares: impl Iterator<Item = (&'static str, f64)>) -> Option<String> {
    let parts = shares.map(|(name, share)| {
        let more = if share < 0.0 { "lower" } else { "higher" };
        format!("{name} {} % {more}", significant(100.0 * share.abs(), 2))
    });
    Some(parts.collect::<Vec<_>>().join(", ")).filter(|text| !text.is_empty())
}

/// The changes of the estimates by a missing term, in words.
pub(super) fn moved_by(term: &MissingTerm) -> String {
    let moved = moved(&term.moves).into_iter();
    match changed(moved.map(|(name, _, share)| (name, share))) {
        None => "with it no estimate changes by more than its standard error".to_owned(),
        Some(changes) => format!("with it the estimates would change ({changes})"),
    }
}

/// The changes of the estimates if the mode were left out, in words.
pub(super) fn without_mode(mode: &HiddenMode) -> String {
    let moved = moved(&mode.moves).into_iter();
    match changed(moved.map(|(name, _, share)| (name, 1.0 / (1.0 + share) - 1.0))) {
        None => "Without the mode no estimate changes by more than its standard error".to_owned(),
        Some(changes) => format!("Without the mode the estimates would change ({changes})"),
    }
}
