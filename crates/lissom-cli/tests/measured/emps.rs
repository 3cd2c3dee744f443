//! EMPS, Janot, Gautier & Brunot: an electro-mechanical positioning system.

use super::common;

/// Published (IDIM-LS): mass \[kg\], viscous \[N·s/m\], Coulomb \[N\], offset \[N\].
const PUBLISHED: [(&str, f64, f64); 4] = [
    // Name, value, relative tolerance.
    ("inertia", 95.1089, 0.01),
    ("viscous", 203.5034, 0.01),
    ("coulomb", 20.3935, 0.01),
    ("offset", -3.1648, 0.05),
];

/// The published equation, which the regression fits: Coulomb friction and one viscous constant.
#[test]
fn figures_are_the_published_ones() {
    let Some(data) = common::data("emps") else { return };
    let result = common::identify(include_str!("emps.toml"), &data, "DATA_EMPS.csv", 0);
    for (key, published, tolerance) in PUBLISHED {
        let found = result["methods"]["regression"][key]["value"].as_f64().unwrap();
        let error = (found / published - 1.0).abs();
        assert!(error < tolerance, "{key}: {found}, published {published}");
    }
    assert_eq!(result["methods"]["regression"]["window_given"], false);
}

#[test]
fn viscous_friction_by_direction_is_found() {
    let Some(data) = common::data("emps") else { return };
    let result = common::identify(include_str!("emps.toml"), &data, "DATA_EMPS.csv", 0);
    // The log's provenance, without a change near rest: 166.7 forward, 239.6 backward, error 4.43 to 3.62 %. The difference is
    // what the change near rest does not move.
    let law = &result["friction"]["law"];
    let value = |key: &str| law[key]["value"].as_f64().unwrap();
    let apart = value("viscous_backward") - value("viscous_forward");
    assert!((apart / (239.6 - 166.7) - 1.0).abs() < 0.05, "{apart}");
    // The law that is printed has it, and its finding says so.
    assert!(common::has_finding(&result, "friction-law"));
}

/// Friction of the law against that of the curve at its speeds, relative: the curve assumes none.
const LAW: f64 = 0.08;
/// From this speed on \[m/s\]: below it forty windows lie in each direction, and the curve's lowest point
/// forward is 10.7 N where the law has 13 N.
const LAW_FROM: f64 = 5e-3;

#[test]
fn friction_is_no_line_over_speed() {
    let Some(data) = common::data("emps") else { return };
    let result = common::identify(include_str!("emps.toml"), &data, "DATA_EMPS.csv", 0);
    assert!(common::has_finding(&result, "friction-law"));
    let law = &result["methods"]["friction_law"];
    let term =
        |name: &str| law["chosen"]["terms"].as_array().unwrap().iter().find(|t| t["term"] == name);
    let value = |v: &serde_json::Value| v["value"].as_f64().unwrap();
    let apart = value(&term("viscous-by-direction").unwrap()["amplitude"][0]);
    let near = term("near-rest").unwrap();
    let (rest, speed) = (value(&near["amplitude"][0]), near["speed"]["value"].as_f64().unwrap());
    // Friction falls towards rest, opposite to Stribeck's, and stays positive there.
    let coulomb = value(&law["chosen"]["coulomb"]);
    assert!(rest < -5.0 && coulomb + rest > 5.0, "{coulomb} {rest}");
    let (viscous, offset) = (value(&law["chosen"]["viscous"]), value(&law["chosen"]["offset"]));
    for p in result["friction"]["curve"].as_array().unwrap() {
        let sign = if p["direction"] == "forward" { 1.0 } else { -1.0 };
        let v = p["speed"]["value"].as_f64().unwrap();
        if v < LAW_FROM {
            continue;
        }
        let by_law =
            coulomb + sign * offset + (viscous + sign * apart) * v + rest * (-v / speed).exp();
        let by_curve = value(&p["friction"]);
        assert!((by_law / by_curve - 1.0).abs() < LAW, "{v}: {by_law} {by_curve}");
    }
}

#[test]
fn predicts_the_force_of_the_other_log() {
    let Some(data) = common::data("emps") else { return };
    let read = |file| common::read(include_str!("emps.toml"), &data, file).campaign;
    let train = lissom::identify::motor_regression(
        &lissom::identify::Prepared::of(&read("DATA_EMPS.csv")),
        &lissom::identify::Options::default(),
    )
    .unwrap();
    let error = train
        .prediction_error(&lissom::identify::Prepared::of(&read("DATA_EMPS_PULSES.csv")))
        .unwrap();
    assert!(error < 0.065, "{error}");
    // And not because there is nothing to predict: the fit's own error is of the same size.
    assert!(error > 0.5 * train.relative_residual);
}

