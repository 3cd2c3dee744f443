//! The pair of Coulomb and viscous friction that stands for a whole friction law, for targets with two numbers.

use lissom_core::replay::{DryTerms, ModalArm, ROOT_SPEED_RAD_S};

/// Largest speed of the pair over v_s, if the speeds of the identification are unknown: 0.7 % of an exponential are left.
const SPEEDS_OF_NEAR_REST: f64 = 5.0;
/// The same for friction with a square root of speed, which has no speed of its own \[rad/s\]: that of a robot's joint.
const SPEED_OF_ROOT_RAD_S: f64 = 10.0;
/// Intervals of the search for the largest error, and of the line's sums.
const PARTS: usize = 1000;

/// Coulomb and viscous friction, both not negative, that stand for a friction law between rest and a largest speed.
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
    /// The pair for an arm's friction, mean of both directions, `F + V·v + h(v)` with
    /// `h(v) = A_s·g(v/v_s) + A·(√(v + e) − √e)` and g = e^{−x} or e^{−x²}.
    ///
    /// It is the line of the result, Coulomb and viscous friction \[N·m, N·m·s/rad\], weighted with the time at each speed of the
    /// logs, under their mean load. Without one it is the line of least squares over speeds from 0 to R, the largest speed of the identification (if it
    /// is unknown 5·v_s, or 10 rad/s without a change near rest); if its slope or its constant is negative, that becomes zero and
    /// the other one is fitted alone. Without h the pair is F and V.
    pub(super) fn of(
        arm: &ModalArm,
        line: Option<[f64; 2]>,
        speed_most_rad_s: Option<f64>,
    ) -> Self {
        let [forward, backward] = arm.viscous_nm_s_per_rad;
        let (f, v) = (arm.coulomb_nm, 0.5 * (forward + backward));
        let terms = &arm.dry_terms;
        if terms.near_rest.is_none() && terms.root.is_none() {
            let [a, b] = line.filter(|_| terms.with_load.is_some()).unwrap_or([f, v]);
            return Self { coulomb_nm: a, viscous_nm_s_per_rad: b, fit: None };
        }
        let known = speed_most_rad_s.filter(|s| *s > 0.0);
        let own = terms.near_rest.map(|near| SPEEDS_OF_NEAR_REST * near.speed_rad_s);
        let most = known.or(own).unwrap_or(SPEED_OF_ROOT_RAD_S);
        let unloaded = |speed: f64| f + v * speed + changes_nm(terms, speed);
        let own = line_of(unloaded, most);
        let [a, b] = line.unwrap_or(own);
        // The line of the result is under the mean load.
        let under_load = if terms.with_load.is_some() { a - own[0] } else { 0.0 };
        let law = |speed: f64| unloaded(speed) + under_load;
        let speeds = (0..=PARTS).map(|i| most * i as f64 / PARTS as f64);
        let worst = speeds.map(|s| ((a + b * s - law(s)).abs(), s));
        let (error_nm, error_at_rad_s) =
            worst.fold((0.0, 0.0), |most, at| if at.0 > most.0 { at } else { most });
        let fit = PairFit { speed_most_rad_s: most, error_nm, error_at_rad_s };
        Self { coulomb_nm: a, viscous_nm_s_per_rad: b, fit: Some(fit) }
    }
}

/// a and b, not negative, with the least squared error of `a + b·v` from 0 to a largest speed.
fn line_of(law: impl Fn(f64) -> f64, most: f64) -> [f64; 2] {
    let [mut s0, mut s1, mut s2, mut y0, mut y1] = [0.0; 5];
    for i in 0..=PARTS {
        let v = most * i as f64 / PARTS as f64;
        // Simpson's rule.
        let w = match i {
            0 | PARTS => 1.0,
            _ if i % 2 == 1 => 4.0,
            _ => 2.0,
        };
        s0 += w;
        s1 += w * v;
        s2 += w * v * v;
        y0 += w * law(v);
        y1 += w * v * law(v);
    }
    let determinant = s0 * s2 - s1 * s1;
    let (a, b) = ((s2 * y0 - s1 * y1) / determinant, (s0 * y1 - s1 * y0) / determinant);
    if b < 0.0 {
        [(y0 / s0).max(0.0), 0.0]
    } else if a < 0.0 {
        [0.0, (y1 / s2).max(0.0)]
    } else {
        [a, b]
    }
}

