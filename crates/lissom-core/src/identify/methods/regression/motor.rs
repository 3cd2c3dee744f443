//! The motor's equation in slip phases.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::gravity_estimate::Gravity;
use crate::identify::methods::friction_law::{Moved, MovingTerm, PossibleTerm, widened};
use crate::identify::methods::regression::cluster_covariance::larger;
use crate::identify::methods::regression::extra_delay::extra_delay;
use crate::identify::methods::regression::fitted::Fitted;
use crate::identify::methods::regression::hidden_mode::{HiddenMode, ShownMode, shown_mode};
use crate::identify::methods::regression::left_out::{RunLeftOut, rms_speed, runs_left_out};
use crate::identify::methods::regression::left_torque::LeftTorque;
use crate::identify::methods::regression::motor_columns::{
    DRY, PLACE_COULOMB, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS,
};
use crate::identify::methods::regression::motor_rows::MotorRows;
use crate::identify::methods::regression::normal::{Cluster, Solution, Term};
use crate::identify::methods::regression::scan::{Candidate, RATIO, Scan};
use crate::identify::methods::regression::sums_by_length::SumsByLength;
use crate::identify::methods::regression::terms::Terms;
use crate::identify::methods::regression::thresholds::{FEW_PHASES, USUAL_VARIATION};
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_noise::RunNoise;
use crate::identify::thresholds::PRESENT;
use crate::record::{Campaign, Run};

/// Estimates from the motor's equation, in torque (or force) according to the torque constant of the command.
#[derive(Debug, Clone, PartialEq)]
pub struct MotorRegression {
    /// Length of the window that was used \[s\].
    pub window_s: f64,
    /// Whether that length was given instead of chosen from the data.
    pub window_given: bool,
    /// Window lengths that were tried.
    pub candidates: Vec<Candidate>,
    /// Number of windows in the fit.
    pub rows: usize,
    /// Number of slip phases with at least one window.
    pub phases: usize,
    /// Relative residual ‖y − X·q‖/‖y‖ of the windowed torque \[1\].
    pub relative_residual: f64,
    /// Inertia J \[kg·m²\] or mass \[kg\].
    pub inertia: Option<Estimate>,
    /// Viscous friction V, without the damping by back-EMF \[N·m·s/rad or N·s/m\].
    pub viscous: Option<Estimate>,
    /// Coulomb friction, mean of both directions \[N·m or N\].
    pub coulomb: Option<Estimate>,
    /// Offset, (forward − backward)/2 \[N·m or N\].
    pub offset: Option<Estimate>,
    /// Coulomb friction while moving forward \[N·m or N\].
    pub forward: Option<Estimate>,
    /// Coulomb friction while moving backward, a magnitude \[N·m or N\].
    pub backward: Option<Estimate>,
    /// Coupling to all tips together, Σκ_i \[N·m/rad\]; `None` if no tip measures an angle.
    pub total_coupling: Option<Estimate>,
    /// Coupling to each tip of the campaign, κ_i = −h_i of (15) \[N·m/rad\]; `None` if the tip measures no angle or
    /// cannot be separated from others. Empty if no tip measures an angle.
    pub coupling: Vec<Option<Estimate>>,
    /// Gravity, if the campaign has it.
    pub gravity: Option<Gravity>,
    /// A flexible mode that no tip measures and that the estimates take into account.
    pub mode: Option<HiddenMode>,
    /// Composition of the residual torque.
    pub left: LeftTorque,
    /// Delay of the command in addition to the terms of the equation \[s\], with the channels as they are logged; `None` if the
    /// logs do not show it.
    pub delay: Option<Estimate>,
    /// Share by which inertia is underestimated if the residual torque is not noise but a real torque that accelerates
    /// the motor \[1\], for example friction that varies in an open loop. Given if each run turns in one direction,
    /// because such runs are not driven by a position loop.
    pub inertia_short_by: Option<f64>,
    /// Terms that are not known to be absent.
    pub(crate) possible: Vec<PossibleTerm>,
    /// The same without each run in turn.
    pub(crate) left_out: Vec<RunLeftOut>,
    /// The same in windows of which each run has some.
    pub(crate) beside_others: Vec<RunLeftOut>,
    /// The same with a flexible mode that no tip measures, if slip phases may show one.
    pub(crate) with_mode: Option<Box<MotorRegression>>,
    /// J, V, CF, offset, κ_i of the tips whose angle is known, g_s and g_c, as the logs have them.
    pub(crate) terms: Terms,
}

