use std::path::Path;

use lissom_core::record::Hold;
use proptest::prelude::*;

use super::{ColumnRef, Log, LogColumn, LogError, LogOptions, TimeBack, read_log, read_log_from};

fn named(name: &str) -> ColumnRef {
    ColumnRef::Name(name.to_owned())
}

fn measured(column: ColumnRef) -> LogColumn {
    LogColumn { column, hold: Hold::Measured }
}

fn read_with(
    text: impl AsRef<[u8]>,
    time: Option<&ColumnRef>,
    columns: &[ColumnRef],
    options: &LogOptions,
) -> Result<Log, LogError> {
    let columns: Vec<LogColumn> = columns.iter().cloned().map(measured).collect();
    read_log_from(text.as_ref(), "a.csv", time, &columns, options)
}

fn read(text: &str, time: &str, column: &str) -> Result<Log, LogError> {
    read_with(text, Some(&named(time)), &[named(column)], &LogOptions::default())
}

#[track_caller]
fn holds(log: &Log, time: &[f64], column: &[f64]) {
    assert_eq!(log.time.as_deref(), Some(time));
    assert_eq!(log.columns[0], column);
}

#[test]
fn reads_every_layout() {
    for text in [
        "t,u,x\n0,9,1\n0.5,9,2\n",
        "t;u;x\n0;9;1\n0.5;9;2",
        "t\tu\tx\n0\t9\t1\n0.5\t9\t2\n",
        "t u  x\n 0   9 1\n 0.5 9 2\n",
        "\u{feff}t,u,x\r\n0,9,1\r\n\r\n0.5,9,2\r\n",
        "\"t\", \"u, raw\", \"x\"\n0,9,1,\n0.5,9,2,\n",
        "# bench, run 7\n# t,u,x\n0,9,1\n# paused\n0.5,9,2\n",
        "#TEST\n#gain=1.0\n#t\tu\tx\n0\t9\t1\n0.5\t9\t2\n",
        "%t\tu\tx\tmade on 1 May\n0\t9\t1\t0\t0\n0.5\t9\t2\t0\t0\r\n",
        "% t, u, x\n0 9 1\n0.5 9 2\n",
        "t,u,x\n0,nothing,1\n0.5,,2\n",
        "t,u,x\ns,\"A\",rad\n0,9,1\n0.5,9,2\n",
    ] {
        holds(
            &read(text, "t", "x").unwrap_or_else(|e| panic!("{text:?}: {e}")),
            &[0.0, 0.5],
            &[1.0, 2.0],
        );
    }
}

/// Rows of plain decimals are read in one pass; blanks, signs and exponents are not plain.
#[test]
fn plain_rows_are_read_as_others_are() {
    let plain = read("t,u,x\n0,9,-1\n0.25,9,2.5\r\n0.5,9,.125\n0.75,9,-0\n", "t", "x").unwrap();
    let other =
        read("t,u,x\n0, 9,-1\n0.25,+9,2.5 \n 0.5,9,1.25e-1\n\"0.75\",9,-0\n", "t", "x").unwrap();
    assert_eq!(plain, other);
    assert!((plain.time_step - 0.01).abs() < 1e-15);
    assert_eq!(plain.columns[0], [-1.0, 2.5, 0.125, 0.0]);
}

#[test]
fn reads_columns_by_number_with_and_without_header() {
    for text in ["0 9 1\n0.5 9 2\n", "t,u,x\n0,9,1\n0.5,9,2\n"] {
        let log = read_with(
            text,
            Some(&ColumnRef::Number(1)),
            &[ColumnRef::Number(3)],
            &LogOptions::default(),
        );
        holds(&log.unwrap(), &[0.0, 0.5], &[1.0, 2.0]);
    }
}

