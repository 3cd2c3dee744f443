//! Ordinary least squares of the motor's equation: the line of Coulomb and viscous friction that publications usually
//! give. It is the baseline for the other methods.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one: half the time")]

use std::sync::Arc;

use rayon::prelude::*;

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::methods::regression::thresholds::{BLOCKS_WANTED, FEW_PHASES};
use crate::identify::methods::regression::{
    Candidate, Cluster, Fitted, Further, ModeTerms, MotorColumns, MotorEquation, Rows,
    SineAndCosine, Term, scan, solve, velocity_and_phases,
};
use crate::identify::methods::thresholds::{SLOWEST_SAMPLE, STANDING_SHARE};
use crate::identify::prepare::phases::{Phase, SMOOTHING_LEAST};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::prepare::window::{WINDOW_STEP, Window};
use crate::identify::thresholds::UNEXPLAINED_TORQUE;
use crate::record::{Campaign, Run};

/// Estimates of the motor's equation by ordinary least squares.
#[derive(Debug, Clone)]
pub struct LeastSquares {
    /// Inertia, Coulomb and viscous friction, offset; couplings if tips measure angles; gravity if the campaign has it.
    pub estimates: DriveEstimates,
    /// Lowest and highest speed in the middle of a window \[rad/s or m/s\].
    pub speed_range: [f64; 2],
    /// Length of the windows \[s\].
    pub window_s: f64,
    /// Window lengths that were tried.
    pub candidates: Vec<Candidate>,
    /// Number of windows used.
    pub rows: usize,
    /// Relative residual ‖y − X·q‖/‖y‖ of the windowed torque \[1\].
    pub relative_residual: f64,
    /// Products of all rows, forward and backward.
    products: [Cluster; 2],
    columns: MotorColumns,
    back_emf_viscous: f64,
}

/// Fits `τ = J·θ̈ + V·θ̇ + CF·sgn θ̇ + o + Σκ_i(θ_m − θ_i) + g_s·sin θ + g_c·cos θ` to all motion with equal weights.
///
/// The equation is multiplied by smooth windows and integrated by parts, as in the regression in slip phases. Here
/// windows may contain reversals, and Coulomb friction has the sign of the velocity at each sample. Windows are used if
/// the motor is faster than 5 % of its largest speed in their middle, and does not rest within them. Standard errors
/// assume that slip phases are independent.
///
/// If friction is not a straight line over speed, the result depends on the range of speeds
/// ([`LeastSquares::speed_range`]).
///
/// Windows have the length `window_s` \[s\] (that of the regression makes both comparable); without it, a length is
/// chosen from the data.
///
/// τ is the command times its torque constant \[N·m, N, or the unit of the command if the constant is unknown\]. `None`
/// if there is too little slipping motion.
///
/// ```
/// # use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
/// # let (t, w) = (0.002, 3.0);
/// # let wave = |f: &dyn Fn(f64) -> f64| (0..10_000).map(|k| f(t * f64::from(k))).collect::<Vec<f64>>();
/// # let motor = wave(&|s| (w * s).sin());
/// # let torque = wave(&|s| -0.02 * w * w * (w * s).sin() + 0.05 * w * (w * s).cos() + 0.3 * (w * s).cos().signum());
/// # let command = Command { quantity: CommandQuantity::Current, hold: Hold::Measured, torque_per_command: Some(1.0), back_emf_viscous: 0.0, limit: None };
/// # let run = Run::new("sine", TimeBase::uniform(0.0, t), torque, motor, vec![]).unwrap();
/// # let campaign = Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, vec![run]).unwrap();
/// use lissom::identify::{Prepared, least_squares}; // of a sine with J = 0.02, V = 0.05, C = 0.3
/// let prepared = Prepared::of(&campaign);
/// let fit = least_squares(&prepared, None).unwrap();
/// assert!((fit.estimates.friction.coulomb.unwrap().value - 0.3).abs() < 1e-3);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (14), (15)]` for the equation.
pub fn least_squares(prepared: &Prepared<'_>, window_s: Option<f64>) -> Option<LeastSquares> {
    let campaign = prepared.used();
    let columns = MotorColumns::of(campaign);
    let runs = campaign.runs.par_iter().zip(prepared.noise()).with_max_len(1);
    let runs: Vec<Moving<'_>> =
        runs.map(|(run, noise)| Moving::of(run, noise, columns.gravity)).collect();
    let fastest = runs.iter().map(Moving::fastest).fold(0.0, f64::max);
    let line = Line { campaign, columns: &columns, runs: &runs, fastest };
    let dry = Term::Plain(columns.count());
    let terms = columns.terms(dry);
    let counts: Vec<bool> = (0..terms.len()).map(|i| i < 3).collect();
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let given = window_s.as_slice();
    let found = scan(sample_s, given, &counts, |length| solve(&line.clusters(length), &terms))?;
    let window_s = found.candidates[found.chosen].window_s;
    let solution = &found.solution;
    let fitted = Fitted { solution, change: &found.change, columns: &columns };
    let mut products = [1.0, -1.0].map(|sign| Cluster::new(0, sign, columns.count() + 2));
    for cluster in line.clusters(window_s) {
        products[usize::from(cluster.sign < 0.0)].merge(&cluster);
    }
    Some(LeastSquares {
        estimates: fitted.estimates(&campaign.channels),
        speed_range: [line.slowest(window_s), fastest],
        window_s,
        rows: solution.rows,
        relative_residual: solution.relative_residual,
        candidates: found.candidates,
        products,
        back_emf_viscous: campaign.channels.command.back_emf_viscous,
        columns,
    })
}

