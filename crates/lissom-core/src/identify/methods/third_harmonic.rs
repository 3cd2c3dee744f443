//! Coulomb friction from the third harmonic of the current, (26)-(29).

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::finding::result_key as key;
use crate::identify::estimate::Estimate;
use crate::identify::findings::Severity;
use crate::identify::methods::thresholds::{STICKING_BIAS, STICKING_MEASURED};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::RunKind;
use crate::identify::prepare::run_phasors::RunPhasors;
use crate::identify::thresholds::TRIPLE_FREQUENCY;
use crate::spectrum::Phasor;

/// Most steps, and halvings of one.
const STEPS: usize = 50;

/// Coulomb friction from one pair of runs, at ω0 and at 3ω0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairEstimate {
    /// Index of the run at ω0.
    pub run: usize,
    /// Index of the run at 3ω0.
    pub triple_run: usize,
    /// ω0 \[rad/s\].
    pub omega_rad_s: f64,
    /// CF/K, in the unit of the command; the standard error counts only that of the phasors.
    pub coulomb_command: Estimate,
    /// Complex least-squares value of CF/K from (27) and (28), before CF is required to be real.
    pub complex_command: Complex64,
    /// Cost (29) at its minimum \[1\].
    pub cost: f64,
}

/// Result of the third-harmonic method of the 1989 report.
#[derive(Debug, Clone)]
pub struct ThirdHarmonic {
    /// Result of each pair.
    pub pairs: Vec<PairEstimate>,
    /// Mean CF/K of the pairs without a finding (of all pairs if all have one), in the unit of the command.
    pub coulomb_command: Estimate,
    /// Standard deviation of single pairs about that mean, in the unit of the command.
    pub spread_command: f64,
    /// For each pair, whether it is part of the mean.
    pub used: Vec<bool>,
}

/// Computes CF/K from one pair of runs by (27)-(29), in the unit of the command.
///
/// With c = CF/K, the motor's phase φ at ω0 and its phase ψ in the run at 3ω0, `i_3 = g·θ_m3 + j·4c/(3π)·e^{j3φ}` and
/// `i_1(3ω0) = g·θ_m(3ω0) + j·4c/π·e^{jψ}`. For a real c the second equation gives g, and then the first gives c′; the
/// cost is `|ln(c′/c)|²`.
///
/// `None` if the linear solution is not positive, so that no friction can be found.
///
/// ```
/// # use {lissom::identify::{RunPhasors, pair_estimate}, lissom::spectrum::Phasor, num_complex::Complex64};
/// # let p = |size: f64, phase: f64| Phasor { value: Complex64::from_polar(size, phase), std: 0.0 };
/// # let (zero, quarter) = (p(0.0, 0.0), std::f64::consts::FRAC_PI_2);
/// let c = 0.132 * 4.0 / std::f64::consts::PI; // fundamental of a square wave of ±0.132 A
/// let low = RunPhasors { omega_rad_s: 2.0, command_1: p(1.0, 0.0), command_3: p(c / 3.0, quarter + 0.9), motor_1: p(0.5, 0.3), motor_3: zero };
/// let triple = RunPhasors { omega_rad_s: 6.0, command_1: p(c, quarter), command_3: zero, motor_1: p(0.5, 0.0), motor_3: zero };
/// let pair = pair_estimate(0, 1, &low, &triple).unwrap();
/// assert!((pair.coulomb_command.value - 0.132).abs() < 1e-12);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (26)-(29)]`
///
/// # Differences from the source
/// The friction term of the third harmonic has the phase 3φ (errata of (27)), so that the result does not
/// depend on the time origin. The minimum is found by the Gauss-Newton method from the linear solution,
/// instead of a direct search.
pub fn pair_estimate(
    run: usize,
    triple_run: usize,
    low: &RunPhasors,
    triple: &RunPhasors,
) -> Option<PairEstimate> {
    let j = Complex64::I;
    let turn = |p: Phasor, k: f64| Complex64::from_polar(1.0, k * p.value.arg());
    let f3 = j * (4.0 / (3.0 * PI)) * turn(low.motor_1, 3.0);
    let f1 = j * (4.0 / PI) * turn(triple.motor_1, 1.0);
    let ratio = low.motor_3.value / triple.motor_1.value;
    // c′ = alpha + beta·c, from g of (28) put into (27).
    let alpha = (low.command_3.value - triple.command_1.value * ratio) / f3;
    let beta = f1 * ratio / f3;
    let complex_command = alpha / (1.0 - beta);
    let linear = ((1.0 - beta).conj() * alpha).re / (1.0 - beta).norm_sqr();
    if !(linear > 0.0 && linear.is_finite()) {
        return None;
    }
    let (value, cost) = least_cost(alpha, beta, linear);
    // First order in the phasors; half of a complex error's power lies along a real estimate.
    let gain = 1.0 / (f3 * (1.0 - beta));
    let variance = gain.norm_sqr()
        * 0.5
        * (low.command_3.std.powi(2)
            + (ratio * triple.command_1.std).norm_sqr()
            + (triple.command_1.value / triple.motor_1.value).norm_sqr() * low.motor_3.std.powi(2));
    value.is_finite().then_some(PairEstimate {
        run,
        triple_run,
        omega_rad_s: low.omega_rad_s,
        coulomb_command: Estimate { value, std: variance.sqrt() },
        complex_command,
        cost,
    })
}

