//! Logs of other formats through the reader of campaigns.

use std::path::PathBuf;

use lissom_core::record::Hold;

use super::{ColumnRef, Log, LogColumn, LogError, LogOptions, read_log};

/// Time, current and angle.
fn rows() -> Vec<[f64; 3]> {
    (0..200).map(|k| 2e-3 * f64::from(k)).map(|t| [t, (40.0 * t).cos(), (20.0 * t).sin()]).collect()
}

fn name(column: &str) -> ColumnRef {
    ColumnRef::Name(column.to_owned())
}

fn read(text: &str, time: &ColumnRef, columns: [ColumnRef; 2]) -> Result<Log, LogError> {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("log");
    std::fs::write(&path, text).unwrap();
    let [current, angle] = columns;
    let held = LogColumn { column: current, hold: Hold::Sampled };
    let measured = LogColumn { column: angle, hold: Hold::Measured };
    read_log(&path, Some(time), &[held, measured], &LogOptions::default())
}

/// The log has these rows, its angle at the stamps of the command.
#[track_caller]
fn holds(log: &Log, per_second: f64, count: usize) {
    let time = log.time.as_ref().unwrap();
    assert_eq!(time.len(), count);
    let first = rows().iter().position(|r| (r[0] * per_second - time[0]).abs() < 1e-9).unwrap();
    for (k, row) in rows()[first..first + count].iter().enumerate() {
        assert!((time[k] - per_second * row[0]).abs() < 1e-6);
        assert!((log.columns[0][k] - row[1]).abs() < 1e-9);
        assert!((log.columns[1][k] - row[2]).abs() < 1e-6, "{k}");
    }
}

fn lines(row: impl Fn(&[f64; 3]) -> String) -> String {
    rows().iter().map(|r| row(r) + "\n").collect()
}

#[test]
fn a_preamble_and_json() {
    let table = lines(|r| format!("{},{},{}", r[0], r[1], r[2]));
    let scope = format!("Model,X\nLength,200\nInterval,0.002,,\nTIME,CH1,CH2\n{table}EOF\n");
    let log = read(&scope, &name("TIME"), [name("CH1"), name("CH2")]).unwrap();
    holds(&log, 1.0, 200);
    let record =
        |r: &[f64; 3]| format!("{{\"t\":{},\"x\":{{\"i\":{},\"q\":{}}}}}", r[0], r[1], r[2]);
    let log = read(&lines(record), &name("t"), [name("i"), name("x/q")]).unwrap();
    holds(&log, 1.0, 200);
    let missing = read(&lines(record), &name("t"), [name("i"), name("p")]).unwrap_err();
    assert!(missing.to_string().contains("the columns are \"t\", \"x/i\", \"x/q\""), "{missing}");
}

#[test]
fn channels_with_clocks_of_their_own() {
    let trace = |k: usize, late_s: f64| lines(|r| format!("; {}; {}", 1e3 * (r[0] + late_s), r[k]));
    let late = |late_s: f64, angle: &str| {
        format!(
            "[key]; [value]\n0.Variable; iq\n0.Data; \n{}1.Variable; pos\n1.Data; \n{angle}",
            trace(1, late_s)
        )
    };
    let both = late(0.0, &trace(2, 0.0));
    let log = read(&both, &name("iq/time"), [name("iq"), name("pos")]).unwrap();
    holds(&log, 1e3, 200);
    let angle = lines(|r| format!("; {}; {}", 1e3 * (r[0] + 5e-4), (20.0 * (r[0] + 5e-4)).sin()));
    let log = read(&late(0.0, &angle), &name("iq/time"), [name("iq"), name("pos")]).unwrap();
    holds(&log, 1e3, 199);
    let blank =
        lines(|r| format!("{},{},\n{},,{}", r[0], r[1], r[0] + 5e-4, (20.0 * (r[0] + 5e-4)).sin()));
    let log = read(&format!("t,i,q\n{blank}"), &name("t"), [name("i"), name("q")]).unwrap();
    holds(&log, 1.0, 199);
}

#[test]
fn a_row_for_each_signal() {
    let row = |k: usize| rows().iter().map(|r| r[k].to_string()).collect::<Vec<_>>().join(",");
    let text = format!("{}\n{}\n{}\n", row(0), row(1), row(2));
    let number = ColumnRef::Number;
    let log = read(&text, &number(1), [number(2), number(3)]).unwrap();
    holds(&log, 1.0, 200);
}

#[test]
fn cells_may_be_missing_and_words_may_not() {
    let with = |blank: std::ops::Range<usize>, cell: &str| {
        let row = |(k, r): (usize, &[f64; 3])| {
            let angle = if blank.contains(&k) { cell.to_owned() } else { r[2].to_string() };
            format!("{},{},{angle}\n", r[0], r[1])
        };
        let rows: String = rows().iter().enumerate().map(row).collect();
        read(&format!("t,i,q\n{rows}"), &name("t"), [name("i"), name("q")])
    };
    holds(&with(0..3, "NaN").unwrap(), 1.0, 197);
    holds(&with(0..3, "").unwrap(), 1.0, 197);
    let single = with(50..51, "").unwrap().time.unwrap();
    assert!(single.len() == 199 && single[50] - single[49] > 1.9 * (single[1] - single[0]));
    assert_eq!(with(50..54, "NaN").unwrap().time.unwrap().len(), 196);
    assert!(matches!(with(50..51, "x"), Err(LogError::NotANumber { row: 52, .. })));
}

#[test]
fn what_is_no_table_is_said_to_be_none() {
    let error = read("%PDF-1.7 stream", &name("t"), [name("i"), name("q")]).unwrap_err();
    assert_eq!(
        error.to_string().rsplit(": ").next().unwrap(),
        "this is a PDF document, not a table that can be read"
    );
    assert!(error.hint().is_some());
}
