//! Tables of a validation.

use lissom::identify::{
    ArmSource, Cause, CauseKind, ChannelResidual, FoundArm, TorquePrediction, TorqueUsed,
    Validation,
};
use lissom::record::Campaign;
use lissom_io::{UnitNames, channel_name_unit};
use lissom_views::digits;

use super::printer;

/// Largest number of runs that are shown one by one.
const SHOWN: usize = 8;
/// Smallest probability that is printed as a number.
const LEAST_PROBABILITY: f64 = 1e-4;
/// Largest number of terms that explain the residual, and smallest share of a term that is shown.
const TERMS: (usize, f64) = (3, 0.02);

pub(crate) fn validation(
    names: UnitNames,
    campaign: &Campaign,
    found: &FoundArm,
    validation: &Validation,
) {
    let source = match found.source {
        ArmSource::OutputError => "output-error method",
        ArmSource::Regression => "regression",
    };
    let modes = match found.arm.modes.len() {
        0 if !found.moves() => {
            "coupling of the tips known, but no mode: only the torque is predicted".to_owned()
        }
        0 => "rigid".to_owned(),
        1 => "1 mode".to_owned(),
        n => format!("{n} modes"),
    };
    printer::line(&format!("arm of the result: {source}, {modes}"));
    if let Some(t) = &validation.torque {
        torque(names, campaign, found, t);
    }
    motion(campaign, validation);
    residuals(campaign, validation);
}

fn percent(share: Option<f64>) -> String {
    share.map_or("-".to_owned(), |s| format!("{:.2} %", 100.0 * s))
}

fn torque(names: UnitNames, campaign: &Campaign, found: &FoundArm, t: &TorquePrediction) {
    let what = if names.torque_unit() == "N" { "force" } else { "torque" };
    printer::line(&format!(
        "\n{what} predicted from the logged motion: residual {:.2} % of {:.4} {} rms{}{}",
        100.0 * t.relative_error,
        t.logged_nm,
        names.torque_unit(),
        t.expected_error.map_or_else(String::new, expected),
        found.torque_used.map_or_else(String::new, used),
    ));
    printer::line(&format!(
        "  averaged with a window of {:.4} s (half power at {:.1} Hz); {:.1} % of the time is left out, as the \
         motor rests or a sensor is at its limit",
        t.window_s,
        t.half_power_hz,
        100.0 * t.rest_share
    ));
    let [forward, backward] = t.by_direction.map(percent);
    printer::line(&format!("  forward {forward}, backward {backward}"));
    let mut stretches: Vec<_> = t.stretches.iter().collect();
    stretches.sort_by(|a, b| b.relative_error.total_cmp(&a.relative_error));
    if let (Some(worst), Some(best)) = (stretches.first(), stretches.last()) {
        printer::line(&format!(
            "  {}: largest residual {:.2} % ({} from {:.2} to {:.2} s, {}), smallest {:.2} %",
            match stretches.len() {
                1 => "1 stretch in one direction".to_owned(),
                n => format!("{n} stretches in one direction"),
            },
            100.0 * worst.relative_error,
            campaign.runs[worst.run].name(),
            worst.start_s,
            worst.end_s,
            if worst.forward { "forward" } else { "backward" },
            100.0 * best.relative_error
        ));
    }
    let terms = t.causes.iter().filter(|c| c.share > TERMS.1).take(TERMS.0);
    let words: Vec<String> = terms
        .map(|c| format!("{} ({}) {:.0} %", c.kind.words(), size(names, c), 100.0 * c.share))
        .collect();
    if !words.is_empty() {
        printer::line(&format!(
            "  terms that would explain a share of the squared residual: {}",
            words.join(", ")
        ));
    }
    if t.runs.len() > 1 {
        let mut rows = vec![vec!["run".to_owned(), format!("residual {what}")]];
        let mut runs: Vec<_> = t.runs.iter().collect();
        runs.sort_by(|a, b| {
            b.relative_error.unwrap_or(0.0).total_cmp(&a.relative_error.unwrap_or(0.0))
        });
        rows.extend(
            runs.iter()
                .take(SHOWN)
                .map(|r| vec![campaign.runs[r.run].name().to_owned(), percent(r.relative_error)]),
        );
        printer::table(&rows);
        if runs.len() > SHOWN {
            printer::line(&format!("… and {} with smaller residuals", runs.len() - SHOWN));
        }
    }
}

