//! The beam's own equation (13) on windows: natural frequencies and damping.

use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::eigenvalues::eigenvalues;
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::methods::regression::motor_rows::behind;
use crate::identify::methods::regression::normal::{Cluster, Rows, Term, solve};
use crate::identify::methods::regression::row_noise::{ChannelPart, products};
use crate::identify::methods::regression::scan::{Candidate, Scan, scan};
use crate::identify::methods::regression::thresholds::WINDOW_SYSTEMATIC;
use crate::identify::methods::regression::window::{WINDOW_STEP, Weights, Window};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::{Campaign, Run, TipQuantity};

/// Windows in a block that the covariance takes as one.
const BLOCK: usize = 40;

/// Estimates from the beam's own equation.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamRegression {
    /// Length of the window that was used for each tip \[s\].
    pub window_s: Vec<f64>,
    /// Window lengths that were tried, by tip.
    pub candidates: Vec<Vec<Candidate>>,
    /// Relative residual ‖y − X·q‖/‖y‖, by tip \[1\].
    pub relative_residual: Vec<f64>,
    /// Modes with the motor clamped, ascending in frequency.
    pub modes: Vec<ModeEstimate>,
    /// −Â, tips × tips \[1/s²\].
    pub stiffness: DMatrix<f64>,
}

/// Fits `θ̈_i = Σ_j â_ij(θ_j − θ_m) − e_i·θ̇_i − d_i·(θ̇_i − θ̇_m) + const` to each tip over all runs, sticking or not,
/// and computes the modes from Â. e_i is damping against the fixed frame and d_i damping within the beam \[1/s\].
///
/// There are as many modes as tips. `None` if a tip is not a calibrated angle or deflection, if there are too few
/// windows, or if the natural frequencies of Â are not all real and positive.
///
/// ```
/// # use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity};
/// # let t = 0.002;
/// # let wave = |gain: &dyn Fn(f64) -> f64| (0..10_000).map(|k| t * f64::from(k)).map(|s| gain(3.0) * (3.0 * s).sin() + gain(9.0) * (9.0 * s).sin()).collect::<Vec<f64>>();
/// # let (motor, tip) = (wave(&|_| 1.0), wave(&|w| 36.0 / (36.0 - w * w)));
/// # let command = Command { quantity: CommandQuantity::Current, hold: Hold::Measured, torque_per_command: Some(1.0), back_emf_viscous: 0.0, limit: None };
/// # let tips = vec![Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true }];
/// # let run = Run::new("two sines", TimeBase::uniform(0.0, t), motor.clone(), motor, vec![tip]).unwrap();
/// # let campaign = Campaign::new(Channels { axis: Axis::Rotary, command, tips }, vec![run]).unwrap();
/// use lissom::identify::{Prepared, beam_regression}; // of a beam with θ_t/θ_m = 36/(s² + 36)
/// let prepared = Prepared::of(&campaign);
/// let mode = beam_regression(&prepared).unwrap().modes[0];
/// assert!((mode.natural_frequency_rad_s.value - 6.0).abs() < 1e-3);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (13), (17)]`, integrated by parts as in the motor's regression; A·1 + B = 0 is built in.
pub fn beam_regression(prepared: &Prepared<'_>) -> Option<BeamRegression> {
    let campaign = prepared.used();
    let tips = &campaign.channels.tips;
    if tips.is_empty()
        || tips.iter().any(|t| !t.calibrated || t.quantity == TipQuantity::Acceleration)
    {
        return None;
    }
    // Many short loops: within the pool none of them has to wake it first.
    rayon::scope(|_| on_windows(campaign, prepared.noise()))
}

