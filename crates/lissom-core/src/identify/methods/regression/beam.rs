//! The beam's own equation (13) on windows: natural frequencies and damping.

use std::sync::Arc;

use nalgebra::DMatrix;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::eigenvalues::eigenvalues;
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::methods::regression::motor_rows::{SineAndCosine, behind};
use crate::identify::methods::regression::normal::{Cluster, Rows, Term, solve};
use crate::identify::methods::regression::row_noise::{ChannelPart, products};
use crate::identify::methods::regression::scan::{Candidate, Scan, scan};
use crate::identify::methods::regression::thresholds::WINDOW_SYSTEMATIC;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::prepare::window::{Weights, Window};
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::{Axis, Campaign, Run, TipQuantity};

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
    /// Sum of the shares of each tip in the modes, 1 − b̂_i: one where the tips show all modes \[1\].
    pub shares: Vec<Estimate>,
    /// Time by which each tip is read later than the motor, as far as damping cannot explain it \[s\].
    pub lags_s: Vec<f64>,
}

/// Fits `θ̈_i = Σ_l â_il(θ_l − θ_m) − Σ_l d_il(θ̇_l − θ̇_m) − e_i·θ̇_i + b̂_i·θ̈_m + g_i·sin θ_m + h_i·cos θ_m + const` to each tip
/// over all runs, sticking or not, and computes the modes from Â and the damping. d_il is damping within the beam and e_i against
/// the fixed frame \[1/s\]; b̂_i \[1\] is what the tip follows of the motor by modes above those of the tips; g_i and h_i \[1/s²\]
/// are gravity. b̂_i, gravity, and d of a single tip are used where they are clearly present: of several tips each mode has a
/// damping ratio of its own.
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
    let sample_time = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let waves: Vec<SineAndCosine> =
        campaign.runs.iter().map(|run| SineAndCosine::of(run.motor())).collect();
    let data = (campaign, noise, waves.as_slice());
    let fits: Vec<TipFit> =
        (0..n).map(|i| TipFit::of(data, i, sample_time)).collect::<Option<_>>()?;
    let stiffness = DMatrix::from_fn(n, n, |i, j| fits[i].scan.solution.value[j]);
    let value = |fit: &TipFit, column| fit.estimate(column).map_or(0.0, |e| e.value);
    // With the motor clamped both kinds of damping are one.
    let damping = DMatrix::from_fn(n, n, |i, j| {
        let against_frame = if i == j { value(&fits[i], frame(n)) } else { 0.0 };
        value(&fits[i], n + j) + against_frame
    });
    let modes = modes(&stiffness, &damping)?;
    let whole = Estimate { value: 1.0, std: 0.0 };
    let shares = fits.iter().map(|f| {
        let follows = f.estimate(follows(n));
        follows.map_or(whole, |e| Estimate { value: 1.0 - e.value, ..e })
    });
    let shares = shares.collect();
    let lag_s = |(i, fit): (usize, &TipFit)| fit.of_lag(i, n) / stiffness.row(i).sum();
    let lags_s = fits.iter().enumerate().map(lag_s).collect();
    let std = standard_errors(&fits, &stiffness, &damping, &modes)?;
    let chosen = |s: &Scan| s.candidates[s.chosen].clone();
    Some(BeamRegression {
        window_s: fits.iter().map(|f| chosen(&f.scan).window_s).collect(),
        relative_residual: fits.iter().map(|f| chosen(&f.scan).relative_residual).collect(),
        modes: modes
            .iter()
            .zip(std)
            .map(|(m, s)| ModeEstimate {
                natural_frequency_rad_s: Estimate { value: m.0, std: s.0 },
                damping_ratio: Estimate { value: m.1, std: s.1 },
            })
            .collect(),
        candidates: fits.into_iter().map(|f| f.scan.candidates).collect(),
        stiffness,
        shares,
        lags_s,
    })
}

/// The fit of one tip's equation.
struct TipFit {
    /// Columns of [`BeamEquation`] that it has.
    columns: Vec<usize>,
    scan: Scan,
}

/// Runs, the noise of their sensors, and what gravity follows in each.
type Data<'a> = (&'a Campaign, &'a [RunNoise], &'a [SineAndCosine]);

