//! Tips that are read later than the motor, where viscous friction would otherwise be negative.

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::identify::estimate::Estimate;
use crate::identify::findings::{Finding, rows};
use crate::identify::methods::regression::motor::{MotorRegression, motor_regression};
use crate::identify::methods::regression::motor_columns::coupled_tips;
use crate::identify::methods::regression::motor_rows::{SineAndCosine, behind};
use crate::identify::methods::regression::normal::{Cluster, Rows, Term, solve};
use crate::identify::methods::regression::scan::scan;
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::window::Window;
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT};
use crate::record::{Axis, Campaign, Run, TipQuantity};

/// Each round leaves a small part of the lag.
const ROUNDS: usize = 3;
/// Columns of [`Deflection`]: the lag, the load's inertia over the stiffness, gravity's sine and cosine, and a constant.
const COLUMNS: usize = 5;
/// Those of gravity.
const GRAVITY: [usize; 2] = [2, 3];

/// The regression with the tips read in time, if it has negative viscous friction without, and not with.
///
/// A tip that is read later by T leaves κ·T of the motor's damping in the coupling. Its deflection then follows the velocity:
/// `θ_m − θ_i = T·θ̇_m + θ̈_i/ω² + g_s·sin θ_m + g_c·cos θ_m + const`. Damping of the load against the frame would look the
/// same; viscous friction below zero decides for a lag.
pub(crate) fn with_tips_in_time<'a>(
    prepared: Prepared<'a>,
    regression: Option<MotorRegression>,
    options: &Options,
) -> (Prepared<'a>, Option<MotorRegression>, Vec<Finding>) {
    if !regression.as_ref().is_some_and(drives) {
        return (prepared, regression, Vec::new());
    }
    let mut in_time = prepared.clone();
    let mut findings = Vec::new();
    for tip in coupled_tips(prepared.used()) {
        let channel = &prepared.used().channels.tips[tip];
        if channel.quantity != TipQuantity::Angle {
            continue;
        }
        let Some(lag_s) = late_by(&mut in_time, tip) else { continue };
        let tip = channel.name.clone();
        findings.push(Finding::new(rows::TipReadLate { tip, lag_s }));
    }
    let again = (!findings.is_empty()).then(|| motor_regression(&in_time, options)).flatten();
    match again.filter(|r| !drives(r)) {
        Some(again) => (in_time, Some(again), findings),
        None => (prepared, regression, Vec::new()),
    }
}

/// Whether viscous friction is surely negative.
fn drives(regression: &MotorRegression) -> bool {
    regression.viscous.is_some_and(|v| v.value < -PRESENT * v.std)
}

/// Takes out the lag of a tip; `None` if it has none.
fn late_by(prepared: &mut Prepared<'_>, tip: usize) -> Option<Estimate> {
    let mut total: Option<Estimate> = None;
    for _ in 0..ROUNDS {
        let lag_s = lag_of(prepared.used(), tip)?;
        if total.is_none() && lag_s.value.abs() < CLEARLY_PRESENT * lag_s.std {
            return None;
        }
        *prepared = prepared.with_tip_taken_earlier(tip, lag_s.value);
        let value = lag_s.value + total.map_or(0.0, |total| total.value);
        total = Some(Estimate { value, std: lag_s.std });
    }
    total
}

/// The lag that is left of a tip \[s\].
fn lag_of(campaign: &Campaign, tip: usize) -> Option<Estimate> {
    let sample_time_s = campaign.runs.iter().map(Run::sample_time_s).fold(0.0, f64::max);
    let mut columns: Vec<usize> = (0..COLUMNS).collect();
    columns.retain(|column| campaign.channels.axis == Axis::Rotary || !GRAVITY.contains(column));
    let terms: Vec<Term> = columns.iter().copied().map(Term::Plain).collect();
    let counts: Vec<bool> = columns.iter().map(|column| *column == 0).collect();
    let scan =
        scan(sample_time_s, &[], &counts, |length| solve(&clusters(campaign, tip, length), &terms));
    let solution = scan?.solution;
    let std = solution.covariance[(0, 0)].max(0.0).sqrt();
    (!solution.inseparable[0]).then(|| Estimate { value: solution.value[0], std })
}

fn clusters(campaign: &Campaign, tip: usize, length_s: f64) -> Vec<Cluster> {
    let windows = Window::of_runs(&campaign.runs, length_s, |_, _| true);
    let noise = DMatrix::zeros(COLUMNS + 1, COLUMNS + 1);
    let waves = campaign.runs.iter().map(|run| SineAndCosine::of(run.motor()));
    let waves: Vec<SineAndCosine> = waves.collect();
    let of_run = |(index, window): (usize, &Option<Arc<Window>>)| {
        let (Some(window), run) = (window, &campaign.runs[index]) else { return Vec::new() };
        let deflection = Deflection { campaign, run, waves: &waves[index], tip, window };
        Cluster::blocks(index, run.len(), window, (&deflection, &noise))
    };
    windows.iter().enumerate().flat_map(of_run).collect()
}

/// `[−∫ẇθ_m, ∫ẅθ_i, ∫w·sin θ_m, ∫w·cos θ_m, ∫w, ∫w(θ_m − θ_i)]`.
struct Deflection<'a> {
    campaign: &'a Campaign,
    run: &'a Run,
    waves: &'a SineAndCosine,
    tip: usize,
    window: &'a Window,
}

impl Rows for Deflection<'_> {
    #[inline(always)]
    fn fill(&self, k: usize, row: &mut Vec<f64>) {
        let Self { campaign, run, waves: SineAndCosine(waves), tip, window } = *self;
        let (motor, own) = (&run.motor()[k..], &run.tips()[tip][k..]);
        let t = run.sample_time_s();
        row.clear();
        row.push(-t * window.first.dot_from(motor, motor[0]));
        row.push(t * window.second.dot_from(own, own[0]));
        row.extend(waves.iter().map(|wave| t * window.value.dot(&wave[k..])));
        row.push(window.area);
        row.push(behind(campaign, run, tip, window, k));
    }
}
