//! Files with several runs, and signals in logs of their own.

use std::fmt::Write as _;

use lissom_core::finding::Finding;
use lissom_core::record::{Run, note};

use super::campaign_tests::{folder, read_logs};
use super::{CampaignReader, read_campaign};

const HEAD: &str = "[signals]\ntime = { column = \"t\", unit = \"s\" }\ncurrent = { column = \"i\", unit = \"A\", hold = \"sampled\" }\n";
const MOTOR: &str = "motor = { column = \"q\", unit = \"rad\" }\n";

/// A motion that does not repeat.
fn angle(t: f64) -> f64 {
    0.5 * (2.0 * t).sin() + 0.3 * (5.3 * t + 1.0).sin() + 0.1 * (9.1 * t).sin()
}

fn table(names: &str, rows: impl Iterator<Item = [f64; 3]>) -> String {
    let mut text = format!("{names}\n");
    for [a, b, c] in rows {
        let _ = writeln!(text, "{a:.6},{b:.9},{c:.9}");
    }
    text
}

#[test]
fn a_column_numbers_the_runs() {
    let mut text = String::from("n,t,i,q\n");
    for row in 0..300 {
        // Rows of two runs alternate.
        let (run, k) = (row % 2, row / 2);
        let _ = writeln!(text, "{},{:.3},{},{}", 7 + run, 0.002 * f64::from(k), k, run * 1000 + k);
    }
    let campaign = format!("{HEAD}{MOTOR}run = \"n\"\n[[runs]]\nfile = \"a.csv\"\n");
    let file = read_logs(&campaign, &[("a.csv", &text)]).unwrap();
    let [first, second] = &file.campaign.runs[..] else { panic!("two runs") };
    assert_eq!((first.name(), first.len()), ("a.csv n 7", 150));
    assert_eq!((second.name(), second.len()), ("a.csv n 8", 150));
    assert!((second.motor()[3] - 1003.0).abs() < 1e-9);
    let error = read_logs(&campaign.replace("\"n\"", "\"m\""), &[("a.csv", &text)]).unwrap_err();
    assert!(error.to_string().contains("no column \"m\""), "{error}");
}

#[test]
fn a_column_of_words_names_the_runs_or_the_joints() {
    let mut text = String::from("joint,t,i,q\n");
    for row in 0..300 {
        let (joint, k) = (["elbow", "wrist"][row % 2], row / 2);
        let _ = writeln!(text, "{joint},{:.3},{k},{}", 0.002 * k as f64, row);
    }
    let campaign = format!("{HEAD}{MOTOR}[[runs]]\nfile = \"a.csv::joint=wrist\"\n");
    let file = read_logs(&campaign, &[("a.csv", &text)]).unwrap();
    let [wrist] = &file.campaign.runs[..] else { panic!("one run") };
    assert_eq!((wrist.name(), wrist.len()), ("a.csv::joint=wrist", 150));
    assert!((wrist.motor()[3] - 7.0).abs() < 1e-9);
    let error = read_logs(&campaign.replace("wrist", "ankle"), &[("a.csv", &text)]).unwrap_err();
    let error = error.to_string();
    assert!(error.ends_with("the groups are \"joint=elbow\", \"joint=wrist\""), "{error}");
    let both = format!("{HEAD}{MOTOR}run = \"joint\"\n[[runs]]\nfile = \"a.csv\"\n");
    let file = read_logs(&both, &[("a.csv", &text)]).unwrap();
    let names: Vec<&str> = file.campaign.runs.iter().map(Run::name).collect();
    assert_eq!(names, ["a.csv joint elbow", "a.csv joint wrist"]);
}

#[test]
fn a_group_that_does_not_exist_is_named_with_those_that_do() {
    let campaign = format!("{HEAD}{MOTOR}[[runs]]\nfile = \"a.csv::run1\"\n");
    let text = table("t,i,q", (0..100).map(|k| [0.01 * f64::from(k), 1.0, 2.0]));
    let error = read_logs(&campaign, &[("a.csv", &text)]).unwrap_err().to_string();
    assert!(error.ends_with("no group of channels is \"run1\"; the file has no groups"), "{error}");
}

#[test]
fn a_tip_may_have_a_log_and_a_clock_of_its_own() {
    let time = |k: i32| 0.002 * f64::from(k);
    let motor = table("t,i,q", (0..10_000).map(time).map(|t| [t, 0.1, angle(t)]));
    // The camera starts 1.5 s later, and its stamps 4 s earlier.
    let frame = |k: i32| 1.5 + f64::from(k) / 60.0;
    let camera = table("t,x,y", (0..960).map(frame).map(|t| [t - 4.0, 1.1 * angle(t), 0.0]));
    let tip = "tips = [{ name = \"end\", column = \"x\", unit = \"rad\", file = \"{run}-camera.csv\" }]\n";
    let campaign = format!("{HEAD}{MOTOR}{tip}[[runs]]\nfile = \"a.csv\"\n");
    let logs: [(&str, &str); 2] = [("a.csv", &motor), ("a-camera.csv", &camera)];
    let folder = folder(&campaign, &logs);
    let path = folder.path().join("campaign.toml");
    let run = &read_campaign(&path).unwrap().campaign.runs[0];
    let [note] = run.notes() else { panic!("{:?}", run.notes()) };
    let note::OtherClock { channel, clock } = note.get().unwrap();
    assert_eq!(channel, "end");
    assert!((clock.offset_s + 4.0).abs() < 1e-3, "{clock:?}");
    assert!((run.time().start_s - 1.5).abs() < 0.03, "{}", run.time().start_s);
    for (k, tip) in run.tips()[0].iter().enumerate().skip(20).take(7000) {
        let t = run.time().start_s + 0.002 * k as f64;
        assert!((tip - 1.1 * angle(t)).abs() < 2e-3, "{k}");
    }
    // With the same clock the stamps are taken as they are, and a wrong one is not noticed here.
    let shared = campaign.replace("camera.csv\"", "camera.csv\", clock = \"shared\"");
    std::fs::write(&path, shared).unwrap();
    assert_eq!(read_campaign(&path).unwrap().campaign.runs[0].notes(), []);
    // A camera of another motion.
    let other = table("t,x,y", (0..960).map(frame).map(|t| [t, (3.3 * t).sin(), 0.0]));
    std::fs::write(folder.path().join("a-camera.csv"), other).unwrap();
    std::fs::write(&path, &campaign).unwrap();
    let error = read_campaign(&path).unwrap_err();
    assert!(error.to_string().contains("a-camera.csv: end does not show the motion of"), "{error}");
    assert!(error.hint().unwrap().contains("clock = \"shared\""));
}