impl TipFit {
    /// Damping within the beam of a single tip, what the tip follows by higher modes, and gravity are terms only where the motion
    /// shows them.
    fn of(data: Data<'_>, i: usize, sample_time_s: f64) -> Option<Self> {
        let channels = &data.0.channels;
        let n = channels.tips.len();
        let fitted = |columns: Vec<usize>| {
            let terms: Vec<Term> = columns.iter().copied().map(Term::Plain).collect();
            let counts: Vec<bool> = columns.iter().map(|column| *column < n).collect();
            let scan = scan(sample_time_s, &[], &counts, |length| {
                solve(&clusters(data, i, length), &terms)
            });
            Some(Self { columns, scan: scan? })
        };
        let shown = |all: &Self, column: usize| {
            all.estimate(column).is_some_and(|e| e.value.abs() > CLEARLY_PRESENT * e.std)
        };
        let without = 0..gravity(n)[0];
        let hangs = |all: &Self| gravity(n).iter().any(|column| shown(all, *column));
        let rotary = channels.axis == Axis::Rotary;
        let all = rotary.then(|| fitted((0..columns(n)).collect())).flatten().filter(hangs);
        let all = all.or_else(|| fitted(without.clone().collect()));
        let Some(all) = all else {
            return fitted((0..n).chain([frame(n), frame(n) + 1]).collect());
        };
        let is_shown = |column: &usize| {
            let within = (n..2 * n).contains(column) && n > 1;
            let sought = (n..2 * n).contains(column) || *column == follows(n);
            within || !sought || shown(&all, *column)
        };
        let kept: Vec<usize> = all.columns.iter().copied().filter(is_shown).collect();
        if kept.len() == all.columns.len() { Some(all) } else { fitted(kept) }
    }

    /// Damping of tip `i` against the frame that must be a lag \[1/s\]: a lag takes as much from the damping within the beam, and
    /// that cannot be less than none.
    fn of_lag(&self, i: usize, tips: usize) -> f64 {
        let [frame, within] = [frame(tips), tips + i].map(|column| self.estimate(column));
        let drives = within.is_some_and(|d| d.value < -CLEARLY_PRESENT * d.std);
        let damped = frame.filter(|e| drives && e.value > CLEARLY_PRESENT * e.std);
        damped.map_or(0.0, |e| e.value)
    }

    /// Coefficient of a column; `None` where the equation does not have it, or the rows do not separate it.
    fn estimate(&self, column: usize) -> Option<Estimate> {
        let at = self.columns.iter().position(|c| *c == column)?;
        let solution = &self.scan.solution;
        let std = solution.covariance[(at, at)].max(0.0).sqrt();
        (!solution.inseparable[at]).then(|| Estimate { value: solution.value[at], std })
    }
}

/// Column of damping against the frame, before that of the constant.
fn frame(tips: usize) -> usize {
    2 * tips
}

/// Column of what the tip follows by higher modes.
fn follows(tips: usize) -> usize {
    2 * tips + 2
}

/// Columns of gravity.
fn gravity(tips: usize) -> [usize; 2] {
    [2 * tips + 3, 2 * tips + 4]
}

/// Number of columns; the right side is after them.
fn columns(tips: usize) -> usize {
    2 * tips + 5
}

