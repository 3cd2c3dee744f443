//! `lissom model`: its JSON against closed forms and itself, its schema, its table and its plots.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use lissom_testmodels::SchemaCheck;
use num_complex::Complex64;
use serde_json::Value;
use tempfile::TempDir;

/// The two-mass arm of Section 6.3.
const TWO_MASSES: &str = r#"[beam]
young_modulus = "30e6 psi"
section = { round = "0.047 in" }
spans = [{ length = "6 in", mass = "0.121 lb" }, { length = "6 in", mass = "0.121 lb" }]
"#;

const DRIVE: &str = r#"[drive]
inertia = "0.005529 lbf*in*s^2"
viscous = "0.01216 lbf*in*s/rad"
torque_constant = "2.184 lbf*in/A"
"#;

/// A uniform cantilever with 2 N·m², 0.5 kg/m and 0.8 m.
const UNIFORM: &str = "[beam]\nflexural_rigidity = 2\nmass_per_length = 0.5\n\
                       spans = [{ length = 0.8 }]\n";

/// A folder with `arm.toml`.
fn folder(arm: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("arm.toml"), arm).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> String {
    let mut command = assert_cmd::Command::cargo_bin("lissom").unwrap();
    let command = command.current_dir(folder).args(["model", "arm.toml"]).args(arguments);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn table(arm: &str, arguments: &[&str]) -> String {
    run(folder(arm).path(), arguments)
}

fn json(arm: &str, arguments: &[&str]) -> Value {
    let arguments = [arguments, &["--json"]].concat();
    serde_json::from_str(&table(arm, &arguments)).unwrap()
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn complex(v: &Value) -> Complex64 {
    Complex64::new(v["re"].as_f64().unwrap(), v["im"].as_f64().unwrap())
}

#[track_caller]
fn close(found: f64, wanted: f64, relative: f64) {
    assert!((found / wanted - 1.0).abs() <= relative, "{found} is not {wanted}");
}

/// Numerator over denominator, descending powers.
fn rational(f: &Value, s: Complex64) -> Complex64 {
    let at = |key: &str| {
        numbers(&f[key]).iter().fold(Complex64::default(), |sum, c| sum * s + Complex64::from(*c))
    };
    at("num") / at("den")
}

#[test]
fn the_reports_two_mass_arm() {
    let model = json(TWO_MASSES, &[]);
    let [first, second] = numbers(&model["natural_frequencies_rad_s"])[..] else { panic!() };
    // As printed in 6.3, within the slip of its units.
    close(first, 6.014, 5e-4);
    close(second, 40.0116, 5e-4);
    close(model["tip_zeros"][0]["s_squared"]["re"].as_f64().unwrap().sqrt(), 35.683, 5e-4);
    assert_eq!(model["tip_zeros"][0]["class"], "b");
    let tip = &model["transfer_functions"][1];
    assert_eq!((&tip["to"], &tip["minimum_phase"]), (&"theta_2".into(), &false.into()));
    assert_eq!(model["n"], 2);
    assert!(model["state_space"].is_null() && model["coupled_frequencies_rad_s"].is_null());
}

/// (13) and (15) from the matrices, the polynomials, zeros, poles and gain, the state space and the
/// response: five ways to the same number.
#[test]
fn all_ways_to_a_response_agree() {
    let damped = "damping = { mass_proportional = 0.3, stiffness_proportional = 0.001 }\n\
                  hub_radius = 0.02\npayload = { mass = 0.02, inertia = 1e-6, offset = 0.01 }\n";
    for extra in ["", damped] {
        let model = json(&format!("{TWO_MASSES}{extra}{DRIVE}"), &["--omega", "0.7:300:40"]);
        let response = &model["frequency_response"];
        let omega = numbers(&response["omega_rad_s"]);
        assert_eq!((omega.len(), omega[0], omega[39]), (40, 0.7, 300.0));
        let functions = model["transfer_functions"].as_array().unwrap();
        let find = |from: &str, to: &str| {
            functions.iter().find(|f| f["from"] == from && f["to"] == to).unwrap()
        };
        for (k, omega) in omega.iter().enumerate() {
            let s = Complex64::new(0.0, *omega);
            let motor = complex(&response["motor_rad_per_a"][k]);
            let same = |a: Complex64, b: Complex64| {
                assert!((a - b).norm() <= 1e-9 * b.norm(), "{a} {b} at {omega} {extra}");
            };
            let each = [
                ("coupling_torque", complex(&response["coupling_nm_per_rad"][k])),
                ("theta_1", complex(&response["tips"][0][k])),
                ("theta_2", complex(&response["tips"][1][k])),
            ];
            for (to, angle) in each {
                let f = find("motor", to);
                same(rational(f, s), angle);
                let product = |key: &str| -> Complex64 {
                    f[key].as_array().unwrap().iter().map(|r| s - complex(r)).product()
                };
                same(product("zeros") / product("poles") * f["gain"].as_f64().unwrap(), angle);
                if to != "coupling_torque" {
                    same(rational(find("current", to), s), angle * motor);
                }
            }
            same(rational(find("current", "motor"), s), motor);
            let outputs = state_space(&model["state_space"], s);
            same(outputs["motor_rad"], motor);
            same(outputs["theta_2_rad"], each[2].1 * motor);
            same(outputs["coupling_torque_nm"], each[0].1 * motor);
        }
    }
}

/// C·(s − A)⁻¹·B + D for the current, by elimination.
fn state_space(model: &Value, s: Complex64) -> std::collections::HashMap<String, Complex64> {
    let matrix = |key: &str| -> Vec<Vec<f64>> {
        model[key].as_array().unwrap().iter().map(numbers).collect()
    };
    let (a, b, c, d) = (matrix("a"), matrix("b"), matrix("c"), matrix("d"));
    assert_eq!(model["inputs"][0], "current_a");
    let n = a.len();
    let mut rows: Vec<Vec<Complex64>> = (0..n)
        .map(|i| {
            let mut row: Vec<Complex64> = a[i].iter().map(|v| Complex64::from(-v)).collect();
            row[i] += s;
            row.push(b[i][0].into());
            row
        })
        .collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| rows[*i][k].norm().total_cmp(&rows[*j][k].norm()));
        rows.swap(k, pivot.unwrap());
        let above = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k] / above[k];
            assert!(i < n);
            row.iter_mut().zip(&above).for_each(|(v, p)| *v -= factor * p);
        }
    }
    let x: Vec<Complex64> = (0..n).map(|i| rows[i][n] / rows[i][i]).collect();
    let names = model["outputs"].as_array().unwrap();
    let outputs = names.iter().enumerate().map(|(k, name)| {
        let sum: Complex64 = c[k].iter().zip(&x).map(|(c, x)| x * c).sum();
        (name.as_str().unwrap().to_owned(), sum + d[k][0])
    });
    outputs.collect()
}