#[test]
fn reads_a_decimal_comma() {
    let options = LogOptions { decimal_comma: true, ..LogOptions::default() };
    for text in ["t;x\n0,0;1,25\n0,5;2\n", "t\tx\n0\t1,25\n0,5\t2\n", "t x\n0 1,25\n0,5 2\n"] {
        let log = read_with(text, Some(&named("t")), &[named("x")], &options).unwrap();
        holds(&log, &[0.0, 0.5], &[1.25, 2.0]);
    }
}

#[track_caller]
fn fails(result: Result<Log, LogError>, message: &str, hint: Option<&str>) {
    let error = result.unwrap_err();
    assert_eq!(error.to_string(), message);
    assert_eq!(error.hint().as_deref(), hint);
}

const REPAIR: Option<&str> =
    Some("repair the row, or cut the log there: missing values are not filled in");
const CHECK: Option<&str> = Some("check that the recording ran and that this is the right file");

#[test]
fn a_row_that_is_a_comment_is_left_out() {
    let log = read("n,t,x\n1,0,1\n#2,1,99\n % 3,2,99\n4,3,2\n", "t", "x").unwrap();
    assert_eq!((log.time.unwrap(), log.columns), (vec![0.0, 3.0], vec![vec![1.0, 2.0]]));
}

#[test]
fn bad_cells_are_named_with_row_and_column() {
    fails(
        read("t,x\n0,1\n\n1,broken\n", "t", "x"),
        "a.csv: row 4, column \"x\": \"broken\" is not a number",
        REPAIR,
    );
    fails(
        read("t,x\n0,1\n1,\"0.1\n", "t", "x"),
        "a.csv: row 3, column \"x\": \"\"0.1\" is not a number",
        REPAIR,
    );
    fails(
        read("t,x\n0,1\n1,NaN\n", "t", "x"),
        "a.csv: row 3, column \"x\": \"NaN\" is not a finite number",
        REPAIR,
    );
    fails(
        read("t,x\n0,1\n1,-inf\n", "t", "x"),
        "a.csv: row 3, column \"x\": \"-inf\" is not a finite number",
        REPAIR,
    );
    fails(
        read("t,x\n0,1\n1\n", "t", "x"),
        "a.csv: row 3, column \"x\": the cell is missing",
        REPAIR,
    );
    fails(
        read("t,x,y\n0,1,1\n1,,1\n", "t", "x"),
        "a.csv: row 3, column \"x\": the cell is missing",
        REPAIR,
    );
    fails(
        read("t;x\n0;1\n1;1,5\n", "t", "x"),
        "a.csv: row 3, column \"x\": \"1,5\" is not a number",
        Some("if the numbers have a decimal comma, add `decimal = \",\"` to [signals]"),
    );
    let named = Some(
        "name every column in the header; if the numbers have a decimal comma, add `decimal = \",\"` to [signals]",
    );
    fails(
        read("t,x\n0,1\n1,1,5\n", "t", "x"),
        "a.csv: row 3, column 3: \"5\" is beyond the 2 columns of the log",
        named,
    );
    fails(
        read_with("0 1\n1 1 7\n", None, &[ColumnRef::Number(2)], &LogOptions::default()),
        "a.csv: row 2, column 3: \"7\" is beyond the 2 columns of the log",
        named,
    );
    assert!(read("t,x\n0,1,\n1,2,,\n", "t", "x").is_ok());
    let titled = "My log\n0,1,7\n1,2,8\n";
    assert!(read_with(titled, None, &[ColumnRef::Number(2)], &LogOptions::default()).is_ok());
    fails(
        read_with("0 1\n1 x\n", None, &[ColumnRef::Number(2)], &LogOptions::default()),
        "a.csv: row 2, column 2: \"x\" is not a number",
        REPAIR,
    );
}