/// Fits `τ = J·θ̈ + V·θ̇ + Σκ_i(θ_m − θ_i) + CF·sgn θ̇ + offset + g_s·sin θ + g_c·cos θ` to the slip phases of all
/// runs; the terms of gravity only if the campaign has it.
///
/// The equation is multiplied by `w = sin⁴` windows within each slip phase and integrated by parts:
/// `∫w·τ = J∫ẅ·θ − V∫ẇ·θ + Σκ_i∫w(θ_m − θ_i) + (±CF + offset)∫w`. A sampled (held) command is integrated exactly. The
/// covariance assumes that slip phases are independent, and runs if there are several; it includes the change of the
/// estimates with the length of the window.
///
/// If `options.window_s` contains lengths, one of them is used; otherwise a length is chosen from the data. `None` if
/// there are too few windows in slip phases.
///
/// τ is the command times its torque constant \[N·m, N, or the unit of the command if the constant is unknown\]. θ_i −
/// θ_m is measured, so no model of the beam is needed.
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
/// use lissom::identify::{Options, Prepared, motor_regression}; // of a sine with J = 0.02, V = 0.05, CF = 0.3
/// let prepared = Prepared::of(&campaign);
/// let fit = motor_regression(&prepared, &Options::default()).unwrap();
/// assert!((fit.coulomb.unwrap().value - 0.3).abs() < 1e-3);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (14), (15)]` for the equation; the method of fitting is lissom's own
/// (`docs/src/theory/regression.md`).
pub fn motor_regression(prepared: &Prepared<'_>, options: &Options) -> Option<MotorRegression> {
    // Many short loops: within the pool none of them has to wake it first.
    rayon::scope(|_| on_slip_phases(prepared.used(), prepared.noise(), &options.window_s))
}

/// Repeats the regression without each run in turn: in windows of the chosen length, and, if some runs have none of these, in the
/// longest windows that the most runs have. The equation is the one without a mode, because a run that differs from the others can
/// look like a mode.
fn without_each_run(sums: &SumsByLength<'_>, scanned: &Scan) -> [Vec<RunLeftOut>; 2] {
    let equation = sums.equation;
    let terms = equation.columns.terms(Term::Signed(DRY));
    let speeds: Vec<f64> = equation.campaign.runs.iter().map(rms_speed).collect();
    let in_windows = |length: f64| runs_left_out(&sums.clusters(length), &terms, &speeds);
    let left_out = in_windows(scanned.candidates[scanned.chosen].window_s);
    if left_out.is_empty() || left_out.len() == equation.runs() {
        return [left_out.clone(), left_out];
    }
    let with_rows: Vec<(f64, usize)> = scanned
        .candidates
        .iter()
        .map(|c| (c.window_s, equation.runs_with_rows(c.window_s)))
        .collect();
    let most = with_rows.iter().map(|(_, runs)| *runs).max().unwrap_or(0);
    let longest = with_rows.iter().filter(|(_, runs)| *runs == most).map(|(length, _)| *length);
    let beside_others = longest.max_by(f64::total_cmp).map(in_windows).unwrap_or_default();
    [left_out, beside_others]
}

fn on_slip_phases(
    campaign: &Campaign,
    noise: &[RunNoise],
    window_s: &[f64],
) -> Option<MotorRegression> {
    let as_logged = MotorRows::of(campaign, noise);
    let sums = SumsByLength::of(&as_logged);
    let sample_time = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let found = sums.scan(sample_time, window_s)?;
    let factor = sums.command_noise_factor(&found);
    let rigid = as_logged.with_command_noise(factor);
    let sums = sums.with_command_noise(&rigid, factor);
    let [left_out, beside_others] = without_each_run(&sums, &found);
    // A log does not show the motion of a mode above its Nyquist frequency.
    let is_logged = |mode: &ShownMode| mode.shape.omega_rad_s * sample_time < PI;
    let shown = shown_mode(&sums, &found).filter(is_logged);
    let with_mode = shown.and_then(|mode| {
        let rows = rigid.with_mode(mode.shape);
        let sums = SumsByLength::of_mode(&rows, mode.shapes_beside());
        let without = found.solution.clone();
        let found = of_scan(campaign, &sums, sums.scan(sample_time, window_s)?, window_s);
        let moves = Moved::between(&without, &found.terms.values);
        Some(Box::new(MotorRegression { mode: Some(mode.report(moves)), ..found }))
    });
    let found = of_scan(campaign, &sums, found, window_s);
    Some(MotorRegression { left_out, beside_others, with_mode, ..found })
}

