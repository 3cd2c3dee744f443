//! Terms of dry friction besides Coulomb friction: a change near rest, ripple over the travel, growth with the root of speed
//! and with the torque of gravity.

use super::near_rest::{NearRest, NearRestNumber, NearRestSeries};
use super::place::Place;
use super::ripple::{Ripple, RippleNumber, RippleSeries};
use super::root::{Root, RootSeries};
use super::taylor_row::Row;
use super::with_load::{WithLoad, WithLoadSeries};

/// Terms of dry friction besides Coulomb friction and offset. The torque of a sliding joint is
/// `s·(A_s·e^{−|θ̇|/v_s} + Σ_r B_r·cos k_rθ + C_r·sin k_rθ + A·√|θ̇| + μ·|g_s·sin θ + g_c·cos θ|)`, with the direction of
/// motion s = ±1.
///
/// The symbols are explained at [`NearRest`], [`Ripple`], [`Root`] and [`WithLoad`]. Rig, replay and identification share these terms.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DryTerms {
    /// Change of friction near rest, if there is any.
    pub near_rest: Option<NearRest>,
    /// Ripples: waves of friction over the angle.
    pub ripples: Vec<Ripple>,
    /// Friction that grows with the square root of speed, if there is any.
    pub root: Option<Root>,
    /// Friction that grows with the torque of gravity, if there is any.
    pub with_load: Option<WithLoad>,
}

impl DryTerms {
    /// Whether there are no terms.
    pub fn is_empty(&self) -> bool {
        let by_place = self.ripples.is_empty() && self.with_load.is_none();
        self.near_rest.is_none() && self.root.is_none() && by_place
    }

    /// The least that they brake by, at any speed and angle \[N·m\]; negative where they drive, without a bound for a
    /// negative root.
    pub(crate) fn least_braking_nm(&self) -> f64 {
        let near = self.near_rest.map_or(0.0, |n| n.torque_nm.min(0.0));
        let falls = self.root.is_some_and(|r| r.torque_nm_per_root_rad_s < 0.0);
        let root = if falls { f64::NEG_INFINITY } else { 0.0 };
        let load = self.with_load.map_or(0.0, |l| l.largest_nm().min(0.0));
        near + root + load - self.ripples.iter().map(|r| r.cosine_nm.hypot(r.sine_nm)).sum::<f64>()
    }

    /// The scales over which they change.
    pub(crate) fn scales(&self) -> impl Iterator<Item = TermScale> {
        let near = self.near_rest.iter().map(|n| TermScale::Speed(n.speed_rad_s));
        near.chain(self.ripples.iter().map(|r| TermScale::PerAngle(r.per_rad)))
    }

    /// Torque against the motion \[N·m\].
    pub(crate) fn braking_nm(&self, at: Place) -> f64 {
        let near = self.near_rest.map_or(0.0, |n| n.braking_nm(at));
        let root = self.root.map_or(0.0, |r| r.braking_nm(at));
        let load = self.with_load.map_or(0.0, |l| l.braking_nm(at));
        near + root + load + self.ripples.iter().map(|r| r.braking_nm(at)).sum::<f64>()
    }

    /// Their torque on the motor, signed.
    pub(crate) fn torque_nm(&self, at: Place) -> f64 {
        at.sign * self.braking_nm(at)
    }