#[test]
fn logs_without_rows_are_refused() {
    fails(read("", "t", "x"), "a.csv: the log is empty", CHECK);
    fails(read("\n \r\n", "t", "x"), "a.csv: the log is empty", CHECK);
    fails(read("t,x\n", "t", "x"), "a.csv: the log has a header and no rows of numbers", CHECK);
    fails(read("#t,x\n", "t", "x"), "a.csv: the log has a header and no rows of numbers", CHECK);
    fails(read("t,x\n0,1\n", "t", "x"), "a.csv: the log has one row of numbers only, row 2", CHECK);
}

#[test]
fn missing_columns_list_those_there_are() {
    let text = "time,theta_m,time\n0,1,2\n1,1,2\n";
    fails(
        read(text, "theta_m", "theta"),
        "a.csv: there is no column \"theta\"; the columns are \"time\", \"theta_m\", \"time\"",
        Some("did you mean \"theta_m\"?"),
    );
    fails(
        read(text, "theta_m", "current"),
        "a.csv: there is no column \"current\"; the columns are \"time\", \"theta_m\", \"time\"",
        Some("give one of these names exactly, or the column's number from 1"),
    );
    fails(
        read(text, "time", "theta_m"),
        "a.csv: 2 columns are called \"time\"",
        Some("give the column's number: 1 or 3"),
    );
    fails(
        read_with(text, None, &[ColumnRef::Number(4)], &LogOptions::default()),
        "a.csv: there is no column 4; the log has 3",
        Some("columns are counted from 1"),
    );
    fails(
        read("0,1\n1,2\n", "t", "x"),
        "a.csv: there is no column \"t\": the log has no header",
        Some("give the column's number, 1 to 2, as in `column = 1`"),
    );
}

#[test]
fn time_that_stands_still_is_refused_and_time_that_goes_back_is_noted() {
    let still = Some(
        "export the stamps with more digits, or give `sample_time` instead of `time` if the sampling is regular",
    );
    fails(
        read("t,x\n0,1\n1,1\n1,2\n", "t", "x"),
        "a.csv: row 4, column \"t\": time stands still at 1",
        still,
    );
    let log = read("t,x\n0,1\n\n1,1\n0.5,1\n", "t", "x").unwrap();
    assert_eq!(log.time_back, [TimeBack { sample: 2, row: 5, before: 1.0, after: 0.5 }]);
    let text = format!("t,x\n{}", "0,1\n1,1\n".repeat(9));
    let options = LogOptions { max_rows: 4, ..LogOptions::default() };
    fails(
        read_with(text, Some(&named("t")), &[named("x")], &options),
        "a.csv: row 4, column \"t\": time goes back from 1 to 0",
        Some("cut the log there, and give both parts as separate runs"),
    );
}

#[test]
fn repeated_rows_are_passed_over() {
    let log = read("t,x\n0,1\n0,1\n0,1\n1,1\n1,1\n2,3\n", "t", "x").unwrap();
    holds(&log, &[0.0, 1.0, 2.0], &[1.0, 1.0, 3.0]);
    assert_eq!(log.repeated, 3);
}

#[test]
fn files_that_are_no_text_are_refused() {
    let hint = Some(
        "a log is text with commas, semicolons, tabs or blanks between the numbers: export the file as CSV",
    );
    let options = LogOptions::default();
    fails(read_with(b"MAT\0\0", None, &[], &options), "a.csv: row 1 is not text", hint);
    let endless = vec![b'1'; 3 << 20];
    fails(
        read_with(endless, None, &[], &options),
        "a.csv: row 1 is longer than 1048576 bytes",
        Some("a log has one sample in each row: check the line ends, or export fewer columns"),
    );
    fails(
        read_with(b"\xff\xfet\0,\0x\0", None, &[], &options),
        "a.csv: the text is in UTF-16 or UTF-32",
        Some("save the log as UTF-8"),
    );
    fails(
        read_with(b"t,x\n0,1\n\x1b[2J,1\n", None, &[], &options),
        "a.csv: row 3 is not text",
        hint,
    );
}

