//! Friction that grows with the torque of gravity.

use super::phase_series::PhaseSeries;
use super::place::Place;
use super::square_root_series::SquareRootSeries;
use super::taylor_row::Row;
use crate::load::GravityLoad;

/// Torque d over which |g| is rounded where gravity changes its sign, relative to the largest torque of gravity \[1\].
pub const ROUNDED_LOAD_SHARE: f64 = 1e-3;

/// Largest change of gravity over a step with friction linear in time, relative to √(g² + d²).
const SHARE_PER_STEP: f64 = 0.4;

/// Friction that grows with the torque of gravity, as that of a loaded gear: the torque against the motion is
/// `s·μ·√(g² + d²)`, with `g = g_s·sin θ + g_c·cos θ`, the direction of motion s = ±1 and d = [`ROUNDED_LOAD_SHARE`] times
/// the largest g. It differs from `s·μ·|g|` by at most μ·d.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WithLoad {
    /// μ \[1\].
    pub coefficient: f64,
    /// The load with the torque g.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub load: GravityLoad,
}

impl WithLoad {
    /// Torque against the motion \[N·m\].
    pub(super) fn braking_nm(&self, at: Place) -> f64 {
        self.coefficient * self.load_nm(at.angle)
    }

    /// Its largest torque, against the motion if it is positive \[N·m\].
    pub(super) fn largest_nm(&self) -> f64 {
        self.coefficient * self.load.amplitude_nm().hypot(self.rounded_nm())
    }

    /// √(g² + d²) \[N·m\]: the derivative of the torque against the motion by μ.
    pub(crate) fn load_nm(&self, angle: f64) -> f64 {
        self.load.torque_nm(angle).hypot(self.rounded_nm())
    }

    /// Derivative of the torque against the motion by the angle.
    pub(super) fn slope(&self, at: Place) -> f64 {
        let size = self.load_nm(at.angle);
        if size <= 0.0 {
            return 0.0;
        }
        let (sine, cosine) = at.angle.sin_cos();
        let by_angle = self.load.sine_nm * cosine - self.load.cosine_nm * sine;
        self.coefficient * self.load.torque_nm(at.angle) * by_angle / size
    }

    /// Longest step over which it may be taken for linear in time \[s\], for a motor that turns at `turning` at most.
    pub(super) fn step_s(&self, at: Place, turning: f64) -> f64 {
        let travel = SHARE_PER_STEP * self.load_nm(at.angle) / self.load.amplitude_nm();
        travel / turning.abs()
    }

    /// d \[N·m\].
    fn rounded_nm(&self) -> f64 {
        ROUNDED_LOAD_SHARE * self.load.amplitude_nm()
    }
}

/// Taylor coefficients along a motion.
#[derive(Debug, Clone, Default)]
pub(super) struct WithLoadSeries {
    phase: PhaseSeries,
    load: Row,
    root: SquareRootSeries,
}

impl WithLoadSeries {
    /// The coefficient of order `k` of the torque against the motion.
    pub(super) fn next(&mut self, law: &WithLoad, k: usize, angle: &Row) -> f64 {
        let rounded = law.rounded_nm();
        if rounded <= 0.0 {
            return 0.0;
        }
        let (sine, cosine) = self.phase.next(1.0, k, angle);
        self.load[k] = law.load.sine_nm * sine + law.load.cosine_nm * cosine;
        let square: f64 = (0..=k).map(|j| self.load[j] * self.load[k - j]).sum();
        let constant = if k == 0 { rounded * rounded } else { 0.0 };
        law.coefficient * self.root.next(k, square + constant)
    }
}

#[cfg(test)]
mod tests {
    use super::super::taylor_row::COEFFICIENTS;
    use super::*;

    const LAW: WithLoad =
        WithLoad { coefficient: 0.05, load: GravityLoad { sine_nm: 3.0, cosine_nm: 4.0 } };

    fn at(angle: f64) -> Place {
        Place { angle, speed: 1.0, sign: 1.0 }
    }

    #[test]
    fn it_is_a_share_of_the_load_within_its_bound() {
        for angle in [-0.927_295_218, -0.9, 0.0, 1.0, 4.0] {
            let more = LAW.braking_nm(at(angle)) - 0.05 * LAW.load.torque_nm(angle).abs();
            assert!((0.0..=0.05 * 5e-3 + 1e-15).contains(&more), "{angle} {more}");
        }
        let none = WithLoad { load: GravityLoad::default(), ..LAW };
        assert!(none.braking_nm(at(1.0)) == 0.0 && none.slope(at(1.0)) == 0.0);
        assert!(WithLoadSeries::default().next(&none, 0, &[1.0; COEFFICIENTS]) == 0.0);
    }

    #[test]
    fn its_slope_is_its_difference() {
        for angle in [-0.927, -0.9, 0.0, 1.0, 4.0] {
            let h = 1e-6;
            let difference = LAW.braking_nm(at(angle + h)) - LAW.braking_nm(at(angle - h));
            assert!((difference / (2.0 * h) - LAW.slope(at(angle))).abs() < 1e-6, "{angle}");
        }
    }

    /// Through the angle at which gravity changes its sign.
    #[test]
    fn its_series_adds_up_to_the_law_where_the_load_turns() {
        let mut angle = [0.0; COEFFICIENTS];
        (angle[0], angle[1]) = (-0.9273, 2.0);
        let (t, mut power, mut sum) = (1e-4, 1.0, 0.0);
        let mut series = WithLoadSeries::default();
        for k in 0..COEFFICIENTS {
            sum += power * series.next(&LAW, k, &angle);
            power *= t;
        }
        let exact = LAW.braking_nm(at(-0.9273 + 2.0 * t));
        assert!((sum / exact - 1.0).abs() < 1e-13, "{sum} {exact}");
    }
}
