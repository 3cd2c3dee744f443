//! Inverse dynamics: the torque that an arm's parameters give for a logged motion, compared with the logged torque.

use crate::registers::widest;
use rayon::prelude::*;

use crate::identify::validation::cause::{Cause, Causes};
use crate::identify::validation::thresholds::{AS_EXPECTED, STRETCH_LEAST};
use crate::identify::validation::torque_arm::TorqueArm;
use crate::identify::validation::torque_rows::{Coupling, Predictor, Row, RunRows};
use crate::record::Campaign;

/// Prediction of the torque of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct TorquePrediction {
    /// Length of the window over which both torques are averaged \[s\].
    pub window_s: f64,
    /// Frequency at which the window halves the power \[Hz\].
    pub half_power_hz: f64,
    /// Relative error ‖logged − predicted‖/‖logged‖ over all windows that count \[1\].
    pub relative_error: f64,
    /// The same while the motor moves forward, and backward; `None` if it does not move in that direction.
    pub by_direction: [Option<f64>; 2],
    /// Root mean square of the logged torque \[N·m\].
    pub logged_nm: f64,
    /// Relative error that a correct arm would have with the same sensors, found by applying the same computation to a
    /// simulated motion \[1\]. `None` if the motion could not be simulated for long enough.
    pub expected_error: Option<f64>,
    /// Share of the windows that do not count \[1\]: the motor rests, so that friction is not determined; a sensor is
    /// at the end of its range; or a command or a tip that acts later is not logged.
    pub rest_share: f64,
    /// Torque of each run over time.
    pub runs: Vec<TorqueRun>,
    /// Error of each part of a run in which the motor moves in one direction, relative to the torque of the whole log.
    pub stretches: Vec<TorqueStretch>,
    /// Likely causes of the residual, the largest share first.
    pub causes: Vec<Cause>,
}

impl TorquePrediction {
    /// Takes what the same recipe leaves of the arm's own motion. Where that is more than the log leaves, the simulated joint creeps
    /// and sticks where the real one does not, and tells nothing of the log.
    pub(super) fn compare(&mut self, expected: Option<Self>) {
        let Some(expected) = expected else { return };
        self.expected_error = Some(expected.relative_error.min(self.relative_error));
        if expected.relative_error > AS_EXPECTED * self.relative_error {
            return;
        }
        for cause in &mut self.causes {
            let own = expected.causes.iter().find(|c| c.kind == cause.kind);
            cause.expected_value = own.map_or(0.0, |c| c.value);
        }
    }
}

/// Torque of one run over time, one row per sample (or per several samples of a long run).
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueRun {
    /// Index of the run.
    pub run: usize,
    /// Relative error ‖logged − predicted‖/‖logged − gravity‖ of this run \[1\]; `None` if no window counts.
    pub relative_error: Option<f64>,
    /// Middle of each window, since the first sample of the run \[s\].
    pub time_s: Vec<f64>,
    /// Logged torque, averaged over the window \[N·m\].
    pub logged_nm: Vec<f64>,
    /// Predicted torque, averaged over the window \[N·m\]; NaN if the window does not count.
    pub predicted_nm: Vec<f64>,
    /// The terms whose sum, with the constant offset, the predicted torque is.
    pub terms: TorqueTerms,
}

/// The terms of a predicted torque over time, averaged over the window \[N·m\].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TorqueTerms {
    /// Inertia times acceleration.
    pub inertia_nm: Vec<f64>,
    /// Viscous friction.
    pub viscous_nm: Vec<f64>,
    /// The other friction: Coulomb friction and what changes with speed or place.
    pub dry_nm: Vec<f64>,
    /// Torque between motor and beam.
    pub coupling_nm: Vec<f64>,
    /// Gravity of an unbalanced load, and torque ripples.
    pub gravity_nm: Vec<f64>,
}

/// A part of a run in which the motor moves in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TorqueStretch {
    /// Index of the run.
    pub run: usize,
    /// Start, since the first sample of the run \[s\].
    pub start_s: f64,
    /// End, since the first sample of the run \[s\].
    pub end_s: f64,
    /// Whether the motor moves forward.
    pub forward: bool,
    /// Residual relative to the logged torque of the whole log \[1\].
    pub relative_error: f64,
}

/// Predicts the torque of every run, `zeros` what each tip of each run shows undeflected.
///
/// ```text
/// ⟨k·u(t − lag)⟩ = J·⟨θ̈⟩ + V̄·⟨θ̇⟩ + ⟨C·sgn θ̇ + ΔV·|θ̇|⟩ + offset + Σκ_i·⟨θ − θ_i⟩ + κ'_i·⟨θ̇ − θ̇_i⟩
/// ```
///
/// with ⟨·⟩ the mean under a sin⁴ window, V̄ and ΔV half the sum and half the difference of viscous
/// friction forward and backward. Derivatives of what is measured are moved onto the window; a held
/// command enters by its exact integral, so that half a sample of the hold is counted. Both sides
/// go through the same window, which shifts no phase.
///
/// `window_s` is chosen where it is `None`: the shortest under which the noise of the motor's sensor
/// makes at most 1 % of the torque by J·θ̈, and ten samples at least. A tip that shows its point late
/// is read as much later, by whole samples and, under the window, a series in the rest.
///
/// `None` where the arm has modes that the tips do not show, or no row counts.
pub(in crate::identify) fn torque(
    found: TorqueArm<'_>,
    campaign: &Campaign,
    zeros: &[Vec<f64>],
    window_s: Option<f64>,
) -> Option<TorquePrediction> {
    predicted(&Predictor::new(found, campaign, zeros, window_s)?)
}

