//! Logs that cannot be used.

use crate::bench::{Bench, Row, csv, good, motion};

#[test]
fn the_log_is_missing() {
    Bench::replacing("run.csv", "run-1.csv").refuses(
        "error: run-1.csv: cannot be opened: No such file or directory (os error 2)\n\
         hint: check the name: a path in a campaign.toml starts from the folder of that file",
    );
}

#[test]
fn the_log_is_a_folder() {
    let bench = Bench::replacing("run.csv", "logs");
    std::fs::create_dir(bench.path().join("logs")).unwrap();
    bench.refuses(
        "error: logs: cannot be opened: is a directory\n\
         hint: give one log as `file`, and a [[runs]] for each log of the folder",
    );
}

#[test]
fn a_column_is_missing() {
    Bench::replacing("column = \"m\"", "column = \"motor\"").refuses(
        "error: run.csv: there is no column \"motor\"; the columns are \"t\", \"i\", \"m\", \
         \"p\"\n\
         hint: give one of these names exactly, or the column's number from 1",
    );
    Bench::replacing("column = \"m\"", "column = \"M\"").refuses(
        "error: run.csv: there is no column \"M\"; the columns are \"t\", \"i\", \"m\", \"p\"\n\
         hint: did you mean \"m\"?",
    );
    Bench::replacing("column = \"m\"", "column = 7").refuses(
        "error: run.csv: there is no column 7; the log has 4\n\
         hint: columns are counted from 1",
    );
    Bench::replacing("column = \"m\"", "column = 0").refuses(
        "error: campaign.toml, line 4: `signals.motor.column` is 0, but must be a whole number \
         from 1 to 100000\n\
         hint: give the column's name in quotes, or its number from 1",
    );
    let headless = csv(&good()).lines().skip(1).collect::<Vec<_>>().join("\n");
    Bench::log(headless).refuses(
        "error: run.csv: there is no column \"t\": the log has no header\n\
         hint: give the column's number, 1 to 4, as in `column = 1`",
    );
    Bench::log(csv(&good()).replace("t,i,m,p", "t,m,m,p"))
        .file("campaign.toml", crate::bench::CAMPAIGN.replace("column = \"i\"", "column = 2"))
        .refuses(
            "error: run.csv: 2 columns are called \"m\"\n\
         hint: give the column's number: 2 or 3",
        );
}

#[test]
fn the_log_has_no_rows() {
    Bench::log("").refuses(
        "error: run.csv: the log is empty\n\
         hint: check that the recording ran and that this is the right file",
    );
    Bench::log("\n \n").refuses(
        "error: run.csv: the log is empty\n\
         hint: check that the recording ran and that this is the right file",
    );
    Bench::log("t,i,m,p\n").refuses(
        "error: run.csv: the log has a header and no rows of numbers\n\
         hint: check that the recording ran and that this is the right file",
    );
    Bench::log("# a comment\n").refuses(
        "error: run.csv: the log has a header and no rows of numbers\n\
         hint: check that the recording ran and that this is the right file",
    );
}

#[test]
fn the_log_has_too_few_rows() {
    Bench::log("t,i,m,p\n0,1,2,3\n").refuses(
        "error: run.csv: the log has one row of numbers only, row 2\n\
         hint: check that the recording ran and that this is the right file",
    );
    Bench::log("0,1,2,3\n").refuses(
        "error: run.csv: there is no column \"t\": the log has no header\n\
         hint: give the column's number, 1 to 4, as in `column = 1`",
    );
    Bench::log(csv(&good()[..2])).refuses(
        "error: run.csv: 2 samples; at least 8 are needed\n\
         hint: record longer, or leave the run out",
    );
    Bench::log(csv(&good()[..7])).refuses(
        "error: run.csv: 7 samples; at least 8 are needed\n\
         hint: record longer, or leave the run out",
    );
}

#[test]
fn a_cell_is_no_number() {
    Bench::row(100, "0.490000,0.1,0.1,-inf").refuses(
        "error: run.csv: row 100, column \"p\": \"-inf\" is not a finite number\n\
         hint: repair the row, or cut the log there: missing values are not filled in",
    );
    Bench::row(100, "0.490000,0.1,---,0.1").refuses(
        "error: run.csv: row 100, column \"m\": \"---\" is not a number\n\
         hint: repair the row, or cut the log there: missing values are not filled in",
    );
    Bench::row(100, "now,0.1,0.1,0.1").refuses(
        "error: run.csv: row 100, column \"t\": \"now\" is not a number\n\
         hint: repair the row, or cut the log there: missing values are not filled in",
    );
    Bench::row(100, "0.490000,1e999,0.1,0.1").refuses(
        "error: run.csv: row 100, column \"i\": \"1e999\" is not a finite number\n\
         hint: repair the row, or cut the log there: missing values are not filled in",
    );
}

