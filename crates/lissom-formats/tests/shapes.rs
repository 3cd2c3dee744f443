//! One log in the shapes in which people's drives write it.

#![expect(clippy::unwrap_used, reason = "tests")]

use std::fmt::Write as _;

use lissom_formats::{Clock, Format, FormatError, LogData, ReadOptions, read_bytes, read_with};

/// Time in s, current in A, angle in rad.
fn rows() -> Vec<[f64; 3]> {
    let row = |k: i32| {
        let t = 2e-3 * f64::from(k);
        [t, (0.5 * f64::from(k % 7) - 1.0) * 0.25, (30.0 * t).sin()]
    };
    (0..60).map(row).collect()
}

fn table(separator: &str, row: impl Fn(&[f64; 3]) -> Vec<String>) -> String {
    rows().iter().map(|r| row(r).join(separator) + "\n").collect()
}

fn plain(separator: &str) -> String {
    table(separator, |r| r.iter().map(|v| format!("{v:.9}")).collect())
}

fn read(text: &str) -> LogData {
    read_bytes(text.as_bytes().to_vec()).unwrap()
}

/// The channels at these places have the values of the rows, times the scales.
#[track_caller]
fn holds(found: &LogData, places: [usize; 3], scales: [f64; 3]) {
    for (k, (place, scale)) in places.into_iter().zip(scales).enumerate() {
        let channel = &found.channels[place];
        let values: Vec<f64> = channel.values.iter().copied().filter(|v| !v.is_nan()).collect();
        assert_eq!(values.len(), rows().len(), "{}", channel.name);
        for (value, row) in values.iter().zip(rows()) {
            assert!((value - scale * row[k]).abs() < 1e-6 * scale, "{}: {value}", channel.name);
        }
    }
}

fn names(found: &LogData) -> Vec<&str> {
    found.channels.iter().map(|c| c.name.as_str()).collect()
}

#[test]
fn a_preamble_of_any_length() {
    let scope = "Model,MSO44\nFirmware,1.2\n\nRecord Length,2000,,\nSample Interval,0.002,,\nTIME,CH1,CH2\n";
    let found = read(&(scope.to_owned() + &plain(",")));
    assert_eq!(names(&found), ["TIME", "CH1", "CH2"]);
    holds(&found, [0, 1, 2], [1.0; 3]);
    assert!(found.notes[0].contains("5 lines above"), "{:?}", found.notes);
    let labview = "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\t\nChannels\t2\t\n\
                   Samples\t60\t60\t\nX0\t0.0\t0.0\nDelta_X\t0.002\t0.002\n***End_of_Header***\t\t\n\
                   X_Value\ti\tq\tComment\n";
    let found = read(&(labview.to_owned() + &plain("\t")));
    assert_eq!(names(&found), ["X_Value", "i", "q"]);
    holds(&found, [0, 1, 2], [1.0; 3]);
    let long = "a line of words, and 1 more\n".repeat(3000);
    holds(&read(&(long + "t,i,q\n" + &plain(","))), [0, 1, 2], [1.0; 3]);
}

#[test]
fn units_below_or_in_brackets() {
    let found = read(&("t,i,q\ns,A,rad\n".to_owned() + &plain(",")));
    let unit = |k: usize| found.channels[k].unit.as_deref();
    assert_eq!([unit(0), unit(1), unit(2)], [Some("s"), Some("A"), Some("rad")]);
    let comma = plain(";").replace('.', ",");
    let latin = [b"t [s];Strom [A];Winkel [\xB0]\n", comma.as_bytes()].concat();
    let found = read_bytes(latin).unwrap();
    assert!(found.decimal_comma);
    assert_eq!(found.channels[2].unit.as_deref(), Some("°"));
    holds(&found, [0, 1, 2], [1.0; 3]);
}

