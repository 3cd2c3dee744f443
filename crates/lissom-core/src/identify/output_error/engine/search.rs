//! Levenberg-Marquardt search in parameters that all windows share and in unknowns of each window.

use nalgebra::{DMatrix, DVector};

use crate::friction::TermScale;
use crate::identify::methods::friction_law::thresholds::NEAR_REST_MOST;
use crate::identify::output_error::engine::budget::Budget;
use crate::identify::output_error::engine::noise::is_least;
use crate::identify::output_error::engine::windows::{fastest_rad_s, travel};
use crate::identify::output_error::thresholds::{
    MODE_TURN_MOST, NEAR_REST_SPEED_LEAST, RATE_MOST, RIPPLE_PHASE_LEAST, RIPPLE_PHASE_MOST,
    STEP_DAMPING_MOST, STEP_LOGARITHM_MOST, STEP_VELOCITY_MOST, TIP_LAG_MOST, WINDOW_COST_HALF,
};
use crate::information::{Reduced, inverse};
use crate::record::{Campaign, Run};
use crate::replay::{
    Body, ModalArm, Oscillator, Parameter, Sampling, Window, WindowSums, costs, in_coordinates,
    sums,
};

/// Damping of the first step, relative to the diagonal; and where sensors' steps are counted, because their edges
/// reject long steps of the search.
const FIRST_DAMPING: f64 = 1e-3;
const FIRST_DAMPING_OVER_STEPS: f64 = 0.1;
/// Factor by which damping falls after a step that lowers the cost as expected (Nielsen); and where sensors show
/// steps and no noise, because the damping grows first at the edges of their steps.
const EASING: f64 = 1.0 / 3.0;
const EASING_OVER_STEPS: f64 = 0.1;
/// A step keeps its promise if the cost falls by this share of the expected fall.
const PROMISE_KEPT: f64 = 0.5;

/// A point of the search: parameters, windows, and sums over their residuals.
#[derive(Debug, Clone)]
pub(crate) struct SearchPoint {
    pub(crate) body: Body,
    pub(crate) windows: Vec<Window>,
    /// Sums, with derivatives by the body's coordinates.
    pub(crate) sums: Vec<WindowSums>,
}

impl SearchPoint {
    /// [`WINDOW_COST_HALF`] times the median of the windows' costs per sample.
    fn usual(&self) -> f64 {
        let mut each: Vec<f64> = self.sums.iter().map(per_sample).collect();
        each.sort_by(f64::total_cmp);
        WINDOW_COST_HALF * each.get(each.len() / 2).copied().unwrap_or(0.0).max(1.0)
    }

    fn robust_cost(&self, usual: f64) -> f64 {
        self.sums.iter().map(|s| robust(s.cost, s.samples, usual)).sum()
    }
}

/// Robust cost `n·κ·ln(1 + c/(n·κ))` of a window with cost c and n samples. It grows slowly if the replay sticks and
/// slips at other times than the log.
fn robust(cost: f64, samples: usize, usual: f64) -> f64 {
    let n = samples as f64 * usual;
    if usual.is_finite() { n * (cost / n).ln_1p() } else { cost }
}

fn per_sample(sums: &WindowSums) -> f64 {
    sums.cost / sums.samples.max(1) as f64
}

/// Derivative of a window's share in the robust cost by its own cost.
fn weight(sums: &WindowSums, usual: f64) -> f64 {
    1.0 / (1.0 + per_sample(sums) / usual)
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Stop {
    /// A further step is expected to lower the cost by too little: compared with the noise, or compared with the cost
    /// itself if other stages follow or the residual is far above the noise.
    Converged,
    /// No step, however short, lowers the cost: it has a kink there.
    NoStepHelps,
    /// The largest number of steps is reached.
    StepsUsedUp,
    /// The limit of evaluations is reached.
    BudgetSpent,
}

/// A step of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Sum of squared residuals in standard deviations of the noise, after the step.
    pub cost: f64,
    /// Expected fall of the cost.
    pub promised: f64,
    /// Damping of Levenberg and Marquardt.
    pub damping: f64,
    /// Whether the step was accepted.
    pub taken: bool,
}

