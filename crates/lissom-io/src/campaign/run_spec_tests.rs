//! What a run may say: name, frequency, and what of its log is left out.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::TAU;

use lissom_core::record::note;

use super::campaign_tests::{PLAIN, log, read_logs};

#[test]
fn runs_may_have_name_frequency_and_skip() {
    let text = format!(
        "{PLAIN}name = \"one\"\nfrequency = \"5 Hz\"\n[[runs]]\nfile = \"b.csv\"\nomega_rad_s = 3\nskip = \"20 ms\"\n\
         [analysis]\nskip = \"0.01 s\"\nwindow = [\"0.3 s\", 0.5]\nharmonics = 9\n"
    );
    let slow = log((0..100).map(|k| 2 * k));
    let file = read_logs(&text, &[("a.csv", &log(0..100)), ("b.csv", &slow)]).unwrap();
    let [first, second] = &file.campaign.runs[..] else { panic!("two runs") };
    assert_eq!((first.name(), first.len()), ("one", 90));
    assert!((first.omega_rad_s().unwrap() - 5.0 * TAU).abs() < 1e-12);
    assert_eq!(first.notes(), [note::HeadSkipped { seconds: 0.01 }.into()]);
    assert_eq!(first.time().start_s, 0.01);
    assert_eq!((second.name(), second.len(), second.sample_time_s()), ("b.csv", 90, 0.002));
    assert_eq!(second.omega_rad_s(), Some(3.0));
    assert_eq!((file.analysis.window_s, file.analysis.harmonics), (vec![0.3, 0.5], Some(9)));
}

#[test]
fn stretches_of_a_run_may_be_left_out() {
    let more = "until = \"0.35 s\"\nleave_out = [[\"100 ms\", 0.2]]\n";
    let logs = [("a.csv", log(0..400))];
    let logs = logs.each_ref().map(|(name, log)| (*name, log.as_str()));
    let runs = read_logs(&format!("{PLAIN}{more}"), &logs).unwrap().campaign.runs;
    let found: Vec<(&str, usize)> = runs.iter().map(|run| (run.name(), run.len())).collect();
    assert_eq!(found, [("a.csv [1/2]", 100), ("a.csv [2/2]", 150)]);
    assert_eq!(runs[0].notes(), [note::LeftOut { stretches: 2 }.into()]);
    for wrong in ["leave_out = [\"1 s\"]", "leave_out = [[1, 2, 3]]", "leave_out = [[2, 1]]"] {
        let error = read_logs(&format!("{PLAIN}{wrong}\n"), &logs).unwrap_err().to_string();
        assert!(error.contains("a list of stretches"), "{error}");
    }
}