#[test]
fn the_files_of_runs_are_listed_and_read_in_another_folder() {
    let text = format!(
        "{HEAD}{}tips = [{{ column = \"p\", unit = \"rad\", file = \"tip.csv\" }}]
[[runs]]\nfile = \"slow.h5::run*\"\n[[runs]]\nfile = \"b/chirp.csv\"\nmotor_file = \"own.csv\"\ntip_files = \"c.csv\"\n",
        MOTOR.replace(" }", ", file = \"{run}-motor.csv\" }")
    );
    let files = |text: &str| CampaignReader::of_text("campaign", text.to_owned()).run_files();
    let named: Vec<_> =
        files(&text).unwrap().iter().map(|file| file.display().to_string()).collect();
    let expected = ["slow.h5", "slow-motor.csv", "tip.csv", "b/chirp.csv", "own.csv", "c.csv"];
    assert_eq!(named, expected);
    // A file that two runs share is listed once.
    let shared =
        format!("{HEAD}{MOTOR}[[runs]]\nfile = \"a.h5::1\"\n[[runs]]\nfile = \"a.h5::2\"\n");
    assert_eq!(files(&shared).unwrap().len(), 1);
    assert!(files(&format!("{HEAD}{MOTOR}")).unwrap_err().to_string().contains("has no `runs`"));

    let rows = || (0..200).map(|k| 0.01 * f64::from(k)).map(|t| [t, t, angle(t)]);
    let place = folder("", &[("a.csv", &table("t,i,q", rows()))]);
    let text = format!("{HEAD}{MOTOR}[[runs]]\nfile = \"a.csv\"\nskip = \"1 s\"\n");
    let read = CampaignReader::of_text("elsewhere/campaign", text).in_folder(place.path()).read();
    assert_eq!(read.unwrap().campaign.runs[0].len(), 100);
}

#[test]
fn keys_of_another_log_need_its_file() {
    let campaign = format!(
        "{HEAD}motor = {{ column = \"q\", unit = \"rad\", clock = \"shared\" }}\n[[runs]]\nfile = \"a.csv\"\n"
    );
    let error = read_logs(&campaign, &[]).unwrap_err();
    assert!(error.to_string().contains("`signals.motor.clock`"), "{error}");
}

#[test]
fn the_header_of_a_text_can_be_stated() {
    let table = table("t,i,q", (0..100).map(|k| [0.01 * f64::from(k), 1.0, f64::from(k)]));
    let text = format!("1,2,3\n4,5,6\n{table}");
    let stated = |key: &str| {
        let campaign = format!("{HEAD}{MOTOR}{key}\n[[runs]]\nfile = \"a.csv\"\n");
        read_logs(&campaign, &[("a.csv", &text)])
    };
    for key in ["header_row = 3", "skip_rows = 2"] {
        let file = stated(key).unwrap();
        assert_eq!(file.campaign.runs[0].len(), 100, "{key}");
    }
    let error = stated("header_row = 300").unwrap_err().to_string();
    assert!(error.contains("a.csv"), "{error}");
    assert!(stated("header_row = 0").is_err());
}

#[test]
fn rows_between_runs_are_counted() {
    let mut text = String::from("n,t,i,q\n");
    for row in 0..400 {
        let name = ["first", "", "02", ""][row / 100];
        let _ = writeln!(text, "{name},{:.3},{row},{row}", 0.002 * (row % 100) as f64);
    }
    let all = format!("{HEAD}{MOTOR}run = \"n\"\n[[runs]]\nfile = \"a.csv\"\n");
    let file = read_logs(&all, &[("a.csv", &text)]).unwrap();
    let notes: Vec<&[Finding]> = file.campaign.runs.iter().map(Run::notes).collect();
    assert_eq!(notes, [&[note::RowsWithoutRun { count: 200, share: 0.5 }.into()][..], &[]]);
    // A number may be written in another way.
    let one = format!("{HEAD}{MOTOR}[[runs]]\nfile = \"a.csv::n=2.0\"\n");
    let file = read_logs(&one, &[("a.csv", &text)]).unwrap();
    let [run] = &file.campaign.runs[..] else { panic!("one run") };
    assert_eq!((run.len(), run.motor()[0]), (100, 200.0));
}