impl LeastSquares {
    /// Whether it leaves little of the torque.
    pub(crate) fn describes_torque(&self) -> bool {
        self.relative_residual < UNEXPLAINED_TORQUE
    }

    /// Relative residual of the windowed torque with other estimates of the same equation. `None` if one of the estimates is missing.
    pub fn left_by(&self, other: &DriveEstimates) -> Option<f64> {
        let friction = &other.friction;
        let (coulomb, offset) = (friction.coulomb?.value, friction.offset?.value);
        let inertia = other.inertia?.value;
        let coupling = |tip: &usize| Some(other.coupling_by_tip.get(*tip).copied()??.value);
        let mut beside = self.columns.tips.iter().map(coupling).collect::<Option<Vec<f64>>>()?;
        if self.columns.gravity {
            let gravity = other.gravity?;
            beside.extend([gravity.sine.value, gravity.cosine.value]);
        }
        let (mut left, mut power) = (0.0, 0.0);
        for cluster in &self.products {
            let mut q = vec![inertia, friction.viscous?.value + self.back_emf_viscous, offset];
            q.extend(&beside);
            q.extend([coulomb, -1.0]);
            let last = q.len() - 1;
            for (i, a) in q.iter().enumerate() {
                for (j, b) in q.iter().enumerate() {
                    left += a * b * cluster.products[(i, j)];
                }
            }
            power += cluster.products[(last, last)];
        }
        (power > 0.0).then(|| (left.max(0.0) / power).sqrt())
    }
}

/// A run with its velocity and its direction at every sample.
struct Moving<'a> {
    run: &'a Run,
    noise: &'a RunNoise,
    phases: Vec<Phase>,
    /// +1 or −1; 0 where the motor stands.
    direction: Vec<f64>,
    speed: Vec<f64>,
    /// Samples before each at which the motor stands.
    stood: Vec<u32>,
    /// Where the campaign has gravity.
    waves: Option<SineAndCosine>,
}

