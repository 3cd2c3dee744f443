//! Texts that instruments and tools write, each with the same log.

#![expect(clippy::unwrap_used, reason = "tests")]

use lissom_formats::{Channel, Clock, Format, LogData, read_bytes};

/// Number of rows.
const ROWS: u32 = 60;

/// Time in s, current in A, angle in rad, with three decimals.
fn rows() -> impl Iterator<Item = [f64; 3]> {
    (0..ROWS).map(f64::from).map(|k| {
        let angle = (0.06 * k).sin();
        [2e-3 * k, 0.125 * (k % 7.0) - 0.25, (1e3 * angle).round() / 1e3]
    })
}

/// A line for each row.
fn lines(line: impl Fn([f64; 3]) -> String) -> String {
    rows().map(|row| line(row) + "\n").collect()
}

fn read(text: &str) -> LogData {
    read_bytes(text.as_bytes().to_vec()).unwrap()
}

fn names(found: &LogData) -> Vec<&str> {
    found.channels.iter().map(|c| c.name.as_str()).collect()
}

fn units(found: &LogData) -> Vec<Option<&str>> {
    found.channels.iter().map(|c| c.unit.as_deref()).collect()
}

/// The channel has the values of a column of the rows, plus an offset.
#[track_caller]
fn has(channel: &Channel, column: usize, offset: f64) {
    assert_eq!(channel.values.len(), ROWS as usize, "{}", channel.name);
    for (value, row) in channel.values.iter().zip(rows()) {
        assert!((value - row[column] - offset).abs() < 1e-9, "{}: {value}", channel.name);
    }
}

#[test]
fn dates_are_counted_from_the_first_one_with_all_decimals() {
    let dates = [
        "11.06.2024 10:00:0",
        "06/11/2024 10:00:0",
        "2024-06-11T10:00:0",
        "2024/06/11 10:00:0",
        "10:00:0",
    ];
    for date in dates {
        let text = lines(|[t, i, q]| format!("{date}{t:.3};{i};{q}"));
        let found = read(&("time;i;q\n".to_owned() + &text));
        assert_eq!(units(&found), [Some("s"), None, None], "{date}");
        has(&found.channels[0], 0, 0.0);
    }
    for zone in ["Z", "+02:00", " AM"] {
        let text = lines(|[t, i, _]| format!("2024-06-11 10:00:0{t:.3}{zone},{i}"));
        has(&read(&("time,i\n".to_owned() + &text)).channels[0], 0, 0.0);
    }
    let python = lines(|[t, i, q]| {
        format!("{},{i},{q}", format!("2024-06-11 10:00:0{t:.3}").replace('.', ","))
    });
    let found = read(&("time,i,q\n".to_owned() + &python));
    assert_eq!(names(&found), ["time", "i", "q"]);
    (0..3).for_each(|k| has(&found.channels[k], k, 0.0));
    let whole_seconds = "time,speed,q\n10:00:00,950,1\n10:00:01,980,2\n10:00:02,990,3\n";
    assert_eq!(read(whole_seconds).channels[1].values, [950.0, 980.0, 990.0]);
    let comma = lines(|[t, i, _]| format!("10:00:0{t:.3};{i}").replace('.', ","));
    has(&read(&("time;i\n".to_owned() + &comma)).channels[0], 0, 0.0);
}

#[test]
fn seconds_and_nanoseconds_are_one_stamp() {
    let nanoseconds = |t: f64| (1e9 * t).round() + 999_900_000.0;
    let stamp = |t: f64| {
        let ns = nanoseconds(t);
        format!("{},{}", 1_700_000_000.0 + (ns / 1e9).floor(), ns % 1e9)
    };
    let names = ["header.stamp.sec,header.stamp.nanosec", "secs,nsecs", "stamp_sec,stamp_nanosec"];
    for header in names {
        let text = lines(|[t, i, q]| format!("{},base,{i},{q}", stamp(t)));
        let found = read(&format!("{header},frame,i,q\n{text}"));
        let time = found.channels.last().unwrap();
        assert_eq!((time.name.as_str(), time.unit.as_deref()), ("time", Some("s")));
        has(time, 0, 0.0);
        assert!((found.channels[0].values[0] - 1.7e9).abs() < 0.5, "{header}");
    }
    let echo = read(&lines(|[t, i, q]| format!("{},base,{i},{q}", stamp(t))));
    assert_eq!(echo.channels.len(), 6);
    has(&echo.channels[5], 0, 0.0);
    let other = read(&lines(|[t, i, q]| format!("{t},{i},{q}")));
    assert_eq!(other.channels.len(), 3);
}

