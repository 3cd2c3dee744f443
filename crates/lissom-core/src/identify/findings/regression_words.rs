//! Findings of the regression in words: missing terms, a mode, an assumed hold, and the estimates that they move.

use lissom_text::significant;

use crate::finding::result_key as key;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::{
    LawTerm, MissingKind, MissingTerm, ModelTerm, Moved, MovingTerm,
};
use crate::identify::methods::regression::{HiddenMode, OtherHold};

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

/// Names, result keys and relative changes of the estimates that a term changes by more than their standard errors.
fn moved(moves: &[Moved; 3]) -> Vec<(&'static str, &'static str, f64)> {
    let names = [
        ("inertia", key::INERTIA),
        ("viscous friction", key::VISCOUS),
        ("Coulomb friction", key::COULOMB),
    ];
    let felt = names.into_iter().zip(moves);
    let felt = felt.filter(|(_, moved)| moved.standard_errors.abs() > FELT);
    felt.map(|((name, key), moved)| (name, key, moved.share)).collect()
}

/// Result keys of these estimates.
pub(super) fn moved_keys(moves: &[Moved; 3]) -> Vec<&'static str> {
    moved(moves).into_iter().map(|(_, key, _)| key).collect()
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

/// A term that is not known to be absent, and what it would change, in words.
pub(super) fn possible(term: &MovingTerm) -> (&'static str, String) {
    let named = match term.term {
        ModelTerm::Law(LawTerm::ViscousByDirection) => "viscous friction that differs by direction",
        ModelTerm::Law(LawTerm::CommandLag) => "a lag between command and angle",
        ModelTerm::Law(LawTerm::Root) => "friction with the square root of speed",
        ModelTerm::Law(LawTerm::NearRest { .. }) => "more or less friction near standstill",
        ModelTerm::Law(LawTerm::WithLoad { .. }) => "friction that grows with the load",
        ModelTerm::Law(LawTerm::Ripple { .. }) => "friction that changes over the travel in waves",
        ModelTerm::Law(LawTerm::TorqueRipple { .. }) => "cogging",
        ModelTerm::Missing(MissingKind::Position) => "a torque in proportion to the angle",
        ModelTerm::Missing(MissingKind::Gravity) => "an unbalanced load",
        ModelTerm::Missing(MissingKind::BeamDamping) => "damping within the beam",
        ModelTerm::Missing(MissingKind::CommandBySign) => "a torque constant that differs by sign",
        ModelTerm::Missing(MissingKind::WithTorque) => {
            "friction that grows with the motor's torque"
        }
        ModelTerm::Missing(MissingKind::OverTravel) => "friction that varies over the travel",
        ModelTerm::Missing(MissingKind::CoulombDrift) => "Coulomb friction that drifts",
        ModelTerm::Missing(MissingKind::ViscousDrift) => "viscous friction that drifts",
    };
    let changes = changed(moved(&term.moves).into_iter().map(|(name, _, share)| (name, share)));
    (named, changes.unwrap_or_default())
}

/// The changes of the estimates if the mode were left out, in words.
pub(super) fn without_mode(mode: &HiddenMode) -> String {
    let moved = moved(&mode.moves).into_iter();
    match changed(moved.map(|(name, _, share)| (name, 1.0 / (1.0 + share) - 1.0))) {
        None => "Without the mode no estimate changes by more than its standard error".to_owned(),
        Some(changes) => format!("Without the mode the estimates would change ({changes})"),
    }
}
