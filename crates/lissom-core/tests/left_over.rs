//! What a replay leaves is told from what the sensors add.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{Identified, Options, identify};
use lissom::record::{Campaign, Run};
use lissom::rig::{Amplifier, Experiment, Instruments, Noise, Pd, Quantiser, Rig, Sensor};

const TIME_S: f64 = 0.002;

/// One mass, encoders of 13 bits with noise of `noise` steps.
fn rig(noise: Option<f64>) -> Rig {
    let span = Span {
        length_m: 0.25,
        flexural_rigidity_n_m2: 0.02,
        mass_kg: 0.05,
        damping_n_s_per_m: 1e-3,
    };
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let beam = LumpedBeam::new(&[span]).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(0.04).unwrap()).unwrap();
    let quantiser = Quantiser::new(13, std::f64::consts::TAU).unwrap();
    let noise = noise.map(|steps| Noise::new(steps * quantiser.step()).unwrap());
    let sensor = Sensor { noise, quantiser: Some(quantiser) };
    let mut instruments = Instruments::ideal(TIME_S).unwrap();
    (instruments.motor, instruments.tips) = (sensor, vec![sensor]);
    instruments.amplifier = Amplifier::ideal().with_limit(6.0).unwrap();
    Rig::new(arm, instruments, Pd::new(8.0, 0.15).unwrap().into())
}

/// Sines of some frequencies, the tip seen with a sway of `sway_rad` at 5.3 rad/s that is not its own.
fn found(noise: Option<f64>, sway_rad: f64) -> Identified {
    let rig = rig(noise);
    let run = |omega_rad_s: f64| {
        let sine = Experiment::sine(omega_rad_s, 0.5, 15.0).unwrap();
        let run = rig.run(&format!("{omega_rad_s} rad/s"), &sine, 3).unwrap().run;
        let sway = |(k, tip): (usize, &f64)| tip + sway_rad * (5.3 * TIME_S * k as f64).sin();
        let tip = run.tips()[0].iter().enumerate().map(sway).collect();
        let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
        Run::new(run.name(), run.time(), command, motor, vec![tip]).unwrap()
    };
    let runs = [1.5, 2.2, 4.5, 13.0, 20.0].map(run).to_vec();
    let campaign = Campaign::new(rig.channels(0..1).unwrap(), runs).unwrap();
    identify(&campaign, &Options::default(), |_| ()).unwrap()
}

fn says_so(id: &Identified) -> bool {
    id.findings.iter().any(|f| f.code() == "more-than-noise")
}

/// With noise, and with nothing but steps, whose errors are slow where the motion is.
#[test]
fn what_sensors_add_is_not_left_over() {
    for noise in [Some(0.5), None] {
        let id = found(noise, 0.0);
        let oe = id.output_error.as_ref().unwrap();
        assert!(oe.whole_runs && oe.left_over.len() == 2);
        assert!(oe.left_over.iter().all(|share| *share < 1e-3), "{:?}", oe.left_over);
        assert!(!says_so(&id));
    }
}

/// A sway of 0.3 deviations of the sensor's noise has 4.5 % of its power, and hides in every plot.
#[test]
fn a_sway_below_the_noise_is_said() {
    let step = std::f64::consts::TAU / f64::from(1 << 13);
    let deviation = step * (0.25_f64 + 1.0 / 12.0).sqrt();
    let id = found(Some(0.5), 0.3 * deviation);
    let left = &id.output_error.as_ref().unwrap().left_over;
    assert!(left[1] > 0.02 && left[1] < 0.05, "{left:?}");
    assert!(says_so(&id));
}