/// Length of the window and [`TorquePrediction::relative_error`] of [`torque`], alone.
pub(in crate::identify) fn torque_error(
    found: TorqueArm<'_>,
    campaign: &Campaign,
    zeros: &[Vec<f64>],
) -> Option<(f64, f64)> {
    let predictor = Predictor::new(found, campaign, zeros, None)?;
    let sums = |run: usize| widest(|| predictor.sums(run));
    let sums = predictor.of_runs(sums);
    let [left, power] = sums.iter().fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    (power > 0.0).then(|| (predictor.window_s, (left / power).sqrt()))
}

/// Whether the tips show the torque between motor and beam.
pub(super) fn shows_coupling(found: TorqueArm<'_>, campaign: &Campaign) -> bool {
    Coupling::new(found, campaign).is_some()
}

impl RunRows {
    fn told(self) -> TorqueRun {
        let counted = || self.rows.iter().filter(|r| r.counts);
        let power: f64 = counted().map(|r| r.logged * r.logged).sum();
        let left: f64 = counted().map(|r| r.residual().powi(2)).sum();
        TorqueRun {
            run: self.run,
            relative_error: (power > 0.0).then(|| (left / power).sqrt()),
            time_s: self.rows.iter().map(|r| r.time_s).collect(),
            logged_nm: self.rows.iter().map(|r| r.logged + r.terms.gravity).collect(),
            predicted_nm: self
                .rows
                .iter()
                .map(|r| if r.counts { r.predicted + r.terms.gravity } else { f64::NAN })
                .collect(),
            terms: TorqueTerms {
                inertia_nm: self.rows.iter().map(|r| r.terms.inertia).collect(),
                viscous_nm: self.rows.iter().map(|r| r.terms.viscous).collect(),
                dry_nm: self.rows.iter().map(|r| r.terms.dry).collect(),
                coupling_nm: self.rows.iter().map(|r| r.terms.coupling).collect(),
                gravity_nm: self.rows.iter().map(|r| r.terms.gravity).collect(),
            },
        }
    }

    /// Rows on end that count and move one way.
    fn stretches(&self, logged_nm: f64, window_s: f64) -> Vec<TorqueStretch> {
        let together = |a: &Row, b: &Row| a.counts == b.counts && a.velocity * b.velocity > 0.0;
        let told = |rows: &[Row]| {
            let (first, last) = (rows.first()?, rows.last()?);
            let long = last.time_s - first.time_s >= STRETCH_LEAST as f64 * window_s;
            let left: f64 = rows.iter().map(|r| r.residual().powi(2)).sum();
            (first.counts && long).then(|| TorqueStretch {
                run: self.run,
                start_s: first.time_s,
                end_s: last.time_s,
                forward: first.velocity > 0.0,
                relative_error: (left / rows.len() as f64).sqrt() / logged_nm,
            })
        };
        self.rows.chunk_by(together).filter_map(told).collect()
    }
}

/// All that the rows of a campaign show.
fn predicted(predictor: &Predictor<'_>) -> Option<TorquePrediction> {
    let rows = |run: usize| widest(|| predictor.rows(run));
    let rows: Vec<RunRows> = predictor.of_runs(rows);
    let counted = || rows.iter().flat_map(|r| &r.rows).filter(|row| row.counts);
    let (mut left, mut power, mut number) = ([0.0; 2], [0.0; 2], 0_usize);
    for row in counted() {
        let side = usize::from(row.velocity < 0.0);
        left[side] += row.residual().powi(2);
        power[side] += row.logged * row.logged;
        number += 1;
    }
    let all: usize = rows.iter().map(|r| r.rows.len()).sum();
    let total = power[0] + power[1];
    if number == 0 || total <= 0.0 {
        return None;
    }
    let causes = Causes::of(&rows.iter().map(|r| &r.causes).collect::<Vec<_>>());
    let logged_nm = (total / number as f64).sqrt();
    Some(TorquePrediction {
        window_s: predictor.window_s,
        half_power_hz: rows.first()?.half_power_hz,
        relative_error: ((left[0] + left[1]) / total).sqrt(),
        by_direction: [0, 1].map(|i| (power[i] > 0.0).then(|| (left[i] / power[i]).sqrt())),
        logged_nm,
        expected_error: None,
        rest_share: 1.0 - number as f64 / all as f64,
        stretches: rows.iter().flat_map(|r| r.stretches(logged_nm, predictor.window_s)).collect(),
        runs: rows.into_par_iter().map(RunRows::told).collect(),
        causes,
    })
}