fn on_windows(campaign: &Campaign, noise: &[RunNoise]) -> Option<BeamRegression> {
    let n = campaign.channels.tips.len();
    // Columns: ∫w(θ_m − θ_j) for each j, ∫ẇθ_i, ∫ẇ(θ_i − θ_m), ∫w, then the right side ∫ẅθ_i.
    let grounded: Vec<Term> = (0..=n).chain([n + 2]).map(Term::Plain).collect();
    let both: Vec<Term> = (0..n + 3).map(Term::Plain).collect();
    let sample_time = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let scans: Vec<Scan> = (0..n)
        .map(|i| {
            let scanned = |terms: &[Term]| {
                let counts: Vec<bool> = (0..terms.len()).map(|k| k < n).collect();
                scan(sample_time, &[], &counts, |length| {
                    solve(&clusters(campaign, noise, i, length), terms)
                })
            };
            // Damping within the beam is a term of its own only where the motion shows it.
            scanned(&both).filter(|s| within(s, n).is_some()).or_else(|| scanned(&grounded))
        })
        .collect::<Option<_>>()?;
    let stiffness = DMatrix::from_fn(n, n, |i, j| scans[i].solution.value[j]);
    // With the motor clamped both kinds of damping are one.
    let damping: Vec<f64> =
        scans.iter().map(|s| s.solution.value[n] + within(s, n).unwrap_or_default()).collect();
    let modes = modes(&stiffness, &damping)?;
    let std = standard_errors(&scans, &stiffness, &damping, &modes)?;
    let chosen = |s: &Scan| s.candidates[s.chosen].clone();
    Some(BeamRegression {
        window_s: scans.iter().map(|s| chosen(s).window_s).collect(),
        relative_residual: scans.iter().map(|s| chosen(s).relative_residual).collect(),
        modes: modes
            .iter()
            .zip(std)
            .map(|(m, s)| ModeEstimate {
                natural_frequency_rad_s: Estimate { value: m.0, std: s.0 },
                damping_ratio: Estimate { value: m.1, std: s.1 },
            })
            .collect(),
        candidates: scans.into_iter().map(|s| s.candidates).collect(),
        stiffness,
    })
}

/// Coefficient of the damping within the beam of `n` tips, where it is clearly present.
fn within(scan: &Scan, n: usize) -> Option<f64> {
    let (solution, at) = (&scan.solution, n + 1);
    if solution.value.len() < n + 3 || solution.inseparable[at] {
        return None;
    }
    let value = solution.value[at];
    (value.abs() > CLEARLY_PRESENT * solution.covariance[(at, at)].max(0.0).sqrt()).then_some(value)
}

/// Natural frequency and damping ratio of each mode of `θ̈ = −K·δ − D·θ̇`, ascending.
fn modes(stiffness: &DMatrix<f64>, damping: &[f64]) -> Option<Vec<(f64, f64)>> {
    let n = stiffness.nrows();
    // Undamped squares and damped poles both from eigenvalues: n is the number of tips.
    let state = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) => f64::from(j - n == i),
        (false, true) => -stiffness[(i - n, j)],
        (false, false) if i == j => -damping[i - n],
        _ => 0.0,
    });
    let mut poles: Vec<_> = eigenvalues(&state)?.into_iter().filter(|p| p.im > 0.0).collect();
    if poles.len() != n {
        return None;
    }
    poles.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    Some(poles.iter().map(|p| (p.norm(), -p.re / p.norm())).collect())
}

