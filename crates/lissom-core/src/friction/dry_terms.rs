//! Terms of dry friction besides Coulomb friction: a change near rest, and ripple over the travel.

use super::near_rest::{NearRest, NearRestNumber, NearRestSeries};
use super::place::Place;
use super::ripple::{Ripple, RippleNumber, RippleSeries};
use super::taylor_row::Row;

/// Terms of dry friction besides Coulomb friction and offset. The torque of a sliding joint is
/// `s·(A_s·e^{−|θ̇|/v_s} + Σ_r B_r·cos k_rθ + C_r·sin k_rθ)`, with the direction of motion s = ±1.
///
/// The symbols are explained at [`NearRest`] and [`Ripple`]. Rig, replay and identification share these terms.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DryTerms {
    /// Change of friction near rest, if there is any.
    pub near_rest: Option<NearRest>,
    /// Ripples: waves of friction over the angle.
    pub ripples: Vec<Ripple>,
}

impl DryTerms {
    /// Whether there are no terms.
    pub fn is_empty(&self) -> bool {
        self.near_rest.is_none() && self.ripples.is_empty()
    }

    /// The least that they brake by, at any speed and angle \[N·m\]; negative where they drive.
    pub(crate) fn least_braking_nm(&self) -> f64 {
        let near = self.near_rest.map_or(0.0, |n| n.torque_nm.min(0.0));
        near - self.ripples.iter().map(|r| r.cosine_nm.hypot(r.sine_nm)).sum::<f64>()
    }

    /// The scales over which they change.
    pub(crate) fn scales(&self) -> impl Iterator<Item = TermScale> {
        let near = self.near_rest.iter().map(|n| TermScale::Speed(n.speed_rad_s));
        near.chain(self.ripples.iter().map(|r| TermScale::PerAngle(r.per_rad)))
    }

    /// Torque against the motion \[N·m\].
    pub(crate) fn braking_nm(&self, at: Place) -> f64 {
        let near = self.near_rest.map_or(0.0, |n| n.braking_nm(at));
        near + self.ripples.iter().map(|r| r.braking_nm(at)).sum::<f64>()
    }

    /// Their torque on the motor, signed.
    pub(crate) fn torque_nm(&self, at: Place) -> f64 {
        at.sign * self.braking_nm(at)
    }

    /// Derivatives of that by the angle and by the velocity.
    pub(crate) fn slopes(&self, at: Place) -> [f64; 2] {
        let by_angle = self.ripples.iter().map(|r| r.slope(at)).sum::<f64>();
        [at.sign * by_angle, self.near_rest.map_or(0.0, |n| n.slope(at))]
    }

    /// Derivative of that by one of the terms' own numbers.
    pub(crate) fn torque_by(&self, number: FrictionNumber, at: Place) -> f64 {
        let by = match number {
            FrictionNumber::NearRest(number) => {
                self.near_rest.map_or(0.0, |n| n.braking_by(number, at))
            }
            FrictionNumber::Ripple(i, number) => {
                self.ripples.get(i).map_or(0.0, |r| r.braking_by(number, at))
            }
        };
        at.sign * by
    }

    /// All numbers in them.
    pub(crate) fn numbers(&self) -> Vec<FrictionNumber> {
        let of_ripple = |i| RippleNumber::ALL.map(|number| FrictionNumber::Ripple(i, number));
        let near = self.near_rest.iter().flat_map(|_| NearRestNumber::ALL);
        let near = near.map(FrictionNumber::NearRest);
        near.chain((0..self.ripples.len()).flat_map(of_ripple)).collect()
    }

    /// Longest step over which friction may be taken for linear in time \[s\], for a motor that turns at
    /// `turning` at most, slows down to the place's speed at most, accelerates by `acceleration`, and by
    /// `per_torque` more per torque.
    pub(crate) fn step_s(
        &self,
        at: Place,
        turning: f64,
        acceleration: f64,
        per_torque: f64,
    ) -> f64 {
        let near = self.near_rest.iter().map(|n| n.step_s(at, acceleration, per_torque));
        near.chain(self.ripples.iter().map(|r| r.step_s(turning))).fold(f64::INFINITY, f64::min)
    }
}

/// What a term changes over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TermScale {
    /// A speed \[rad/s\].
    Speed(f64),
    /// Waves over the angle \[rad per rad\].
    PerAngle(f64),
}

/// A parameter of [`DryTerms`] that a search may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrictionNumber {
    /// Parameter of the change near rest.
    NearRest(NearRestNumber),
    /// Parameter of a ripple; ripples are counted from zero.
    Ripple(usize, RippleNumber),
}

impl FrictionNumber {
    /// Whether the parameter is positive and may span decades, so that a search changes its logarithm.
    pub fn is_scale(self) -> bool {
        self == Self::NearRest(NearRestNumber::Speed)
    }

    /// Whether the parameter is a torque, comparable with Coulomb friction. A term whose
    /// torques are all zero has no effect.
    pub fn is_torque(self) -> bool {
        match self {
            Self::NearRest(number) => number == NearRestNumber::Torque,
            Self::Ripple(_, number) => number != RippleNumber::Rate,
        }
    }

    /// Name in results; ripples are counted from one.
    pub fn name(self) -> String {
        match self {
            Self::NearRest(number) => number.name().to_owned(),
            Self::Ripple(i, number) => format!("{}-{}", number.name(), i + 1),
        }
    }

    /// Value of the parameter; zero if its term is absent.
    pub fn of(self, terms: &DryTerms) -> f64 {
        match self {
            Self::NearRest(number) => terms.near_rest.map_or(0.0, |n| number.of(&n)),
            Self::Ripple(i, number) => terms.ripples.get(i).map_or(0.0, |r| number.of(r)),
        }
    }

    /// Sets the value; does nothing if its term is absent.
    pub fn set(self, terms: &mut DryTerms, value: f64) {
        let place = match self {
            Self::NearRest(number) => terms.near_rest.as_mut().map(|n| number.in_term(n)),
            Self::Ripple(i, number) => terms.ripples.get_mut(i).map(|r| number.in_term(r)),
        };
        if let Some(place) = place {
            *place = value;
        }
    }
}

/// Taylor coefficients of the terms' torque along a motion, one after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct TermSeries {
    near_rest: NearRestSeries,
    ripples: Vec<RippleSeries>,
}

impl TermSeries {
    /// The coefficient of order `k` of the torque against the motion while slipping in the direction of `sign`,
    /// from those of angle and velocity up to that order.
    pub(crate) fn next(
        &mut self,
        terms: &DryTerms,
        k: usize,
        sign: f64,
        (angle, velocity): (&Row, &Row),
    ) -> f64 {
        self.ripples.resize_with(terms.ripples.len(), RippleSeries::default);
        let near = terms.near_rest.map_or(0.0, |n| self.near_rest.next(&n, k, sign, velocity));
        let ripples = self.ripples.iter_mut().zip(&terms.ripples);
        near + ripples.map(|(series, ripple)| series.next(ripple, k, angle)).sum::<f64>()
    }
}
