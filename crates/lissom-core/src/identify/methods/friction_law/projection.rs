//! The line C + V·|v| nearest to a friction law at the speeds of a log.

use crate::identify::methods::friction_law::law_term::LawTerm;

/// Number of quantiles that stand for the speeds of a log.
const QUANTILES: usize = 200;

/// The speeds of a log, weighted with time: quantiles of those of windows that are evenly spread over it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Speeds(Vec<f64>);

impl Speeds {
    /// Of all speeds, ascending.
    pub(super) fn of(sorted: &[f64]) -> Self {
        let count = sorted.len().min(QUANTILES);
        let at = |k: usize| sorted[(2 * k + 1) * sorted.len() / (2 * count)];
        Self((0..count).map(at).collect())
    }

    /// Their mean.
    pub(crate) fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    /// Level and slope of the least-squares line of a function of speed.
    pub(crate) fn line_of(&self, share: impl Fn(f64) -> f64) -> [f64; 2] {
        let n = self.0.len() as f64;
        let mean = self.mean();
        let level = self.0.iter().map(|v| share(*v)).sum::<f64>() / n;
        let (mut square, mut product) = (0.0, 0.0);
        for v in &self.0 {
            square += (v - mean).powi(2);
            product += (v - mean) * (share(*v) - level);
        }
        let slope = if square > 0.0 { product / square } else { 0.0 };
        [level - slope * mean, slope]
    }

    /// What a term's amplitude of one adds to the line's Coulomb and viscous friction.
    ///
    /// Terms that are no function of speed, or add as much in one direction as they take in the other, add nothing: the line
    /// is friction without a load, the mean of both directions and over the travel.
    pub(super) fn of_term(&self, term: LawTerm) -> [f64; 2] {
        match term {
            LawTerm::NearRest { .. } | LawTerm::Root => {
                self.line_of(|speed| term.at_speed(1.0, speed, 1.0))
            }
            _ => [0.0; 2],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drive::Falloff;

    /// The root over speeds from 0 to 1, evenly: ∫(a + b·v − √v)² is least for a = 4/15, b = 4/5.
    #[test]
    fn the_line_of_a_root_is_the_closed_form() {
        let speeds: Vec<f64> = (0..100_000).map(|k| (f64::from(k) + 0.5) * 1e-5).collect();
        let [a, b] = Speeds::of(&speeds).of_term(LawTerm::Root);
        assert!((a - 4.0 / 15.0).abs() < 1e-3 && (b - 0.8).abs() < 1e-3, "{a} {b}");
    }

    #[test]
    fn friction_that_falls_off_far_beyond_the_speeds_is_a_line() {
        let near = LawTerm::NearRest { speed: 100.0, falloff: Falloff::Exponential };
        let [a, b] = Speeds::of(&[0.1, 0.2, 0.3, 0.4]).of_term(near);
        assert!((a - 1.0).abs() < 1e-4 && (b + 0.01).abs() < 1e-4, "{a} {b}");
    }
}
