//! Friction that grows with the square root of speed.

use super::place::Place;
use super::square_root_series::SquareRootSeries;
use super::taylor_row::Row;

/// Speed e that makes the square root smooth at rest \[rad/s\]: far below the speeds of any log. The law differs from
/// `A·√|v|` by at most `√e·A` = 1e-4·A.
pub const ROOT_SPEED_RAD_S: f64 = 1e-8;

/// Largest change of the speed over a step with friction linear in time, relative to the speed.
const SHARE_PER_STEP: f64 = 0.4;

/// Friction that grows with the square root of speed: the torque against the motion is `s·A·(√(|v| + e) − √e)`, with the
/// velocity v of the motor, its direction s = ±1 and e = [`ROOT_SPEED_RAD_S`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Root {
    /// A \[N·m/√(rad/s)\].
    #[cfg_attr(feature = "serde", serde(rename = "amplitude"))]
    pub torque_nm_per_root_rad_s: f64,
}

impl Root {
    /// Torque against the motion \[N·m\].
    pub(super) fn braking_nm(self, at: Place) -> f64 {
        self.torque_nm_per_root_rad_s * Self::growth(at.speed)
    }

    /// √(|v| + e) − √e, without the difference of nearly equal numbers. Beyond a reversal it is zero.
    #[inline]
    pub(crate) fn growth(speed: f64) -> f64 {
        let speed = speed.max(0.0);
        speed / ((speed + ROOT_SPEED_RAD_S).sqrt() + ROOT_SPEED_RAD_S.sqrt())
    }

    /// Derivative of the torque by the velocity.
    pub(super) fn slope(self, at: Place) -> f64 {
        0.5 * self.torque_nm_per_root_rad_s / (at.speed.max(0.0) + ROOT_SPEED_RAD_S).sqrt()
    }

    /// Longest step over which it may be taken for linear in time \[s\], where the motor slows down to the place's
    /// speed at most and accelerates by `acceleration`.
    pub(super) fn step_s(at: Place, acceleration: f64) -> f64 {
        SHARE_PER_STEP * at.speed / acceleration.abs()
    }
}

/// Taylor coefficients along a motion.
#[derive(Debug, Clone, Default)]
pub(super) struct RootSeries {
    root: SquareRootSeries,
}

impl RootSeries {
    /// The coefficient of order `k` of the torque against the motion, in the direction of `sign`.
    pub(super) fn next(&mut self, law: Root, k: usize, sign: f64, velocity: &Row) -> f64 {
        let speed = sign * velocity[k];
        let rest = if k == 0 { ROOT_SPEED_RAD_S } else { 0.0 };
        let root = self.root.next(k, if k == 0 { speed.max(0.0) } else { speed } + rest);
        law.torque_nm_per_root_rad_s * if k == 0 { Root::growth(speed) } else { root }
    }
}

#[cfg(test)]
mod tests {
    use super::super::taylor_row::COEFFICIENTS;
    use super::*;

    const LAW: Root = Root { torque_nm_per_root_rad_s: 0.3 };

    fn at(speed: f64) -> Place {
        Place { angle: 0.0, speed, sign: 1.0 }
    }

    #[test]
    fn it_is_the_square_root_of_speed_within_its_bound_and_zero_at_rest() {
        let most = 0.3 * ROOT_SPEED_RAD_S.sqrt();
        for speed in [0.0_f64, 1e-12, 1e-8, 1e-3, 0.5, 40.0] {
            let less = 0.3 * speed.sqrt() - LAW.braking_nm(at(speed));
            assert!((0.0..=most).contains(&less), "{speed} {less}");
        }
        assert!(LAW.braking_nm(at(0.0)) == 0.0 && LAW.braking_nm(at(-1e-3)) == 0.0);
    }

    #[test]
    fn its_slope_is_its_difference() {
        for speed in [1e-8, 1e-4, 0.5, 40.0] {
            let h = 1e-4 * speed;
            let difference = LAW.braking_nm(at(speed + h)) - LAW.braking_nm(at(speed - h));
            assert!((difference / (2.0 * h) / LAW.slope(at(speed)) - 1.0).abs() < 1e-6, "{speed}");
        }
    }

    /// From rest, where the square root is sharpest: v = a·t up to a tenth of e.
    #[test]
    fn its_series_adds_up_to_the_law_from_rest() {
        let mut velocity = [0.0; COEFFICIENTS];
        velocity[1] = -3.0;
        let (t, mut power, mut sum) = (0.1 * ROOT_SPEED_RAD_S / 3.0, 1.0, 0.0);
        let mut series = RootSeries::default();
        for k in 0..COEFFICIENTS {
            sum += power * series.next(LAW, k, -1.0, &velocity);
            power *= t;
        }
        assert!((sum / LAW.braking_nm(at(3.0 * t)) - 1.0).abs() < 1e-14, "{sum}");
    }
}
