//! Chances of deviations, and which of many are more than chance.

use statrs::distribution::{ContinuousCDF as _, Normal, StudentsT};

/// Both tails of a normal distribution beyond ±z.
pub(super) fn tails(z: f64) -> f64 {
    2.0 * Normal::standard().sf(z.abs())
}

/// Upper limit of a deviation: JSON cannot represent infinity.
const MOST: f64 = 1e6;

/// The deviation of a normal distribution with the same tails as Student's t with these degrees of freedom. Zero without a
/// degree of freedom, or if t is not a number.
pub(super) fn normal_deviation(t: f64, freedom: f64) -> f64 {
    let Ok(student) = StudentsT::new(0.0, 1.0, freedom) else { return 0.0 };
    if t.is_nan() {
        return 0.0;
    }
    let t = t.clamp(-MOST, MOST);
    let tail = student.sf(t.abs());
    // Far out the tail underflows, and is none of chance anyway.
    let z = if tail > 0.0 { -Normal::standard().inverse_cdf(tail) } else { t.abs() };
    z.copysign(t)
}

/// Which of many are more than chance: of those chosen a share of `rate` is expected to be chance (Benjamini and Hochberg,
/// J. R. Stat. Soc. B 57, 1995). `tails` has the chance of each.
pub(super) fn discoveries(tails: &[f64], rate: f64) -> Vec<bool> {
    let mut order: Vec<usize> = (0..tails.len()).collect();
    order.sort_by(|a, b| tails[*a].total_cmp(&tails[*b]));
    let allowed = |rank: usize| rate * (rank + 1) as f64 / tails.len() as f64;
    let last = (0..order.len()).rev().find(|rank| tails[order[*rank]] <= allowed(*rank));
    let mut chosen = vec![false; tails.len()];
    for place in &order[..last.map_or(0, |rank| rank + 1)] {
        chosen[*place] = true;
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_values() {
        // Quantiles of the normal distribution and of Student's t (4 degrees of freedom) for 2.5 %.
        assert!((tails(1.959_963_984_540_054) - 0.05).abs() < 1e-9);
        assert!((normal_deviation(-2.776_445_105, 4.0) + 1.959_964).abs() < 1e-5);
        assert!((normal_deviation(1.5, f64::INFINITY) - 1.5).abs() < 1e-9);
        assert_eq!(normal_deviation(f64::NAN, 4.0).to_bits(), 0.0f64.to_bits());
        assert_eq!(normal_deviation(3.0, 0.0).to_bits(), 0.0f64.to_bits());
        assert!(normal_deviation(f64::INFINITY, 4.0).is_finite());
        assert!(normal_deviation(f64::NEG_INFINITY, f64::INFINITY).is_finite());
    }

    #[test]
    fn example_of_the_paper() {
        // Benjamini and Hochberg (1995), section 3.2: of these 15, the four smallest are chosen at 5 %.
        let tails = [
            0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344, 0.0459, 0.3240, 0.4262,
            0.5719, 0.6528, 0.7590, 1.0,
        ];
        assert_eq!(discoveries(&tails, 0.05).iter().filter(|c| **c).count(), 4);
        assert!(discoveries(&[], 0.05).is_empty());
    }
}