/// A row without a value is as one that was not logged.
#[test]
fn a_cell_is_missing() {
    for row in ["0.490000,0.1,,0.1", "0.490000,0.1,0.1", "0.490000,NaN,0.1,0.1"] {
        let found = Bench::row(100, row).findings("rows-filled");
        assert!(found[0].starts_with("run.csv: "), "{row}: {found:?}");
    }
    // Without time stamps the rows behind it would be earlier.
    let bench =
        Bench::replacing("time = { column = \"t\", unit = \"s\" }", "sample_time = \"5 ms\"");
    let log = csv(&good());
    let mut rows: Vec<&str> = log.lines().collect();
    rows[99] = "0.490000,0.1,,0.1";
    bench.file("run.csv", rows.join("\n")).refuses(
        "error: run.csv: row 100, column \"m\": the cell is missing\n\
         hint: repair the row, or cut the log there: missing values are not filled in",
    );
}

/// A tip that was logged for longer or shorter than the motor: rows with one of them alone are left out.
#[test]
fn the_tip_is_longer_or_shorter_than_the_motor() {
    let log = csv(&good());
    let whole = Bench::log(&log).result();
    for more in ["20.000000,,,0.1\n20.005000,,,0.1\n", "20.000000,0.1,0.1\n20.005000,0.1,0.1\n"] {
        let longer = Bench::log(format!("{log}{more}")).result();
        assert_eq!(longer["parameters"], whole["parameters"]);
    }
}

#[test]
fn time_does_not_increase() {
    Bench::row(100, "0.484000,0.1,0.1,0.1").refuses(
        "error: run.csv: row 100, column \"t\": time goes back from 0.485 to 0.484\n\
         hint: cut the log there, and give both parts as separate runs",
    );
    Bench::row(100, "0.485000,0.1,0.1,0.1").refuses(
        "error: run.csv: row 100, column \"t\": time stands still at 0.485\n\
         hint: export the stamps with more digits, or give `sample_time` instead of `time` if \
         the sampling is regular",
    );
    let still: Vec<Row> = good().into_iter().map(|[_, i, m, p]| [0.0, i, m, p]).collect();
    Bench::log(csv(&still)).refuses(
        "error: run.csv: row 3, column \"t\": time stands still at 0\n\
         hint: export the stamps with more digits, or give `sample_time` instead of `time` if \
         the sampling is regular",
    );
}

#[test]
fn gaps_leave_no_piece() {
    let pieces: Vec<Row> =
        good().into_iter().enumerate().filter(|(k, _)| k % 40 < 20).map(|(_, row)| row).collect();
    Bench::log(csv(&pieces)).refuses(
        "error: run.csv: the log is cut at gaps in the time stamps (99), and no piece has 50 \
         samples; the longest has 20\n\
         hint: log without interruption; if the stamps are too coarse for the sampling, \
         give `sample_time` instead of `time`",
    );
}

#[test]
fn signals_are_constant() {
    let constant = |column: usize| {
        let mut rows = good();
        for row in &mut rows {
            row[column] = 0.5;
        }
        csv(&rows)
    };
    let two = "[[runs]]\nfile = \"second.csv\"\n";
    Bench::adding(two).file("run.csv", constant(2)).file("second.csv", constant(2)).refuses(
        "error: campaign.toml: every run has a constant channel: motor in 2 of 2\n\
         hint: check the wiring and which columns the campaign names; a tip without a signal \
         can be left out of [signals]",
    );
    Bench::adding(two).file("run.csv", constant(1)).file("second.csv", constant(1)).refuses(
        "error: campaign.toml: every run has a constant channel: command in 2 of 2\n\
         hint: check the wiring and which columns the campaign names; a tip without a signal \
         can be left out of [signals]",
    );
    Bench::adding(two).file("run.csv", constant(1)).file("second.csv", constant(2)).refuses(
        "error: campaign.toml: every run has a constant channel: motor in 1 of 2, command in 1 \
         of 2\n\
         hint: check the wiring and which columns the campaign names; a tip without a signal \
         can be left out of [signals]",
    );
}

#[test]
fn a_number_is_too_large_in_its_unit() {
    let mut rows = motion(4.0, 0.005, 20.0);
    for row in &mut rows {
        row[1] *= 1e306;
    }
    let text = crate::bench::CAMPAIGN.replace("unit = \"A\"", "unit = \"A\", scale = 1e6");
    Bench::log(csv(&rows)).file("campaign.toml", text).refuses(
        "error: run.csv: channel command: sample 1 is larger than 1e100 in SI units\n\
         hint: check the log at that sample, and `unit`, `scale` and `offset` of the channel",
    );
    let late: Vec<Row> = good().into_iter().map(|[t, i, m, p]| [t * 1e200, i, m, p]).collect();
    Bench::log(csv(&late)).refuses(
        "error: run.csv: channel time: sample 2 is larger than 1e100 in SI units\n\
         hint: check the log at that sample, and `unit`, `scale` and `offset` of the channel",
    );
}