/// The page that shows these estimates.
const PAGE: &str = include_str!("../../../../docs/src/evidence/measured.md");

/// The published estimates as an arm, in place of those found.
fn published(found: &serde_json::Value) -> serde_json::Value {
    let mut result = found.clone();
    let arm = &mut result["arm"];
    arm["inertia"] = PUBLISHED[0].1.into();
    for key in ["viscous_forward", "viscous_backward"] {
        arm[key] = PUBLISHED[1].1.into();
    }
    arm["coulomb"] = PUBLISHED[2].1.into();
    arm["offset"] = PUBLISHED[3].1.into();
    arm["command_lag_s"] = 0.0.into();
    for key in ["near_rest", "root", "with_load"] {
        arm[key] = serde_json::Value::Null;
    }
    for key in ["ripples", "torque_ripples"] {
        arm[key] = serde_json::json!([]);
    }
    result
}

/// The estimates of the first log, and the published ones, on the log that neither is from: the same
/// preprocessing for both.
#[test]
fn the_other_logs_force_is_predicted_better_than_by_the_published_figures() {
    let Some(data) = common::data("emps") else { return };
    let found = common::identify(include_str!("emps.toml"), &data, "DATA_EMPS.csv", 0);
    let known = published(&found);
    // Half power at 93, 47 and 19 Hz.
    for window in ["10 ms", "20 ms", "50 ms"] {
        let left = |result: &serde_json::Value| {
            let campaign = include_str!("emps.toml");
            let more = (0, &["--window", window][..]);
            let v = common::validate(result, campaign, &data, "DATA_EMPS_PULSES.csv", more);
            v["torque"]["relative_error"].as_f64().unwrap()
        };
        let (own, theirs) = (left(&found), left(&known));
        assert!(
            own < 0.9 * theirs,
            "{window}: {own} by lissom, {theirs} by the published estimates"
        );
        assert!(own < 0.05, "{window}: {own}");
        let row = format!("| {window} | {:.2} % | {:.2} % |", 100.0 * own, 100.0 * theirs);
        assert!(PAGE.contains(&row), "docs/src/evidence/measured.md has another row than {row}");
    }
}

/// Relative difference of the classical estimate from the published one: the slow stretches lie at the
/// ends of the travel, where friction is higher.
const CLASSICAL: f64 = 0.08;

#[test]
fn constant_velocities_give_friction_near_the_published_figure() {
    let Some(data) = common::data("emps") else { return };
    let result = common::identify(include_str!("emps.toml"), &data, "DATA_EMPS.csv", 0);
    let classical = &result["methods"]["constant_velocity"];
    // The log moves at 0.042, 0.083 and 0.125 m/s both ways.
    let points = classical["points"].as_array().unwrap();
    for (direction, sign) in [("forward", 1.0), ("backward", -1.0)] {
        let speed = |p: &serde_json::Value| p["velocity"]["value"].as_f64().unwrap() * sign;
        let mut speeds: Vec<f64> =
            points.iter().filter(|p| p["direction"] == direction).map(speed).collect();
        assert!(speeds.len() >= 9, "{direction}: {}", speeds.len());
        speeds.sort_by(f64::total_cmp);
        speeds.dedup_by(|a, b| *a < 1.02 * *b);
        assert_eq!(speeds.len(), 3, "{direction}: {speeds:?}");
    }
    let value = |v: &serde_json::Value| v["value"].as_f64().unwrap();
    let found = value(&classical["coulomb"]);
    let published = PUBLISHED[2].1;
    assert!((found / published - 1.0).abs() < CLASSICAL, "{found}");
    let interval = &classical["coulomb"]["ci95"];
    let ends = [0, 1].map(|k| interval[k].as_f64().unwrap());
    assert!(ends[0] < published && published < ends[1], "{ends:?}");
    // It says itself why it is no better: friction changes along the screw.
    let scatters = |f: &serde_json::Value| f["message"].as_str().unwrap().contains("scatter about");
    assert!(result["findings"].as_array().unwrap().iter().any(scatters));
    // Viscous friction by direction as by the regression, within that.
    let viscous = |line: usize| value(&classical["lines"][line]["viscous"]);
    assert!((viscous(0) / 166.7 - 1.0).abs() < 0.1, "{}", viscous(0));
    assert!((viscous(1) / 239.6 - 1.0).abs() < 0.1, "{}", viscous(1));
    // The regression stands, and its estimates are the ones taken.
    assert_eq!(
        result["friction"]["law"]["coulomb"],
        result["methods"]["friction_law"]["chosen"]["coulomb"]
    );
}