fn expected(error: f64) -> String {
    format!("; {:.2} % expected if the arm is correct", 100.0 * error)
}

fn used(used: TorqueUsed) -> String {
    let error = 100.0 * used.relative_error;
    format!("; {error:.2} % in the logs of the result (window {:.4} s)", used.window_s)
}

/// Size that a term would have, in its unit.
fn size(names: UnitNames, cause: &Cause) -> String {
    let unit = match cause.kind {
        CauseKind::Delay => return format!("{:+.3} ms", 1e3 * cause.value),
        CauseKind::Coupling => return format!("{:+.2} %", 100.0 * cause.value),
        CauseKind::Inertia => names.inertia_unit(),
        CauseKind::Viscous | CauseKind::ViscousByDirection => names.viscous_unit(),
        CauseKind::Position => names.coupling_unit(),
        CauseKind::Coulomb | CauseKind::Offset | CauseKind::NearRest => {
            names.torque_unit().to_owned()
        }
    };
    let sign = if cause.value < 0.0 { "" } else { "+" };
    format!("{sign}{} {unit}", digits::shown(cause.value, 4))
}

fn motion(campaign: &Campaign, validation: &Validation) {
    if validation.horizons.is_empty() {
        return;
    }
    printer::line(
        "\nmotion predicted from the logged command, one initial state for each stretch:",
    );
    let mut heading = vec!["horizon".to_owned(), "stretches".to_owned()];
    let channels = &campaign.channels;
    for c in 0..=channels.tips.len() {
        let (name, unit) = channel_name_unit(channels, c);
        heading.extend([format!("{name} fit"), format!("rms [{unit}]")]);
    }
    let mut rows = vec![heading];
    for h in &validation.horizons {
        let over =
            if h.whole_runs { "whole runs".to_owned() } else { format!("{} s", shown(h.length_s)) };
        let mut row = vec![over, h.windows.to_string()];
        for fit in &h.channels {
            row.extend([format!("{:.2} %", fit.fit_percent), digits::shown(fit.residual_rms, 4)]);
        }
        rows.push(row);
    }
    printer::table(&rows);
}

/// A time without zeros at the end.
fn shown(seconds: f64) -> String {
    let text = format!("{seconds:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn residuals(campaign: &Campaign, validation: &Validation) {
    let Some(h) = validation.horizons.get(validation.chosen) else { return };
    let over =
        if h.whole_runs { "whole runs".to_owned() } else { format!("{} s", shown(h.length_s)) };
    printer::line(&format!("\nresiduals over {over}:"));
    let heading = [
        "channel",
        "rms",
        "sensor noise",
        "sensor steps only",
        "test for white noise",
        "correlation with the command",
    ];
    let mut rows = vec![heading.map(str::to_owned).to_vec()];
    for (c, r) in validation.residuals.iter().enumerate() {
        rows.push(residual_row(channel_name_unit(&campaign.channels, c), r));
    }
    printer::table(&rows);
}

fn residual_row((name, unit): (&str, &str), r: &ChannelResidual) -> Vec<String> {
    let steps = if r.sensor_step > 0.0 {
        format!("{} {unit}", digits::shown(r.sensor_step / 12.0_f64.sqrt(), 4))
    } else {
        "-".to_owned()
    };
    vec![
        name.to_owned(),
        format!("{} {unit}", digits::shown(r.rms, 4)),
        format!("{} {unit}", digits::shown(r.sensor_noise, 4)),
        steps,
        if r.white_probability < LEAST_PROBABILITY {
            format!("p < {LEAST_PROBABILITY}")
        } else {
            format!("p = {:.4}", r.white_probability)
        },
        format!("{:.0} % of lags outside the 95 % band", 100.0 * r.outside()),
    ]
}
