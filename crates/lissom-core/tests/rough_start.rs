//! Output errors that begin at an arm which is wrong by factors come to the estimates that one from the true arm comes to.
//!
//! J, V and CF wrong by a factor of three in any direction cost nothing. Where all three are wrong so, modes may be too, their
//! stiffness by three. Measured: one mode's frequency by 0.7 to 3 where the rest is too large, by a third to 0.7 where it is too
//! small; both of two modes' by 0.7 to 2 where the rest is too large, by 1.5 to 2 where it is too small; a few starts each. Beyond that
//! (a frequency of 0.5 or a third with the rest too large, 3 of two modes) the search ends elsewhere, 25 to 400 standard errors off.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{Effort, Interrupt, OutputError, OutputErrorStart, Prepared, output_error};
use lissom::record::{Campaign, Run};
use lissom::replay::{ModalArm, Parameter};
use lissom::rig::{Experiment, Instruments, Noise, Pd, Quantiser, Rig, Sensor, Settle};

/// Noise of the sensors in steps.
const NOISE_STEPS: f64 = 0.5;
/// Furthest that estimates are from each other, in deviations.
const DEVIATIONS: f64 = 1.0;
/// Furthest that a damping ratio is from that of the arm, in standard errors.
const FROM_TRUTH: f64 = 3.0;

/// The report's arm: one mode at 6.6 rad/s.
fn report() -> Rig {
    let mut rig = lissom_testmodels::report_rig(Some(12));
    let instruments = &mut rig.instruments;
    let step = instruments.motor.quantiser.unwrap().step();
    instruments.motor.noise = Some(Noise::new(NOISE_STEPS * step).unwrap());
    instruments.tips[0].noise = instruments.motor.noise;
    rig
}

/// Two unequal masses, friction by direction: modes at 7.9 and 41 rad/s.
fn sliding_two_masses() -> Rig {
    let span = |mass_kg| Span {
        length_m: 0.15,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: 0.02 * mass_kg,
    };
    let beam = LumpedBeam::new(&[span(0.06), span(0.04)]).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::by_direction(0.05, 0.04).unwrap()).unwrap();
    let quantiser = Quantiser::new(14, std::f64::consts::TAU).unwrap();
    let noise = Some(Noise::new(NOISE_STEPS * quantiser.step()).unwrap());
    let sensor = Sensor { noise, quantiser: Some(quantiser) };
    let mut instruments = Instruments::ideal(0.002).unwrap();
    instruments.motor = sensor;
    instruments.tips = vec![sensor];
    Rig::new(arm, instruments, Pd::new(8.0, 0.15).unwrap().into())
}

fn campaign(rig: &Rig, sines_rad_s: &[f64]) -> Campaign {
    let sine = |omega_rad_s: &f64| {
        let sine = Experiment::sine(*omega_rad_s, 0.6, 8.0).unwrap();
        let sine = sine.settling(Settle::Wait { wait_s: 20.0 });
        rig.run(&format!("{omega_rad_s} rad/s"), &sine, 5).unwrap().run
    };
    let runs: Vec<Run> = sines_rad_s.iter().map(sine).collect();
    Campaign::new(rig.channels(0..rig.arm.beam().len()).unwrap(), runs).unwrap()
}

/// Times J, V and CF; times every mode's frequency and stiffness.
type Factors = ([f64; 3], [f64; 2]);

/// The arm with its estimates times these.
fn wrong(arm: &ModalArm, ([inertia, viscous, coulomb], [omega, stiffness]): Factors) -> ModalArm {
    let mut wrong = arm.clone();
    wrong.inertia_kg_m2 *= inertia;
    wrong.viscous_nm_s_per_rad = arm.viscous_nm_s_per_rad.map(|v| viscous * v);
    wrong.coulomb_nm *= coulomb;
    for mode in &mut wrong.modes {
        mode.omega_rad_s *= omega;
        mode.stiffness_nm_per_rad *= stiffness;
    }
    wrong
}

fn from(campaign: &Campaign, sines_rad_s: &[f64], arm: ModalArm) -> OutputError {
    let start = OutputErrorStart {
        shown_rad_s: Vec::new(),
        further_terms: Vec::new(),
        most_evaluations: Effort::Thorough.most_evaluations(),
        interrupt: Interrupt::default(),
        arms: vec![arm],
        omega_rad_s: sines_rad_s.iter().map(|omega| Some(*omega)).collect(),
        first_window_s: None,
    };
    output_error(&Prepared::of(campaign), &start).unwrap()
}

#[track_caller]
fn comes_to_the_same(rig: &Rig, sines_rad_s: &[f64], starts: &[Factors]) {
    let campaign = campaign(rig, sines_rad_s);
    let truth = ModalArm::of_arm(&rig.arm).unwrap();
    let best = from(&campaign, sines_rad_s, truth.clone());
    for factors in starts {
        let found = from(&campaign, sines_rad_s, wrong(&truth, *factors));
        let others = |oe: &OutputError| -> Vec<Parameter> {
            oe.parameters.iter().copied().filter(|p| !p.is_damper()).collect()
        };
        assert_eq!(others(&found), others(&best), "{factors:?}");
        for p in others(&best) {
            let (best, found) = (best.estimate(p).unwrap(), found.estimate(p).unwrap());
            let off = (found.value - best.value) / best.std;
            assert!(off.abs() < DEVIATIONS, "{factors:?}: {} off by {off}", p.name());
        }
        if found.parameters == best.parameters {
            for p in best.parameters.iter().filter(|p| p.is_damper()) {
                let (best, found) = (best.estimate(*p).unwrap(), found.estimate(*p).unwrap());
                let off = (found.value - best.value) / best.std;
                assert!(off.abs() < DEVIATIONS, "{factors:?}: {} off by {off}", p.name());
            }
        }
        // These sines do not tell which kind of damper the beam has: where another one is found, its ratio is the arm's.
        for (mode, ratio) in truth.damping_ratios().into_iter().enumerate() {
            let found = found.estimate_of(|arm| arm.damping_ratios()[mode]);
            let off = (found.value - ratio) / found.std;
            assert!(off.abs() < FROM_TRUTH, "{factors:?}: ratio of mode {mode} off by {off}");
        }
    }
}

const THIRD: f64 = 1.0 / 3.0;
/// J, V and CF three times too large or small, together and against each other.
const RIGID: [Factors; 4] = [
    ([3.0, 3.0, 3.0], [1.0, 1.0]),
    ([THIRD, THIRD, THIRD], [1.0, 1.0]),
    ([3.0, THIRD, 3.0], [1.0, 1.0]),
    ([THIRD, 3.0, THIRD], [1.0, 1.0]),
];

#[test]
fn one_mass() {
    let modes = [
        ([3.0, 3.0, 3.0], [2.0, 3.0]),
        ([3.0, 3.0, 3.0], [0.7, THIRD]),
        ([THIRD, THIRD, THIRD], [0.7, THIRD]),
        ([THIRD, THIRD, THIRD], [THIRD, THIRD]),
    ];
    comes_to_the_same(&report(), &[2.0, 4.5, 9.0, 15.0], &[&RIGID[..], &modes].concat());
}

#[test]
fn two_masses() {
    let modes = [([3.0, 3.0, 3.0], [1.5, 3.0])];
    comes_to_the_same(
        &sliding_two_masses(),
        &[2.0, 4.5, 12.0, 20.0],
        &[&RIGID[..2], &modes].concat(),
    );
}