#[test]
fn commas_in_quotes_are_decimal_or_between_thousands() {
    let quoted = |v: f64| format!("\"{v:.3}\"").replace('.', ",");
    let text = lines(|[t, i, q]| [t, i, q].map(quoted).join(","));
    let found = read(&("\"t\",\"i\",\"q\"\n".to_owned() + &text));
    assert!(found.decimal_comma);
    (0..3).for_each(|k| has(&found.channels[k], k, 0.0));
    let text = lines(|[t, i, q]| format!("{t:.3},\"1,23{:.3}\",{q}", 4.0 + i));
    let found = read(&("t,i,q\n".to_owned() + &text));
    assert!(!found.decimal_comma);
    has(&found.channels[1], 1, 1234.0);
    assert!(found.notes.is_empty(), "{:?}", found.notes);
    let text = |separator: &str| {
        let row = |k| format!("{k}{separator}\"1,{}\"\n", 100 + k);
        format!("t{separator}q\n{}", (0..20).map(row).collect::<String>())
    };
    for (separator, value) in [(",", 1100.0), (";", 1.1)] {
        let found = read(&text(separator));
        assert!((found.channels[1].values[0] - value).abs() < 1e-9);
        assert!(found.notes[0].starts_with("commas are ambiguous"), "{:?}", found.notes);
    }
}

#[test]
fn twincat_scope_with_any_separator() {
    for (separator, decimal) in [("\t", "."), ("\t", ","), (",", "."), (";", "."), (";", ",")] {
        let pairs = |cells: &[&str]| cells.join(separator) + "\n";
        let head = pairs(&["Name", "scope"])
            + "\n"
            + &pairs(&["Name", "iq", "Name", "pos"])
            + &pairs(&["SampleTime[ms]", "2", "SampleTime[ms]", "2"])
            + &pairs(&["Unit", "A", "Unit", "rad"])
            + "\n";
        let row = |[t, i, q]: [f64; 3]| {
            [1e3 * t, i, 1e3 * t, q]
                .map(|v| format!("{v:.6}").replace('.', decimal))
                .join(separator)
        };
        let found = read(&(head + &lines(row)));
        assert_eq!(found.format, Format::TwinCat, "{separator:?} {decimal}");
        assert_eq!(names(&found), ["iq/time", "iq", "pos/time", "pos"]);
        assert_eq!(units(&found), [Some("ms"), Some("A"), Some("ms"), Some("rad")]);
        has(&found.channels[3], 2, 0.0);
    }
}

#[test]
fn oscilloscopes_state_units_and_samples_in_the_lines_above() {
    let text = lines(|[t, i, q]| format!("{t:.3},{i},{q}"));
    let tektronix = "Model,MSO44\nHorizontal Units,s,,\nSample Interval,0.002,,\nVertical Units,V,A,\n\
                     Labels,,,\nTIME,CH1,CH2\n";
    let siglent = "Record Length,Analog:60,,\nSample Interval,0.002,,\nVertical Units,CH1:V,CH2:A,\n\
                   Source,CH1,CH2,\nSecond,Volt,Ampere,\n";
    let yokogawa = "\"HResolution\",2.0e-3\n\"HUnit\",\"s\"\n\"VUnit\",\"V\",\"A\"\n\"Trace\",\"CH1\",\"CH2\"\n";
    let found = read(&(yokogawa.to_owned() + &lines(|[_, i, q]| format!(",{i},{q}"))));
    assert_eq!(units(&found)[1..], [Some("V"), Some("A")]);
    assert_eq!(found.channels[2].clock, Clock::Even { start_s: 0.0, step_s: 2e-3 });
    let pico = "Time,Channel A,Channel B\n(s),(V),(A)\n\n";
    let cases = [
        (tektronix, ["TIME", "CH1", "CH2"], ["s", "V", "A"]),
        ("x-axis,1,2\nsecond,Volt,Ampere\n", ["x-axis", "1", "2"], ["second", "Volt", "Ampere"]),
        (siglent, ["Source", "CH1", "CH2"], ["Second", "Volt", "Ampere"]),
        (pico, ["Time", "Channel A", "Channel B"], ["s", "V", "A"]),
    ];
    for (head, wanted, stated) in cases {
        let found = read(&(head.to_owned() + &text));
        assert_eq!(names(&found), wanted);
        assert_eq!(units(&found), stated.map(Some));
        assert_eq!(found.channels[0].clock, Clock::Unstated);
        (0..3).for_each(|k| has(&found.channels[k], k, 0.0));
    }
}

