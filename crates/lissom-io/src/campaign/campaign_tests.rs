#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use lissom_core::record::{Axis, CommandQuantity, Hold, TipQuantity, note};
use proptest::prelude::*;
use tempfile::TempDir;

use super::{CampaignFile, CampaignReader, ReadOptions, read_campaign};
use crate::io_error::Error;

/// A campaign of one log `a.csv` with columns t, u, x, y.
pub(super) const PLAIN: &str = r#"
[signals]
time = { column = "t", unit = "s" }
current = { column = "u", unit = "A", hold = "sampled" }
motor = { column = "x", unit = "rad" }
[drive]
torque_constant = "0.25 N*m/A"
[[runs]]
file = "a.csv"
"#;

pub(super) fn signal(k: usize) -> f64 {
    (k as f64 * 0.1).sin()
}

/// Rows t, u, x, y at 1 ms: time, row number modulo 4, a sine and its cosine.
pub(super) fn log(rows: impl IntoIterator<Item = usize>) -> String {
    let mut text = String::from("t,u,x,y\n");
    for k in rows {
        let (time, angle) = (k as f64 / 1000.0, k as f64 * 0.1);
        writeln!(text, "{time:.3},{},{},{}", k % 4, angle.sin(), angle.cos()).unwrap();
    }
    text
}

pub(super) fn folder(campaign: &str, logs: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("campaign.toml"), campaign).unwrap();
    for (name, text) in logs {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

pub(super) fn read_logs(campaign: &str, logs: &[(&str, &str)]) -> Result<CampaignFile, Error> {
    read_campaign(&folder(campaign, logs).path().join("campaign.toml"))
}

pub(super) fn read(campaign: &str) -> Result<CampaignFile, Error> {
    read_logs(campaign, &[("a.csv", &log(0..100))])
}

#[test]
fn a_hold_that_nobody_knows_is_assumed() {
    assert!(!read(PLAIN).unwrap().campaign.hold_assumed);
    let unknown = PLAIN.replace("\"sampled\"", "\"unknown\"");
    assert_ne!(unknown, PLAIN);
    let campaign = read(&unknown).unwrap().campaign;
    assert_eq!((campaign.channels.command.hold, campaign.hold_assumed), (Hold::Measured, true));
}

#[test]
fn reads_a_plain_campaign() {
    let file = read(PLAIN).unwrap();
    let channels = &file.campaign.channels;
    assert_eq!((channels.axis, channels.tips.len()), (Axis::Rotary, 0));
    assert_eq!(channels.command.quantity, CommandQuantity::Current);
    assert_eq!(channels.command.hold, Hold::Sampled);
    assert_eq!(channels.command.torque_per_command, Some(0.25));
    assert_eq!(channels.command.limit, None);
    let run = &file.campaign.runs[0];
    assert_eq!((run.name(), run.len(), run.sample_time_s()), ("a.csv", 100, 0.001));
    assert_eq!(run.motor()[7], signal(7));
    assert_eq!(run.command()[7], 3.0);
    assert_eq!((run.omega_rad_s(), run.notes()), (None, &[][..]));
    assert_eq!((file.known.torque_constant, file.known.arm), (Some(0.25), None));
    assert_eq!(file.analysis, super::AnalysisOptions::default());
}

#[test]
fn scale_offset_and_unit_apply_in_that_order() {
    let text = PLAIN
        .replace("unit = \"rad\"", "unit = \"deg\", scale = 2, offset = 10")
        .replace("unit = \"A\"", "unit = \"mA\", scale = -1")
        .replace("column = \"x\"", "column = 3");
    let run = &read(&text).unwrap().campaign.runs[0];
    assert!((run.motor()[5] - (2.0 * signal(5) + 10.0) * PI / 180.0).abs() < 1e-15);
    assert_eq!(run.command()[3], -3e-3);
}

#[test]
fn gaps_make_runs_of_their_own() {
    let rows = (0..80).chain(100..110).chain(200..300);
    let file = read_logs(PLAIN, &[("a.csv", &log(rows))]).unwrap();
    let [first, second] = &file.campaign.runs[..] else { panic!("two runs") };
    assert_eq!((first.name(), first.len(), first.notes().len()), ("a.csv [1/2]", 80, 2));
    assert_eq!((second.name(), second.len(), second.notes().len()), ("a.csv [2/2]", 100, 0));
    assert_eq!(second.motor()[0], signal(200));
    assert_eq!(second.time().start_s, 0.2);
}

#[test]
fn long_logs_are_thinned_and_it_is_said() {
    let folder = folder(PLAIN, &[("a.csv", &log(0..1000))]);
    let options = ReadOptions { max_rows: 300, ..ReadOptions::default() };
    let file = CampaignReader::of_file(&folder.path().join("campaign.toml"))
        .options(options)
        .read()
        .unwrap();
    let run = &file.campaign.runs[0];
    assert_eq!((run.len(), run.sample_time_s()), (250, 0.004));
    assert_eq!(run.notes(), [note::Thinned { factor: 4 }.into()]);
    assert_eq!(run.command()[9], 1.5);
    assert_eq!(run.motor()[9], signal(36));
}

#[test]
fn a_sample_time_stands_in_for_stamps() {
    let text = PLAIN.replace("time = { column = \"t\", unit = \"s\" }", "sample_time = \"2 ms\"");
    let run = &read(&format!("{text}skip = \"10 ms\"\n")).unwrap().campaign.runs[0];
    assert_eq!((run.len(), run.sample_time_s(), run.time().start_s), (95, 0.002, 0.01));
    assert_eq!(run.motor()[0], signal(5));
}

#[test]
fn tips_of_every_kind() {
    let tips = r#"[
        { column = "x", unit = "deg" },
        { name = "strain", column = "x", unit = "mm", radius = "0.5 m", quantity = "deflection" },
        { column = "x", unit = "gn", radius = 2, quantity = "acceleration" },
        { column = "x", unit = "1", quantity = "acceleration" },
        { name = "camera", x = "y", y = "x", origin = [0, 0], scale = -1 },
    ]"#;
    let file = read(&PLAIN.replace("[drive]", &format!("tips = {tips}\n[drive]"))).unwrap();
    let found: Vec<(&str, TipQuantity, bool)> = file
        .campaign
        .channels
        .tips
        .iter()
        .map(|tip| (tip.name.as_str(), tip.quantity, tip.calibrated))
        .collect();
    assert_eq!(
        found,
        [
            ("tip 1", TipQuantity::Angle, true),
            ("strain", TipQuantity::Deflection, true),
            ("tip 3", TipQuantity::Acceleration, true),
            ("tip 4", TipQuantity::Acceleration, false),
            ("camera", TipQuantity::Angle, true),
        ]
    );
    let tips = file.campaign.runs[0].tips();
    for (tip, factor) in tips.iter().zip([PI / 180.0, 0.002, 9.806_65 / 2.0, 1.0]) {
        assert!((tip[9] - signal(9) * factor).abs() < 1e-15);
    }
    assert!((tips[4][99] + 9.9).abs() < 1e-12, "{}", tips[4][99]);
}