/// First-order standard errors of the modes from those of the regression, by finite differences.
fn standard_errors(
    scans: &[Scan],
    stiffness: &DMatrix<f64>,
    damping: &[f64],
    at: &[(f64, f64)],
) -> Option<Vec<(f64, f64)>> {
    let n = scans.len();
    let mut variance = vec![(0.0, 0.0); n];
    for (i, scan) in scans.iter().enumerate() {
        // Gradient of every mode with respect to row i's parameters â_i1..â_in, e_i.
        let gradients: Vec<Vec<(f64, f64)>> = (0..=n)
            .map(|j| {
                let (mut k, mut d) = (stiffness.clone(), damping.to_vec());
                let step = 1e-5 * stiffness[(i, i)].abs().max(1e-12);
                let step = if j < n { step } else { step.sqrt() * 1e-2 };
                if j < n {
                    k[(i, j)] += step;
                } else {
                    d[i] += step;
                }
                let moved = modes(&k, &d)?;
                Some(
                    moved
                        .iter()
                        .zip(at)
                        .map(|(m, a)| ((m.0 - a.0) / step, (m.1 - a.1) / step))
                        .collect(),
                )
            })
            .collect::<Option<_>>()?;
        let again = gradients.last().filter(|_| within(scan, n).is_some());
        let gradients: Vec<_> = gradients.iter().chain(again).collect();
        let covariance = &scan.solution.covariance;
        for (mode, total) in variance.iter_mut().enumerate() {
            let mut systematic = (0.0, 0.0);
            for (a, ga) in gradients.iter().enumerate() {
                systematic.0 += WINDOW_SYSTEMATIC * scan.change[a] * ga[mode].0;
                systematic.1 += WINDOW_SYSTEMATIC * scan.change[a] * ga[mode].1;
                for (b, gb) in gradients.iter().enumerate() {
                    total.0 += ga[mode].0 * gb[mode].0 * covariance[(a, b)];
                    total.1 += ga[mode].1 * gb[mode].1 * covariance[(a, b)];
                }
            }
            total.0 += systematic.0 * systematic.0;
            total.1 += systematic.1 * systematic.1;
        }
    }
    Some(variance.iter().map(|v| (v.0.max(0.0).sqrt(), v.1.max(0.0).sqrt())).collect())
}

/// Sums of blocks of windows over every run, for tip `i`.
fn clusters(campaign: &Campaign, noise: &[RunNoise], i: usize, length_s: f64) -> Vec<Cluster> {
    let columns = campaign.channels.tips.len() + 4;
    let windows = Window::of_runs(&campaign.runs, length_s, |_, _| true);
    let of_run = |(index, window): (usize, &Option<Arc<Window>>)| {
        let (Some(window), run) = (window, &campaign.runs[index]) else { return Vec::new() };
        let step = ((window.len() as f64 * WINDOW_STEP) as usize).max(1);
        let equation = BeamEquation { campaign, run, tip: i, window };
        let noise = equation.noise(&noise[index]);
        let starts: Vec<usize> = (0..run.len() - window.len()).step_by(step).collect();
        let cluster = |block: &[usize]| {
            let mut cluster = Cluster::new(index, 0.0, columns);
            cluster.add_windows(block.iter().copied(), &equation, &noise);
            cluster
        };
        starts.chunks(BLOCK).map(cluster).collect()
    };
    windows.par_iter().enumerate().flat_map_iter(of_run).collect()
}

/// `[∫w(θ_m − θ_j).., ∫ẇθ_i, ∫ẇ(θ_i − θ_m), ∫w, ∫ẅθ_i]`, scaled by the noise that it carries.
struct BeamEquation<'a> {
    campaign: &'a Campaign,
    run: &'a Run,
    tip: usize,
    window: &'a Window,
}

impl Rows for BeamEquation<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        let Self { campaign, run, window, .. } = *self;
        row.clear();
        for j in 0..run.tips().len() {
            row.push(behind(campaign, run, j, window, k));
        }
        row.push(self.own(&window.first, k));
        row.push(self.bent(&window.first, k));
        row.push(window.area);
        row.push(self.own(&window.second, k));
        for value in row {
            *value *= window.row_scale;
        }
    }
}

