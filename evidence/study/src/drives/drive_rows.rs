//! The results as comma separated text, one row for each drive.

use super::drive_parameter::DriveParameter;
use super::drive_score::{FoundCode, ParameterScore};
use super::drive_study::{DriveOutcome, DriveStudyPlan};
use super::effects::{Input, Lag};

/// Columns before the parameters.
const HEAD: &str = "study,seed,index,cause,effects,magnitude,motion,runs,rows,row_s,encoder_bits,loop_rad_s,input,\
                    noise_share,wander_std,wander_s,rest_share,rest_speed_share,ripple_share,ripple_per_turn,gravity_share,\
                    constant_load,mode_inertia_ratio,mode_rad_s,mode_over_loop,late_stamps,lag_rows,dry_share,viscous_share,\
                    stuck_share,rejected,simulation_s,identification_s,method,first,findings";

/// The campaigns of a study as comma separated text, with a header; missing values are empty.
pub fn drive_rows(plan: &DriveStudyPlan, outcomes: &[Option<DriveOutcome>]) -> String {
    let mut header = HEAD.to_owned();
    for parameter in DriveParameter::ALL {
        for column in ["_true", "_as_fell", "", "_std", "_bound", "_warned_by"] {
            header.extend([",", &parameter.to_string(), column]);
        }
    }
    let mut lines = vec![header];
    lines.extend(outcomes.iter().flatten().map(|outcome| row(plan, outcome)));
    lines.join("\n") + "\n"
}

/// The size of the cause of a campaign.
fn magnitude(outcome: &DriveOutcome) -> Option<f64> {
    use super::effects::Cause;
    let (effects, numbers) = (&outcome.effects, &outcome.numbers);
    match outcome.cause? {
        Cause::Clean => None,
        Cause::InputNoise => noise_share(effects.input),
        Cause::Wander => effects.wander.map(|w| w.relative_std),
        Cause::UnseenMode => effects.unseen_mode.map(|m| m.inertia_ratio),
        Cause::Load => Some((numbers.gravity_nm + numbers.load_nm) / numbers.coulomb_nm),
        Cause::Lag => lag_rows(effects.lag),
    }
}

fn noise_share(input: Input) -> Option<f64> {
    match input {
        Input::Held => None,
        Input::Measured { noise_share, .. } => Some(noise_share),
    }
}

/// The delay of the angle after the current in rows, relative to the declared one.
fn lag_rows(lag: Option<Lag>) -> Option<f64> {
    Some(match lag? {
        Lag::Delay { rows } => rows,
        Lag::MeanBefore | Lag::MeasuredAsHeld => -0.5,
        Lag::HeldAsMeasured => 0.5,
    })
}

fn row(plan: &DriveStudyPlan, outcome: &DriveOutcome) -> String {
    let (effects, numbers) = (&outcome.effects, &outcome.numbers);
    let cell = |value: Option<f64>| value.map_or_else(String::new, |v| format!("{v:.6e}"));
    let score = outcome.score.as_ref().ok();
    let first = score.and_then(|s| s.first()).map_or_else(String::new, FoundCode::label);
    let codes: Vec<String> = score.map_or_else(
        || vec!["failed".to_owned()],
        |s| {
            s.findings
                .iter()
                .map(|f| format!("{}:{:?}", f.label().replace(' ', ""), f.severity))
                .collect()
        },
    );
    let input = match effects.input {
        Input::Held => "held",
        Input::Measured { samples_per_row: 1, .. } => "measured",
        Input::Measured { .. } => "measured of a fast loop",
    };
    let mode = numbers.mode_rad_s;
    let mut cells = vec![
        plan.study.to_string(),
        plan.seed.to_string(),
        outcome.index.to_string(),
        outcome.cause.map_or_else(String::new, |c| c.to_string()),
        effects.names().join(" "),
        cell(magnitude(outcome)),
        format!("{:?}", outcome.motion),
        outcome.runs.to_string(),
        outcome.rows.to_string(),
        numbers.row_s.to_string(),
        numbers.encoder_bits.to_string(),
        cell(Some(numbers.loop_rad_s)),
        input.to_owned(),
        cell(noise_share(effects.input)),
        cell(effects.wander.map(|w| w.relative_std)),
        cell(effects.wander.map(|w| w.correlation_time_s)),
        cell(effects.near_rest.map(|n| n.rest_share)),
        cell(effects.near_rest.map(|n| n.speed_share)),
        cell(effects.ripple.map(|r| r.share)),
        cell(effects.ripple.map(|r| r.per_turn)),
        cell(effects.gravity.map(|g| g.share)),
        cell(effects.constant_load),
        cell(effects.unseen_mode.map(|m| m.inertia_ratio)),
        cell(mode),
        cell(mode.map(|m| m / numbers.loop_rad_s)),
        cell(effects.late_stamps),
        cell(lag_rows(effects.lag)),
        cell(Some(numbers.coulomb_nm / numbers.peak_nm)),
        cell(Some(numbers.viscous_nm_s_per_rad * numbers.peak_speed_rad_s / numbers.peak_nm)),
        cell(Some(outcome.stuck_share)),
        outcome.rejected.len().to_string(),
        format!("{:.3}", outcome.simulation.as_secs_f64()),
        format!("{:.3}", outcome.identification.as_secs_f64()),
        score.and_then(|s| s.method).unwrap_or("none").to_owned(),
        first,
        codes.join(" "),
    ];
    for parameter in DriveParameter::ALL {
        let of = score.and_then(|s| s.parameters.iter().find(|p| p.parameter == parameter));
        cells.extend(parameter_cells(of));
    }
    cells.join(",")
}

fn parameter_cells(of: Option<&ParameterScore>) -> [String; 6] {
    let Some(p) = of else { return Default::default() };
    let cell = |value: Option<f64>| value.map_or_else(String::new, |v| format!("{v:.8e}"));
    [
        cell(Some(p.truth)),
        cell(Some(p.truth_as_fell)),
        cell(p.estimate.map(|e| e.value)),
        cell(p.estimate.map(|e| e.std)),
        cell(p.bound),
        p.warned_by.join(" "),
    ]
}
