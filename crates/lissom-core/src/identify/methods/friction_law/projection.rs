//! The line C + V·|v| nearest to a friction law in the motion of a log.

use crate::friction::WithLoad;
use crate::identify::methods::friction_law::law_term::LawTerm;

/// Number of samples that stand for the motion of a log.
const SAMPLES: usize = 2000;

/// The motion of a log, weighted with time: speeds in ascending order, each with the angle at which it was driven.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Motion(Vec<[f64; 2]>);

impl Motion {
    /// Of all speeds with their angles, ascending; `None` without any.
    pub(super) fn of(sorted: &[[f64; 2]]) -> Option<Self> {
        let count = sorted.len().min(SAMPLES);
        let at = |k: usize| sorted[(2 * k + 1) * sorted.len() / (2 * count)];
        (count > 0).then(|| Self((0..count).map(at).collect()))
    }

    /// Mean speed.
    pub(crate) fn mean_speed(&self) -> f64 {
        self.0.iter().map(|[speed, _]| speed).sum::<f64>() / self.0.len() as f64
    }

    /// Mean of a function of the angle.
    pub(crate) fn mean_over_angles(&self, share: impl Fn(f64) -> f64) -> f64 {
        self.0.iter().map(|[_, angle]| share(*angle)).sum::<f64>() / self.0.len() as f64
    }

    /// Level and slope of the least-squares line of a function of speed.
    pub(crate) fn line_of(&self, share: impl Fn(f64) -> f64) -> [f64; 2] {
        let n = self.0.len() as f64;
        let mean = self.mean_speed();
        let shares: Vec<f64> = self.0.iter().map(|[speed, _]| share(*speed)).collect();
        let level = shares.iter().sum::<f64>() / n;
        let (mut square, mut product) = (0.0, 0.0);
        for ([speed, _], share) in self.0.iter().zip(shares) {
            square += (speed - mean).powi(2);
            product += (speed - mean) * (share - level);
        }
        let slope = if square > 0.0 { product / square } else { 0.0 };
        [level - slope * mean, slope]
    }

    /// What a term's amplitude of one adds to the line's Coulomb and viscous friction.
    ///
    /// Ripples, and what adds as much in one direction as it takes in the other, add nothing: the line is friction in the mean of
    /// both directions and over the travel, under the mean load of the log. A load is no function of speed, even where a swing is
    /// fastest under the least load.
    pub(super) fn of_term(&self, term: LawTerm) -> [f64; 2] {
        match term {
            LawTerm::NearRest { .. } | LawTerm::Root => {
                self.line_of(|speed| term.at_speed(1.0, speed, 1.0))
            }
            LawTerm::WithLoad { load } => {
                let with_load = WithLoad { coefficient: 1.0, load };
                [self.mean_over_angles(|angle| with_load.load_nm(angle)), 0.0]
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