    /// Derivatives of that by the angle and by the velocity.
    pub(crate) fn slopes(&self, at: Place) -> [f64; 2] {
        let load = self.with_load.map_or(0.0, |l| l.slope(at));
        let by_angle = load + self.ripples.iter().map(|r| r.slope(at)).sum::<f64>();
        let root = self.root.map_or(0.0, |r| r.slope(at));
        [at.sign * by_angle, root + self.near_rest.map_or(0.0, |n| n.slope(at))]
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
            FrictionNumber::Root => self.root.map_or(0.0, |_| Root::growth(at.speed)),
            FrictionNumber::WithLoad => self.with_load.map_or(0.0, |l| l.load_nm(at.angle)),
        };
        at.sign * by
    }

    /// All numbers in them.
    pub(crate) fn numbers(&self) -> Vec<FrictionNumber> {
        let of_ripple = |i| RippleNumber::ALL.map(|number| FrictionNumber::Ripple(i, number));
        let near = self.near_rest.iter().flat_map(|_| NearRestNumber::ALL);
        let near = near.map(FrictionNumber::NearRest);
        let root = self.root.map(|_| FrictionNumber::Root);
        let load = self.with_load.map(|_| FrictionNumber::WithLoad);
        near.chain((0..self.ripples.len()).flat_map(of_ripple)).chain(root).chain(load).collect()
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
        let root = self.root.map(|_| Root::step_s(at, acceleration));
        let load = self.with_load.map(|l| l.step_s(at, turning));
        let ripples = self.ripples.iter().map(|r| r.step_s(turning));
        near.chain(root).chain(load).chain(ripples).fold(f64::INFINITY, f64::min)
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
    /// A, the torque of the term with the square root of speed.
    Root,
    /// μ, the coefficient of the term with the torque of gravity.
    WithLoad,
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
            // Friction of A acts at 1 rad/s.
            Self::Root => true,
            Self::WithLoad => false,
        }
    }

    /// Name in results; ripples are counted from one.
    pub fn name(self) -> String {
        match self {
            Self::NearRest(number) => number.name().to_owned(),
            Self::Ripple(i, number) => format!("{}-{}", number.name(), i + 1),
            Self::Root => "root".to_owned(),
            Self::WithLoad => "with-load".to_owned(),
        }
    }

    /// Value of the parameter; zero if its term is absent.
    pub fn of(self, terms: &DryTerms) -> f64 {
        match self {
            Self::NearRest(number) => terms.near_rest.map_or(0.0, |n| number.of(&n)),
            Self::Ripple(i, number) => terms.ripples.get(i).map_or(0.0, |r| number.of(r)),
            Self::Root => terms.root.map_or(0.0, |r| r.torque_nm_per_root_rad_s),
            Self::WithLoad => terms.with_load.map_or(0.0, |l| l.coefficient),
        }
    }

    /// Sets the value; does nothing if its term is absent.
    pub fn set(self, terms: &mut DryTerms, value: f64) {
        let place = match self {
            Self::NearRest(number) => terms.near_rest.as_mut().map(|n| number.in_term(n)),
            Self::Ripple(i, number) => terms.ripples.get_mut(i).map(|r| number.in_term(r)),
            Self::Root => terms.root.as_mut().map(|r| &mut r.torque_nm_per_root_rad_s),
            Self::WithLoad => terms.with_load.as_mut().map(|l| &mut l.coefficient),
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
    root: RootSeries,
    with_load: WithLoadSeries,
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
        let root = terms.root.map_or(0.0, |r| self.root.next(r, k, sign, velocity));
        let load = terms.with_load.map_or(0.0, |l| self.with_load.next(&l, k, angle));
        near + root
            + load
            + ripples.map(|(series, ripple)| series.next(ripple, k, angle)).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::GravityLoad;

    /// By angle, velocity and every parameter, in both directions.
    #[test]
    fn derivatives_are_those_of_the_torque() {
        let terms = DryTerms {
            near_rest: Some(NearRest {
                torque_nm: 0.1,
                offset_nm: 0.02,
                speed_rad_s: 0.7,
                falloff: super::super::Falloff::Gaussian,
            }),
            ripples: vec![Ripple { per_rad: 3.0, cosine_nm: 0.02, sine_nm: -0.01 }],
            root: Some(Root { torque_nm_per_root_rad_s: 0.2 }),
            with_load: Some(WithLoad {
                coefficient: 0.05,
                load: GravityLoad { sine_nm: 3.0, cosine_nm: 1.0 },
            }),
        };
        let h = 1e-6;
        for sign in [1.0, -1.0] {
            let at = |angle: f64, velocity: f64| Place { angle, speed: sign * velocity, sign };
            let (q, v) = (0.4, sign * 0.5);
            let near = |difference: f64, slope: f64| {
                assert!((difference / (2.0 * h) - slope).abs() < 1e-8, "{difference} {slope}");
            };
            let torque = |angle, velocity| terms.torque_nm(at(angle, velocity));
            let [by_angle, by_velocity] = terms.slopes(at(q, v));
            near(torque(q + h, v) - torque(q - h, v), by_angle);
            near(torque(q, v + h) - torque(q, v - h), by_velocity);
            for number in terms.numbers() {
                let with = |change: f64| {
                    let mut moved = terms.clone();
                    number.set(&mut moved, number.of(&terms) + change);
                    moved.torque_nm(at(q, v))
                };
                near(with(h) - with(-h), terms.torque_by(number, at(q, v)));
            }
        }
    }
}
