//! Files that cannot be compared.

use crate::bench::Bench;

/// A result with no more than `lissom compare` needs.
fn result(axis: &str, constant: &str, unit: &str) -> String {
    let friction = if unit == "A" && constant == "null" { AMPERE } else { NONE };
    with_friction(axis, constant, unit, friction)
}

fn with_friction(axis: &str, constant: &str, unit: &str, friction: &str) -> String {
    format!(
        r#"{{"lissom": "0.1.0", "axis": "{axis}", "torque_per_command": {constant}, "command_unit": "{unit}", "from": null,
            "friction": {{{friction}, "curve": []}}, "drive": {{}}, "beam": {{"modes": [], "coupling_by_tip": []}},
            "arm": null, "methods": {{}}, "models": {{"from": "responses", "tips": []}}, "runs": [], "findings": [],
            "frequency_response": {{"omega_rad_s": [], "run": [], "flagged": [], "vouched_for": [], "tips": [],
            "motor_raw": {{"re": [], "im": [], "std": []}}, "motor_corrected": {{"re": [], "im": [], "std": []}}}}}}"#
    )
}

const AMPERE: &str = r#""coulomb": {"value": 1.0, "std": 0.1, "ci95": [0.8, 1.2], "unit": "A"}"#;

const NONE: &str = r#""coulomb": null"#;

fn refuses(bench: &Bench, arguments: &[&str], message: &str) {
    bench.lissom_refuses("compare", arguments, 1, message);
}

#[test]
fn a_file_is_no_result() {
    let bench = Bench::new()
        .file("a.json", result("rotary", "null", "A"))
        .file("model.json", "{\"lissom\": \"0.1.0\"}")
        .file("cut.json", "{\"lissom\":")
        .file("old.json", with_friction("rotary", "null", "A", "\"coulomb\": 1"));
    let hint = "hint: give files that `lissom identify CAMPAIGN --json FILE` wrote";
    refuses(
        &bench,
        &["a.json", "campaign.toml"],
        &format!("error: campaign.toml: is not JSON: expected value at line 1 column 2\n{hint}"),
    );
    refuses(
        &bench,
        &["a.json", "cut.json"],
        &format!(
            "error: cut.json: is not JSON: EOF while parsing a value at line 1 column 10\n{hint}"
        ),
    );
    refuses(
        &bench,
        &["model.json", "a.json"],
        &format!(
            "error: model.json: is not a result of `lissom identify`: it has no `axis`\n{hint}"
        ),
    );
    refuses(
        &bench,
        &["a.json", "no.json"],
        &format!("error: no.json: cannot be read: No such file or directory (os error 2)\n{hint}"),
    );
    refuses(
        &bench,
        &["a.json", "old.json"],
        "error: old.json: `friction` cannot be read: invalid type: integer `1`, expected \
         struct EstimateEntry\n\
         hint: write it again with `lissom identify CAMPAIGN --json FILE`",
    );
}

#[test]
fn there_is_nothing_to_compare_with() {
    let a = result("rotary", "null", "A");
    let bench = Bench::new().file("a.json", &a).file("copy.json", &a);
    refuses(
        &bench,
        &["a.json"],
        "error: a.json: is the only result given\n\
         hint: give two or more: lissom compare before.json after.json",
    );
    let hint = "hint: give results from different logs: only their errors are independent";
    refuses(&bench, &["a.json", "./a.json"], &format!("error: ./a.json: is given twice\n{hint}"));
    refuses(
        &bench,
        &["a.json", "copy.json"],
        &format!("error: copy.json: has the same estimates as a.json\n{hint}"),
    );
}

#[test]
fn results_are_in_different_units() {
    let bench = Bench::new()
        .file("a.json", result("rotary", "null", "A"))
        .file("v.json", result("rotary", "null", "V"))
        .file("nm.json", result("rotary", "0.25", "A"))
        .file("n.json", result("linear", "40.0", "A"));
    refuses(
        &bench,
        &["a.json", "nm.json"],
        "error: results in different units cannot be compared: a.json has a rotary axis and friction in A \
         (no torque constant), nm.json has a rotary axis and friction in N·m\n\
         hint: give `torque_constant` in [drive] of every campaign or of none, and identify again",
    );
    refuses(
        &bench,
        &["a.json", "v.json"],
        "error: results in different units cannot be compared: a.json has a rotary axis and friction in A \
         (no torque constant), v.json has a rotary axis and friction in V (no torque constant)\n\
         hint: log the same command in every campaign, or give `torque_constant` in [drive] of each, and identify again",
    );
    refuses(
        &bench,
        &["nm.json", "n.json"],
        "error: results in different units cannot be compared: nm.json has a rotary axis and friction in N·m, \
         n.json has a linear axis and friction in N\n\
         hint: compare results of the same axis",
    );
}

#[test]
fn a_comparison_would_cost_a_result() {
    let other = AMPERE.replace("1.0", "1.1");
    let bench = Bench::new()
        .file("a.json", result("rotary", "null", "A"))
        .file("b.json", with_friction("rotary", "null", "A", &other))
        .file("c.json", with_friction("rotary", "null", "A", &AMPERE.replace("1.0", "0.9")));
    refuses(
        &bench,
        &["a.json", "b.json", "--json", "a.json"],
        "error: a.json: is an input; it is not overwritten\nhint: give each output a file of its own",
    );
    refuses(
        &bench,
        &["--json", "c.json", "a.json", "b.json"],
        "error: c.json: exists and is not an earlier output; it is not overwritten\n\
         hint: put the input before `--json FILE`, give another name, or delete the file if you do not need it",
    );
}
