//! The pair of Coulomb and viscous friction that comes nearest to a whole friction law, for targets with two numbers.

use lissom_core::drive::Falloff;
use lissom_core::replay::{ModalArm, NearRest};

/// Largest speed of the pair over v_s, if the speeds of the identification are unknown: 0.7 % of an exponential are left.
const SPEEDS_OF_NEAR_REST: f64 = 5.0;
/// Intervals of the search for the largest error, and of Simpson's rule.
const PARTS: usize = 1000;
/// Where Simpson's rule ends: nothing of a Gaussian is left.
const GAUSSIAN_END: f64 = 6.0;

/// Coulomb and viscous friction, both not negative, that fit a friction law best between rest and a largest speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrictionPair {
    /// Coulomb friction \[N·m\].
    pub(super) coulomb_nm: f64,
    /// Viscous friction \[N·m·s/rad\].
    pub(super) viscous_nm_s_per_rad: f64,
    /// How well it fits; `None` if the law is such a pair.
    pub(super) fit: Option<PairFit>,
}

/// How well a pair fits a friction law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PairFit {
    /// Largest speed \[rad/s\].
    pub(super) speed_most_rad_s: f64,
    /// Largest |pair − law| between rest and that speed \[N·m\].
    pub(super) error_nm: f64,
    /// The speed of that error \[rad/s\].
    pub(super) error_at_rad_s: f64,
}

impl FrictionPair {
    /// The pair of an arm's friction, mean of both directions, `F + V·v + A_s·g(v/v_s)`, with g = e^{−x} or e^{−x²}.
    ///
    /// The pair a + b·v has the least `∫ (a + b·v − friction)² dv` from v = 0 to R, the largest speed of the
    /// identification (5·v_s if it is unknown). With r = R/v_s and the moments `m_0 = ∫_0^1 g(r·x) dx`,
    /// `m_1 = ∫_0^1 x·g(r·x) dx`:
    ///
    /// `a = F + A_s·(4·m_0 − 6·m_1)`, `b = V + A_s·(12·m_1 − 6·m_0)/R`.
    ///
    /// If one of both is negative, it becomes zero and the other one is fitted alone. Without a change near rest the pair
    /// is F and V.
    pub(super) fn of(arm: &ModalArm, speed_most_rad_s: Option<f64>) -> Self {
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        let (f, v) = (arm.coulomb_nm, 0.5 * (forward + backward));
        let Some(near) = arm.dry_terms.near_rest else {
            return Self { coulomb_nm: f, viscous_nm_s_per_rad: v, fit: None };
        };
        let known = speed_most_rad_s.filter(|s| *s > 0.0);
        let most = known.unwrap_or(SPEEDS_OF_NEAR_REST * near.speed_rad_s);
        let [m0, m1] = moments(near.falloff, most / near.speed_rad_s);
        let size = near.torque_nm;
        let (mut a, mut b) =
            (f + size * (4.0 * m0 - 6.0 * m1), v + size * (12.0 * m1 - 6.0 * m0) / most);
        if b < 0.0 {
            (a, b) = (f + 0.5 * v * most + size * m0, 0.0);
        } else if a < 0.0 {
            (a, b) = (0.0, v + (1.5 * f + 3.0 * size * m1) / most);
        }
        let (a, b) = (a.max(0.0), b.max(0.0));
        let off = |speed: f64| a + b * speed - f - v * speed - size * share(&near, speed);
        let speeds = (0..=PARTS).map(|i| most * i as f64 / PARTS as f64);
        let worst = speeds.map(|s| (off(s).abs(), s));
        let (error_nm, error_at_rad_s) =
            worst.fold((0.0, 0.0), |most, at| if at.0 > most.0 { at } else { most });
        let fit = PairFit { speed_most_rad_s: most, error_nm, error_at_rad_s };
        Self { coulomb_nm: a, viscous_nm_s_per_rad: b, fit: Some(fit) }
    }
}

fn share(near: &NearRest, speed: f64) -> f64 {
    near.falloff.share(speed / near.speed_rad_s)
}

