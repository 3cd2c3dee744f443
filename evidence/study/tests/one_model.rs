//! Table, `result.json`, arm, validation and C source of a result are one model: simulated drives with every effect, and
//! measured logs.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]
#![expect(clippy::print_stderr, reason = "says that a test was left out")]

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use lissom::identify::{Effort, Identified, Options, identify, predict_logs};
use lissom::record::{Campaign, Run, TimeBase};
use lissom::replay::{ModalArm, ROOT_SPEED_RAD_S, ROUNDED_LOAD_SHARE};
use lissom_io::export::{c_files, export_model_of_text};
use lissom_io::result::{DirectionName, arm_of_text};
use lissom_io::{ResultFile, read_campaign};
use lissom_study::{DriveCampaign, DriveStudy};

/// Simulated campaigns, of a seed that no rule was tuned on.
const CAMPAIGNS: usize = 30;
const SEED: u64 = 5801;
/// Relative error of numbers that are written in decimals and read back.
const READ: f64 = 1e-9;
/// Relative error of `float`.
const FLOAT: f64 = 1e-5;

/// Friction against the motion in a direction ±1, as the sum of an arm's terms, without what depends on place.
fn by_speed(arm: &ModalArm, v: f64, s: f64) -> f64 {
    let terms = &arm.dry_terms;
    let near = terms.near_rest.map_or(0.0, |n| n.torque_nm * n.falloff.share(v / n.speed_rad_s));
    let root = terms.root.map_or(0.0, |r| {
        r.torque_nm_per_root_rad_s * ((v + ROOT_SPEED_RAD_S).sqrt() - ROOT_SPEED_RAD_S.sqrt())
    });
    let viscous = arm.viscous_nm_s_per_rad[usize::from(s < 0.0)];
    arm.coulomb_nm + s * arm.offset_nm + near + root + viscous * v
}

/// All torque that the motor has to supply at a constant speed.
fn supplied(arm: &ModalArm, velocity: f64, q: f64) -> f64 {
    let s = velocity.signum();
    let wave = |k: f64, cosine: f64, sine: f64| cosine * (k * q).cos() + sine * (k * q).sin();
    let terms = &arm.dry_terms;
    let ripples: f64 = terms.ripples.iter().map(|r| wave(r.per_rad, r.cosine_nm, r.sine_nm)).sum();
    let load = terms.with_load.map_or(0.0, |term| {
        let torque = term.load.sine_nm * q.sin() + term.load.cosine_nm * q.cos();
        term.coefficient * torque.hypot(ROUNDED_LOAD_SHARE * term.load.amplitude_nm())
    });
    let gravity = arm.gravity.map_or(0.0, |g| g.sine_nm * q.sin() + g.cosine_nm * q.cos());
    let cogging: f64 =
        arm.torque_ripples.iter().map(|r| wave(r.per_rad, r.cosine_nm, r.sine_nm)).sum();
    s * (by_speed(arm, velocity.abs(), s) + ripples + load) + gravity + cogging
}

/// What the compiled C source gives at places.
fn by_c(text: &str, places: &[(f32, f32)]) -> Vec<f64> {
    let folder = tempfile::tempdir().unwrap();
    let files = c_files(&export_model_of_text("result.json".to_owned(), text).unwrap());
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("lissom_feedforward.h", &files.header);
    write("lissom_feedforward.c", &files.source);
    let mut main =
        "#include <stdio.h>\n#include \"lissom_feedforward.h\"\nint main(void) {\n".to_owned();
    for (v, q) in places {
        let _ = writeln!(
            main,
            " printf(\"%.9g\\n\", lissom_friction((float){v:e}, (float){q:e}, 1e-9f));"
        );
    }
    write("main.c", &(main + " return 0; }\n"));
    let compiled = Command::new("cc")
        .current_dir(folder.path())
        .args(["-std=c99", "main.c", "lissom_feedforward.c", "-o", "main", "-lm"])
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let run = Command::new(folder.path().join("main")).output().unwrap();
    let printed = String::from_utf8(run.stdout).unwrap();
    printed.split_whitespace().map(|n| n.parse().unwrap()).collect()
}

/// The first samples of the first run: its prediction is compared, which takes long for whole campaigns.
fn beginning(campaign: &Campaign) -> Campaign {
    let run = &campaign.runs[0];
    let count = run.len().min(2000);
    let of = |channel: &[f64]| channel[..count].to_vec();
    let tips = run.tips().iter().map(|tip| of(tip)).collect();
    let base = TimeBase::uniform(0.0, run.sample_time_s());
    let run = Run::new(run.name(), base, of(run.command()), of(run.motor()), tips).unwrap();
    Campaign { runs: vec![run], ..campaign.clone() }
}