/// The estimates in the windows that a scan chose.
fn of_scan(
    campaign: &Campaign,
    sums: &SumsByLength<'_>,
    found: Scan,
    window_s: &[f64],
) -> MotorRegression {
    let equation = sums.equation;
    let columns = &equation.columns;
    let terms = columns.terms(Term::Signed(DRY));
    let chosen = &found.candidates[found.chosen];
    let (channels, window_s_chosen) = (&campaign.channels, chosen.window_s);
    let phases = equation.phases(window_s_chosen);
    let clusters = equation.clusters_with_delay(window_s_chosen);
    let mut solution = found.solution;
    if phases < FEW_PHASES {
        // Of few strokes the window with the least scatter is in part one whose scatter came out small.
        for length in [window_s_chosen / RATIO, window_s_chosen * RATIO] {
            let beside =
                sums.solved(length, &terms).map(|s| larger(&solution.covariance, &s.covariance));
            solution.covariance = beside.unwrap_or(solution.covariance);
        }
        solution.covariance += of_usual_variation(&clusters, &terms, &solution);
    }
    let solution = &solution;
    let one = Fitted { solution, change: &found.change, columns };
    let DriveEstimates { friction, inertia, coupling: total_coupling, coupling_by_tip, gravity } =
        one.estimates(channels);
    let left = LeftTorque::of(&clusters, &terms, solution);
    let from_chosen =
        || found.candidates.iter().map(|c| c.window_s).filter(|l| *l >= window_s_chosen);
    // Noise of the command averages out in longer windows; friction that wanders does not.
    let share = |length: f64| {
        let s = sums.solved(length, &terms)?;
        Some(s.turned_round[PLACE_INERTIA] / s.value[PLACE_INERTIA].powi(2))
    };
    let short_by = || from_chosen().filter_map(share).fold(f64::INFINITY, f64::min);
    let inertia_short_by = turn_one_way(&clusters).then(short_by);
    MotorRegression {
        window_s: chosen.window_s,
        window_given: !window_s.is_empty(),
        rows: chosen.rows,
        phases,
        relative_residual: solution.relative_residual,
        inertia,
        viscous: friction.viscous,
        coulomb: friction.coulomb,
        offset: friction.offset,
        forward: friction.forward,
        backward: friction.backward,
        total_coupling,
        coupling: coupling_by_tip,
        gravity,
        mode: None,
        possible: Vec::new(),
        left,
        delay: extra_delay(&clusters, &terms, columns),
        inertia_short_by,
        left_out: Vec::new(),
        beside_others: Vec::new(),
        with_mode: None,
        terms: Terms::of(&one),
        candidates: found.candidates,
    }
}

/// What friction that varies from one slip phase to the next as much as usual adds to the covariance: few phases do not show
/// it.
fn of_usual_variation(clusters: &[Cluster], terms: &[Term], solution: &Solution) -> DMatrix<f64> {
    let p = terms.len();
    let mut sum: DMatrix<f64> = DMatrix::zeros(p, p);
    let mut normal: DMatrix<f64> = DMatrix::zeros(p, p);
    let mut of_phase = DVector::zeros(p);
    let mut before: Option<(usize, f64)> = None;
    for cluster in clusters {
        // Neighbours of one direction are parts of one phase.
        if before.is_some_and(|b| b != (cluster.run, cluster.sign)) {
            sum += &of_phase * of_phase.transpose();
            of_phase.fill(0.0);
        }
        before = Some((cluster.run, cluster.sign));
        for (i, term) in terms.iter().enumerate() {
            let factor = term.factor(cluster.sign);
            of_phase[i] += factor * cluster.products[(term.column(), DRY)];
            for (j, other) in terms.iter().enumerate() {
                let products = cluster.products[(term.column(), other.column())];
                normal[(i, j)] += factor * other.factor(cluster.sign) * products;
            }
        }
    }
    sum += &of_phase * of_phase.transpose();
    let variation = USUAL_VARIATION * solution.value[PLACE_COULOMB];
    match normal.try_inverse() {
        Some(inverse) => &inverse * sum * &inverse * variation.powi(2),
        None => DMatrix::zeros(p, p),
    }
}