fn voltage(drive: &str) -> String {
    PLAIN
        .replace(
            "current = { column = \"u\", unit = \"A\"",
            "voltage = { column = \"u\", unit = \"V\"",
        )
        .replace("torque_constant = \"0.25 N*m/A\"", drive)
}

#[test]
fn a_voltage_takes_a_constant_per_volt_or_a_winding() {
    let command = |drive: &str| read(&voltage(drive)).unwrap().campaign.channels.command;
    let direct = command("torque_constant = \"0.5 N*m/V\"\nvoltage_limit = 24");
    assert_eq!((direct.torque_per_command, direct.back_emf_viscous), (Some(0.5), 0.0));
    assert_eq!(direct.limit, Some(24.0));
    let winding = command(
        "torque_constant = \"0.5 N*m/A\"\nresistance = \"2 ohm\"\nback_emf = \"0.4 V*s/rad\"",
    );
    assert_eq!((winding.torque_per_command, winding.back_emf_viscous), (Some(0.25), 0.1));
    assert_eq!(command("").torque_per_command, None);
}

#[test]
fn a_command_of_unknown_unit() {
    let text = PLAIN
        .replace(
            "current = { column = \"u\", unit = \"A\"",
            "command = { column = \"u\", unit = \"1\"",
        )
        .replace("torque_constant = \"0.25 N*m/A\"", "limit = 200");
    let command = read(&text).unwrap().campaign.channels.command;
    assert_eq!(command.quantity, CommandQuantity::Arbitrary);
    assert_eq!((command.torque_per_command, command.limit), (None, Some(200.0)));
    let alias = text.replace("command =", "voltage =");
    assert_eq!(read(&alias).unwrap().campaign.channels.command, command);
}