#[test]
fn stamps_brackets_blanks_and_an_index() {
    let iso = table(",", |r| {
        vec![
            format!("2024-01-01T23:59:{:06.3}", 59.9 - 0.0 + r[0].min(0.05)),
            format!("{:.9}", r[1]),
        ]
    });
    let found = read(&("time,i\n".to_owned() + &iso));
    assert_eq!(found.channels[0].unit.as_deref(), Some("s"));
    assert!((found.channels[0].values[3] - 6e-3).abs() < 1e-6);
    let midnight = table(",", |r| {
        let s = 86_399.95 + r[0];
        let clock = if s < 86_400.0 {
            format!("23:59:{:06.3}", s - 86_340.0)
        } else {
            format!("00:00:{:06.3}", s - 86_400.0)
        };
        vec![clock, format!("{:.9}", r[1]), format!("{:.9}", r[2])]
    });
    holds(&read(&("time,i,q\n".to_owned() + &midnight)), [0, 1, 2], [1.0; 3]);
    let brackets = table(",", |r| {
        vec![format!("{:.9}", r[0]), format!("[{:.9}]", r[1]), format!("[{:.9}]", r[2])]
    });
    holds(&read(&("t,i,q\n".to_owned() + &brackets)), [0, 1, 2], [1.0; 3]);
    let mut late = String::from("t,i,q\n");
    for r in rows() {
        let _ = writeln!(late, "{:.9},{:.9},\n{:.9},,{:.9}", r[0], r[1], r[0] + 5e-4, r[2]);
    }
    let found = read(&late);
    assert_eq!(found.channels[0].values.len(), 2 * rows().len());
    assert_eq!(found.channels[1].values.iter().filter(|v| v.is_nan()).count(), rows().len());
    let named = table(",", |r| {
        vec![format!("{}", 1.6e18 + 1e9 * r[0]), "joint_1".to_owned(), format!("{:.9}", r[2])]
    });
    let found = read(&("%time,field.name0,field.position0\n".to_owned() + &named));
    assert_eq!(names(&found)[2], "field.position0");
    assert_eq!(found.channels[1].not_a_number, Some((2, "joint_1".to_owned())));
    let index = rows()
        .into_iter()
        .enumerate()
        .map(|(k, r)| format!("{k},{:.9},{:.9},{:.9}\n", r[0], r[1], r[2]));
    let found = read(&(",t,i,q\n".to_owned() + &index.collect::<String>()));
    assert_eq!(names(&found), ["", "t", "i", "q"]);
}

#[test]
fn one_row_for_each_signal() {
    let of = |k: usize| rows().iter().map(|r| format!("{:.9}", r[k])).collect::<Vec<_>>().join(",");
    let text = format!("{}\n{}\n{}\n", of(0), of(1), of(2));
    let found = read(&text);
    assert_eq!(found.format, Format::TextByRow);
    holds(&found, [0, 1, 2], [1.0; 3]);
    let found = read(&format!("t [s],{}\ni [A],{}\nq,{}\n", of(0), of(1), of(2)));
    assert_eq!((names(&found)[1], found.channels[1].unit.as_deref()), ("i [A]", Some("A")));
    holds(&found, [0, 1, 2], [1.0; 3]);
}

#[test]
fn ends_of_tables() {
    let whole = "t,i,q\n".to_owned() + &plain(",");
    let found = read(&(whole.clone() + "EOF\n"));
    holds(&found, [0, 1, 2], [1.0; 3]);
    let cut = whole.trim_end().rsplit_once(',').unwrap().0;
    let found = read(cut);
    assert_eq!(found.channels[0].values.len(), rows().len() - 1);
    assert!(found.notes[0].contains("incomplete"));
    let error =
        read_bytes((whole + "a second table\nx,y\n1,2\n3,4\n5,6\n").into_bytes()).unwrap_err();
    assert!(error.to_string().starts_with("row 62: "), "{error}");
}