/// The problem that a search solves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ReplayProblem<'a> {
    pub(crate) campaign: &'a Campaign,
    pub(crate) parameters: &'a [Parameter],
    pub(crate) sampling: Sampling<'a>,
    pub(crate) budget: &'a Budget,
    /// Whether windows that fit far worse than the others count less.
    pub(crate) robust: bool,
    /// Expected fall of the cost below which the search ends.
    pub(crate) promise: f64,
    /// Expected fall, as a share of the cost, below which the search ends as well.
    pub(crate) near_enough: f64,
}

impl ReplayProblem<'_> {
    /// Replays `windows` through `body`.
    pub(crate) fn at(&self, body: Body, windows: Vec<Window>) -> SearchPoint {
        let filtered = self.sampling.command_noise > 0.0;
        self.budget.count(samples_of(&windows), self.parameters.len(), filtered);
        let mut sums = sums(&body.arm, self.parameters, self.campaign, &windows, self.sampling);
        if let Some(jacobian) = body.jacobian(self.parameters) {
            sums = sums.iter().map(|s| in_coordinates(s, &jacobian)).collect();
        }
        SearchPoint { body, windows, sums }
    }

    /// Lowers the cost from `point` by at most `steps` steps.
    pub(crate) fn search(
        &self,
        mut point: SearchPoint,
        steps: usize,
    ) -> (SearchPoint, Vec<Iteration>, Stop) {
        let over_steps = self.sampling.noise.iter().any(is_least);
        let (mut damping, easing) = if over_steps {
            (FIRST_DAMPING_OVER_STEPS, EASING_OVER_STEPS)
        } else {
            (FIRST_DAMPING, EASING)
        };
        let mut growth = 2.0;
        let mut kept_its_promise = false;
        let mut iterations = Vec::new();
        for _ in 0..steps {
            if self.budget.is_spent() {
                return (point, iterations, Stop::BudgetSpent);
            }
            let usual = if self.robust { point.usual() } else { f64::INFINITY };
            let Some(step) = self.step(&point, damping, usual) else {
                return (point, iterations, Stop::NoStepHelps);
            };
            let before = point.robust_cost(usual);
            if step.promised < self.promise.max(self.near_enough * before) {
                return (point, iterations, Stop::Converged);
            }
            let (body, windows) = self.moved(&point, &step);
            let possible = is_possible(self.campaign, &body.arm);
            // A step after one that kept its promise is usually accepted, so it is replayed with its derivatives at
            // once.
            let ahead =
                (possible && kept_its_promise).then(|| self.at(body.clone(), windows.clone()));
            let after = match &ahead {
                Some(ahead) => ahead.robust_cost(usual),
                None if possible => {
                    let filtered = self.sampling.command_noise > 0.0;
                    self.budget.count(samples_of(&windows), 0, filtered);
                    let costs = costs(&body.arm, self.campaign, &windows, self.sampling);
                    let samples = point.sums.iter().map(|s| s.samples);
                    costs.iter().zip(samples).map(|(c, n)| robust(c.cost, n, usual)).sum()
                }
                None => f64::INFINITY,
            };
            let gain = (before - after) / step.promised;
            let taken = after < before;
            kept_its_promise = gain > PROMISE_KEPT;
            let cost = if taken { after } else { before };
            iterations.push(Iteration { cost, promised: step.promised, damping, taken });
            if taken {
                point = ahead.unwrap_or_else(|| self.at(body, windows));
                damping *= (1.0 - (2.0 * gain - 1.0).powi(3)).max(easing);
                growth = 2.0;
            } else {
                damping *= growth;
                growth *= 2.0;
                if damping > STEP_DAMPING_MOST {
                    return (point, iterations, Stop::NoStepHelps);
                }
            }
        }
        (point, iterations, Stop::StepsUsedUp)
    }

    fn moved(&self, point: &SearchPoint, step: &Step) -> (Body, Vec<Window>) {
        let mut body = point.body.clone();
        let coordinates = body.coordinates(self.parameters);
        for (coordinate, change) in coordinates.into_iter().zip(step.shared.iter()) {
            let change = match body.scale(coordinate) {
                Some(value) => {
                    value
                        * (change / value).clamp(-STEP_LOGARITHM_MOST, STEP_LOGARITHM_MOST).exp_m1()
                }
                None => *change,
            };
            body.shift(coordinate, change);
        }
        let windows = point
            .windows
            .iter()
            .zip(&step.own)
            .map(|(w, change)| {
                let mut w = w.clone();
                let len = w.start.len();
                w.start.iter_mut().zip(change.iter()).for_each(|(x, c)| *x += c);
                w.zeros.iter_mut().zip(change.iter().skip(len)).for_each(|(x, c)| *x += c);
                w
            })
            .collect();
        (body, windows)
    }

    fn step(&self, point: &SearchPoint, damping: f64, usual: f64) -> Option<Step> {
        let shared = point.body.coordinates(self.parameters).len();
        let reduced: Vec<Reduced> =
            point.sums.iter().map(|s| Reduced::new(s, shared, damping)).collect();
        let mut normal = DMatrix::zeros(shared, shared);
        let mut right = DVector::zeros(shared);
        let mut diagonal = DVector::zeros(shared);
        for (r, s) in reduced.iter().zip(&point.sums) {
            let weight = weight(s, usual);
            normal += &r.normal * weight;
            right += &r.right * weight;
            diagonal += s.gram.diagonal().rows(0, shared) * weight;
        }
        for i in 0..shared {
            normal[(i, i)] += damping * diagonal[i];
        }
        let change = inverse(&normal) * right;
        let mut own: Vec<DVector<f64>> =
            reduced.iter().map(|r| &r.own - &r.by_shared * &change).collect();
        for (own, window) in own.iter_mut().zip(&point.windows) {
            let fastest = fastest_within(&self.campaign.runs[window.run], window);
            own[1] = kick(own[1], window.start[1], fastest);
        }
        // Decrease of the quadratic model: δᵀ(g + λ·diag·δ) = 2·gᵀδ − δᵀHδ.
        let mut promised = 0.0;
        for (s, own) in point.sums.iter().zip(&own) {
            let size = s.gram.ncols() - 1;
            let mut all = DVector::zeros(size);
            all.rows_mut(0, shared).copy_from(&change);
            all.rows_mut(shared, size - shared).copy_from(own);
            let g = s.gram.column(size).rows(0, size).into_owned();
            let bend = all.dot(&(s.gram.view((0, 0), (size, size)) * &all));
            promised += weight(s, usual) * (2.0 * g.dot(&all) - bend);
        }
        promised.is_finite().then_some(Step { shared: change, own, promised })
    }
}