#[test]
fn a_linear_axis() {
    let text = voltage("torque_constant = \"35.15 N/V\"")
        .replace("unit = \"rad\"", "unit = \"mm\"")
        .replace(
            "[drive]",
            "tips = [{ column = \"x\", unit = \"m/s^2\", quantity = \"acceleration\" }]\n[drive]",
        );
    let channels = read(&text).unwrap().campaign.channels;
    assert_eq!(channels.axis, Axis::Linear);
    assert!((channels.command.torque_per_command.unwrap() - 35.15).abs() < 1e-12);
}

#[test]
fn an_arm_to_compare_with() {
    let text = PLAIN.replace("[drive]", "[drive]\narm = \"arm.toml\"");
    let arm = "[rig]\nsample_time = \"3 ms\"\n";
    let file = read_logs(&text, &[("a.csv", &log(0..100)), ("arm.toml", arm)]).unwrap();
    assert_eq!(file.known.arm.unwrap().rig.unwrap().instruments.sample_time_s, 0.003);
    assert!(file.known.arm_path.unwrap().ends_with("arm.toml"));
}

#[track_caller]
fn fails_on(campaign: &str, logs: &[(&str, &str)], message: &str, hint: Option<&str>) {
    let folder = folder(campaign, logs);
    let error = read_campaign(&folder.path().join("campaign.toml")).unwrap_err();
    let prefix = format!("{}/", folder.path().display());
    assert_eq!(error.to_string().replace(&prefix, ""), message);
    assert_eq!(error.hint().as_deref(), hint);
}

#[track_caller]
pub(super) fn fails(campaign: &str, message: &str, hint: Option<&str>) {
    fails_on(campaign, &[("a.csv", &log(0..100))], message, hint);
}

#[test]
fn wrong_keys_and_units() {
    fails(
        &PLAIN.replace("hold", "holds"),
        "campaign.toml, line 4: `signals.current.holds` is not a known key",
        Some("did you mean `hold`?"),
    );
    fails(
        &PLAIN.replace("motor =", "moter ="),
        "campaign.toml, line 5: `signals.moter` is not a known key",
        Some("did you mean `motor`?"),
    );
    fails(
        &PLAIN.replace(", hold = \"sampled\"", ""),
        "campaign.toml, line 4: `signals.current` has no `hold`",
        Some(
            "write hold = \"sampled\" for a command that is held between samples, hold = \"measured\" for a measurement",
        ),
    );
    fails(
        &PLAIN.replace("\"sampled\"", "\"held\""),
        "campaign.toml, line 4: `signals.current.hold` is \"held\", but must be \"sampled\" or \"measured\" or \"unknown\"",
        Some("write one of these words"),
    );
    fails(
        &PLAIN.replace("unit = \"A\"", "unit = \"V\""),
        "campaign.toml, line 4: `signals.current.unit`: \"V\" is a voltage [kg*m^2*s^-3*A^-1], where a current [A] is expected",
        Some("for a logged voltage write `voltage = …` instead of `current`, and `voltage_limit`"),
    );
    fails(
        &PLAIN.replace("N*m/A", "N*m/V"),
        "campaign.toml, line 7: `drive.torque_constant`: \"0.25 N*m/V\" is a torque per voltage (or current per angular rate) [s*A], where a torque per current (or voltage per angular rate) [kg*m^2*s^-2*A^-1] is expected",
        Some("write it as in \"2.184 lbf*in/A\""),
    );
    fails(
        &PLAIN.replace("unit = \"rad\"", "unit = \"kg\""),
        "campaign.toml, line 5: `signals.motor.unit`: the motor is measured in a mass [kg], which is neither an angle nor a length",
        Some(
            "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: unit = \"rad\" with scale = rad per count; speeds: \"rpm\" with quantity = \"speed\"",
        ),
    );
    fails(
        &PLAIN.replace("time = {", "sample_time = 1\ntime = {"),
        "campaign.toml, line 2: `signals` has both `time` and `sample_time`",
        Some("give one of the two"),
    );
    fails(
        &PLAIN.replace("current =", "#"),
        "campaign.toml, line 2: `signals` has none of `current`, `voltage`, `command`",
        Some("add one of them"),
    );
    fails(
        &PLAIN.replace("unit = \"rad\"", "unit = \"rad\", scale = 0"),
        "campaign.toml, line 5: `signals.motor.scale` is 0, but must be other than zero",
        Some("check the number and its unit"),
    );
    fails(
        &PLAIN.replace("\"0.25 N*m/A\"", "\"0 N*m/A\""),
        "campaign.toml, line 7: `drive.torque_constant` is \"0 N*m/A\", but must be other than zero",
        Some("check the number and its unit"),
    );
    fails("", "campaign.toml has no `signals`", Some("add the table [signals]"));
    let no_runs = PLAIN.replace("[[runs]]\nfile = \"a.csv\"", "");
    let add = Some("add a table [[runs]] with `file = \"...\"` for each log");
    fails(&no_runs, "campaign.toml has no `runs`", add);
    fails(&format!("runs = []\n{no_runs}"), "campaign.toml, line 1: `runs` is an empty list", add);
}