impl<'a> Moving<'a> {
    fn of(run: &'a Run, noise: &'a RunNoise, gravity: bool) -> Self {
        let (motor, sample_s) = (run.motor(), run.sample_time_s());
        let smooth = noise.needed_smoothing.max(SMOOTHING_LEAST);
        let (velocity, mut phases) = velocity_and_phases(motor, smooth, sample_s);
        // What is shorter than the smoothing has no sure direction.
        phases.retain(|phase| phase.to - phase.from > smooth);
        let speed: Vec<f64> = velocity.iter().map(|v| v.abs()).collect();
        let fastest = speed.iter().copied().fold(0.0, f64::max);
        let mut direction = vec![0.0; motor.len()];
        for phase in &phases {
            direction[phase.from..phase.to].fill(phase.sign);
        }
        // A reversal is short; slower for longer than the smoothing is standing.
        let mut slow_since = None;
        for k in 0..=motor.len() {
            let slow = k < motor.len() && speed[k] < STANDING_SHARE * fastest;
            match (slow, slow_since) {
                (true, None) => slow_since = Some(k),
                (false, Some(from)) => {
                    if k - from > smooth {
                        direction[from..k].fill(0.0);
                    }
                    slow_since = None;
                }
                _ => {}
            }
        }
        let mut count = 0;
        let mut stood = vec![0];
        stood.extend(direction.iter().map(|d| {
            count += u32::from(*d == 0.0);
            count
        }));
        let waves = gravity.then(|| SineAndCosine::of(motor));
        Self { run, noise, phases, direction, speed, stood, waves }
    }

    fn fastest(&self) -> f64 {
        let within = self.speed.iter().zip(&self.direction).filter(|(_, d)| **d != 0.0);
        within.map(|(v, _)| *v).fold(0.0, f64::max)
    }

    /// Middles of the windows of `n` samples in a phase that are used, `step` apart.
    fn middles(
        &self,
        phase: &Phase,
        n: usize,
        least: f64,
    ) -> impl Iterator<Item = usize> + use<'_> {
        let step = ((n as f64 * WINDOW_STEP) as usize).max(1);
        let (before, last) = (n / 2, self.run.len().saturating_sub(n - n / 2));
        let few = (n / 8) as u32;
        (phase.from.max(before)..phase.to.min(last)).step_by(step).filter(move |&k| {
            let from = k - before;
            self.speed[k] > least && self.stood[from + n + 1] - self.stood[from] <= few
        })
    }
}

/// All runs, for windows of any length.
struct Line<'a> {
    campaign: &'a Campaign,
    columns: &'a MotorColumns,
    runs: &'a [Moving<'a>],
    fastest: f64,
}

impl Line<'_> {
    fn windows(&self, length_s: f64) -> Vec<Option<Arc<Window>>> {
        Window::of_runs(&self.campaign.runs, length_s, |_, _| true)
    }

    /// Sums of every phase, or of parts of it where phases are few.
    fn clusters(&self, length_s: f64) -> Vec<Cluster> {
        let least = SLOWEST_SAMPLE * self.fastest;
        let windows = self.windows(length_s);
        let held = |(moving, window): (&Moving<'_>, &Option<Arc<Window>>)| {
            let n = window.as_ref().map_or(usize::MAX, |w| w.len());
            moving.phases.iter().filter(|phase| phase.to - phase.from > n).count()
        };
        let phases: usize = self.runs.iter().zip(&windows).map(held).sum();
        let parts = if phases < FEW_PHASES { BLOCKS_WANTED.div_ceil(phases.max(1)) } else { 1 };
        let of_run = |(index, (moving, window)): (usize, (&Moving<'_>, &Option<Arc<Window>>))| {
            let mut clusters = Vec::new();
            let Some(window) = window else { return clusters };
            let n = window.len();
            let plain = MotorEquation {
                campaign: self.campaign,
                run: moving.run,
                columns: self.columns,
                gravity: moving.waves.as_ref(),
                window,
                mode: ModeTerms::None,
            };
            let rows = LineRow { plain, direction: &moving.direction };
            let noise = plain.noise(moving.noise, Some(Further::WithoutNoise));
            for phase in &moving.phases {
                let middles: Vec<usize> = moving.middles(phase, n, least).collect();
                let parts = parts.min(middles.len() / 8).max(1);
                for part in middles.chunks(middles.len().div_ceil(parts).max(1)) {
                    let mut cluster = Cluster::new(index, phase.sign, self.columns.count() + 2);
                    cluster.add_windows(part.iter().map(|k| k - n / 2), &rows, &noise);
                    clusters.push(cluster);
                }
            }
            clusters
        };
        let all = self.runs.par_iter().zip(&windows).with_max_len(1).enumerate();
        all.flat_map_iter(of_run).collect()
    }

    /// Least speed in the middle of a window that is used.
    fn slowest(&self, length_s: f64) -> f64 {
        let least = SLOWEST_SAMPLE * self.fastest;
        let windows = self.windows(length_s);
        let all = self.runs.iter().zip(&windows).flat_map(|(moving, window)| {
            let n = window.as_ref().map_or(usize::MAX / 4, |w| w.len());
            let phases = moving.phases.iter();
            phases.flat_map(move |p| moving.middles(p, n, least).map(|k| moving.speed[k]))
        });
        all.fold(f64::INFINITY, f64::min)
    }
}