#[test]
fn a_missing_file_is_named() {
    let result = read_log(Path::new("no/such.csv"), None, &[], &LogOptions::default());
    fails(
        result,
        "no/such.csv: cannot be opened: No such file or directory (os error 2)",
        Some("check the name: a path in a campaign.toml starts from the folder of that file"),
    );
}

#[test]
fn a_long_log_is_thinned_while_it_is_read() {
    use std::fmt::Write as _;
    let mut text = String::from("t,u,x\n");
    for k in 0..103 {
        writeln!(text, "{k},{},{k}", k % 4).unwrap();
    }
    let columns = [LogColumn { column: named("u"), hold: Hold::Sampled }, measured(named("x"))];
    let options = LogOptions { max_rows: 17, ..LogOptions::default() };
    let log =
        read_log_from(text.as_bytes(), "a.csv", Some(&named("t")), &columns, &options).unwrap();
    assert_eq!(log.factor, 8);
    let stamps: Vec<f64> = (0..12).map(|k| f64::from(8 * k)).collect();
    assert_eq!(log.time.unwrap(), stamps);
    assert_eq!(log.columns, [vec![1.5; 12], stamps]);
}

#[test]
fn comments_are_searched_for_names_from_the_last() {
    let mut text = "# a,b\n".repeat(60);
    text += "# t,x\n# made by hand\n0,1\n0.5,2\n";
    holds(&read(&text, "t", "x").unwrap(), &[0.0, 0.5], &[1.0, 2.0]);
}

#[test]
fn many_names_are_listed_in_part() {
    let names: Vec<String> = (0..100).map(|k| format!("c{k}")).collect();
    let text = format!("{}\n{}", names.join(","), "1,\n".repeat(2));
    let message = read_with(text, None, &[named("wanted")], &LogOptions::default());
    let message = message.unwrap_err().to_string();
    assert!(message.ends_with("\"c38\", \"c39\" and 60 more"), "{message}");
}

#[test]
fn a_broken_reader_is_reported_with_its_row() {
    struct Broken;
    impl std::io::Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("the disk is gone"))
        }
    }
    let text = &b"t,x\n0,1\n"[..];
    let reader = std::io::BufReader::new(std::io::Read::chain(text, Broken));
    let result = read_log_from(reader, "a.csv", None, &[], &LogOptions::default());
    fails(
        result,
        "a.csv: reading failed at row 3: the disk is gone",
        Some("check that it is a file and that you may read it"),
    );
}

proptest! {
    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let options = LogOptions { max_rows: 4, decimal_comma: true, ..LogOptions::default() };
        let _ = read_with(&bytes, Some(&ColumnRef::Number(1)), &[ColumnRef::Number(2)], &options);
        let _ = read_with(&bytes, None, &[named("x")], &options);
    }

    #[test]
    fn no_lines_panic(lines in proptest::collection::vec("[-#%tx0-9.,;\t \"eµ]{0,12}", 0..12)) {
        let text = lines.join("\n");
        let options = LogOptions { max_rows: 4, decimal_comma: true, ..LogOptions::default() };
        let log = read_with(&text, Some(&ColumnRef::Number(1)), &[ColumnRef::Number(2)], &options);
        if let Ok(log) = log {
            let stamps = log.time.unwrap();
            let back = |k: usize| log.time_back.iter().any(|back| back.sample == k);
            prop_assert!((1..stamps.len()).all(|k| stamps[k - 1] < stamps[k] || back(k)));
        }
        let _ = read_with(&text, Some(&named("t")), &[named("x")], &options);
    }

    #[test]
    fn what_is_written_is_read(values in proptest::collection::vec(-1e9..1e9f64, 2..50)) {
        let rows: Vec<String> = values.iter().enumerate().map(|(k, v)| format!("{k};{v}")).collect();
        let log = read(&format!("t;x\n{}", rows.join("\n")), "t", "x").unwrap();
        prop_assert_eq!(&log.columns[0], &values);
    }
}