#[test]
fn a_uniform_cantilever_has_its_closed_forms() {
    let model = json(UNIFORM, &["--modes", "4", "--omega", "3:4:2"]);
    let unit = (2.0 / 0.5_f64).sqrt() / (0.8 * 0.8);
    // Roots of cos x·cosh x = −1 and of tan x = tanh x.
    let clamped_free = [1.875_104_068_711_961_2, 4.694_091_132_974_175, 7.854_757_438_237_613];
    let frequencies = numbers(&model["natural_frequencies_rad_s"]);
    assert_eq!(frequencies.len(), 4);
    for (found, x) in frequencies.iter().zip(clamped_free) {
        close(*found, unit * x * x, 1e-12);
    }
    // From the tip, y = sin ξ·cosh ξ + cos ξ·sinh ξ: zeros s = 2ξ² at tan ξ = −tanh ξ, half the
    // first and third roots of cos x·cosh x = 1.
    for (k, x) in [4.730_040_744_862_704, 10.995_607_838_001_671].iter().enumerate() {
        let zero = model["tip_zeros"][k]["s_squared"]["re"].as_f64().unwrap().sqrt();
        close(zero, unit * 2.0 * (x / 2.0_f64).powi(2), 1e-12);
    }
    assert_eq!(model["kind"], "distributed");
    let truncated = &model["truncated"];
    // All of m·l²/3 but the first mode's part.
    let first = model["modes"][0]["inertia_kg_m2"].as_f64().unwrap();
    let rest = 0.5 * 0.8_f64.powi(3) / 3.0 - first;
    close(truncated["residual_inertia_kg_m2"].as_f64().unwrap(), rest, 1e-10);
}

#[test]
fn a_payload_moves_poles_and_no_zero_unless_it_turns() {
    let study = |payload: &str| {
        let model = json(&format!("{TWO_MASSES}{payload}"), &["--payload", "0.5x,2x,0.3 kg"]);
        let cases = model["payload_study"].as_array().unwrap().clone();
        assert_eq!(cases.len(), 4);
        let shifts: Vec<f64> = cases.iter().map(|c| c["zero_shift"].as_f64().unwrap()).collect();
        let first: Vec<f64> =
            cases.iter().map(|c| numbers(&c["natural_frequencies_rad_s"])[0]).collect();
        assert!(first[1] > first[0] && first[0] > first[2], "{first:?}");
        shifts
    };
    assert!(study("").iter().all(|shift| *shift < 1e-12));
    assert!(study("payload = { mass = 0.1 }\n").iter().all(|shift| *shift < 1e-12));
    let turning = study("payload = { mass = 0.1, inertia = 1e-3 }\n");
    // A factor multiplies the rotary inertia as well; a mass leaves it, and zeros know that alone.
    assert!(turning[1..3].iter().all(|shift| *shift > 1e-3), "{turning:?}");
    assert!(turning[0] < 1e-12 && turning[3] < 1e-12, "{turning:?}");
}

