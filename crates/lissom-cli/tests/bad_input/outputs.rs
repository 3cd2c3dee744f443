//! Outputs that cannot be written, and options that mean nothing.

use crate::bench::{Bench, text};

#[test]
fn the_folder_of_an_output_is_absent() {
    let bench = Bench::new();
    let json =
        ["campaign.toml", "--report", "out.html", "--plots", "plots", "--json", "no/out.json"];
    bench.refuses_with(
        &json,
        1,
        "error: no/out.json: cannot be written: No such file or directory (os error 2)\n\
             hint: create the folder first",
    );
    let report = ["campaign.toml", "--json", "out.json", "--report", "no/out.html"];
    bench.refuses_with(
        &report,
        1,
        "error: no/out.html: cannot be written: No such file or directory (os error 2)\n\
             hint: create the folder first",
    );
}

#[test]
fn an_output_is_a_folder_or_below_a_file() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path().join("folder")).unwrap();
    bench.refuses_with(
        &["campaign.toml", "--report", "out.html", "--json", "folder"],
        1,
        "error: folder: cannot be written: is a directory\n\
             hint: give a file name, not a folder",
    );
    bench.refuses_with(
        &["campaign.toml", "--json", "out.json", "--plots", "run.csv"],
        1,
        "error: run.csv: cannot be written: File exists (os error 17)\n\
             hint: give another path: a file has the name of the folder",
    );
    bench.refuses_with(
        &["campaign.toml", "--json", "run.csv/out.json"],
        1,
        "error: run.csv/out.json: cannot be written: Not a directory (os error 20)\n\
             hint: give another path: a file has the name of the folder",
    );
}

#[test]
fn an_output_would_cost_a_log() {
    let bench = Bench::new();
    bench.refuses_with(
        &["--json", "run.csv", "campaign.toml"],
        1,
        "error: run.csv: exists and is not an earlier output; it is not overwritten\n\
         hint: put the input before `--json FILE`, give another name, or delete the file if you do not need it",
    );
    bench.refuses_with(
        &["campaign.toml", "--json", "out", "--report", "out"],
        1,
        "error: out: is given for two outputs\nhint: give each output a file of its own",
    );
}

#[test]
fn a_window_is_no_time() {
    let hint = "hint: write a time with its unit, such as \"0.3 s\"";
    let usage = "\n\nFor more information, try '--help'.";
    for (window, reason) in [
        ("abc", "\"abc\" does not begin with a number"),
        ("0 s", "it must be greater than zero"),
        ("-1 s", "it must be greater than zero"),
        ("1 A", "\"1 A\" is a current [A], where a time [s] is expected"),
        ("0.3", "\"0.3\" has no unit; a time [s] is expected"),
    ] {
        let message = format!(
            "error: invalid value '{window}' for '--window <TIME>': {reason}\n\
         {hint}{usage}",
        );
        Bench::new().refuses_with(&["campaign.toml", "--window", window], 2, &message);
    }
    let negative = "[analysis]\nwindow = \"-1 s\"\n";
    Bench::adding(negative).refuses(
        "error: campaign.toml, line 13: `analysis.window` is \"-1 s\", but must be greater \
         than zero\n\
         hint: check its sign",
    );
}

#[test]
fn all_outputs_appear_together() {
    let bench = Bench::new();
    let output = bench.identify(&[
        "campaign.toml",
        "--json",
        "out.json",
        "--report",
        "out.html",
        "--plots",
        "new/plots",
    ]);
    assert!(matches!(output.status.code(), Some(0 | 3)), "{}", text(&output.stderr));
    for name in ["out.json", "out.html", "new/plots"] {
        assert!(bench.path().join(name).exists(), "{name}");
    }
    let hidden = std::fs::read_dir(bench.path())
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().starts_with('.'));
    assert_eq!(hidden.count(), 0, "no part of a file is left");
}
