//! When a slip ends.

use crate::lti::first_root::first_nonpositive;

/// How long something goes on as it is.
#[derive(Debug, Clone, Copy)]
pub(super) enum Contact<E> {
    /// Throughout the step.
    Lasts,
    /// Until a time \[s\].
    Ends(f64, E),
    /// It should start from rest and does not.
    Undecided(E),
}

impl<E> Contact<E> {
    pub(super) fn map<T>(self, f: impl FnOnce(E) -> T) -> Contact<T> {
        match self {
            Self::Lasts => Contact::Lasts,
            Self::Ends(time, event) => Contact::Ends(time, f(event)),
            Self::Undecided(event) => Contact::Undecided(f(event)),
        }
    }
}

/// When a slip ends, its velocity in its own direction being a polynomial in time; `rounding` is
/// what accelerations are known to.
pub(super) fn slip_ends<E>(velocity: &[f64], step: f64, rounding: f64, event: E) -> Contact<E> {
    // From rest the root at the start is divided out. Released between samples, what slips starts
    // with no acceleration but rounding, and that root is double.
    let roots = match (velocity[0] == 0.0, velocity[1].abs() <= rounding) {
        (false, _) => 0,
        (true, false) => 1,
        (true, true) => 2,
    };
    let polynomial = &velocity[roots..];
    if polynomial[0] <= 0.0 {
        return Contact::Undecided(event);
    }
    match first_nonpositive(polynomial, step) {
        Some(time) => Contact::Ends(time, event),
        None => Contact::Lasts,
    }
}