/// Computes the mean of the pairs' results, and the standard deviation of single pairs about it.
///
/// The standard error of the mean includes the scatter of the pairs and the bias by sticking, from the `stuck_share` of
/// each pair's run; the bias is not reduced by averaging. `None` without pairs. For a single pair, its own standard
/// error is used in place of the scatter.
pub fn mean_estimate(
    pairs: &[PairEstimate],
    stuck_share: impl Fn(&PairEstimate) -> f64,
) -> Option<(Estimate, f64)> {
    let n = pairs.len() as f64;
    let first = pairs.first()?;
    let value = pairs.iter().map(|p| p.coulomb_command.value).sum::<f64>() / n;
    let stuck = pairs.iter().map(stuck_share).sum::<f64>() / n;
    let bias = STICKING_BIAS * stuck.max(STICKING_MEASURED);
    let spread = if pairs.len() == 1 {
        first.coulomb_command.std
    } else {
        let squares = pairs.iter().map(|p| (p.coulomb_command.value - value).powi(2)).sum::<f64>();
        (squares / (n - 1.0)).sqrt()
    };
    Some((Estimate { value, std: (spread / n.sqrt()).hypot(bias * value) }, spread))
}

/// c with the least cost (29), `|ln((α + β·c)/c)|²`, and that cost: Gauss-Newton in ln c, with steps that are halved until
/// they lower it.
fn least_cost(alpha: Complex64, beta: Complex64, start: f64) -> (f64, f64) {
    let left = |c: f64| ((alpha + beta * c) / c).ln();
    let mut best = (start, left(start));
    for _ in 0..STEPS {
        let (c, residual) = best;
        // d ln(c′/c)/d ln c = β·c/c′ − 1.
        let slope = beta * c / (alpha + beta * c) - 1.0;
        let step = -(slope.conj() * residual).re / slope.norm_sqr();
        let shares = std::iter::successors(Some(1.0), |share| Some(0.5 * share)).take(STEPS);
        let mut tried = shares.map(|share| c * (share * step).exp()).map(|c| (c, left(c)));
        let Some(better) = tried.find(|t| t.1.norm_sqr() < residual.norm_sqr()) else {
            break;
        };
        best = better;
    }
    (best.0, best.1.norm_sqr())
}

