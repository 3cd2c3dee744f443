//! The line C + V·|v| nearest to a friction law in the motion of a log.

use rayon::prelude::*;

use crate::friction::WithLoad;
use crate::identify::methods::friction_law::law_term::LawTerm;

/// Number of samples that stand for the motion of a log.
const SAMPLES: usize = 2000;
/// Stretches of the log, one after another.
const PARTS: usize = 8;

/// The motion of a log, weighted with time, in stretches: speeds, each with the angle at which it was driven.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Motion(Vec<Vec<[f64; 2]>>);

impl Motion {
    /// Of all speeds with their angles, in the order of time; `None` without any.
    pub(super) fn of(in_time: &[[f64; 2]]) -> Option<Self> {
        let thinned = |part: &[[f64; 2]]| -> Vec<[f64; 2]> {
            let mut sorted = part.to_vec();
            sorted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            let count = (SAMPLES * part.len()).div_ceil(in_time.len()).min(part.len());
            let at = |k: usize| sorted[(2 * k + 1) * sorted.len() / (2 * count)];
            (0..count).map(at).collect()
        };
        let parts = in_time.par_chunks(in_time.len().div_ceil(PARTS).max(1));
        (!in_time.is_empty()).then(|| Self(parts.map(thinned).collect()))
    }

    fn mean(&self, of: impl Fn(&[f64; 2]) -> f64) -> f64 {
        let count: usize = self.0.iter().map(Vec::len).sum();
        self.0.iter().flatten().map(of).sum::<f64>() / count as f64
    }

    /// Mean speed.
    pub(crate) fn mean_speed(&self) -> f64 {
        self.mean(|[speed, _]| *speed)
    }

    /// Level and slope of the least-squares line of a function of speed, with the mean of a function of the angle on the level.
    pub(crate) fn line_of(
        &self,
        by_speed: impl Fn(f64) -> f64,
        by_angle: impl Fn(f64) -> f64,
    ) -> [f64; 2] {
        let mean = self.mean_speed();
        let level = self.mean(|[speed, _]| by_speed(*speed));
        let square = self.mean(|[speed, _]| (speed - mean).powi(2));
        let product = self.mean(|[speed, _]| (speed - mean) * (by_speed(*speed) - level));
        let slope = if square > 0.0 { product / square } else { 0.0 };
        [level - slope * mean + self.mean(|[_, angle]| by_angle(*angle)), slope]
    }

    /// Standard errors of two numbers that the motion gives, by leaving out one stretch of it after another (jackknife): another
    /// log of the same joint has other speeds.
    pub(crate) fn scatter(&self, of: impl Fn(&Self) -> [f64; 2]) -> [f64; 2] {
        let n = self.0.len();
        let without = |k: usize| of(&Self([&self.0[..k], &self.0[k + 1..]].concat()));
        let found: Vec<[f64; 2]> = (0..if n > 1 { n } else { 0 }).map(without).collect();
        [0, 1].map(|i| {
            let mean = found.iter().map(|x| x[i]).sum::<f64>() / n as f64;
            let square: f64 = found.iter().map(|x| (x[i] - mean).powi(2)).sum();
            (square * (n - 1) as f64 / n as f64).sqrt()
        })
    }

    /// What a term's amplitude of one adds to the line's Coulomb and viscous friction.
    ///
    /// Ripples, and what adds as much in one direction as it takes in the other, add nothing: the line is friction in the mean of
    /// both directions and over the travel, under the mean load of the log. A load is no function of speed, even where a swing is
    /// fastest under the least load.
    pub(super) fn of_term(&self, term: LawTerm) -> [f64; 2] {
        match term {
            LawTerm::NearRest { .. } | LawTerm::Root => {
                self.line_of(|speed| term.at_speed(1.0, speed, 1.0), |_| 0.0)
            }
            LawTerm::WithLoad { load } => {
                let with_load = WithLoad { coefficient: 1.0, load };
                self.line_of(|_| 0.0, |angle| with_load.load_nm(angle))
            }
            _ => [0.0; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drive::Falloff;
    use crate::load::GravityLoad;

    /// The root over speeds from 0 to 1, evenly: ∫(a + b·v − √v)² is least for a = 4/15, b = 4/5.
    #[test]
    fn the_line_of_a_root_is_the_closed_form() {
        let motion: Vec<[f64; 2]> =
            (0..100_000).map(|k| [(f64::from(k) + 0.5) * 1e-5, 0.0]).collect();
        let [a, b] = Motion::of(&motion).unwrap().of_term(LawTerm::Root);
        assert!((a - 4.0 / 15.0).abs() < 1e-3 && (b - 0.8).abs() < 1e-3, "{a} {b}");
    }

    /// Two stretches at 0 and 1 rad/s, and two that have both: the mean speed is ½, and its standard error √(3/4·(2·(1/6)²)).
    #[test]
    fn stretches_at_other_speeds_scatter() {
        let stretches = [[0.0; 2], [1.0; 2], [0.0, 1.0], [0.0, 1.0]];
        let motion = Motion(stretches.map(|s| s.map(|speed| [speed, 0.0]).to_vec()).to_vec());
        let [mean, none] = motion.scatter(|motion| [motion.mean_speed(), 1.0]);
        assert!((mean - (0.75_f64 * 2.0 / 36.0).sqrt()).abs() < 1e-12 && none == 0.0, "{mean}");
    }

    #[test]
    fn friction_that_falls_off_far_beyond_the_speeds_is_a_line() {
        let near = LawTerm::NearRest { speed: 100.0, falloff: Falloff::Exponential };
        let motion = [0.1, 0.2, 0.3, 0.4].map(|speed| [speed, 0.0]);
        let [a, b] = Motion::of(&motion).unwrap().of_term(near);
        assert!((a - 1.0).abs() < 1e-4 && (b + 0.01).abs() < 1e-4, "{a} {b}");
    }

    /// A load that is 2 N·m in one half of the time and none in the other.
    #[test]
    fn friction_under_load_is_that_of_the_mean_load() {
        let load = GravityLoad { sine_nm: 0.0, cosine_nm: 2.0 };
        let motion = [[0.1, 0.0], [0.3, std::f64::consts::FRAC_PI_2]];
        let [a, b] = Motion::of(&motion).unwrap().of_term(LawTerm::WithLoad { load });
        assert!((a - 1.0).abs() < 0.01 && b == 0.0, "{a} {b}");
    }
}
