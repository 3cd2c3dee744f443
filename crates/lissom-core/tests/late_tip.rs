//! A tip that is read some samples later than the motor, as by a camera: a rig's log whose tip is moved by whole
//! samples, which no interpolation touches.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::{Finding, Identified, Options, Severity, identify};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
};
use lissom::replay::{ModalArm, Parameter};
use lissom::rig::{Experiment, Settle};

const CONSTANT: f64 = 0.246_759;

fn sine(omega_rad_s: f64, amplitude_rad: f64) -> Run {
    let rig = lissom_testmodels::report_rig(Some(12));
    let sine = Experiment::sine(omega_rad_s, amplitude_rad, 12.0).unwrap();
    rig.run("sine", &sine.settling(Settle::Wait { wait_s: 60.0 }), 0).unwrap().run
}

/// The tip shows at a sample what it showed `late` samples before; a motor that is later is as if it were early.
fn moved(run: &Run, late: isize) -> Run {
    let (by, n) = (late.unsigned_abs(), run.len());
    let (first, last) = (run.command(), run.motor());
    let (kept, shown) = if late < 0 { (0..n - by, by..n) } else { (by..n, 0..n - by) };
    let tip = run.tips()[0][shown].to_vec();
    let (command, motor) = (first[kept.clone()].to_vec(), last[kept].to_vec());
    let time = TimeBase::uniform(0.0, run.sample_time_s());
    Run::new(run.name(), time, command, motor, vec![tip]).unwrap()
}

fn identified(late: isize) -> Identified {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(CONSTANT),
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
    let sines = [(3.1, 0.7), (9.3, 0.5), (5.0, 0.6), (15.0, 0.3)];
    let runs = sines.map(|(omega, amplitude)| moved(&sine(omega, amplitude), late));
    identify(&Campaign::new(channels, runs.into()).unwrap(), &Options::default(), |_| ()).unwrap()
}

#[test]
fn a_late_tip_is_counted_and_said() {
    let truth = ModalArm::of_arm(&lissom_testmodels::report_arm()).unwrap();
    for late in [3, -1, 0] {
        let found = identified(late);
        let lag = found.output_error.as_ref().unwrap().estimate(Parameter::TipLag(0));
        let said = found.findings.iter().find(|f| f.code() == "tip-lag");
        assert_eq!((lag.is_some(), said.is_some()), (late != 0, late != 0), "{late} {lag:?}");
        let beam = &found.beam;
        let mode = truth.modes[0];
        for (name, estimate, truth) in [
            ("Coulomb friction", found.friction.coulomb, truth.coulomb_nm),
            ("viscous friction", found.friction.viscous, truth.viscous_nm_s_per_rad[0]),
            ("inertia", found.inertia, truth.inertia_kg_m2),
            ("coupling", beam.coupling, mode.stiffness_nm_per_rad),
            ("frequency", Some(beam.modes[0].natural_frequency_rad_s), mode.omega_rad_s),
            ("lag", lag, late as f64 * 0.003),
        ] {
            if name == "lag" && late == 0 {
                continue;
            }
            let estimate = estimate.unwrap_or_else(|| panic!("{late}: no {name}"));
            let standard_errors = (estimate.value - truth) / estimate.std;
            assert!(standard_errors.abs() < 4.0, "{late} {name} {estimate:?} {truth}");
            assert!(estimate.std < 5e-3 * truth.abs(), "{late} {name} {estimate:?}");
        }
        let warned = found.findings.iter().filter(|f| f.severity() != Severity::Info);
        let codes: Vec<&str> = warned.map(Finding::code).collect();
        assert!(!codes.contains(&"replay-departs"), "{late} {codes:?}");
    }
}