/// Every pair of runs at ω0 and 3ω0; each run meets the triple nearest to it in amplitude.
pub(crate) fn third_harmonic(prepared: &Prepared<'_>) -> Option<ThirdHarmonic> {
    let (runs, findings) = (prepared.runs(), prepared.findings());
    let phasors: Vec<_> = runs
        .iter()
        .map(|r| match &r.kind {
            RunKind::Sinusoidal(s) => s.phasors(),
            RunKind::ConstantVelocity | RunKind::General => None,
        })
        .collect();
    // Sticking, which is no warning, is in the standard error of the mean.
    let flagged = |i: usize| {
        findings.iter().any(|f| {
            f.run.as_deref() == Some(&runs[i].name)
                && f.severity() >= Severity::Warning
                && f.affects().contains(&key::THIRD_HARMONIC)
        })
    };
    let mut pairs = Vec::new();
    for (i, low) in phasors.iter().enumerate() {
        let Some(low) = low else { continue };
        let amplitude = low.motor_1.value.norm();
        let triple = phasors
            .iter()
            .enumerate()
            .filter_map(|(k, p)| Some((k, (*p)?)))
            .filter(|(_, p)| {
                (p.omega_rad_s / (3.0 * low.omega_rad_s) - 1.0).abs() < TRIPLE_FREQUENCY
            })
            .min_by(|(_, a), (_, b)| {
                let far = |p: f64| (p / amplitude).ln().abs();
                far(a.motor_1.value.norm()).total_cmp(&far(b.motor_1.value.norm()))
            });
        if let Some((k, triple)) = triple {
            pairs.extend(pair_estimate(i, k, low, &triple));
        }
    }
    let clean: Vec<bool> =
        pairs.iter().map(|p| !flagged(p.run) && !flagged(p.triple_run)).collect();
    let used = if clean.iter().any(|c| *c) { clean } else { vec![true; pairs.len()] };
    let chosen: Vec<PairEstimate> =
        pairs.iter().zip(&used).filter(|(_, u)| **u).map(|(p, _)| *p).collect();
    let stuck = |i: usize| runs[i].stuck_share.unwrap_or(0.0);
    let (coulomb_command, spread_command) = mean_estimate(&chosen, |p| stuck(p.run))?;
    Some(ThirdHarmonic { pairs, coulomb_command, spread_command, used })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Phasors of an ideal experiment whose time origin is shifted by `delay_s`.
    fn ideal(delay_s: f64, ripple: f64) -> (RunPhasors, RunPhasors) {
        let (omega, cf) = (2.0, 0.132);
        let exact = |value: Complex64| Phasor { value, std: 0.0 };
        let polar = Complex64::from_polar;
        let g = Complex64::new(-3.0, 1.7);
        let j = Complex64::I;
        let theta = polar(0.5, 0.3 + omega * delay_s);
        let theta3 = polar(ripple, 1.1 + 3.0 * omega * delay_s);
        let triple = polar(0.4, -0.8);
        let low = RunPhasors {
            omega_rad_s: omega,
            command_1: exact(Complex64::ONE),
            command_3: exact(
                g * theta3 + j * (4.0 * cf / (3.0 * PI)) * polar(1.0, 3.0 * theta.arg()),
            ),
            motor_1: exact(theta),
            motor_3: exact(theta3),
        };
        let high = RunPhasors {
            omega_rad_s: 3.0 * omega,
            command_1: exact(g * triple + j * (4.0 * cf / PI) * polar(1.0, triple.arg())),
            command_3: exact(Complex64::ZERO),
            motor_1: exact(triple),
            motor_3: exact(Complex64::ZERO),
        };
        (low, high)
    }

    #[test]
    fn exact_for_an_ideal_square_wave_at_any_time_origin() {
        for delay in [0.0, 0.37, 1.9] {
            for ripple in [0.0, 0.02] {
                let (low, high) = ideal(delay, ripple);
                let estimate = pair_estimate(0, 1, &low, &high).unwrap();
                assert!((estimate.coulomb_command.value - 0.132).abs() < 1e-12, "{estimate:?}");
                assert!(estimate.cost < 1e-20);
            }
        }
    }

    #[test]
    fn the_minimum_is_one() {
        let (mut low, high) = ideal(0.2, 0.02);
        low.command_3.value *= Complex64::from_polar(1.05, 0.1);
        let found = pair_estimate(0, 1, &low, &high).unwrap();
        let cost = |c: f64| {
            let ratio = low.motor_3.value / high.motor_1.value;
            let j = Complex64::I;
            let psi = Complex64::from_polar(1.0, high.motor_1.value.arg());
            let g3 = (high.command_1.value - j * (4.0 * c / PI) * psi) * ratio;
            let phase = Complex64::from_polar(1.0, 3.0 * low.motor_1.value.arg());
            let derived = (low.command_3.value - g3) * (3.0 * PI / 4.0) / (j * phase);
            (derived.norm() / c).ln().powi(2) + (derived / c).arg().powi(2)
        };
        let c = found.coulomb_command.value;
        assert!((cost(c) - found.cost).abs() < 1e-12);
        assert!(cost(c) < cost(c * 1.0001) && cost(c) < cost(c * 0.9999));
    }

    #[test]
    fn no_friction_gives_no_estimate() {
        let (mut low, high) = ideal(0.0, 0.0);
        low.command_3.value = -low.command_3.value;
        assert!(pair_estimate(0, 1, &low, &high).is_none());
    }
}