#[test]
fn a_command_is_a_current_a_voltage_or_unknown() {
    fails(
        &PLAIN.replace(
            "current = { column = \"u\", unit = \"A\"",
            "command = { column = \"u\", unit = \"N\"",
        ),
        "campaign.toml, line 4: `signals.command.unit`: the command is measured in a force [kg*m*s^-2], which is neither a current, a voltage nor a torque",
        Some(
            "give \"A\", \"V\" or \"N*m\" (\"N\" on a linear axis), or \"1\" for a command of unknown unit",
        ),
    );
    let current = PLAIN.replace("current =", "command =");
    let command = read(&current).unwrap().campaign.channels.command;
    assert_eq!(command.quantity, CommandQuantity::Current);
}

#[test]
fn a_byte_order_mark_and_crlf_are_allowed() {
    let text = format!("\u{feff}{}", PLAIN.replace('\n', "\r\n"));
    assert_eq!(read(&text).unwrap().campaign.runs.len(), 1);
}

#[test]
fn drives_that_do_not_fit_their_command() {
    let winding =
        "campaign.toml, line 7: `drive.torque_constant`: a torque constant per ampere needs";
    fails(
        &voltage("torque_constant = \"0.5 N*m/A\""),
        &format!("{winding} `resistance` if the command is a voltage"),
        Some(
            "give `resistance` and `back_emf`, or the torque constant per volt, as in \"0.15 N*m/V\"",
        ),
    );
    fails(
        &voltage("torque_constant = \"0.5 N*m/A\"\nresistance = 2"),
        &format!("{winding} `back_emf` if the command is a voltage"),
        Some(
            "for a DC motor `back_emf` equals the torque constant in SI, as in \"0.0107 V*s/rad\"; with 0 its damping is part of viscous friction",
        ),
    );
    fails(
        &voltage("torque_constant = 0.5"),
        "campaign.toml, line 7: `drive.torque_constant`: a torque constant without a unit could be per ampere or per volt",
        Some("give it a unit: N*m/A or N*m/V, N/A or N/V"),
    );
    fails(
        &voltage("current_limit = 2"),
        "campaign.toml, line 7: `drive.current_limit` does not apply if the command is a voltage",
        Some("remove it, or describe the channel that it belongs to"),
    );
}

#[test]
fn tips_that_do_not_fit_the_axis() {
    let with = |tip: &str| PLAIN.replace("[drive]", &format!("tips = [{{ {tip} }}]\n[drive]"));
    fails(
        &with("column = \"x\", unit = \"m\", quantity = \"deflection\""),
        "campaign.toml, line 6: `signals.tips[1]`: a length [m] at a tip of a rotary axis needs `radius`",
        Some(
            "give the distance of the sensor from the joint and what it measures, as in quantity = \"deflection\", radius = \"0.45 m\"",
        ),
    );
    fails(
        &with("column = \"x\", unit = \"rad\", radius = 1"),
        "campaign.toml, line 6: `signals.tips[1].radius`: a radius does not apply to this tip",
        Some("remove `radius`"),
    );
    fails(
        &with("column = \"x\", unit = \"rad\", quantity = \"acceleration\""),
        "campaign.toml, line 6: `signals.tips[1].unit`: \"rad\" is a plain number or angle, where an angular acceleration [s^-2] is expected",
        Some("write it as in \"20 rad/s^2\""),
    );
    fails(
        &with("x = \"x\", y = \"y\", quantity = \"deflection\""),
        "campaign.toml, line 6: `signals.tips[1]`: x and y of a camera can only give the angle of the radius to the point",
        Some("remove `quantity`"),
    );
    fails(
        &with("x = \"x\"").replace("unit = \"rad\"", "unit = \"m\"").replace("N*m/A", "N/A"),
        "campaign.toml, line 6: `signals.tips[1]`: x and y of a camera give an angle, but the motor is measured in metres",
        Some("give one column with a unit of length"),
    );
}

