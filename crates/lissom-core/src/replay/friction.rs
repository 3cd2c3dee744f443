//! Dry friction on the replayed motor, and its effect over a step in which it is linear in time.

use super::modal_arm::ModalArm;
use super::parameter::Parameter;
use crate::friction::{DryTerms, Place};

/// Most rounds until friction at the end of a step and the motion there agree, and the share of the
/// Coulomb friction within which they do.
const ROUNDS: usize = 40;
const AGREE: f64 = 1e-14;

/// Coulomb friction, offset and further terms, with what they depend on.
#[derive(Debug, Clone)]
pub(super) struct Friction {
    pub(super) coulomb: f64,
    pub(super) offset: f64,
    pub(super) terms: DryTerms,
}

/// Friction over a step, linear in time: its ends, and the derivatives of that by angle and velocity.
///
/// Both ends are moved alike by what the mean over the step is beside that of a straight line, so that
/// the impulse is right to the fourth order of the step. Tangents leave that out.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    pub(super) from: f64,
    pub(super) to: f64,
    places: [Place; 2],
    slopes: [[f64; 2]; 2],
    /// How much less the end's friction changes because the motion there changes with it: 1 + κ.
    stiffer: f64,
}

/// A step as it would be if friction stayed what it is at its beginning.
pub(super) struct Held<'a, const D: usize> {
    pub(super) from: &'a [f64; D],
    pub(super) to: [f64; D],
    /// Responses of the end to a torque, and to one that grows from zero.
    pub(super) push: &'a [f64; D],
    pub(super) ramp: &'a [f64; D],
    /// The motor's acceleration at the beginning.
    pub(super) acceleration: f64,
    pub(super) duration_s: f64,
}

impl<const D: usize> Held<'_, D> {
    /// The end where friction has these values at both ends, and `first` was what it stayed at.
    pub(super) fn end(&self, first: f64, ends: [f64; 2]) -> [f64; 2] {
        let (shift, rise) = (ends[0] - first, ends[1] - ends[0]);
        [0, 1].map(|i| self.to[i] - shift * self.push[i] - rise * self.ramp[i])
    }

    /// Halfway, the end being `end`: the angle and the velocity.
    fn middle(&self, end: [f64; 2]) -> [f64; 2] {
        let gained = self.acceleration * self.duration_s;
        [
            self.from[0] + self.duration_s * (0.5 * self.from[1] + 0.125 * gained),
            0.25 * (3.0 * self.from[1] + end[1] + gained),
        ]
    }
}

/// Forward is +1, backward −1.
pub(super) fn sign(direction: usize) -> f64 {
    if direction == 0 { 1.0 } else { -1.0 }
}

fn place(x: &[f64], direction: usize) -> Place {
    let sign = sign(direction);
    Place { angle: x[0], speed: sign * x[1], sign }
}

impl Friction {
    pub(super) fn new(arm: &ModalArm) -> Self {
        Self { coulomb: arm.coulomb_nm, offset: arm.offset_nm, terms: arm.dry_terms.clone() }
    }

    /// Signed torque while slipping.
    pub(super) fn torque<const D: usize>(&self, x: &[f64; D], direction: usize) -> f64 {
        let constant = sign(direction) * self.coulomb + self.offset;
        if self.terms.is_empty() { constant } else { constant + self.beyond(place(x, direction)) }
    }

    fn beyond(&self, at: Place) -> f64 {
        self.terms.torque_nm(at)
    }

    /// Derivatives of it by angle and velocity.
    pub(super) fn slopes<const D: usize>(&self, x: &[f64; D], direction: usize) -> [f64; 2] {
        self.terms.slopes(place(x, direction))
    }

    /// Its derivative by a parameter of its own.
    pub(super) fn by<const D: usize>(&self, p: Parameter, x: &[f64; D], direction: usize) -> f64 {
        self.by_at(p, place(x, direction))
    }

    fn by_at(&self, p: Parameter, at: Place) -> f64 {
        match p {
            Parameter::Coulomb => at.sign,
            Parameter::Offset => 1.0,
            Parameter::Friction(number) => self.terms.torque_by(number, at),
            _ => 0.0,
        }
    }

    /// Longest step over which it may be taken for linear in time \[s\].
    pub(super) fn step_s<const D: usize>(
        &self,
        x: &[f64; D],
        direction: usize,
        (acceleration, per_torque): (f64, f64),
        within_s: f64,
    ) -> f64 {
        let mut at = place(x, direction);
        // Within the step it may come closer to rest.
        at.speed = (at.speed - acceleration.abs() * within_s).max(0.0);
        let turning = x[1].abs() + acceleration.abs() * within_s;
        self.terms.step_s(at, turning, acceleration, per_torque)
    }

    /// Over a step.
    pub(super) fn over<const D: usize>(&self, step: &Held<'_, D>, direction: usize) -> Ends {
        let from = self.torque(step.from, direction);
        let first = place(step.from, direction);
        if self.terms.is_empty() {
            let none = [[0.0; 2]; 2];
            return Ends { from, to: from, places: [first; 2], slopes: none, stiffer: 1.0 };
        }
        let constant = from - self.beyond(first);
        let at = |x: &[f64]| constant + self.beyond(place(x, direction));
        // Let go, it begins without a push, and would be pushed back at once.
        let moving = if step.from[1] == 0.0 { 0.0 } else { 1.0 };
        let (mut ends, mut end) = ([from; 2], [step.to[0], step.to[1]]);
        for _ in 0..ROUNDS {
            let (last, middle) = (at(&end), at(&step.middle(end)));
            let bent = moving * (2.0 * middle - from - last) / 3.0;
            let next = [from + bent, last + bent];
            let agrees = (next[1] - ends[1]).abs() <= AGREE * (from.abs() + self.coulomb.abs());
            ends = next;
            end = step.end(from, ends);
            if agrees {
                break;
            }
        }
        let last = place(&end, direction);
        let slopes = [self.terms.slopes(first), self.terms.slopes(last)];
        let stiffer = 1.0 + slopes[1][0] * step.ramp[0] + slopes[1][1] * step.ramp[1];
        Ends { from: ends[0], to: ends[1], places: [first, last], slopes, stiffer }
    }

    /// What both ends change by, for a tangent of the motor that is `start` and, if the end's friction did not change
    /// with it, would be `end_of(d)` for d at the beginning.
    pub(super) fn tangent(
        &self,
        ends: &Ends,
        own: Option<Parameter>,
        start: &[f64; 2],
        end_of: impl FnOnce(f64) -> [f64; 2],
    ) -> [f64; 2] {
        let own = |k: usize| own.map_or(0.0, |p| self.by_at(p, ends.places[k]));
        let change =
            |k: usize, s: &[f64; 2]| own(k) + ends.slopes[k][0] * s[0] + ends.slopes[k][1] * s[1];
        let first = change(0, start);
        [first, change(1, &end_of(first)) / ends.stiffer]
    }
}
