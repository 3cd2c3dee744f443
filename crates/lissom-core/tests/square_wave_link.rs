//! A rotary flexible link as in a teaching laboratory: square-wave references, a tip's angle, a current measured with noise. Bands of
//! such transients are no responses; the tip's own equation has the mode.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::{Effort, Options, identify};
use lissom::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, Tip, TipQuantity,
};
use lissom::replay::ModalArm;
use lissom::rig::{Drive, Experiment, Reference, Settle};

const CONSTANT: f64 = 0.246_759;

fn square(omega_rad_s: f64, amplitude_rad: f64, seed: u64) -> Run {
    let rig = lissom_testmodels::report_rig(Some(12));
    let reference = Drive::Angle(Reference::square(omega_rad_s, amplitude_rad).unwrap());
    let square = Experiment::new(reference, 30.0).unwrap();
    rig.run("square", &square.settling(Settle::Wait { wait_s: 10.0 }), seed).unwrap().run
}

#[test]
fn the_mode_is_that_of_the_tips_own_equation() {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Sampled,
        torque_per_command: Some(CONSTANT),
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
    let truth = ModalArm::of_arm(&lissom_testmodels::report_arm()).unwrap().modes[0].omega_rad_s;
    for (seed, omega_rad_s) in [(1, 0.8), (2, 1.3), (3, 2.1)] {
        let runs = vec![square(omega_rad_s, 0.4, seed), square(0.7 * omega_rad_s, 0.25, seed + 10)];
        let campaign = Campaign::new(channels.clone(), runs).unwrap();
        let options = Options { effort: Effort::Quick, ..Options::default() };
        let found = identify(&campaign, &options, |_| ()).unwrap();
        let mode = found.beam.modes[0];
        let frequency = mode.natural_frequency_rad_s;
        assert!((frequency.value / truth - 1.0).abs() < 0.01, "{omega_rad_s}: {frequency:?}");
        assert!(
            (frequency.value - truth).abs() < 5.0 * frequency.std,
            "{omega_rad_s}: {frequency:?}"
        );
        assert_eq!(found.beam.modes.len(), 1, "{omega_rad_s}");
        assert!(mode.damping_ratio.value > -2.0 * mode.damping_ratio.std);
    }
}
