//! What the crate adds to its parts: options that work together, seeds, errors that `?` converts.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::time::Duration;

use lissom::identify::SearchEnd;
use lissom::prelude::*;

/// A rigid axis with noise in its sensor.
fn rig() -> Rig {
    let motor = Motor::builder().inertia_kg_m2(2e-3).torque_constant_nm_per_a(0.2);
    let arm = Arm::builder().motor(motor).coulomb_nm(0.02).build().unwrap();
    let pd = Pd::new(8.0, 0.25).unwrap();
    Rig::builder(arm).sample_time_s(3e-3).noise_rad(2e-4).controller(pd).build().unwrap()
}

fn sines() -> [Result<Experiment, lissom::rig::RigError>; 2] {
    [1.0, 3.0].map(|omega| Experiment::sine(omega, 0.5, 20.0))
}

#[test]
fn a_time_limit_and_a_request_both_end_the_search() {
    let logs = rig().campaign(sines()).unwrap();
    let ended = |identify: Identify<'_>| {
        let found = identify.run().unwrap();
        found.identified().output_error.as_ref().map(|found| found.end)
    };
    let asked = || {
        let interrupt = Interrupt::default();
        interrupt.ask();
        interrupt
    };
    let long = Duration::from_secs(600);
    let ends = [
        ended(Identify::new(&logs).time_limit(Duration::ZERO).interrupt(Interrupt::default())),
        ended(Identify::new(&logs).interrupt(Interrupt::default()).time_limit(Duration::ZERO)),
        ended(Identify::new(&logs).interrupt(asked()).time_limit(long)),
        ended(Identify::new(&logs).time_limit(long).interrupt(asked())),
    ];
    for end in ends {
        assert_ne!(end, Some(SearchEnd::Done), "the search went on");
    }
    assert_eq!(ended(Identify::new(&logs).time_limit(long)), Some(SearchEnd::Done));
}

#[test]
fn another_seed_gives_independent_noise_and_the_same_seed_the_same_log() {
    let motor = |seed: Option<u64>| {
        let logs = match seed {
            None => rig().campaign(sines()),
            Some(seed) => rig().campaign_from_seed(seed, sines()),
        };
        logs.unwrap().campaign.runs[0].motor().to_vec()
    };
    assert_eq!(motor(None), motor(Some(1)));
    assert_ne!(motor(None), motor(Some(100)));
}

#[test]
fn an_analysis_table_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let logs = rig().campaign(sines()).unwrap();
    let run = &logs.campaign.runs[0];
    let time: Vec<f64> = (0..run.len()).map(|k| 3e-3 * k as f64).collect();
    let columns = [("t", time.as_slice()), ("i", run.command()), ("q", run.motor())];
    lissom::io::write::write_csv(&folder.path().join("run.csv"), &columns).unwrap();
    let text = "[signals]\ntime = { column = \"t\", unit = \"s\" }\n\
        current = { column = \"i\", unit = \"A\", hold = \"sampled\" }\n\
        motor = { column = \"q\", unit = \"rad\" }\n[analysis]\nwindow = \"0.15 s\"\n\
        [[runs]]\nfile = \"run.csv\"\n";
    let path = folder.path().join("campaign.toml");
    std::fs::write(&path, text).unwrap();
    let file = read_campaign(&path).unwrap();
    let found = Identify::of_file(&file).effort(Effort::Quick).run().unwrap();
    let regression = found.identified().regression.as_ref().unwrap();
    assert!(regression.window_given && (regression.window_s - 0.15).abs() < 1e-9);
}

#[test]
fn errors_of_files_become_the_one_error() {
    fn write() -> Result<(), lissom::Error> {
        let empty: [(&str, &[f64]); 0] = [];
        lissom::io::write::write_csv("no/such/folder/log.csv".as_ref(), &empty)?;
        Ok(())
    }
    assert!(write().unwrap_err().hint().is_some());
}

#[test]
fn what_is_not_given_is_said_not_to_be_given() {
    let motor = Arm::builder().motor(Motor::builder()).build().unwrap_err();
    assert_eq!(motor.to_string(), "inertia_kg_m2 is not given");
    let arm = || Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).build().unwrap();
    let pd = || Pd::new(8.0, 0.25).unwrap();
    let no_time = Rig::builder(arm()).controller(pd()).build().unwrap_err();
    assert_eq!(no_time.to_string(), "the rig has no sample time");
    let no_controller = Rig::builder(arm()).sample_time_s(1e-3).build().unwrap_err();
    assert_eq!(no_controller.to_string(), "the rig has no controller");
}

#[test]
fn a_chirp_and_a_measured_current_by_name() {
    let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02);
    let rig = Rig::builder(arm.build().unwrap())
        .sample_time_s(1e-3)
        .encoder_counts(65_536)
        .current_noise_a(1e-3)
        .controller(Pd::new(8.0, 0.25).unwrap())
        .build()
        .unwrap();
    let logs = rig.campaign([Experiment::chirp((2.0, 40.0), 0.5, 10.0).unwrap()]).unwrap();
    let found = Identify::new(&logs).effort(Effort::Quick).run().unwrap();
    let coulomb = found.coulomb().unwrap();
    assert!((coulomb.value - 0.02).abs() < 5.0 * coulomb.std && coulomb.std < 2e-3, "{found}");
    let listed = found.parameters();
    let inertia = listed.iter().find(|p| p.key.starts_with("drive.inertia")).unwrap();
    assert!(inertia.estimate.is_some());
}
