//! Frequency responses of a campaign: one point for each sinusoidal run, and bands from all other runs.

use rayon::prelude::*;

use crate::finding::result_key as key;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{Finding, Severity, rows};
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind};
use crate::identify::responses::bands::{WithoutFriction, bands, general};
use crate::identify::responses::correct::{Response, corrected_by_harmonics, ratio};
use crate::identify::responses::rational::TipForm;
use crate::identify::responses::response_point::{ResponsePoint, sticking_error};
use crate::identify::responses::thresholds::{POINT_UNCERTAIN, STUCK_LEAST};
use crate::record::{Campaign, TipQuantity};
use crate::spectrum::Phasor;

/// What the replay says of friction.
#[derive(Default)]
pub(crate) struct Replayed<'a> {
    /// Corrected response of each run: of sinusoidal ones where friction is known over time.
    pub(crate) sinusoidal: Vec<Option<Response>>,
    /// Those of the other runs, where an arm was found that describes them from end to end.
    pub(crate) bands: Option<Box<dyn WithoutFriction + 'a>>,
}

/// Builds the table. Where the replay says nothing friction is taken for a square wave of
/// `coulomb_command` (CF/K), if that is known.
pub(crate) fn response_table(
    campaign: &Campaign,
    runs: &[RunAnalysis],
    coulomb_command: Option<Estimate>,
    replayed: &Replayed<'_>,
    findings: &[Finding],
) -> Vec<ResponsePoint> {
    let mut points: Vec<ResponsePoint> = runs
        .par_iter()
        .enumerate()
        .filter_map(|(index, run)| {
            let of_replay = replayed.sinusoidal.get(index).copied().flatten();
            sinusoidal(index, run, coulomb_command, of_replay, findings)
        })
        .collect();
    let mut of_bands = bands(campaign, runs, coulomb_command, replayed.bands.as_deref());
    // Every band is of all these runs: what is wrong in one of them is in each.
    if general(runs).iter().any(|&i| spoken_against(&runs[i], findings)) {
        for band in &mut of_bands {
            band.flagged = true;
        }
    }
    points.extend(of_bands);
    points.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    points
}

fn sinusoidal(
    index: usize,
    run: &RunAnalysis,
    coulomb_command: Option<Estimate>,
    replayed: Option<Response>,
    findings: &[Finding],
) -> Option<ResponsePoint> {
    let RunKind::Sinusoidal(s) = &run.kind else { return None };
    let (motor, command) = (s.motor.get(1)?, s.command.get(1)?);
    let square = |c: Estimate| {
        let stuck = run.stuck_share.unwrap_or(0.0).max(STUCK_LEAST);
        let c = Estimate { std: c.std.hypot(sticking_error(stuck) * c.value), ..c };
        corrected_by_harmonics(&s.motor, command, c)
    };
    let motor_corrected = replayed.or_else(|| coulomb_command.and_then(square));
    Some(ResponsePoint {
        omega_rad_s: s.omega_rad_s,
        run: Some(index),
        motor_raw: ratio(motor, command),
        motor_corrected,
        tips: s.tips.iter().map(|t| tip_response(t.get(1)?, motor)).collect(),
        flagged: spoken_against(run, findings)
            || motor_corrected.is_none_or(|r| weak(&r).is_some()),
        square_wave: replayed.is_none(),
    })
}

/// Whether a warning of this run is about its corrected response.
fn spoken_against(run: &RunAnalysis, findings: &[Finding]) -> bool {
    findings.iter().any(|f| {
        f.run.as_deref() == Some(&run.name)
            && f.severity() >= Severity::Warning
            && f.affects().contains(&key::CORRECTED_RESPONSE)
    })
}

/// Relative standard error of a corrected response, where it is too large for the point to count.
fn weak(response: &Response) -> Option<f64> {
    let relative = response.std / response.value.norm();
    (relative.is_nan() || relative > POINT_UNCERTAIN).then_some(relative)
}

/// Findings about corrected points that friction leaves too uncertain.
pub(crate) fn weak_points(points: &[ResponsePoint], runs: &[RunAnalysis]) -> Vec<Finding> {
    points
        .iter()
        .filter_map(|p| {
            let std_share = weak(&p.motor_corrected?)?;
            let run = &runs[p.run?];
            let omega_rad_s = p.omega_rad_s;
            let found = rows::CorrectionWeak { omega_rad_s, std_share };
            Some(Finding::of_run(&run.name, found))
        })
        .collect()
}

fn tip_response(tip: Phasor, motor: Phasor) -> Option<Response> {
    (tip.value.norm() > 0.0).then(|| ratio(tip, motor))
}

/// Form of a tip's model and its responses in that form: θ_i/θ_m for angles and deflections.
pub(crate) fn tip_model(
    quantity: TipQuantity,
    calibrated: bool,
    response: Response,
) -> (TipForm, Response) {
    match (quantity, calibrated) {
        (TipQuantity::Angle, _) => (TipForm::Angle, response),
        (TipQuantity::Deflection, true) => {
            (TipForm::Angle, Response { value: response.value + 1.0, std: response.std })
        }
        (TipQuantity::Deflection, false) | (TipQuantity::Acceleration, _) => {
            (TipForm::SecondDerivative, response)
        }
    }
}