fn samples_of(windows: &[Window]) -> usize {
    windows.iter().map(Window::len).sum()
}

/// Limits the change of a window's first velocity in one step.
fn kick(change: f64, velocity: f64, fastest: f64) -> f64 {
    let (most, to_rest) = (STEP_VELOCITY_MOST * fastest, -velocity);
    change.clamp(to_rest.min(-most), to_rest.max(most))
}

/// Largest speed of the logged motor in a window.
fn fastest_within(run: &Run, window: &Window) -> f64 {
    let moves =
        run.motor()[window.samples.clone()].windows(2).map(|pair| (pair[1] - pair[0]).abs());
    moves.fold(0.0, f64::max) / run.sample_time_s()
}

/// Whether friction with all of its terms brakes, at rest and at speed; otherwise nothing holds the motor. Also
/// whether the runs can show its terms: a change within very low speeds, or waves that pass within a sample, need
/// ever shorter steps of the replay, and waves far longer than the travel are nearly constant.
fn is_braking(campaign: &Campaign, arm: &ModalArm, sample_s: f64) -> bool {
    let terms = &arm.dry_terms;
    if terms.is_empty() {
        return true;
    }
    let fastest = fastest_rad_s(campaign);
    let travel = travel(campaign);
    let shown = |scale: TermScale| match scale {
        TermScale::Speed(speed) => {
            (NEAR_REST_SPEED_LEAST * fastest..=NEAR_REST_MOST * fastest).contains(&speed)
        }
        TermScale::PerAngle(k) => {
            k * travel > RIPPLE_PHASE_LEAST && k * fastest * sample_s < RIPPLE_PHASE_MOST
        }
    };
    terms.scales().all(shown) && arm.coulomb_nm + terms.least_braking_nm() > 0.0
}