#[test]
fn exports_of_controllers() {
    let twincat = "Name\tscope1\nFile\tC:\\a.csv\n\nName\tiq\tName\tpos\nData-Type\tREAL64\tData-Type\tREAL64\n\
                   SampleTime[ms]\t2\tSampleTime[ms]\t2\nUnit\tA\tUnit\trad\n\n";
    let pairs = table("\t", |r| {
        let t = format!("{:.3}", 1e3 * r[0]);
        vec![t.clone(), format!("{:.9}", r[1]), t, format!("{:.9}", r[2])]
    });
    let found = read(&(twincat.to_owned() + &pairs + "EOF\n"));
    assert_eq!(found.format, Format::TwinCat);
    assert_eq!(names(&found), ["iq/time", "iq", "pos/time", "pos"]);
    assert_eq!(found.channels[3].clock, Clock::Channel(2));
    assert_eq!(found.channels[3].unit.as_deref(), Some("rad"));
    holds(&found, [0, 1, 3], [1e3, 1.0, 1.0]);
    let trace = |k: usize| {
        table("; ", |r| vec![String::new(), format!("{:.3}", 1e3 * r[0]), format!("{:.9}", r[k])])
    };
    let codesys = format!(
        "[key]; [value]\nVersion; 0x03050000\n0.Variable; Axis.iq\n0.Color; 1\n0.Data; \n{}1.Variable; Axis.pos\n1.Data; \n{}",
        trace(1),
        trace(2)
    );
    let found = read(&codesys);
    assert_eq!(found.format, Format::Codesys);
    assert_eq!(names(&found), ["Axis.iq/time", "Axis.iq", "Axis.pos/time", "Axis.pos"]);
    holds(&found, [0, 1, 3], [1e3, 1.0, 1.0]);
}

#[test]
fn json_in_three_shapes() {
    let list =
        |k: usize| rows().iter().map(|r| format!("{:.9}", r[k])).collect::<Vec<_>>().join(",");
    let arrays =
        format!("{{\"t\":[{}],\"i\":[{}],\"run\":{{\"q\":[{}]}}}}", list(0), list(1), list(2));
    let found = read(&arrays);
    assert_eq!(names(&found), ["t", "i", "run/q"]);
    holds(&found, [0, 1, 2], [1.0; 3]);
    let record = |r: &[f64; 3]| {
        format!("{{\"t\":{:.9},\"m\":{{\"i\":{:.9}}},\"q\":[{:.9},0]}}", r[0], r[1], r[2])
    };
    let records = rows().iter().map(record).collect::<Vec<_>>();
    let found = read(&format!("{{\"motor\":\"x\",\"entries\":[{}]}}", records.join(",")));
    assert_eq!(names(&found), ["entries/t", "entries/m/i", "entries/q[0]", "entries/q[1]"]);
    holds(&found, [0, 1, 2], [1.0; 3]);
    let lines = records.join("\n");
    holds(&read(&lines), [0, 1, 2], [1.0; 3]);
    let cut = read(&lines[..lines.len() - 5]);
    assert_eq!(cut.channels[0].values.len(), rows().len() - 1);
    assert!(read_bytes(b"{\"t\":[1,2,".to_vec()).unwrap_err().to_string().contains("line 1"));
}

#[test]
fn compressed_and_foreign_files() {
    use std::io::Write as _;
    let text = "t,i,q\n".to_owned() + &plain(",");
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gzip.write_all(text.as_bytes()).unwrap();
    let bytes = gzip.finish().unwrap();
    holds(&read_bytes(bytes.clone()).unwrap(), [0, 1, 2], [1.0; 3]);
    let cut = read_bytes(bytes[..bytes.len() / 2].to_vec()).unwrap_err();
    assert!(matches!(cut, FormatError::Damaged { .. }), "{cut}");
    let pdf = read_bytes(b"%PDF-1.7 ...".to_vec()).unwrap_err();
    assert_eq!(pdf.to_string(), "is a PDF document, not a table that can be read");
    for nothing in ["", "\n\n", "only words\nand more\n", "t,i,q\n"] {
        assert!(
            matches!(read_bytes(nothing.into()).unwrap_err(), FormatError::NoTable),
            "{nothing}"
        );
    }
}

