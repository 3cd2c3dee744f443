//! Logs that no campaign.toml describes: `lissom inspect`, `lissom init`, `lissom identify LOG`.
#![expect(clippy::unwrap_used, reason = "tests")]

mod simulated_axis;

use std::fmt::Write as _;
use std::path::Path;

use lissom_testmodels::SchemaCheck;
use serde_json::{Value, json};
use tempfile::TempDir;

use simulated_axis::{lissom, simulated_axis};

/// A folder, and the rows of the simulated log: time, current, angle.
fn simulated() -> (TempDir, Vec<[f64; 3]>) {
    let folder = simulated_axis();
    let text = std::fs::read_to_string(folder.path().join("made/log.csv")).unwrap();
    let numbers =
        |line: &str| -> Vec<f64> { line.split(',').filter_map(|c| c.parse().ok()).collect() };
    let rows = text.lines().map(numbers).filter(|n| n.len() >= 3).map(|n| [n[0], n[1], n[2]]);
    let rows = rows.collect();
    (folder, rows)
}

fn lines(rows: &[[f64; 3]], row: impl Fn(&[f64; 3]) -> String) -> String {
    rows.iter().fold(String::new(), |mut text, r| {
        let _ = writeln!(text, "{}", row(r));
        text
    })
}

/// Coulomb friction, viscous friction and inertia of a log are found within 2 %.
#[track_caller]
fn found(folder: &Path, log: &str, options: &[&str]) -> Value {
    let given = ["--torque-constant", "0.5 N*m/A", "--hold", "sampled", "--quick", "--json"];
    let arguments = [&["identify", log], options, &given[..]].concat();
    let (code, json, error) = lissom(folder, &arguments);
    assert_eq!(code, Some(0), "{log}: {error}");
    let result: Value = serde_json::from_str(&json).unwrap();
    let truth =
        [("/friction/coulomb", 0.25), ("/friction/viscous", 0.05), ("/drive/inertia", 0.012)];
    for (pointer, truth) in truth {
        let value = result.pointer(&format!("{pointer}/value")).unwrap().as_f64().unwrap();
        assert!((value / truth - 1.0).abs() < 0.02, "{log}: {pointer} {value}");
    }
    result
}

#[test]
fn the_parameters_are_found_in_one_command() {
    let (folder, rows) = simulated();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "units.csv",
        format!("t,i,q\ns,A,rad\n{}", lines(&rows, |r| format!("{},{},{}", r[0], r[1], r[2]))),
    );
    let comma =
        |r: &[f64; 3]| format!("{};{};{}", 1e3 * r[0], r[1], r[2].to_degrees()).replace('.', ",");
    write("comma.csv", format!("t [ms];Strom [A];Winkel [°]\n{}", lines(&rows, comma)));
    let record = |r: &[f64; 3]| {
        json!({"stamp": r[0], "state": {"effort": 0.5 * r[1], "position": r[2]}}).to_string()
    };
    write("records.json", lines(&rows, record));
    write("bare.txt", lines(&rows, |r| format!("{} {} {}", r[0], r[1], r[2])));
    let ends = |r: &[f64; 3]| format!("{},{},{},{}", r[0], 1.0, r[2].to_degrees(), r[1]);
    write("ends.csv", format!("time_s,mode,axis_pos_deg,axis_current_A\n{}", lines(&rows, ends)));
    let counts = |r: &[f64; 3]| {
        format!("{},{},{}", r[0], r[1], (r[2] * 65536.0 / std::f64::consts::TAU).round())
    };
    write("counts.csv", format!("t,i,counts\n{}", lines(&rows, counts)));

    found(folder.path(), "units.csv", &[]);
    found(folder.path(), "comma.csv", &[]);
    found(folder.path(), "ends.csv", &[]);
    found(folder.path(), "bare.txt", &["--time", "1:s", "--current", "2:A", "--motor", "3:rad"]);
    let counts = ["--time", "t:s", "--current", "i:A", "--motor", "counts:rad,scale=0.0000958738"];
    found(folder.path(), "counts.csv", &counts);
    // A torque needs no torque constant: the state of a robot.
    let state = [
        "identify",
        "records.json",
        "--time",
        "stamp:s",
        "--command",
        "effort:N*m,hold=sampled",
        "--motor",
        "state/position:rad",
        "--quick",
        "--json",
    ];
    let (code, json, error) = lissom(folder.path(), &state);
    assert_eq!(code, Some(0), "{error}");
    let result: Value = serde_json::from_str(&json).unwrap();
    let inertia = result["drive"]["inertia"]["value"].as_f64().unwrap();
    assert!((inertia / 0.012 - 1.0).abs() < 0.02, "{inertia}");
}