/// Whether an arm is within the limits of the search: friction brakes, and every mode turns by less than
/// [`MODE_TURN_MOST`] in a sample. Faster modes are in no log, and they and rates above [`RATE_MOST`] need ever shorter
/// steps of the replay.
pub(crate) fn is_possible(campaign: &Campaign, arm: &ModalArm) -> bool {
    let sample_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let turn = |m: &Oscillator| m.omega_rad_s * sample_s;
    let damped = |m: &Oscillator| (m.within_per_s.abs() + m.grounded_per_s.abs()) * sample_s;
    let rigid = arm.coupling_nm_per_rad() / arm.inertia_kg_m2 * sample_s * sample_s;
    arm.modes.iter().all(|m| turn(m) < MODE_TURN_MOST && damped(m) < MODE_TURN_MOST)
        && arm.at_points_per_s.iter().all(|c| (c * sample_s).abs() < MODE_TURN_MOST)
        && arm.tip_lags_s.iter().all(|lag| lag.abs() < TIP_LAG_MOST * sample_s)
        && rigid < MODE_TURN_MOST * MODE_TURN_MOST
        && arm.rate_bound() * sample_s < RATE_MOST
        && is_braking(campaign, arm, sample_s)
}

struct Step {
    shared: DVector<f64>,
    own: Vec<DVector<f64>>,
    promised: f64,
}

#[cfg(test)]
mod tests {
    use crate::identify::output_error::engine::search::{is_possible, kick};
    use crate::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
    use crate::replay::{DryTerms, ModalArm, Ripple};

    /// A ripple far longer than the travel is a constant, and one that passes within a sample is no ripple.
    #[test]
    fn ripples_are_waves_over_the_travel() {
        let motor: Vec<f64> = (0..400).map(|k| 0.35 * (0.05 * f64::from(k)).sin()).collect();
        let still = vec![0.0; motor.len()];
        let run = Run::new("sine", TimeBase::uniform(0.0, 0.002), still, motor, vec![]).unwrap();
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Sampled,
            torque_per_command: Some(0.5),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: Vec::new() };
        let campaign = Campaign::new(channels, vec![run]).unwrap();
        let with = |per_rad: f64| ModalArm {
            inertia_kg_m2: 0.02,
            viscous_nm_s_per_rad: [0.05; 2],
            coulomb_nm: 0.3,
            offset_nm: 0.0,
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            dry_terms: DryTerms {
                ripples: vec![Ripple { per_rad, cosine_nm: 0.01, sine_nm: 0.0 }],
                ..DryTerms::default()
            },
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        };
        for (per_rad, possible) in
            [(-4.0, false), (1e-6, false), (0.5, false), (4.0, true), (2e3, false)]
        {
            assert_eq!(is_possible(&campaign, &with(per_rad)), possible, "{per_rad}");
        }
    }

    #[test]
    fn a_step_kicks_no_window_but_to_rest() {
        for (change, velocity, fastest, made) in [
            (0.1, 5.0, 2.0, 0.1),
            (100.0, 5.0, 2.0, 0.6),
            (-100.0, 5.0, 2.0, -5.0),
            (-100.0, -5.0, 2.0, -0.6),
            (100.0, 0.0, 0.0, 0.0),
        ] {
            let found = kick(change, velocity, fastest);
            assert!((found - made).abs() < 1e-12, "{change} {velocity} {found}");
        }
    }
}