/// A row of [`MotorColumns`] with `∫w·s` before the right side, s the direction at each sample.
struct LineRow<'a> {
    plain: MotorEquation<'a>,
    direction: &'a [f64],
}

impl Rows for LineRow<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        let MotorEquation { run, window, .. } = self.plain;
        self.plain.fill(k, row);
        let dry = window.value.dot(&self.direction[k..]) * run.sample_time_s() * window.row_scale;
        row.insert(row.len() - 1, dry);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Axis, Channels, Command, CommandQuantity, Hold, TimeBase};

    const INERTIA_KG_M2: f64 = 0.02;

    fn campaign(hold: Hold, noise: f64) -> Campaign {
        let sample_s = 1e-3;
        let wave = |of: &dyn Fn(f64) -> f64, shift: f64| -> Vec<f64> {
            (0..20_000).map(|k| of(sample_s * (f64::from(k) + shift))).collect()
        };
        let (slow, fast) = (2.0_f64, 7.0_f64);
        let angle = |t: f64| (slow * t).sin() + 0.2 * (fast * t).sin();
        let torque = |t: f64| {
            let v = slow * (slow * t).cos() + 0.2 * fast * (fast * t).cos();
            let a = -slow * slow * (slow * t).sin() - 0.2 * fast * fast * (fast * t).sin();
            INERTIA_KG_M2 * a + 0.05 * v + 0.3 * v.signum() + 0.04
        };
        // A held command is the mean over its sample.
        let shift = if hold == Hold::Sampled { 0.5 } else { 0.0 };
        let mut seed = 1_u32;
        let motor = wave(&angle, 0.0).into_iter().map(|x| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            x + noise * (f64::from(seed >> 8) / f64::from(1 << 24) - 0.5)
        });
        let motor = motor.collect();
        let run = Run::new(
            "sines",
            TimeBase::uniform(0.0, sample_s),
            wave(&torque, shift),
            motor,
            vec![],
        );
        let command = Command {
            quantity: CommandQuantity::Current,
            hold,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.01,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
        Campaign::new(channels, vec![run.unwrap()]).unwrap()
    }

    /// Of a motion whose torque is known, with either hold and with a noisy encoder.
    #[test]
    fn the_equation_of_a_known_motion_is_found() {
        for (hold, noise, within) in
            [(Hold::Measured, 0.0, 2e-3), (Hold::Sampled, 0.0, 2e-3), (Hold::Measured, 1e-3, 0.03)]
        {
            let campaign = campaign(hold, noise);
            let found = least_squares(&Prepared::of(&campaign), None).unwrap();
            let (friction, inertia) = (&found.estimates.friction, found.estimates.inertia.unwrap());
            for (name, value, truth) in [
                ("inertia", inertia.value, INERTIA_KG_M2),
                ("viscous", friction.viscous.unwrap().value, 0.04),
                ("Coulomb", friction.coulomb.unwrap().value, 0.3),
                ("offset", friction.offset.unwrap().value, 0.04),
            ] {
                assert!((value / truth - 1.0).abs() < within, "{hold:?} {noise}: {name} {value}");
            }
        }
    }

    /// Nothing of the same equation leaves less, and a wrong inertia leaves more.
    #[test]
    fn no_other_estimates_leave_less() {
        let campaign = campaign(Hold::Measured, 1e-3);
        let found = least_squares(&Prepared::of(&campaign), None).unwrap();
        let own = found.left_by(&found.estimates).unwrap();
        assert!((own - found.relative_residual).abs() < 1e-6, "{own}");
        let mut other = found.estimates.clone();
        other.inertia = other.inertia.map(|e| e.scaled(1.2));
        assert!(found.left_by(&other).unwrap() > 2.0 * own);
    }
}