#[test]
fn what_is_missing_is_asked_for_at_once() {
    let (folder, rows) = simulated();
    let log = folder.path().join("plain.csv");
    std::fs::write(
        &log,
        format!("t,i,q\n{}", lines(&rows, |r| format!("{},{},{}", r[0], r[1], r[2]))),
    )
    .unwrap();
    let (code, _, error) = lissom(folder.path(), &["identify", "plain.csv"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("--time t:UNIT --current i:UNIT --motor q:UNIT"), "{error}");
    let (code, _, error) = lissom(folder.path(), &["identify", "plain.csv", "--motor", "p:rad"]);
    assert_eq!(code, Some(1));
    assert!(
        error.contains("there is no channel \"p\"; the channels are \"t\", \"i\", \"q\""),
        "{error}"
    );
    let (code, _, error) = lissom(folder.path(), &["identify", "plain.csv", "--motor", "q:foo"]);
    assert_eq!(code, Some(2));
    assert!(error.contains("foo"), "{error}");
    let mixed = ["identify", "made/campaign.toml", "--motor", "q:rad"];
    let (code, _, error) = lissom(folder.path(), &mixed);
    assert_eq!(code, Some(1));
    assert!(error.contains("describes its logs itself"), "{error}");
}

#[test]
fn a_unit_that_the_data_contradict() {
    let (folder, rows) = simulated();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let milli = |r: &[f64; 3]| format!("{},{},{}", 1e3 * r[0], r[1], r[2]);
    write("milli.csv", format!("t [s],i [A],q [rad]\n{}", lines(&rows, milli)));
    let (_, json, _) = lissom(folder.path(), &["identify", "milli.csv", "--quick", "--json"]);
    let result: Value = serde_json::from_str(&json).unwrap();
    let codes: Vec<&str> = result["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| f["code"].as_str().unwrap())
        .collect();
    assert!(codes.contains(&"time-unit"), "{codes:?}");
    // A speed says the same of an angle in degrees.
    let speed: Vec<f64> = rows.windows(2).map(|w| (w[1][2] - w[0][2]) / 2e-3).collect();
    let mut text = String::from("t [s],i [A],q [rad],n [rpm]\n");
    for (row, speed) in rows.iter().zip(&speed) {
        let _ = writeln!(
            text,
            "{},{},{},{}",
            row[0],
            row[1],
            row[2].to_degrees(),
            speed * 30.0 / std::f64::consts::PI
        );
    }
    write("degrees.csv", text);
    let (code, shown, _) = lissom(folder.path(), &["inspect", "degrees.csv"]);
    assert_eq!(code, Some(0));
    let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains(
            "n [rpm] is the rate of q [rad], but with the stated units it is 0.0174 times"
        ),
        "{shown}"
    );
}

#[test]
fn units_of_every_log_and_of_a_speed_count() {
    let (folder, rows) = simulated();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let table = |unit: &str, scale: f64| {
        let row = |r: &[f64; 3]| format!("{},{},{}", r[0], r[1], scale * r[2]);
        format!("t,i,q\ns,A,{unit}\n{}", lines(&rows, row))
    };
    write("rad.csv", table("rad", 1.0));
    write("deg.csv", table("Grad", 180.0 / std::f64::consts::PI));
    found(folder.path(), "deg.csv", &[]);
    let (code, _, error) = lissom(folder.path(), &["identify", "rad.csv", "deg.csv", "--quick"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("deg.csv: the unit of \"q\" is deg, in rad.csv it is rad"), "{error}");
    // A set-point is not the motor; the speed is, in turns per minute.
    let speed = rows.windows(2).map(|w| (w[1][2] - w[0][2]) / 2e-3);
    let mut text = String::from("t [s],i [A],Position setpoint [deg],n [min^-1]\n");
    for (row, speed) in rows.iter().zip(speed) {
        let turns = speed * 30.0 / std::f64::consts::PI;
        let _ = writeln!(text, "{},{},{},{turns}", row[0] + 1e-3, row[1], 50.0 * row[2]);
    }
    write("speed.csv", text);
    found(folder.path(), "speed.csv", &[]);
    // An angle in degrees under a header in rad, with a speed beside it, is refused.
    let speed = rows.windows(2).map(|w| (w[1][2] - w[0][2]) / 2e-3);
    let mut text = String::from("t [s],i [A],q [rad],w [rad/s]\n");
    for (row, speed) in rows.iter().zip(speed) {
        let _ = writeln!(text, "{},{},{},{speed}", row[0], row[1], row[2].to_degrees());
    }
    write("wrong.csv", text);
    let (code, _, error) = lissom(folder.path(), &["identify", "wrong.csv", "--quick"]);
    assert_eq!(code, Some(1), "{error}");
    assert!(error.contains("deg"), "{error}");
}

#[test]
fn inspect_and_init() {
    let (folder, rows) = simulated();
    let row = |r: &[f64; 3]| {
        format!(
            "{},{},{:.3},{:.6},7",
            r[0],
            r[1].clamp(-1.0, 1.0),
            r[2],
            0.5 * r[1].clamp(-1.0, 1.0)
        )
    };
    let text = format!("t [s],i [A],q,tau [N*m],spare\n{}", lines(&rows, row));
    std::fs::write(folder.path().join("log.csv"), text).unwrap();
    let (code, json, error) = lissom(folder.path(), &["inspect", "log.csv", "--json"]);
    assert_eq!(code, Some(0), "{error}");
    let found: Value = serde_json::from_str(&json).unwrap();
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/inspect.schema.json"),
        "inspect",
    );
    check.look_at(&found);
    let channels = &found["logs"][0]["channels"];
    assert!((channels[2]["step"].as_f64().unwrap() - 1e-3).abs() < 1e-6, "{channels}");
    assert!(channels[1]["at_max_share"].as_f64().unwrap() > 0.02, "{channels}");
    assert_eq!(channels[3]["multiple_of"], 2);
    assert_eq!(channels[4]["constant"], true);
    let roles: Vec<(&str, u64)> = found["logs"][0]["roles"]
        .as_array()
        .unwrap()
        .iter()
        .map(|r| (r["role"].as_str().unwrap(), r["channel"].as_u64().unwrap()))
        .collect();
    assert_eq!(roles, [("time", 1), ("current", 2), ("torque", 4), ("motor", 3)]);

    let (code, shown, error) = lissom(folder.path(), &["init", "log.csv"]);
    assert_eq!(code, Some(0), "{error}");
    assert!(shown.contains("to do: log.csv: the unit of the motor"), "{shown}");
    let written = std::fs::read_to_string(folder.path().join("campaign.toml")).unwrap();
    assert!(
        written.contains("# TO DO")
            && written.contains("# motor = { column = \"q\", unit = \"?\" }"),
        "{written}"
    );
    let (code, _, error) = lissom(folder.path(), &["init", "log.csv", "--motor", "q:rad"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("exists, and is not overwritten"), "{error}");
    let again = ["init", "log.csv", "--motor", "q:rad", "--out", "other.toml"];
    let (code, shown, _) = lissom(folder.path(), &again);
    assert_eq!(code, Some(0));
    assert!(shown.contains("next: lissom identify other.toml"), "{shown}");
    let (code, _, error) = lissom(folder.path(), &["identify", "other.toml", "--quick"]);
    assert!(matches!(code, Some(0 | 3)), "{error}");
}

#[test]
fn inspect_shows_the_logs_that_can_be_read() {
    let (folder, rows) = simulated();
    let row = |r: &[f64; 3]| format!("{},{},{}", r[0], r[1], r[2]);
    let text =
        format!("made by a drive\nunits,are,below\nt [s],i [A],q [rad]\n{}", lines(&rows, row));
    std::fs::write(folder.path().join("log.csv"), text).unwrap();
    let asked = ["inspect", "missing.csv", "log.csv", "--header-row", "3"];
    let (code, shown, error) = lissom(folder.path(), &asked);
    assert_eq!(code, Some(1));
    assert!(shown.contains("log.csv: delimited text, 3 channels"), "{shown}");
    assert!(error.contains("missing.csv: cannot be opened"), "{error}");
    let (code, shown, _) = lissom(folder.path(), &[&asked[..], &["--json", "found.json"]].concat());
    assert_eq!((code, shown.as_str()), (Some(1), ""));
    assert!(!folder.path().join("found.json").exists());
}

#[test]
fn a_log_is_checked_against_limits() {
    let (folder, rows) = simulated();
    let at = folder.path();
    std::fs::create_dir(at.join("drive-17")).unwrap();
    let row = |r: &[f64; 3]| format!("{},{},{}", r[0], r[1], r[2]);
    let log = format!("t,i_cmd,q\ns,A,rad\n{}", lines(&rows, row));
    std::fs::write(at.join("drive-17/0815.csv"), log).unwrap();
    let limits = |coulomb: &str| {
        format!(
            "path = \"{{machine}}/{{time}}.csv\"\n[[limits]]\nparameter = \"friction.coulomb\"\nunit = \"N*m\"\n{coulomb}\n\
             [[limits]]\nparameter = \"drive.inertia\"\nunit = \"kg*m^2\"\nmin = 0.01\nmax = 0.02\n"
        )
    };
    let check = |coulomb: &str, more: &[&str]| {
        std::fs::write(at.join("limits.toml"), limits(coulomb)).unwrap();
        let given = ["check", "drive-17/0815.csv", "--limits", "limits.toml", "--quick"];
        lissom(at, &[&given, more].concat())
    };
    let constant = ["--torque-constant", "0.5 N*m/A"];
    let (code, shown, error) = check("max = 0.3", &constant);
    assert_eq!(code, Some(0), "{shown}{error}");
    assert!(shown.contains("machine: drive-17") && shown.contains("time: 0815"), "{shown}");
    let (code, json, _) = check("max = 0.2", &[&constant[..], &["--json"]].concat());
    assert_eq!(code, Some(5), "{json}");
    let found: Value = serde_json::from_str(&json).unwrap();
    let mut schema = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/check.schema.json"),
        "check",
    );
    schema.look_at(&found);
    assert_eq!(found["parameters"][0]["outcome"], "fail");
    assert_eq!(found["parameters"][1]["outcome"], "pass");
    // The interval contains the limit.
    let value = found["parameters"][0]["value"].as_f64().unwrap();
    let (code, shown, _) = check(&format!("max = {value}"), &constant);
    assert_eq!(code, Some(3), "{shown}");
    let (code, _, error) = check("max = 0.3", &[]);
    assert_eq!(code, Some(1));
    assert!(
        error.contains("the limits of friction.coulomb are in N·m, the result is in A"),
        "{error}"
    );
    let (code, _, error) = check("min = 0.4\nmax = 0.3", &constant);
    assert_eq!(code, Some(1));
    assert!(error.contains("limits.toml"), "{error}");
}
