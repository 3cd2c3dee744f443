//! Beams that cannot be, and options that ask for what there is not.

use super::bench::{Bench, text};

/// `[beam]` with these lines, and every output asked for.
#[track_caller]
fn refuses(beam: &str, message: &str) {
    let outputs = ["arm.toml", "--json", "out.json", "--plots", "plots", "--payload", "2x"];
    let bench = Bench::new().file("arm.toml", format!("[beam]\n{beam}\n"));
    bench.lissom_refuses("model", &outputs, 1, message);
}

/// One span with these entries, EI = 2 N·m².
#[track_caller]
fn refuses_span(span: &str, message: &str) {
    refuses(&format!("flexural_rigidity = 2\nspans = [{{ {span} }}]"), message);
}

#[test]
fn a_size_is_zero_negative_or_absurd() {
    let zero = "hint: check the number and its unit";
    let sign = "hint: check its sign";
    for key in ["length", "mass"] {
        let other = if key == "length" { "mass = 1" } else { "length = 1" };
        for (value, fault, hint) in [
            ("0", "0, but must be greater than zero", zero),
            ("-2", "-2, but must be greater than zero", sign),
            ("1e-320", "1e-320, but must be of a magnitude from 1e-100 to 1e100 in SI", zero),
            ("1e308", "1e308, but must be of a magnitude from 1e-100 to 1e100 in SI", zero),
        ] {
            refuses_span(
                &format!("{key} = {value}, {other}"),
                &format!("error: arm.toml, line 3: `beam.spans[1].{key}` is {fault}\n{hint}"),
            );
        }
    }
    for (value, fault, hint) in [
        ("0", "0, but must be greater than zero", zero),
        ("-1", "-1, but must be greater than zero", sign),
        ("\"-3 N*m^2\"", "\"-3 N*m^2\", but must be greater than zero", sign),
    ] {
        refuses(
            &format!("flexural_rigidity = {value}\nspans = [{{ length = 1, mass = 1 }}]"),
            &format!("error: arm.toml, line 2: `beam.flexural_rigidity` is {fault}\n{hint}"),
        );
    }
}

#[test]
fn there_is_no_span() {
    refuses(
        "flexural_rigidity = 2\nspans = []",
        "error: arm.toml, line 3: `beam.spans` is a list, where a list of at least one span is \
         expected\n\
         hint: `lissom demo` writes an example",
    );
    refuses(
        "flexural_rigidity = 2",
        "error: arm.toml, line 1: `beam` has no `spans`\n\
         hint: add `spans` to beam",
    );
    let count = "but must be a whole number from 1 to 1000000\n\
                 hint: give a whole number within these limits";
    for value in ["0", "1000001", "-3"] {
        refuses_span(
            &format!("length = 1, mass = 1, count = {value}"),
            &format!("error: arm.toml, line 3: `beam.spans[1].count` is {value}, {count}"),
        );
    }
}

#[test]
fn sizes_are_each_possible_and_together_not() {
    refuses(
        "flexural_rigidity = 1e99\nspans = [{ length = 1e-99, mass = 1e-99 }]",
        "error: arm.toml: the dimensions are so far apart that the tip's compliance leaves the range \
         of a double\n\
         hint: check the numbers and their units",
    );
}

#[test]
fn options_of_model() {
    let bench = Bench::new()
        .file("arm.toml", "[beam]\nflexural_rigidity = 2\nspans = [{ length = 1, mass = 1 }]\n");
    let usage = "\n\nFor more information, try '--help'.";
    let hint = "hint: give START:STOP:COUNT in rad/s, such as 0.1:100:200, or a file";
    for (value, fault) in [
        ("1:2", "a range must have three parts"),
        ("0:1:5", "\"0\" must be positive and finite"),
        ("2:1:5", "STOP must be greater than START"),
        ("1:2:0", "COUNT is \"0\", but must be a whole number from 2 to 1000000"),
        ("5", "one frequency is not a range"),
    ] {
        bench.lissom_refuses(
            "model",
            &["arm.toml", "--omega", value],
            2,
            &format!(
                "error: invalid value '{value}' for '--omega <FILE|START:STOP:COUNT>': {fault}\n\
                 {hint}{usage}"
            ),
        );
    }
    bench.lissom_refuses(
        "model",
        &["arm.toml", "--omega", "nothing.csv"],
        1,
        "error: nothing.csv: cannot be read: No such file or directory (os error 2)\n\
         hint: give a file, or a range START:STOP:COUNT in rad/s, such as 0.1:100:200",
    );
    let bench = bench.file("grid.csv", "1\n-2\n");
    bench.lissom_refuses(
        "model",
        &["arm.toml", "--omega", "grid.csv", "--json", "out.json"],
        1,
        "error: grid.csv, line 2: -2 is not positive and finite\n\
         hint: frequencies are in rad/s and greater than zero",
    );
    bench.lissom_refuses(
        "model",
        &["arm.toml", "--json", "arm.toml"],
        1,
        "error: arm.toml: exists and is not an earlier output; it is not overwritten\n\
         hint: put the input before `--json FILE`, give another name, or delete the file if you do not need it",
    );
}

/// Spans whose stiffness differs by 10⁹, thousands of them: figures, no NaN, no panic.
#[test]
fn thousands_of_spans_of_absurd_ratio() {
    let each = |i: usize| {
        let rigidity = if i % 7 < 3 { "1e-4" } else { "1e5" };
        format!("{{ length = 0.01, mass = 0.1, flexural_rigidity = {rigidity} }}")
    };
    let soft_and_stiff = (0..3000).map(each).collect::<Vec<_>>().join(",\n");
    let bench = Bench::new().file("arm.toml", format!("[beam]\nspans = [\n{soft_and_stiff}]\n"));
    let output = bench.lissom("model", &["arm.toml", "--json", "--omega", "1e-4:1e4:20"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let model: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let ascending = |key: &str| {
        let list = model[key].as_array().unwrap();
        assert_eq!(list.len(), 10, "{key}");
        let size = |v: &serde_json::Value| v.as_f64().or(v["s_squared"]["re"].as_f64()).unwrap();
        assert!(list.windows(2).all(|w| 0.0 < size(&w[0]) && size(&w[0]) < size(&w[1])), "{key}");
    };
    ascending("natural_frequencies_rad_s");
    ascending("tip_zeros");
    let tips = model["frequency_response"]["tips"][0].as_array().unwrap();
    assert!(tips.len() == 20 && tips.iter().all(|tip| tip["re"].is_number()));
}

#[test]
fn ratios_stand_beside_dampers() {
    refuses(
        "flexural_rigidity = 2\ndamping = { ratio = 0.01 }\n\
         spans = [{ length = 1, mass = 1, damping = 0.1 }]",
        "error: arm.toml: damping ratios by mode and dampers at masses are both given: no mode would \
         keep its ratio\n\
         hint: leave out the `damping` of the spans, or write damping = { mass_proportional = \
         \"...\", stiffness_proportional = \"...\" } instead of ratios",
    );
}
