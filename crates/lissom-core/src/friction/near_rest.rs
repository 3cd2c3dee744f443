//! Friction that changes near rest: the Stribeck effect, or friction that grows less than in proportion to speed.

use super::falloff::Falloff;
use super::place::Place;
use super::taylor_row::Row;

/// Largest share of v_s by which the speed may move over a step with friction linear in time.
const SHARE_PER_STEP: f64 = 0.4;
/// Largest (rate × step) at which friction that falls with speed lets the speed grow, and the same where
/// the motor has just been let go: what it errs by there grows with it.
const GROWTH: f64 = 0.5;
const LET_GO: f64 = 0.1;
/// Share of v_s by which the law is continued beyond a reversal.
const CONTINUED: f64 = -0.5;
/// Speeds at which nothing of it is left, over v_s: of an exponential, and of a Gaussian.
const GONE: [f64; 2] = [9.0, 3.0];

/// Change of friction near rest: the torque against the motion is `s·(A_s + s·a_s)·e^{−|θ̇|/v_s}` or
/// `s·(A_s + s·a_s)·e^{−(θ̇/v_s)²}`, with the direction of motion s = ±1.
///
/// # Source
/// `[Armstrong1994]`. A_s > 0 is the Stribeck effect; with A_s < 0 friction grows less than in proportion to speed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NearRest {
    /// A_s \[N·m\]: friction at rest minus Coulomb friction, mean of both directions.
    #[cfg_attr(feature = "serde", serde(rename = "amplitude"))]
    pub torque_nm: f64,
    /// a_s \[N·m\]: half the difference of that change, forward minus backward.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub offset_nm: f64,
    /// v_s \[rad/s\]: speed over which friction changes.
    #[cfg_attr(feature = "serde", serde(rename = "speed"))]
    pub speed_rad_s: f64,
    /// Exponential or Gaussian.
    pub falloff: Falloff,
}

/// A parameter of [`NearRest`] that a search may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NearRestNumber {
    /// A_s, the torque.
    Torque,
    /// v_s, the speed.
    Speed,
}

impl NearRestNumber {
    /// All of them.
    pub(super) const ALL: [Self; 2] = [Self::Torque, Self::Speed];

    /// Its name in results.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Torque => "near-rest",
            Self::Speed => "near-rest-speed",
        }
    }

    /// Its value.
    pub(super) fn of(self, term: &NearRest) -> f64 {
        match self {
            Self::Torque => term.torque_nm,
            Self::Speed => term.speed_rad_s,
        }
    }

    /// Its place in the term.
    pub(super) fn in_term(self, term: &mut NearRest) -> &mut f64 {
        match self {
            Self::Torque => &mut term.torque_nm,
            Self::Speed => &mut term.speed_rad_s,
        }
    }
}

impl NearRest {
    /// Torque against the motion \[N·m\].
    pub(super) fn braking_nm(&self, at: Place) -> f64 {
        self.at_rest_nm(at.sign) * self.share(at.speed)
    }

    /// Derivative of the torque by the velocity.
    pub(super) fn slope(&self, at: Place) -> f64 {
        -(self.at_rest_nm(at.sign) * self.falls(at.speed) / self.speed_rad_s)
    }

    /// Derivative of the torque against the motion by one of its numbers.
    pub(super) fn braking_by(&self, number: NearRestNumber, at: Place) -> f64 {
        match number {
            NearRestNumber::Torque => self.share(at.speed),
            NearRestNumber::Speed => {
                self.at_rest_nm(at.sign) * self.falls(at.speed) * at.speed
                    / self.speed_rad_s.powi(2)
            }
        }
    }

    /// Longest step over which it may be taken for linear in time \[s\], where the motor slows down to the place's
    /// speed at most, accelerates by `acceleration`, and by `per_torque` more per torque.
    pub(super) fn step_s(&self, at: Place, acceleration: f64, per_torque: f64) -> f64 {
        if !self.acts_at(at.speed) {
            return f64::INFINITY;
        }
        let moves = SHARE_PER_STEP * self.speed_rad_s / acceleration.abs();
        let growth = if at.speed < self.speed_rad_s { LET_GO } else { GROWTH };
        moves.min(growth * self.speed_rad_s / (per_torque * self.at_rest_nm(at.sign)).abs())
    }

    fn at_rest_nm(&self, sign: f64) -> f64 {
        self.torque_nm + sign * self.offset_nm
    }

    /// What of it is there at a speed.
    fn share(&self, speed: f64) -> f64 {
        self.falloff.share(self.ratio(speed))
    }

    /// By how much that falls as the speed rises by v_s.
    fn falls(&self, speed: f64) -> f64 {
        let steeper = match self.falloff {
            Falloff::Exponential => 1.0,
            Falloff::Gaussian => 2.0 * self.ratio(speed),
        };
        steeper * self.share(speed)
    }

    fn ratio(&self, speed: f64) -> f64 {
        (speed / self.speed_rad_s).max(CONTINUED)
    }

    /// Whether anything is left of it at a speed.
    fn acts_at(&self, speed: f64) -> bool {
        let gone = match self.falloff {
            Falloff::Exponential => GONE[0],
            Falloff::Gaussian => GONE[1],
        };
        speed < gone * self.speed_rad_s
    }
}

/// Taylor coefficients along a motion. For `f = e^u`: `k·f_k = Σ j·u_j·f_{k−j}`.
#[derive(Debug, Clone, Default)]
pub(super) struct NearRestSeries {
    exponent: Row,
    fall: Row,
}

impl NearRestSeries {
    /// The coefficient of order `k` of the torque against the motion, in the direction of `sign`.
    pub(super) fn next(&mut self, law: &NearRest, k: usize, sign: f64, velocity: &Row) -> f64 {
        let scale = 1.0 / law.speed_rad_s;
        self.exponent[k] = match law.falloff {
            Falloff::Exponential => -sign * scale * velocity[k],
            Falloff::Gaussian => {
                let square: f64 = (0..=k).map(|j| velocity[j] * velocity[k - j]).sum();
                -scale * scale * square
            }
        };
        self.fall[k] = if k == 0 {
            self.exponent[0].exp()
        } else {
            let sum: f64 = (1..=k).map(|j| j as f64 * self.exponent[j] * self.fall[k - j]).sum();
            sum / k as f64
        };
        law.at_rest_nm(sign) * self.fall[k]
    }
}