impl MotorRegression {
    /// By how much friction changes from one slip phase to the next, as a share of Coulomb friction.
    pub(crate) fn varies_by(&self) -> Option<f64> {
        self.left.is_between_phases().then_some(self.left.varies_by)
    }

    /// Terms that are not known to be absent and would change estimates by more than three of their standard errors.
    pub(crate) fn moving(&self) -> impl Iterator<Item = MovingTerm> {
        let estimates = [self.inertia, self.viscous, self.coulomb];
        let all = self.possible.iter().map(move |p| MovingTerm::of(p, estimates));
        all.filter(|m| m.moves.iter().any(|m| m.standard_errors.abs() > PRESENT))
    }

    /// The estimates with one viscous coefficient. Standard errors of friction and inertia count what terms that are not known to
    /// be absent would change. The coupling keeps its own: its sign tells whether a tip's sensor is reversed.
    pub fn estimates(&self) -> DriveEstimates {
        let counted = |e: Option<Estimate>, weights: &[(usize, f64)]| {
            let of = |change: &[f64]| weights.iter().map(|(i, w)| w * change[*i]).sum();
            // An offset may be zero.
            let is_offset = weights[0].0 == PLACE_OFFSET;
            let size = self.coulomb.filter(|_| is_offset).map_or(0.0, |c| c.value.abs());
            e.map(|e| widened(e, size, &self.possible, of))
        };
        let friction = Friction {
            coulomb: counted(self.coulomb, &[(PLACE_COULOMB, 1.0)]),
            forward: counted(self.forward, &[(PLACE_COULOMB, 1.0), (PLACE_OFFSET, 1.0)]),
            backward: counted(self.backward, &[(PLACE_COULOMB, 1.0), (PLACE_OFFSET, -1.0)]),
            offset: counted(self.offset, &[(PLACE_OFFSET, 1.0)]),
            viscous: counted(self.viscous, &[(PLACE_VISCOUS, 1.0)]),
            ..Friction::default()
        };
        DriveEstimates {
            friction,
            inertia: counted(self.inertia, &[(PLACE_INERTIA, 1.0)]),
            coupling: self.total_coupling,
            coupling_by_tip: self.coupling.clone(),
            gravity: self.gravity,
        }
    }

    /// Relative error ‖y − X·q‖/‖y‖ with which these estimates predict the windowed torque of other runs \[1\], in
    /// their slip phases and with the window of this fit. `None` if no slip phase contains a window.
    pub fn prediction_error(&self, prepared: &Prepared<'_>) -> Option<f64> {
        let equation = MotorRows::of(prepared.used(), prepared.noise());
        let values = &self.terms.values;
        if self.terms.columns != equation.columns {
            return None;
        }
        let (mut left, mut power) = (0.0, 0.0);
        let equation = match self.mode {
            Some(mode) => equation.with_mode(mode.shape()),
            None => equation,
        };
        for c in equation.clusters(self.window_s) {
            let last = c.products.ncols() - 1;
            let mut q = vec![values[0], values[1]];
            q.push(c.sign * values[2] + values[3]);
            q.extend(&values[4..]);
            q.push(-1.0);
            let q = DVector::from_vec(q);
            left += q.dot(&(&c.products * &q));
            power += c.products[(last, last)];
        }
        (power > 0.0).then(|| (left.max(0.0) / power).sqrt())
    }
}

/// Whether each run turns one way.
fn turn_one_way(clusters: &[Cluster]) -> bool {
    clusters.windows(2).all(|pair| pair[0].run != pair[1].run || pair[0].sign * pair[1].sign > 0.0)
}
