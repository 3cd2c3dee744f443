//! `validation.json`: how well a result predicts a log that it is not from.
//!
//! Its schema is `docs/validate.schema.json`.

use lissom::identify::{
    Cause, ChannelResidual, Fit, FoundArm, Horizon, MovedBy, Stretch, TorquePrediction, Validation,
};
use lissom::record::{Axis, Campaign, Channels, TipQuantity};
use serde_json::{Map, Value, json};

use super::estimate_json::{axis, finding};
use super::unit_names::UnitNames;

/// A validation as JSON, SI units throughout.
pub fn validation_json(campaign: &Campaign, found: &FoundArm, v: &Validation) -> Value {
    let channels = &campaign.channels;
    let names = UnitNames::new(channels);
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "axis": axis(channels.axis),
        "arm": super::result_arm::arm(channels, names, found),
        "torque": v.torque.as_ref().map(|t| torque(campaign, names, found, t)),
        "motion": {
            "horizons": v.horizons.iter().map(|h| horizon(channels, h)).collect::<Vec<_>>(),
            "chosen": if v.horizons.is_empty() { None } else { Some(v.chosen) },
            "moved_mode": v.moved_mode.map(|m| json!({
                "mode": m.mode + 1,
                "by": match m.by {
                    MovedBy::Load => "load",
                    MovedBy::Stiffness => "stiffness",
                },
                "natural_frequency_rad_s": m.omega_rad_s,
                "of_log_rad_s": m.of_log_rad_s,
                "residual_ratio": m.residual_ratio,
            })),
        },
        "residuals": v
            .residuals
            .iter()
            .enumerate()
            .map(|(c, r)| residual(channels, c, r))
            .collect::<Vec<_>>(),
        "findings": v.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}

/// Name and unit of a channel, the motor first, then tips.
pub fn channel_name_unit(channels: &Channels, channel: usize) -> (&str, &'static str) {
    let (angle, rate) = match channels.axis {
        Axis::Rotary => ("rad", "rad/s²"),
        Axis::Linear => ("m", "m/s²"),
    };
    let Some(tip) = channel.checked_sub(1).map(|i| &channels.tips[i]) else {
        return ("motor", angle);
    };
    let unit = match (tip.calibrated, tip.quantity) {
        (false, _) => "1",
        (true, TipQuantity::Acceleration) => rate,
        (true, _) => angle,
    };
    (&tip.name, unit)
}

fn torque(campaign: &Campaign, names: UnitNames, found: &FoundArm, t: &TorquePrediction) -> Value {
    let name = |run: usize| campaign.runs[run].name();
    let stretch = |s: &Stretch| {
        json!({
            "run": name(s.run),
            "start_s": s.start_s,
            "end_s": s.end_s,
            "direction": if s.forward { "forward" } else { "backward" },
            "relative_error": s.relative_error,
        })
    };
    let term = |c: &Cause| json!({ "term": c.kind.name(), "value": c.value, "share": c.share, "expected_value": c.expected_value });
    let runs = t.runs.iter();
    let mut map = Map::new();
    map.insert("relative_error".to_owned(), json!(t.relative_error));
    map.insert(
        "relative_error_of_logs_used".to_owned(),
        json!(found.torque_used.map(|t| t.relative_error)),
    );
    map.insert("relative_error_expected".to_owned(), json!(t.expected_error));
    map.insert("relative_error_forward".to_owned(), json!(t.by_direction[0]));
    map.insert("relative_error_backward".to_owned(), json!(t.by_direction[1]));
    map.insert(format!("logged_rms_{}", names.torque()), json!(t.logged_nm));
    map.insert("window_s".to_owned(), json!(t.window_s));
    map.insert("half_power_hz".to_owned(), json!(t.half_power_hz));
    map.insert("rest_share".to_owned(), json!(t.rest_share));
    let runs: Vec<Value> =
        runs.map(|r| json!({ "run": name(r.run), "relative_error": r.relative_error })).collect();
    map.insert("runs".to_owned(), Value::Array(runs));
    map.insert("stretches".to_owned(), t.stretches.iter().map(stretch).collect());
    map.insert("residual_terms".to_owned(), t.causes.iter().map(term).collect());
    Value::Object(map)
}

fn horizon(channels: &Channels, h: &Horizon) -> Value {
    let fit = |(c, f): (usize, &Fit)| {
        let (name, unit) = channel_name_unit(channels, c);
        json!({
            "channel": name,
            "unit": unit,
            "residual_rms": f.residual_rms,
            "fit_percent": f.fit_percent,
        })
    };
    json!({
        "length_s": h.length_s,
        "whole_runs": h.whole_runs,
        "windows": h.windows,
        "channels": h.channels.iter().enumerate().map(fit).collect::<Vec<_>>(),
    })
}

fn residual(channels: &Channels, channel: usize, r: &ChannelResidual) -> Value {
    let (name, unit) = channel_name_unit(channels, channel);
    json!({
        "channel": name,
        "unit": unit,
        "samples": r.samples,
        "rms": r.rms,
        "sensor_step": r.sensor_step,
        "sensor_noise": r.sensor_noise,
        "autocorrelation": r.autocorrelation,
        "autocorrelation_band": r.autocorrelation_band,
        "ljung_box": r.ljung_box,
        "white_probability": r.white_probability,
        "lags": r.lags(),
        "cross_correlation": r.cross_correlation,
        "cross_correlation_band": r.cross_correlation_band,
        "outside_share": r.outside(),
    })
}