/// h(v), what friction has besides Coulomb and viscous friction at a speed \[N·m\].
fn changes_nm(terms: &DryTerms, speed: f64) -> f64 {
    let near =
        terms.near_rest.map_or(0.0, |n| n.torque_nm * n.falloff.share(speed / n.speed_rad_s));
    let root = (speed + ROOT_SPEED_RAD_S).sqrt() - ROOT_SPEED_RAD_S.sqrt();
    near + terms.root.map_or(0.0, |r| r.torque_nm_per_root_rad_s * root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lissom_core::drive::Falloff;
    use lissom_core::replay::NearRest;

    fn arm(near_nm: f64, falloff: Falloff, viscous: f64) -> ModalArm {
        let near = NearRest { torque_nm: near_nm, offset_nm: 0.0, speed_rad_s: 0.4, falloff };
        ModalArm {
            inertia_kg_m2: 1.0,
            viscous_nm_s_per_rad: [1.1 * viscous, 0.9 * viscous],
            coulomb_nm: 14.6,
            offset_nm: 0.3,
            dry_terms: DryTerms { near_rest: Some(near), ..DryTerms::default() },
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        }
    }

    /// The line by the moments `m_0 = (1 − e^{−r})/r`, `m_1 = (1 − (1 + r)·e^{−r})/r²` of an exponential:
    /// `a = F + A·(4·m_0 − 6·m_1)`, `b = V + A·(12·m_1 − 6·m_0)/R`, r = R/v_s.
    #[test]
    fn the_line_is_that_of_the_closed_form() {
        for near_nm in [9.9, -5.0] {
            for most in [2.0, 7.0] {
                let pair =
                    FrictionPair::of(&arm(near_nm, Falloff::Exponential, 8.0), None, Some(most));
                let r = most / 0.4;
                let (m0, m1) = ((1.0 - (-r).exp()) / r, (1.0 - (1.0 + r) * (-r).exp()) / (r * r));
                let a = 14.6 + near_nm * (4.0 * m0 - 6.0 * m1);
                let b = 8.0 + near_nm * (12.0 * m1 - 6.0 * m0) / most;
                assert!((pair.coulomb_nm / a - 1.0).abs() < 1e-8, "{pair:?} {a}");
                assert!((pair.viscous_nm_s_per_rad - b).abs() < 1e-8 * 8.0, "{pair:?} {b}");
            }
        }
    }

    #[test]
    fn the_line_of_the_result_is_taken() {
        let law = arm(9.9, Falloff::Exponential, 8.0);
        let pair = FrictionPair::of(&law, Some([15.0, 7.5]), Some(2.0));
        assert!((pair.coulomb_nm - 15.0).abs() <= 0.0);
        assert!((pair.viscous_nm_s_per_rad - 7.5).abs() <= 0.0);
        assert!((pair.fit.unwrap().error_nm - (14.6 + 9.9 - 15.0)).abs() < 1e-12, "{pair:?}");
    }

    #[test]
    fn the_error_is_that_at_rest_and_far_below_that_of_the_pair_at_speed() {
        let pair = FrictionPair::of(&arm(9.9, Falloff::Exponential, 8.0), None, None);
        let fit = pair.fit.unwrap();
        assert!((fit.speed_most_rad_s - 2.0).abs() < 1e-12);
        assert!(fit.error_at_rad_s <= 0.0 && fit.error_nm < 0.6 * 9.9, "{pair:?}");
    }

    #[test]
    fn neither_number_is_negative() {
        let pair = FrictionPair::of(&arm(9.9, Falloff::Exponential, 0.0), None, Some(2.0));
        assert!(pair.viscous_nm_s_per_rad <= 0.0 && pair.coulomb_nm > 14.6);
        let mut light = arm(-20.0, Falloff::Exponential, 0.0);
        light.coulomb_nm = 5.0;
        let pair = FrictionPair::of(&light, None, Some(0.5));
        assert!(pair.coulomb_nm <= 0.0 && pair.viscous_nm_s_per_rad >= 0.0, "{pair:?}");
    }

    #[test]
    fn a_law_without_a_change_near_rest_keeps_its_numbers() {
        let mut plain = arm(9.9, Falloff::Gaussian, 8.0);
        plain.dry_terms.near_rest = None;
        let pair = FrictionPair::of(&plain, None, Some(3.0));
        assert!(pair.fit.is_none() && (pair.coulomb_nm - 14.6).abs() <= 0.0);
    }
}