#[test]
fn odd_ratios_are_pointed_out() {
    let with = |damping: &str| {
        let model = json(&format!("{TWO_MASSES}damping = {{ {damping} }}\n"), &[]);
        model["warnings"].as_array().unwrap().len()
    };
    assert_eq!(with("ratio = \"2 %\""), 0);
    assert_eq!(with("ratio = 2"), 1);
    assert_eq!(with("ratios = [0.01, 0.01, 0.02]"), 1);
}

#[test]
fn a_uniform_beam_keeps_a_thousand_zeros() {
    let model = json(UNIFORM, &["--modes", "1000"]);
    let zeros = model["tip_zeros"].as_array().unwrap();
    let highest = numbers(&model["natural_frequencies_rad_s"])[999];
    // s = 2ξ²·√(EI/μ)/L², ξ near (k − ¼)·π.
    let unit = (2.0 / 0.5_f64).sqrt() / (0.8 * 0.8);
    let expected = (highest / (2.0 * unit)).sqrt() / std::f64::consts::PI + 0.25;
    assert_eq!(zeros.len(), expected.floor() as usize);
    assert!(model["warnings"].as_array().unwrap().is_empty());
}

#[test]
fn section_3_is_reported() {
    let model = json(TWO_MASSES, &["--properties"]);
    let properties = model["properties"].as_array().unwrap();
    assert_eq!(properties.len(), 7);
    assert!(properties.iter().all(|p| p["holds"] == true), "{properties:#?}");
    let turning = format!("{TWO_MASSES}payload = {{ mass = 0.1, inertia = 1e-3 }}\n");
    let table = table(&turning, &["--properties"]);
    assert!(table.contains("zeros and payload  does not hold"), "{table}");
}

#[test]
fn a_million_masses_take_no_matrix() {
    let long = "[beam]\nflexural_rigidity = 2\n\
                spans = [{ length = 1e-6, mass = 5e-7, count = 1000000 }]\n";
    let model = json(long, &["--modes", "1"]);
    // A uniform cantilever of 2 N·m², 0.5 kg/m and 1 m, its masses half a span too far out.
    let wanted = 2.0 * 1.875_104_068_711_961_2_f64.powi(2);
    close(numbers(&model["natural_frequencies_rad_s"])[0], wanted, 3e-6);
    assert!(model["ei_a"].is_null() && !model["notes"].as_array().unwrap().is_empty());
}

#[test]
fn a_model_and_its_schema_name_the_same_keys() {
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/model.schema.json"),
        "model",
    );
    let all = ["--omega", "1:10:3", "--payload", "2x", "--properties"];
    check.look_at(&json(&format!("{TWO_MASSES}{DRIVE}"), &all));
    let payload = "hub_radius = 0.1\npayload = { mass = 0.1, inertia = 1e-3, offset = -0.05 }\n";
    check.look_at(&json(&format!("{UNIFORM}{payload}{DRIVE}"), &all[..4]));
    let many =
        "[beam]\nflexural_rigidity = 2\nspans = [{ length = 0.01, mass = 0.01, count = 300 }]\n";
    check.look_at(&json(many, &all[..4]));
    let modes = "[beam]\nmodes = [{ frequency = 1, coupling = 0.5, gains = [1] }]\n";
    check.look_at(&json(&format!("{modes}{DRIVE}"), &all[..2]));
    check.holds(&[
        "ei_a",
        "modes[].share",
        "tip_zeros[].s_squared.re",
        "transfer_functions[].poles[].im",
        "state_space.outputs",
        "truncated.residual_inertia_kg_m2",
        "frequency_response.motor_rad_per_a[].re",
        "payload_study[].zeros[].class",
        "properties[].holds",
    ]);
}

#[test]
fn plots_show_what_was_asked_for() {
    let folder = folder(&format!("{TWO_MASSES}{DRIVE}"));
    run(folder.path(), &["--payload", "2x", "--plots", "plots"]);
    for (name, text) in [
        ("bode-tip", "Magnitude (dB)"),
        ("bode-motor", "Frequency (rad/s)"),
        ("modes", "6.015 rad/s"),
        ("payload", "zeros ±σ (b)"),
    ] {
        let plot = folder.path().join("plots").join(name);
        let svg = std::fs::read_to_string(plot.with_extension("svg")).unwrap();
        assert!(svg.contains(text), "{name}");
        let png = std::fs::read(plot.with_extension("png")).unwrap();
        assert!(png.starts_with(b"\x89PNG") && png.len() > 5000, "{name}");
    }
}

#[test]
fn frequencies_come_from_a_file() {
    let folder = folder(TWO_MASSES);
    std::fs::write(folder.path().join("grid.csv"), "omega,note\n1,slow\n6,near\n").unwrap();
    let table = run(folder.path(), &["--omega", "grid.csv"]);
    assert!(table.contains("omega [rad/s]") && table.contains("6.00000"), "{table}");
    // (42) at 1 rad/s.
    let (square, g) = (1.0, 57_951.6 + 45.4939);
    let decibel = 20.0 * (g / (square * square - 1637.78 * square + 57_951.6_f64)).log10();
    assert!(table.contains(&format!("{decibel:.3}")), "{table}");
}