/// Natural frequency and damping ratio of each mode of `θ̈ = −K·δ − D·θ̇`, ascending.
fn modes(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Option<Vec<(f64, f64)>> {
    let n = stiffness.nrows();
    // Undamped squares and damped poles both from eigenvalues: n is the number of tips.
    let state = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, _) => f64::from(j == i + n),
        (false, true) => -stiffness[(i - n, j)],
        (false, false) => -damping[(i - n, j - n)],
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
    fits: &[TipFit],
    stiffness: &DMatrix<f64>,
    damping: &DMatrix<f64>,
    at: &[(f64, f64)],
) -> Option<Vec<(f64, f64)>> {
    let n = stiffness.nrows();
    let mut variance = vec![(0.0, 0.0); n];
    for (i, TipFit { columns, scan }) in fits.iter().enumerate() {
        let step = 1e-5 * stiffness[(i, i)].abs().max(1e-12);
        // Gradient of every mode with respect to row i's parameters â_il and d_il.
        let gradients: Vec<Vec<(f64, f64)>> = (0..2 * n)
            .map(|column| {
                let (mut k, mut d) = (stiffness.clone(), damping.clone());
                let step = if column < n { step } else { step.sqrt() * 1e-2 };
                let of_row = if column < n { &mut k } else { &mut d };
                of_row[(i, column % n)] += step;
                let moved = modes(&k, &d)?;
                let by =
                    |(m, a): (&(f64, f64), &(f64, f64))| ((m.0 - a.0) / step, (m.1 - a.1) / step);
                Some(moved.iter().zip(at).map(by).collect())
            })
            .collect::<Option<_>>()?;
        let constant = vec![(0.0, 0.0); n];
        let of_column = |column: &usize| match *column {
            within if within < 2 * n => &gradients[within],
            against if against == frame(n) => &gradients[n + i],
            _ => &constant,
        };
        let gradients: Vec<_> = columns.iter().map(of_column).collect();
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
fn clusters((campaign, noise, waves): Data<'_>, i: usize, length_s: f64) -> Vec<Cluster> {
    let windows = Window::of_runs(&campaign.runs, length_s, |_, _| true);
    let of_run = |(index, window): (usize, &Option<Arc<Window>>)| {
        let (Some(window), run) = (window, &campaign.runs[index]) else { return Vec::new() };
        let equation = BeamEquation { campaign, run, waves: &waves[index], tip: i, window };
        let noise = equation.noise(&noise[index]);
        Cluster::blocks(index, run.len(), window, (&equation, &noise))
    };
    windows.par_iter().enumerate().flat_map_iter(of_run).collect()
}

/// `[∫w(θ_m − θ_l).., ∫ẇ(θ_l − θ_m).., ∫ẇθ_i, ∫w, ∫ẅθ_m, ∫w·sin θ_m, ∫w·cos θ_m, ∫ẅθ_i]`, scaled by the noise that it carries.
struct BeamEquation<'a> {
    campaign: &'a Campaign,
    run: &'a Run,
    waves: &'a SineAndCosine,
    tip: usize,
    window: &'a Window,
}

impl Rows for BeamEquation<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        let Self { campaign, run, waves: SineAndCosine(waves), window, .. } = *self;
        row.clear();
        let tips = 0..run.tips().len();
        row.extend(tips.clone().map(|l| behind(campaign, run, l, window, k)));
        row.extend(tips.map(|l| self.bent(l, &window.first, k)));
        row.push(self.own(&window.first, k));
        row.push(window.area);
        let motor = &run.motor()[k..];
        row.push(run.sample_time_s() * window.second.dot_from(motor, motor[0]));
        row.extend(waves.iter().map(|wave| window.value.dot(&wave[k..]) * run.sample_time_s()));
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
        let deflection = |l: usize| tips[l].quantity == TipQuantity::Deflection;
        let mut of_motor: Vec<ChannelPart<'_>> = vec![(follows(n), &window.second, 1.0)];
        let mut of_tips: Vec<Vec<ChannelPart<'_>>> = vec![Vec::new(); n];
        for (l, of_tip) in of_tips.iter_mut().enumerate() {
            of_tip.push((l, &window.value, -1.0));
            of_tip.push((n + l, &window.first, 1.0));
            if !deflection(l) {
                of_motor.push((l, &window.value, 1.0));
                of_motor.push((n + l, &window.first, -1.0));
            }
        }
        for (column, weight) in [(frame(n), &window.first), (columns(n), &window.second)] {
            of_tips[own].push((column, weight, 1.0));
            if deflection(own) {
                of_motor.push((column, weight, 1.0));
            }
        }
        let of_tips = of_run.tips.iter().copied().zip(of_tips);
        let noise = products(columns(n) + 1, of_tips.chain([(of_run.motor, of_motor)]));
        noise * (self.run.sample_time_s() * window.row_scale).powi(2)
    }

    /// ∫weight·(θ_l − θ_m).
    #[inline(always)]
    fn bent(&self, l: usize, weight: &Weights, k: usize) -> f64 {
        let (motor, tip) = (&self.run.motor()[k..], &self.run.tips()[l][k..]);
        self.run.sample_time_s()
            * match self.campaign.channels.tips[l].quantity {
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