impl BeamEquation<'_> {
    /// What noise adds to a row's products, in expectation.
    fn noise(&self, of_run: &RunNoise) -> DMatrix<f64> {
        let window = self.window;
        let tips = &self.campaign.channels.tips;
        let (n, own) = (tips.len(), self.tip);
        let deflection = |j: usize| tips[j].quantity == TipQuantity::Deflection;
        let mut of_motor: Vec<ChannelPart<'_>> = Vec::new();
        let mut of_tips: Vec<Vec<ChannelPart<'_>>> = vec![Vec::new(); n];
        for (j, of_tip) in of_tips.iter_mut().enumerate() {
            of_tip.push((j, &window.value, -1.0));
            if !deflection(j) {
                of_motor.push((j, &window.value, 1.0));
            }
        }
        of_tips[own].push((n + 1, &window.first, 1.0));
        if !deflection(own) {
            of_motor.push((n + 1, &window.first, -1.0));
        }
        for (column, weight) in [(n, &window.first), (n + 3, &window.second)] {
            of_tips[own].push((column, weight, 1.0));
            if deflection(own) {
                of_motor.push((column, weight, 1.0));
            }
        }
        let of_tips = of_run.tips.iter().copied().zip(of_tips);
        let noise = products(n + 4, of_tips.chain([(of_run.motor, of_motor)]));
        noise * (self.run.sample_time_s() * window.row_scale).powi(2)
    }

    /// ∫weight·(θ_i − θ_m).
    #[inline(always)]
    fn bent(&self, weight: &Weights, k: usize) -> f64 {
        let (motor, tip) = (&self.run.motor()[k..], &self.run.tips()[self.tip][k..]);
        self.run.sample_time_s()
            * match self.campaign.channels.tips[self.tip].quantity {
                TipQuantity::Deflection => weight.dot(tip),
                _ => weight.dot_difference(tip, motor),
            }
    }

    /// ∫weight·θ_i, the angle from the motor's first: keeps ∫ẅ·const at rounding of small numbers.
    #[inline(always)]
    fn own(&self, weight: &Weights, k: usize) -> f64 {
        let (motor, tip) = (&self.run.motor()[k..], &self.run.tips()[self.tip][k..]);
        self.run.sample_time_s()
            * match self.campaign.channels.tips[self.tip].quantity {
                TipQuantity::Deflection => weight.dot(tip) + weight.dot_from(motor, motor[0]),
                _ => weight.dot_from(tip, motor[0]),
            }
    }
}

#[cfg(test)]
mod tests {
    use num_complex::Complex64;

    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, TimeBase, Tip};

    /// Three sines of the motor and a tip with θ_t/θ_m = (e·s + 36)/(s² + (d + e)·s + 36), with steps of its encoder.
    fn campaign(grounded: f64, within: f64) -> Campaign {
        let t = 0.002;
        let wave = |gain: &dyn Fn(f64) -> Complex64| -> Vec<f64> {
            (0..15_000)
                .map(|k| {
                    let of_sine = |w: f64| (gain(w) * Complex64::cis(w * t * f64::from(k))).im;
                    ([2.1, 5.3, 7.9].map(of_sine).iter().sum::<f64>() / 2e-5).round() * 2e-5
                })
                .collect()
        };
        let response = |w: f64| {
            let s = Complex64::new(0.0, w);
            (within * s + 36.0) / (s * s + (grounded + within) * s + 36.0)
        };
        let (motor, tip) = (wave(&|_| Complex64::from(1.0)), wave(&response));
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let name = "tip".to_owned();
        let tips = vec![Tip { name, quantity: TipQuantity::Angle, calibrated: true }];
        let run = Run::new("sines", TimeBase::uniform(0.0, t), motor.clone(), motor, vec![tip]);
        Campaign::new(Channels { axis: Axis::Rotary, command, tips }, vec![run.unwrap()]).unwrap()
    }

    #[test]
    fn damping_of_either_kind_is_found() {
        for (grounded, within) in [(0.24, 0.0), (0.0, 0.24), (0.12, 0.12)] {
            let campaign = campaign(grounded, within);
            let found = beam_regression(&Prepared::of(&campaign)).unwrap();
            let damping = found.modes[0].damping_ratio;
            assert!((damping.value / 0.02 - 1.0).abs() < 0.02, "{grounded} {within}: {damping:?}");
        }
    }
}
