//! The motor's equation on slip phases.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::missing::{MissingTerm, missing_term};
use super::motor_rows::{DRY, INERTIA, MotorRows, TIPS, VISCOUS};
use super::normal::{Cluster, Solution, Term, solve};
use super::scan::{Candidate, SYSTEMATIC, Scan, scan};
use crate::identify::Estimate;
use crate::record::{Campaign, Run};

/// Directional viscous terms are reported when they differ by this many deviations…
const DIRECTION_DEVIATIONS: f64 = 4.0;
/// …and leave at most this share of the residual.
const DIRECTION_RESIDUAL: f64 = 0.9;

/// Figures of the motor's equation, in torque (or force) as the command's constant gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct MotorRegression {
    /// Length of the window used \[s\].
    pub window_s: f64,
    /// Whether that length was given rather than chosen.
    pub window_given: bool,
    /// Lengths tried.
    pub candidates: Vec<Candidate>,
    /// Rows in the fit.
    pub rows: usize,
    /// Slip phases that hold at least one window.
    pub phases: usize,
    /// ‖y − X·q‖/‖y‖: part of the windowed torque that the model leaves.
    pub relative_residual: f64,
    /// Inertia J \[kg·m²\] or mass \[kg\].
    pub inertia: Option<Estimate>,
    /// Viscous friction V \[N·m·s/rad or N·s/m\], back-EMF taken out.
    pub viscous: Option<Estimate>,
    /// Coulomb friction, mean of both directions \[N·m or N\].
    pub coulomb: Option<Estimate>,
    /// (forward − backward)/2 \[N·m or N\].
    pub offset: Option<Estimate>,
    /// Friction while moving forward.
    pub forward: Option<Estimate>,
    /// Friction while moving backward.
    pub backward: Option<Estimate>,
    /// Coupling to all tips together, Σκ_i; `None` without tips whose angle is known.
    pub total_coupling: Option<Estimate>,
    /// Coupling to each tip of the campaign, κ_i = −h_i of (15) \[N·m/rad\]; `None` where its
    /// angle is not known or it cannot be told from others. Empty where no angle is known.
    pub coupling: Vec<Option<Estimate>>,
    /// Viscous friction by direction, where the data reject one constant.
    pub viscous_by_direction: Option<ByDirection>,
    /// A term that the equation lacks, where the data call for one.
    pub missing: Option<MissingTerm>,
    /// J, V, CF, offset, κ_i of the tips whose angle is known, as the logs have them.
    pub(crate) terms: Terms,
}

/// Terms of the motor's equation together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Terms {
    pub(crate) values: Vec<f64>,
    pub(crate) covariance: DMatrix<f64>,
    /// Changes, up to a factor, that the logs do not show.
    pub(crate) lost: Vec<DVector<f64>>,
}

/// Viscous friction forward and backward, with what else they change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ByDirection {
    /// While moving forward.
    pub forward: Estimate,
    /// While moving backward.
    pub backward: Estimate,
    /// Mean of both.
    pub mean: Estimate,
    /// Offset that is left beside them.
    pub offset: Estimate,
    /// Residual beside that of one constant.
    pub relative_residual: f64,
}

/// Fits `τ = J·θ̈ + V·θ̇ + Σκ_i(θ_m − θ_i) + CF·sgn θ̇ + offset` on the slip phases of all runs.
///
/// The equation is multiplied by `w = sin⁴` windows within each phase and integrated by parts:
/// `∫w·τ = J∫ẅ·θ − V∫ẇ·θ + Σκ_i∫w(θ_m − θ_i) + (±CF + offset)∫w`. A held command enters by its
/// exact integral. The covariance takes phases, and runs where there are several, as independent,
/// and counts how much the figures move with the window's length.
///
/// With lengths in `window_s` one of these is used; without, the length is chosen from the data.
/// `None` where no phase holds windows enough.
///
/// τ is the command times its torque constant \[N·m, N, or the command's unit where the constant is
/// unknown\]; θ_i − θ_m is measured, so that no model of the beam enters.
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
/// use lissom::identify::motor_regression; // of a sine with J = 0.02, V = 0.05, CF = 0.3
/// let fit = motor_regression(&campaign, &[]).unwrap();
/// assert!((fit.coulomb.unwrap().value - 0.3).abs() < 1e-3);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (14), (15)]` is the equation; the way of fitting it is this project's own
/// (DESIGN.md, "How does the regression work?").
pub fn motor_regression(campaign: &Campaign, window_s: &[f64]) -> Option<MotorRegression> {
    // Many short loops: within the pool none of them has to wake it first.
    rayon::scope(|_| on_slip_phases(campaign, window_s))
}