/// `∫_0^1 g(r·x) dx` and `∫_0^1 x·g(r·x) dx`.
fn moments(falloff: Falloff, r: f64) -> [f64; 2] {
    match falloff {
        Falloff::Exponential => [-(-r).exp_m1() / r, (-(-r).exp_m1() - r * (-r).exp()) / (r * r)],
        Falloff::Gaussian => {
            let end = r.min(GAUSSIAN_END);
            let step = end / PARTS as f64;
            let at = |i: usize| {
                let weight = match i {
                    0 | PARTS => 1.0,
                    _ if i % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight * Falloff::Gaussian.share(i as f64 * step)
            };
            let area = (0..=PARTS).map(at).sum::<f64>() * step / 3.0;
            [area / r, -(-r * r).exp_m1() / (2.0 * r * r)]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lissom_core::replay::DryTerms;

    /// Relative difference of the closed form and a sum over 20 001 speeds \[1\]: the sum's own error, one part in 20 000.
    const SUM: f64 = 2e-4;

    fn arm(near_nm: f64, falloff: Falloff, viscous: f64) -> ModalArm {
        let near = NearRest { torque_nm: near_nm, offset_nm: 0.0, speed_rad_s: 0.4, falloff };
        ModalArm {
            inertia_kg_m2: 1.0,
            viscous_nm_s_per_rad: [1.1 * viscous, 0.9 * viscous],
            coulomb_nm: 14.6,
            offset_nm: 0.3,
            dry_terms: DryTerms { near_rest: Some(near), ripples: Vec::new() },
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            gravity: None,
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        }
    }

    /// The line by normal equations over many speeds.
    fn line(arm: &ModalArm, most: f64) -> [f64; 2] {
        let near = arm.dry_terms.near_rest.unwrap();
        let law = |v: f64| arm.coulomb_nm + 8.0 * v + near.torque_nm * share(&near, v);
        let mut s = [0.0; 5];
        for i in 0..=20_000 {
            let v = most * f64::from(i) / 20_000.0;
            let terms = [1.0, v, v * v, law(v), v * law(v)];
            s.iter_mut().zip(terms).for_each(|(s, t)| *s += t);
        }
        let det = s[0] * s[2] - s[1] * s[1];
        [(s[2] * s[3] - s[1] * s[4]) / det, (s[0] * s[4] - s[1] * s[3]) / det]
    }

    #[test]
    fn the_closed_form_is_the_least_squares_line_over_many_speeds() {
        for falloff in [Falloff::Exponential, Falloff::Gaussian] {
            for near_nm in [9.9, -5.0] {
                for most in [0.3, 2.0, 7.0] {
                    let arm = arm(near_nm, falloff, 8.0);
                    let pair = FrictionPair::of(&arm, Some(most));
                    let [a, b] = line(&arm, most);
                    if b > 0.0 {
                        assert!((pair.coulomb_nm / a - 1.0).abs() < SUM, "{pair:?} {a} {b}");
                        assert!((pair.viscous_nm_s_per_rad - b).abs() < SUM * 8.0, "{pair:?} {b}");
                    } else {
                        assert!(pair.viscous_nm_s_per_rad <= 0.0, "{pair:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_error_is_that_at_rest_and_far_below_that_of_the_pair_at_speed() {
        let pair = FrictionPair::of(&arm(9.9, Falloff::Exponential, 8.0), None);
        let fit = pair.fit.unwrap();
        assert!((fit.speed_most_rad_s - 2.0).abs() < 1e-12);
        assert!(fit.error_at_rad_s <= 0.0 && fit.error_nm < 0.6 * 9.9, "{pair:?}");
    }

    #[test]
    fn neither_number_is_negative() {
        let pair = FrictionPair::of(&arm(9.9, Falloff::Exponential, 0.0), Some(2.0));
        assert!(pair.viscous_nm_s_per_rad <= 0.0 && pair.coulomb_nm > 14.6);
        let mut light = arm(-20.0, Falloff::Exponential, 0.0);
        light.coulomb_nm = 5.0;
        let pair = FrictionPair::of(&light, Some(0.5));
        assert!(pair.coulomb_nm <= 0.0 && pair.viscous_nm_s_per_rad >= 0.0, "{pair:?}");
    }

    #[test]
    fn a_law_without_a_change_near_rest_keeps_its_numbers() {
        let mut plain = arm(9.9, Falloff::Gaussian, 8.0);
        plain.dry_terms.near_rest = None;
        let pair = FrictionPair::of(&plain, Some(3.0));
        assert!(pair.fit.is_none() && (pair.coulomb_nm - 14.6).abs() <= 0.0);
    }
}