#[test]
fn samples_without_times_have_the_stated_clock() {
    let index = lines(|[t, i, q]| format!("{:.0},{i},{q},", 500.0 * t));
    let rigol = "X,CH1,CH2,Start,Increment\nSequence,Volt,Volt,-6.0e-02,2.0e-03\n";
    let found = read(&(rigol.to_owned() + &index));
    assert_eq!(names(&found), ["X", "CH1", "CH2"]);
    assert_eq!(units(&found), [None, Some("Volt"), Some("Volt")]);
    assert_eq!(found.channels[1].clock, Clock::Even { start_s: -0.06, step_s: 2e-3 });
    let head = "CH1(V),CH2(V),t0 =-6.0e-02s, tInc = 2.0e-03s,\n";
    let found = read(&(head.to_owned() + &lines(|[_, i, q]| format!("{i},{q},,"))));
    assert_eq!(found.channels[1].clock, Clock::Even { start_s: -0.06, step_s: 2e-3 });
    has(found.with_time_stamps().channels.last().unwrap(), 0, -0.06);
}

#[test]
fn settings_beside_the_first_samples_cost_no_sample() {
    let settings = ["Record Length,60,", "Sample Interval,0.002,", "Source,CH1,", "Units,V,"];
    let row = |(k, [t, i, _]): (usize, [f64; 3])| {
        format!("{},{t:.3},{i},\n", settings.get(k).unwrap_or(&",,"))
    };
    let found = read(&rows().enumerate().map(row).collect::<String>());
    has(&found.channels[3], 0, 0.0);
    has(&found.channels[4], 1, 0.0);
}

/// A LabVIEW measurement file; `X` has the times in no column, in one, or in one for each channel.
fn labview(separator: &str, decimal: &str, x: &str) -> String {
    let line = |cells: &[&str]| cells.join(separator) + "\n";
    let mut text = line(&["LabVIEW Measurement", ""])
        + &line(&["Separator", separator])
        + &line(&["Decimal_Separator", decimal])
        + &line(&["X_Columns", x])
        + &line(&["***End_of_Header***", ""])
        + "\n";
    let half: Vec<[f64; 3]> = rows().take(ROWS as usize / 2).collect();
    let all: Vec<[f64; 3]> = rows().collect();
    for (begin, part) in all.chunks(half.len()).enumerate() {
        let pair = |key: &str, a: &str, b: &str| match x {
            "Multi" => line(&[key, a, "", b, ""]),
            _ => line(&[key, a, b, ""]),
        };
        let time = format!("10:00:00{decimal}{}", 6 * begin);
        let time = if begin == 0 { time } else { format!("10:00:00{decimal}06") };
        text += &pair("Channels", "2", "");
        text += &pair("Samples", "30", "30");
        text += &pair("Date", "2024/06/11", "2024/06/11");
        text += &pair("Time", &time, &time);
        text += &pair("Y_Unit_Label", "A", "rad");
        text += &pair("X_Dimension", "Time", "Time");
        text += &pair("X0", "0", "0");
        text += &pair("Delta_X", &format!("0{decimal}002"), &format!("0{decimal}002"));
        text += &line(&["***End_of_Header***", "", "", ""]);
        text += &match x {
            "Multi" => line(&["X_Value", "i", "X_Value", "q", "Comment"]),
            _ => line(&["X_Value", "i", "q", "Comment"]),
        };
        for (k, [_, i, q]) in part.iter().enumerate() {
            let [t, i, q] =
                [2e-3 * k as f64, *i, *q].map(|v| format!("{v:.6}").replace('.', decimal));
            text += &match x {
                "Multi" => line(&[&t, &i, &t, &q]),
                "One" => line(&[&t, &i, &q]),
                _ => line(&["", &i, &q]),
            };
        }
        text += "\n";
    }
    text
}