#[test]
fn logs_that_do_not_fit_their_campaign() {
    fails_on(
        PLAIN,
        &[],
        "a.csv: cannot be opened: No such file or directory (os error 2)",
        Some("check the name: a path in a campaign.toml starts from the folder of that file"),
    );
    fails_on(
        PLAIN,
        &[("a.csv", &log((0..40).chain(100..130)))],
        "a.csv: the log is cut at gaps in the time stamps (1), and no piece has 50 samples; the longest has 40",
        Some(
            "log without interruption; if the stamps are too coarse for the sampling, give `sample_time` instead of `time`",
        ),
    );
    fails_on(
        PLAIN,
        &[("a.csv", &log(0..5))],
        "a.csv: 5 samples; at least 8 are needed",
        Some("record longer, or leave the run out"),
    );
    fails(
        &format!("{PLAIN}skip = \"1 s\"\n"),
        "a.csv: leaving out what is asked for leaves 0 rows of a log of 0.099 s",
        Some("leave out less: see `skip`, `until` and `leave_out`"),
    );
    fails(
        &format!("{PLAIN}frequency = \"500 Hz\"\n"),
        "campaign.toml, line 10: `runs[1].frequency` is 3141.5927 rad/s, but must be below 3141.5927 rad/s, the Nyquist frequency of a.csv",
        Some(
            "`omega_rad_s` is in rad/s; `frequency = \"5 Hz\"` has a unit; check also the unit of the time stamps",
        ),
    );
    fails(
        &PLAIN.replace("column = \"x\"", "column = \"z\""),
        "a.csv: there is no column \"z\"; the columns are \"t\", \"u\", \"x\", \"y\"",
        Some("give one of these names exactly, or the column's number from 1"),
    );
}

#[test]
fn a_missing_campaign_is_named() {
    let error = read_campaign(Path::new("no/campaign.toml")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no/campaign.toml: cannot be read: No such file or directory (os error 2)"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_change_of_a_good_campaign_panics(
        at in 0..PLAIN.len(), length in 0..20_usize, with in "[-\"{}=,. 0-9a-z\\[\\]\n]{0,6}"
    ) {
        let end = (at + length).min(PLAIN.len());
        let _ = read(&format!("{}{with}{}", &PLAIN[..at], &PLAIN[end..]));
    }

    #[test]
    fn no_text_panics(text in "\\PC{0,120}") {
        let _ = read(&text);
    }

    #[test]
    fn no_log_panics(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let folder = folder(&PLAIN.replace("\"t\"", "1").replace("\"u\"", "2").replace("\"x\"", "2"), &[]);
        std::fs::write(folder.path().join("a.csv"), bytes).unwrap();
        let _ = read_campaign(&folder.path().join("campaign.toml"));
    }
}

#[test]
fn a_confined_campaign_reads_nothing_outside_of_its_folder() {
    const OWN: &str =
        "unit = \"rad\", file = \"/dev/zero\", time = { column = \"t\", unit = \"s\" }";
    let outside = |text: String| {
        let reader = CampaignReader::of_text("campaign", text).confined();
        reader.read().unwrap_err().to_string()
    };
    for file in ["../a.csv", "/etc/hostname", "b/../../a.csv::x"] {
        let error = outside(PLAIN.replace("a.csv", file));
        assert!(error.ends_with("is not inside the folder of the campaign"), "{error}");
    }
    let arm = outside(PLAIN.replace("[drive]", "[drive]\narm = \"../arm.toml\""));
    assert!(arm.ends_with("is not inside the folder of the campaign"), "{arm}");
    let own = outside(PLAIN.replace("unit = \"rad\"", OWN));
    assert_eq!(own, "/dev/zero: is not inside the folder of the campaign");
    let checked = CampaignReader::of_text("campaign", PLAIN.replace("a.csv", "none/a.csv"));
    checked.confined().check().unwrap();
    let inside = outside(PLAIN.replace("a.csv", "none/a.csv"));
    assert!(inside.contains("cannot be opened"), "{inside}");
}