/// Whether the result has an arm.
fn holds(name: &str, campaign: &Campaign, id: &Identified) -> bool {
    let Some(found) = &id.arm else { return false };
    let file = ResultFile::of(&campaign.channels, id, None);
    let text = serde_json::to_string(&file).unwrap();
    let read = arm_of_text("result.json", &text, &campaign.channels).unwrap();
    let short = beginning(campaign);
    let torque = |arm| predict_logs(arm, &short).unwrap().torque.map(|t| t.runs);
    let (own, again) = (torque(found), torque(&read));
    assert_eq!(own.is_some(), again.is_some(), "{name}");
    for (a, b) in own.iter().flatten().zip(again.iter().flatten()) {
        let largest = a.logged_nm.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
        for (a, b) in a.predicted_nm.iter().zip(&b.predicted_nm) {
            assert!(a.is_nan() && b.is_nan() || (a - b).abs() < READ * largest, "{name}: {a} {b}");
        }
    }
    // The table's numbers, which are those of the file, at the speeds of the log.
    let arm = &read.arm;
    let fastest = campaign.runs.iter().flat_map(|run| {
        let of_run = run.motor().windows(2).map(|w| (w[1] - w[0]).abs() / run.sample_time_s());
        of_run.collect::<Vec<f64>>()
    });
    let fastest = fastest.fold(0.0, f64::max);
    let back_emf = campaign.channels.command.back_emf_viscous;
    let law = &file.friction;
    let mut largest = 0.0_f64;
    for share in [0.05, 0.1, 0.3, 0.6, 0.9] {
        for (s, direction) in [(1.0, DirectionName::Forward), (-1.0, DirectionName::Backward)] {
            let v = share * fastest;
            let by_arm = by_speed(arm, v, s) - back_emf * v;
            largest = largest.max(by_arm.abs());
            let Some(given) = law.at(v, direction) else { continue };
            // A root begins at a speed of 1e-8, which a table does not say.
            let root = arm.dry_terms.root.map_or(0.0, |r| r.torque_nm_per_root_rad_s.abs());
            let bound = READ * largest + root * ROOT_SPEED_RAD_S.sqrt();
            assert!((given - by_arm).abs() <= bound, "{name}: {v} {s}: {given} {by_arm}");
        }
    }
    // Over the travel of the log.
    let motor = || campaign.runs.iter().flat_map(|run| run.motor().iter().copied());
    let (low, high) =
        motor().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), q| (a.min(q), b.max(q)));
    #[expect(clippy::cast_possible_truncation, reason = "what the C source takes")]
    let places: Vec<(f32, f32)> = (0..60_u8)
        .map(|k| {
            let speed = [0.05, -0.1, 0.4, -0.7, 0.9][usize::from(k % 5)] * fastest;
            (speed as f32, (low + (high - low) * f64::from(k) / 59.0) as f32)
        })
        .collect();
    let wanted: Vec<f64> =
        places.iter().map(|(v, q)| supplied(arm, f64::from(*v), f64::from(*q))).collect();
    let largest = wanted.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
    for ((found, wanted), place) in by_c(&text, &places).iter().zip(wanted).zip(&places) {
        assert!((found - wanted).abs() < FLOAT * largest, "{name} {place:?}: {found} {wanted}");
    }
    true
}

#[test]
fn simulated_drives() {
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let draws = (0..).filter_map(|i| DriveCampaign::draw(DriveStudy::Real, SEED, i));
    let mut arms = 0;
    for campaign in draws.take(CAMPAIGNS) {
        let name = format!("real {SEED} {}", campaign.index);
        let id = identify(&campaign.logs, &options, |_| ()).unwrap();
        arms += usize::from(holds(&name, &campaign.logs, &id));
    }
    assert!(arms > CAMPAIGNS / 2, "only {arms} have an arm");
}

/// Each set with its log files, and the campaign that describes them.
const SETS: [(&str, &str, &str); 4] = [
    ("emps", "DATA_EMPS.csv", include_str!("../../../crates/lissom-cli/tests/measured/emps.toml")),
    (
        "emps",
        "DATA_EMPS_PULSES.csv",
        include_str!("../../../crates/lissom-cli/tests/measured/emps.toml"),
    ),
    ("cu-flexarm", "", include_str!("../../../crates/lissom-cli/tests/measured/cu-rigid.toml")),
    (
        "krauss-slfr",
        "",
        include_str!("../../../crates/lissom-cli/tests/measured/krauss-fixed.toml"),
    ),
];

#[test]
fn measured_logs() {
    let Some(data) = std::env::var_os("LISSOM_DATA").map(PathBuf::from) else {
        eprintln!("LISSOM_DATA is unset: no measured logs");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("campaign.toml");
    let mut arms = 0;
    for (set, file, text) in SETS {
        let at = |path: &Path| path.to_str().unwrap().to_owned();
        let text = text.replace("{data}", &at(&data.join(set))).replace("{file}", file);
        fs::write(&path, text).unwrap();
        let campaign = read_campaign(&path).unwrap().campaign;
        let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
        arms += usize::from(holds(&format!("{set} {file}"), &campaign, &id));
    }
    assert!(arms >= 3, "only {arms} have an arm");
}