#[test]
fn segments_of_labview_files_are_one_log() {
    for (separator, decimal) in [("\t", "."), ("\t", ","), (",", "."), (";", ",")] {
        let found = read(&labview(separator, decimal, "One"));
        assert_eq!(found.format, Format::LabView);
        assert_eq!(names(&found), ["X_Value", "i", "q"]);
        assert_eq!(units(&found), [Some("s"), Some("A"), Some("rad")]);
        (0..3).for_each(|k| has(&found.channels[k], k, 0.0));
    }
    let found = read(&labview("\t", ".", "No"));
    assert_eq!(names(&found), ["i", "q", "time"]);
    has(&found.channels[2], 0, 0.0);
    let found = read(&labview("\t", ".", "Multi"));
    assert_eq!(names(&found), ["X_Value", "i", "X_Value", "q"]);
    assert_eq!(units(&found), [Some("s"), Some("A"), Some("s"), Some("rad")]);
    assert_eq!(found.channels[3].clock, Clock::Channel(2));
    has(&found.channels[2], 0, 0.0);
}

#[test]
fn a_long_table_has_a_channel_for_each_name() {
    let text = lines(|[t, i, q]| {
        let later = t + 0.001;
        format!("{t:.3},\"NT:/i\",{i}\n{later:.3},\"NT:/q [deg]\",{q}\n{later:.3},NT:/mode,auto")
    });
    let found = read(&("Timestamp,Key,Value\n".to_owned() + &text));
    assert_eq!(found.format, Format::TextByValue);
    assert_eq!(names(&found), ["NT:/i/time", "NT:/i", "NT:/q [deg]/time", "NT:/q [deg]"]);
    assert_eq!(units(&found), [Some("s"), None, Some("s"), Some("deg")]);
    assert_eq!(found.channels[3].clock, Clock::Channel(2));
    has(&found.channels[2], 0, 0.001);
    has(&found.channels[3], 2, 0.0);
    assert!(found.notes[0].starts_with("left out: NT:/mode"), "{:?}", found.notes);
    let text = lines(|[t, i, q]| {
        format!("{i};2024-06-11 10:00:0{t:.3};i\n{q};2024-06-11 10:00:0{t:.3};q")
    });
    let found = read(&("value;time;signal\n".to_owned() + &text.replace('.', ",")));
    assert!(found.decimal_comma);
    has(&found.channels[2], 0, 0.0);
    has(&found.channels[3], 2, 0.0);
    let states = lines(|[t, i, _]| format!("{t:.3},run,{i}"));
    assert_eq!(read(&("time,state,value\n".to_owned() + &states)).format, Format::Text);
}

#[test]
fn gaps_and_lengths_in_json_are_noted() {
    let found = read("{\"t\":[0,1,2],\"i [A]\":[0.5,null,1],\"q\":[1,2]}");
    assert_eq!(units(&found), [None, Some("A"), None]);
    assert_eq!(
        found.notes,
        [
            "values are missing, null or text in i [A]",
            "the arrays differ in length: 2 in q; 3 in t, i [A]"
        ]
    );
}

#[test]
fn complex_numbers_of_frequency_responses_are_two_channels() {
    let f = |t: f64| 500.0 * t + 1.0;
    let texts = [
        "# made by x\nf [Hz],H [rad/A],coherence\n".to_owned()
            + &lines(|[t, i, q]| format!("{},{i}{q:+}j,0.9", f(t))),
        "f [Hz],H [rad/A],coherence\n".to_owned()
            + &lines(|[t, i, q]| format!("{}, ({i:e}{q:+e}j),0.9", f(t))),
        "f [Hz];H [rad/A];coherence\n".to_owned()
            + &lines(|[t, i, q]| format!("{};{i} + {q}i;0.9", f(t)).replace("+ -", "- ")),
        "f [Hz];H [rad/A];coherence\n".to_owned()
            + &lines(|[t, i, q]| format!("{};{i:.3}{q:+.3}i;0.9", f(t)).replace('.', ",")),
        "f (Hz) H (rad/A) coherence\n".replace(" (", "(")
            + &lines(|[t, i, q]| format!("{} ({i:e}{q:+e}j) 0.9", f(t))),
    ];
    for text in texts {
        let found = read(&text);
        assert!(names(&found)[1].ends_with("/real") && names(&found)[2].ends_with("/imag"));
        assert_eq!(units(&found), [Some("Hz"), Some("rad/A"), Some("rad/A"), None]);
        has(&found.channels[1], 1, 0.0);
        has(&found.channels[2], 2, 0.0);
        assert!(found.channels.iter().all(|c| c.not_a_number.is_none()));
    }
}