#[test]
fn a_stated_header_row_has_the_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.csv");
    let read = |text: String, options: ReadOptions| {
        std::fs::write(&path, text).unwrap();
        read_with(&path, &options)
    };
    let text = "1,2,3\n4,5,6\nt,100,q\ns,A,rad\nREAL,REAL,REAL\n".to_owned() + &plain(",");
    let at = |row: usize| ReadOptions { header_row: Some(row), ..ReadOptions::default() };
    let found = read(text.clone(), at(3)).unwrap();
    assert_eq!(names(&found), ["t", "100", "q"]);
    assert_eq!(found.channels[1].unit.as_deref(), Some("A"));
    holds(&found, [0, 1, 2], [1.0; 3]);
    let skipped = ReadOptions { skip_rows: 5, ..ReadOptions::default() };
    holds(&read(text.clone(), skipped).unwrap(), [0, 1, 2], [1.0; 3]);
    let error = read(text.clone(), at(500)).unwrap_err();
    assert_eq!(error.to_string(), "row 500: no table of numbers is below this row");
    let error = read("a title\n\n".to_owned() + &text, at(1)).unwrap_err();
    assert_eq!(error.to_string(), "row 1: has 1 names; the table in row 8 has 3 columns");
    let thousands = ReadOptions { decimal_comma: Some(false), ..ReadOptions::default() };
    let found = read("t;q\n0;1,234\n1;2,345\n2;3\n".to_owned(), thousands).unwrap();
    assert_eq!(found.channels[1].values, [1234.0, 2345.0, 3.0]);
    assert!(!found.decimal_comma);
    let comma = ReadOptions { decimal_comma: Some(true), ..ReadOptions::default() };
    let found = read("t;q\n0;1\n1;2\n2;3\n".to_owned(), comma).unwrap();
    assert_eq!(found.channels[1].values, [1.0, 2.0, 3.0]);
}

#[test]
fn records_with_long_lists_are_groups() {
    let list = |from: u32| (from..from + 100).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
    let text = format!(
        "{{\"runs\":[{{\"name\":\"a\",\"t\":[{}],\"q\":[{}]}},{{\"t\":[{}],\"q\":[{}]}}]}}",
        list(0),
        list(5),
        list(0),
        list(9)
    );
    let data = lissom_formats::read_bytes(text.into_bytes()).unwrap();
    let groups = data.groups("runs[*]");
    assert_eq!(groups.len(), 2);
    assert_eq!(groups[1].0, "runs[1]");
    assert_eq!(groups[1].1.channels.len(), 2);
    let q = groups[1].1.channels.iter().find(|c| c.name == "q").unwrap();
    assert!((q.values[2] - 11.0).abs() < 1e-12);
}

#[test]
fn columns_of_time_stamps_belong_to_the_columns_behind_them() {
    let mut text = String::from("Time I [ms];I [A];Time q [ms];q [deg]\n");
    for k in 0..200 {
        let late = if k < 100 { format!("{};{}", 2 * k, k) } else { ";".to_owned() };
        let _ = writeln!(text, "{k};{};{late}", 0.5 * f64::from(k));
    }
    let found = read(&text);
    let clocks: Vec<Clock> = found.channels.iter().map(|c| c.clock).collect();
    let (none, after) = (Clock::Unstated, Clock::Channel);
    assert_eq!(clocks, [none, after(0), none, after(2)]);
    // Two clocks of the same rows side by side.
    let both = text.replace("Time I [ms];I [A]", "I [A];Time I [ms]");
    assert!(read(&both).channels.iter().all(|c| c.clock == none));
}

#[test]
fn repeated_headers_and_remarks_are_left_out() {
    let header = "t [s];i [A];q [rad]\n";
    let rows = |from: usize| -> String {
        let row = |k: usize| format!("0.{k:03};{k};{}\n", 2 * k);
        (from..from + 120).map(row).collect::<Vec<_>>().concat()
    };
    let text = format!("{header}{}{header}{}", rows(0), rows(0));
    let found = read(&text);
    assert_eq!(found.channels[1].values.len(), 240);
    assert!(found.channels.iter().all(|c| c.not_a_number.is_none()));
    let remark = rows(0).replace("0.110;110;220", "0.110;110;220;;bumped into the table");
    let found = read(&format!("{header}{remark}"));
    assert_eq!((found.channels.len(), found.channels[1].values.len()), (3, 120));
}