fn on_slip_phases(campaign: &Campaign, window_s: &[f64]) -> Option<MotorRegression> {
    let equation = MotorRows::of(campaign);
    let tips = &equation.tips;
    let mut terms =
        vec![Term::Plain(INERTIA), Term::Plain(VISCOUS), Term::Signed(DRY), Term::Plain(DRY)];
    terms.extend((0..tips.len()).map(|i| Term::Plain(TIPS + i)));
    // The offset is small by nature: it does not take part in the choice of the window.
    let counts: Vec<bool> = (0..terms.len()).map(|i| i != 3).collect();
    let sample_time = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let found =
        scan(sample_time, window_s, &counts, |length| solve(&equation.clusters(length), &terms))?;
    let chosen = &found.candidates[found.chosen];
    let solution = &found.solution;
    let figure = |i: usize| {
        let systematic = SYSTEMATIC * found.change[i];
        let std = (solution.covariance[(i, i)].max(0.0) + systematic * systematic).sqrt();
        (!solution.inseparable[i]).then_some(Estimate { value: solution.value[i], std })
    };
    // A sum of CF and offset can be separable where each alone is not.
    let direction = |sign: f64| {
        let c = &solution.covariance;
        let variance = c[(2, 2)] + c[(3, 3)] + 2.0 * sign * c[(2, 3)];
        let systematic = SYSTEMATIC * (found.change[2] + sign * found.change[3]);
        let std = (variance.max(0.0) + systematic * systematic).sqrt();
        let value = solution.value[2] + sign * solution.value[3];
        let separable = !solution.inseparable[2] && !solution.inseparable[3];
        separable.then_some(Estimate { value, std })
    };
    let mut coupling = vec![None; if tips.is_empty() { 0 } else { campaign.channels.tips.len() }];
    for (i, &tip) in tips.iter().enumerate() {
        coupling[tip] = figure(4 + i);
    }
    let total_coupling = total(&found, 4..4 + tips.len());
    let back_emf = campaign.channels.command.back_emf_viscous;
    let viscous = |e: Estimate| Estimate { value: e.value - back_emf, std: e.std };
    let known: Vec<f64> = (0..tips.len()).map(|i| solution.value[4 + i]).collect();
    let clusters = equation.clusters_with_more(chosen.window_s, &known);
    let missing = missing_term(&clusters, &terms, solution, TIPS + tips.len(), tips.len());
    let by_direction = by_direction(&clusters, &terms, solution);
    Some(MotorRegression {
        window_s: chosen.window_s,
        window_given: !window_s.is_empty(),
        rows: chosen.rows,
        phases: chosen.clusters,
        relative_residual: solution.relative_residual,
        inertia: figure(0),
        viscous: figure(1).map(viscous),
        coulomb: figure(2),
        offset: figure(3),
        forward: direction(1.0),
        backward: direction(-1.0),
        total_coupling,
        coupling,
        viscous_by_direction: by_direction.map(|d| ByDirection {
            forward: viscous(d.forward),
            backward: viscous(d.backward),
            mean: viscous(d.mean),
            ..d
        }),
        missing,
        candidates: found.candidates,
        terms: Terms {
            values: solution.value.iter().copied().collect(),
            covariance: solution.covariance.clone(),
            lost: solution.lost.clone(),
        },
    })
}

/// Sum of some figures, with their covariances; `None` of none, or where one is inseparable.
fn total(found: &Scan, figures: Range<usize>) -> Option<Estimate> {
    let s = &found.solution;
    if figures.is_empty() || figures.clone().any(|i| s.inseparable[i]) {
        return None;
    }
    let sum = |f: &dyn Fn(usize) -> f64| figures.clone().map(f).sum::<f64>();
    let variance = sum(&|i| sum(&|k| s.covariance[(i, k)]));
    let systematic = SYSTEMATIC * sum(&|i| found.change[i]);
    let std = (variance.max(0.0) + systematic * systematic).sqrt();
    Some(Estimate { value: sum(&|i| s.value[i]), std })
}

impl MotorRegression {
    /// Relative error with which these figures predict the windowed torque of other records:
    /// ‖y − X·q‖/‖y‖ on their slip phases, at this fit's window. `None` where no phase holds one.
    pub fn prediction_error(&self, campaign: &Campaign) -> Option<f64> {
        let equation = MotorRows::of(campaign);
        let values = &self.terms.values;
        if values.len() != 4 + equation.tips.len() {
            return None;
        }
        let (mut left, mut power) = (0.0, 0.0);
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

/// Viscous friction by direction, if the data call for it.
fn by_direction(clusters: &[Cluster], terms: &[Term], one: &Solution) -> Option<ByDirection> {
    let mut split = terms.to_vec();
    split[1] = Term::Forward(VISCOUS);
    split.insert(2, Term::Backward(VISCOUS));
    let two = solve(clusters, &split)?;
    if two.inseparable[1] || two.inseparable[2] || two.inseparable[4] {
        return None;
    }
    let c = &two.covariance;
    let difference = two.value[1] - two.value[2];
    let deviation = (c[(1, 1)] + c[(2, 2)] - 2.0 * c[(1, 2)]).max(0.0).sqrt();
    let called_for = difference.abs() > DIRECTION_DEVIATIONS * deviation
        && two.relative_residual < DIRECTION_RESIDUAL * one.relative_residual;
    let figure = |i: usize| Estimate { value: two.value[i], std: c[(i, i)].max(0.0).sqrt() };
    called_for.then(|| ByDirection {
        forward: figure(1),
        backward: figure(2),
        mean: Estimate {
            value: 0.5 * (two.value[1] + two.value[2]),
            std: 0.5 * (c[(1, 1)] + c[(2, 2)] + 2.0 * c[(1, 2)]).max(0.0).sqrt(),
        },
        offset: figure(4),
        relative_residual: two.relative_residual,
    })
}
