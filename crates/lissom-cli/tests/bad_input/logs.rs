//! Logs that cannot be used.

use crate::bench::{Bench, Row, csv, good, motion};

#[test]
fn the_log_is_missing() {
    Bench::replacing("run.csv", "run-1.csv").refuses("");
}

#[test]
fn the_log_is_a_folder() {
    let bench = Bench::replacing("run.csv", "logs");
    std::fs::create_dir(bench.path().join("logs")).unwrap();
    bench.refuses("");
}

#[test]
fn a_column_is_missing() {
    Bench::replacing("column = \"m\"", "column = \"motor\"").refuses("");
    Bench::replacing("column = \"m\"", "column = \"M\"").refuses("");
    Bench::replacing("column = \"m\"", "column = 7").refuses("");
    Bench::replacing("column = \"m\"", "column = 0").refuses("");
    let headless = csv(&good()).lines().skip(1).collect::<Vec<_>>().join("\n");
    Bench::log(headless).refuses("");
    Bench::log(csv(&good()).replace("t,i,m,p", "t,m,m,p")).file(
        "campaign.toml",
        crate::bench::CAMPAIGN.replace("column = \"i\"", "column = 2"),
    )
    .refuses("");
}

#[test]
fn the_log_has_no_rows() {
    Bench::log("").refuses("");
    Bench::log("\n \n").refuses("");
    Bench::log("t,i,m,p\n").refuses("");
    Bench::log("# a comment\n").refuses("");
}

#[test]
fn the_log_has_too_few_rows() {
    Bench::log("t,i,m,p\n0,1,2,3\n").refuses("");
    Bench::log("0,1,2,3\n").refuses("");
    Bench::log(csv(&good()[..2])).refuses("");
    Bench::log(csv(&good()[..7])).refuses("");
}

#[test]
fn a_cell_is_no_number() {
    Bench::row(100, "0.490000,NaN,0.1,0.1").refuses("");
    Bench::row(100, "0.490000,0.1,0.1,-inf").refuses("");
    Bench::row(100, "0.490000,0.1,---,0.1").refuses("");
    Bench::row(100, "now,0.1,0.1,0.1").refuses("");
    Bench::row(100, "0.490000,1e999,0.1,0.1").refuses("");
}

#[test]
fn a_cell_is_missing() {
    Bench::row(100, "0.490000,0.1,,0.1").refuses("");
    Bench::row(100, "0.490000,0.1,0.1").refuses("");
}

/// A tip that was logged for longer or shorter than the motor: rows with one of them alone.
#[test]
fn the_tip_is_longer_or_shorter_than_the_motor() {
    let log = csv(&good());
    let longer = format!("{log}20.000000,,,0.1\n20.005000,,,0.1\n");
    Bench::log(longer).refuses("");
    let shorter = format!("{log}20.000000,0.1,0.1\n20.005000,0.1,0.1\n");
    Bench::log(shorter).refuses("");
}

#[test]
fn time_does_not_increase() {
    Bench::row(100, "0.484000,0.1,0.1,0.1").refuses("");
    Bench::row(100, "0.485000,0.1,0.1,0.1").refuses("");
    let still: Vec<Row> = good().into_iter().map(|[_, i, m, p]| [0.0, i, m, p]).collect();
    Bench::log(csv(&still)).refuses("");
}

#[test]
fn gaps_leave_no_piece() {
    let pieces: Vec<Row> =
        good().into_iter().enumerate().filter(|(k, _)| k % 40 < 20).map(|(_, row)| row).collect();
    Bench::log(csv(&pieces)).refuses("");
}

#[test]
fn signals_are_constant() {
    let constant = |column: usize| {
        let mut rows = good();
        rows.iter_mut().for_each(|row| row[column] = 0.5);
        csv(&rows)
    };
    let two = "[[runs]]\nfile = \"second.csv\"\n";
    Bench::adding(two).file("run.csv", constant(2)).file("second.csv", constant(2)).refuses("");
    Bench::adding(two).file("run.csv", constant(1)).file("second.csv", constant(1)).refuses("");
    Bench::adding(two).file("run.csv", constant(1)).file("second.csv", constant(2)).refuses("");
    Bench::log(constant(3)).refuses("");
}

#[test]
fn a_number_overflows_in_its_unit() {
    let mut rows = motion(4.0, 0.005, 20.0);
    rows.iter_mut().for_each(|row| row[1] *= 1e306);
    let text = crate::bench::CAMPAIGN.replace("unit = \"A\"", "unit = \"A\", scale = 1e6");
    Bench::log(csv(&rows)).file("campaign.toml", text).refuses("");
}
