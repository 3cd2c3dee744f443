//! SLFR in its loop: the arm found from sweeps, driven by the author's controller as he wrote it, at a
//! frequency of other runs.

use std::f64::consts::TAU;
use std::path::Path;

use lissom::arm::Arm;
use lissom::beam::{KnownMode, ModalBeam};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{Options, identify};
use lissom::replay::ModalArm;
use lissom::rig::{
    Amplifier, Controller, Delay, Experiment, Instruments, Proportional, Quantiser, Rig, Sensed,
    Settle,
};
use num_complex::Complex64;

use super::common;

const COUNTS: u32 = 1024;
const SAMPLE_S: f64 = 0.002;
const HERTZ: f64 = 5.0;
/// Samples of its period.
const PERIOD: usize = 100;
/// Samples before it is looked at.
const SETTLED: usize = 400;
const LIMIT: f64 = 200.0;

/// `3·(s + 13)/(s + 20)` by Tustin's rule at 500 Hz, whole numbers of the command kept: what is cut off
/// is lost to the recursion.
#[derive(Debug, Default)]
struct Lag {
    reference_counts: Vec<f64>,
    command: f64,
    error_counts: f64,
}

impl Lag {
    fn of(command: f64, error: f64, error_before: f64) -> f64 {
        let exact = (980.0 * command + 3.0 * (1013.0 * error - 987.0 * error_before)) / 1020.0;
        exact.trunc().clamp(-LIMIT, LIMIT)
    }
}

impl Controller for Lag {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        let sample = (now.time_s / now.period_s).round() as usize;
        let error = self.reference_counts[sample % PERIOD] - counts(now.motor_rad);
        self.command = Self::of(self.command, error, self.error_counts);
        self.error_counts = error;
        self.command
    }

    fn reset(&mut self) {
        (self.command, self.error_counts) = (0.0, 0.0);
    }
}

fn counts(angle_rad: f64) -> f64 {
    (angle_rad / TAU * f64::from(COUNTS)).round()
}

/// Amplitudes of the harmonics 1, 3, 5 and 7.
fn odd(samples: &[f64]) -> [f64; 4] {
    let whole = samples.len() / PERIOD * PERIOD;
    [1, 3, 5, 7].map(|k| {
        let turn = |i: usize| Complex64::cis(-TAU * (k * i) as f64 / PERIOD as f64);
        let sum: Complex64 = samples[..whole].iter().enumerate().map(|(i, x)| turn(i) * x).sum();
        2.0 * sum.norm() / whole as f64
    })
}

/// Root of the summed squares of those above the first.
fn content(harmonics: &[f64; 4]) -> f64 {
    harmonics[1..].iter().map(|a| a * a).sum::<f64>().sqrt()
}

/// Reference, command and angle of a log of the fixed runs, in the drive's units.
fn fixed(data: &Path, run: usize) -> [Vec<f64>; 3] {
    let path = data.join(format!("april2009_openloop/fixed{run}-5hz.txt"));
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    let rows: Vec<Vec<f64>> =
        rows.map(|row| row.split('\t').map(|x| x.trim().parse().unwrap()).collect()).collect();
    [2, 3, 4].map(|column| rows.iter().map(|row| row[column]).collect())
}

/// The arm of a replay with the modes that the motor feels; what its tips show does not matter here.
fn of(found: &ModalArm) -> Arm {
    let mut found = found.clone().without_light_modes();
    found.modes.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    let modes = found.modes.len();
    let mode = |k: usize| {
        let (omega_rad_s, ratio) = found.clamped_modes()[k];
        KnownMode {
            omega_rad_s,
            damping_ratio: ratio.max(0.0),
            coupling_nm_per_rad: found.modes[k].stiffness_nm_per_rad,
            gains: (0..modes).map(|tip| f64::from(u8::from(tip == k))).collect(),
        }
    };
    let beam = ModalBeam::new((0..modes).map(mode).collect());
    let motor = Motor::new(found.inertia_kg_m2, found.viscous_nm_s_per_rad[0], 1.0).unwrap();
    // The offset, larger than Coulomb friction here, is the rig's constant load.
    let coulomb = Coulomb::symmetric(found.coulomb_nm).unwrap();
    Arm::new(beam.unwrap(), motor, coulomb).unwrap()
}

/// What the loop commands, from rest, of an arm whose command acts `lag_s` late.
fn commanded(found: &ModalArm, lag_s: f64, reference_counts: &[f64]) -> [f64; 4] {
    let mut instruments = Instruments::ideal(SAMPLE_S).unwrap();
    instruments.motor.quantiser = Some(Quantiser::encoder(COUNTS).unwrap());
    instruments.amplifier = Amplifier::ideal().with_limit(LIMIT).unwrap();
    instruments.delay = Some(Delay::new(lag_s).unwrap());
    let mut rig = Rig::new(of(found), instruments, Proportional::new(1.0).unwrap().into());
    rig.scene.load_nm = found.offset_nm;
    let amplitude_rad = 50.0 * TAU / f64::from(COUNTS);
    let experiment = Experiment::sine(TAU * HERTZ, amplitude_rad, 4.0).unwrap();
    let at_once = experiment.settling(Settle::AtOnce);
    let mut law = Lag { reference_counts: reference_counts.to_vec(), ..Lag::default() };
    let run = rig.run_with(&mut law, "5 Hz", &at_once, 0).unwrap().run;
    odd(&run.command()[SETTLED..])
}

#[test]
fn the_controller_is_the_authors() {
    let Some(data) = common::data("krauss-slfr") else { return };
    for run in [1, 2] {
        let [reference, command, angle] = fixed(&data, run);
        let error: Vec<f64> = reference.iter().zip(&angle).map(|(u, y)| u - y).collect();
        for k in 1..command.len() {
            let next = Lag::of(command[k - 1], error[k], error[k - 1]);
            assert!((next - command[k]).abs() < 0.5, "row {k}: {next} for {}", command[k]);
        }
    }
}

#[test]
fn odd_harmonics_are_predicted_from_sweeps() {
    let Some(data) = common::data("krauss-slfr") else { return };
    let file = common::read(include_str!("krauss-all-sweeps.toml"), &data, "");
    let id = identify(&file.campaign, &Options::default(), |_| {}).unwrap();
    let found = &id.output_error.as_ref().unwrap().arm;
    let reference = &fixed(&data, 1)[0][..PERIOD];
    let predicted = commanded(found, found.command_lag_s, reference);
    let free = ModalArm { coulomb_nm: 0.0, offset_nm: 0.0, ..found.clone() };
    let without_friction = commanded(&free, found.command_lag_s, reference);
    for run in [1, 2] {
        let measured = odd(&fixed(&data, run)[1][SETTLED..]);
        let off = |a: f64, b: f64| (a / b - 1.0).abs();
        assert!(off(predicted[0], measured[0]) < 0.02, "{predicted:?}, {measured:?}");
        assert!(off(predicted[1], measured[1]) < 0.1, "{predicted:?}, {measured:?}");
        for found in [&predicted, &without_friction] {
            let (found, measured) = (content(found), content(&measured));
            assert!(off(found, measured) < 0.1, "{found}, {measured}");
        }
    }
}
