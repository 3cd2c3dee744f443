//! The single-mass arm of the report, Section 6.2.

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::rig::{Amplifier, Instruments, Pd, Quantiser, Rig, Sensor};

const INCH_M: f64 = 0.0254;
const POUND_FORCE_N: f64 = 4.448_221_615_260_5;
const POUND_KG: f64 = 0.453_592_37;

/// The arm of `[Feliu1989, 6.2]`: 7 in of 0.032 in music wire, 0.121 lb at its tip, the
/// identified motor, 0.132 A of Coulomb friction and the air table's damping of (36), 0.06 1/s.
///
/// # Panics
/// Never: the numbers are fixed and valid.
#[expect(clippy::expect_used, reason = "fixed, valid numbers of a test model")]
pub fn report_arm() -> Arm {
    let psi = POUND_FORCE_N / (INCH_M * INCH_M);
    let rigidity = 30e6 * psi * std::f64::consts::PI * (0.032 * INCH_M).powi(4) / 64.0;
    let mass_kg = 0.121 * POUND_KG;
    let span = Span {
        length_m: 7.0 * INCH_M,
        flexural_rigidity_n_m2: rigidity,
        mass_kg,
        damping_n_s_per_m: 0.06 * mass_kg,
    };
    let torque = POUND_FORCE_N * INCH_M;
    let motor = Motor::new(0.005_529 * torque, 0.012_16 * torque, 2.184 * torque);
    let motor = motor.expect("valid motor");
    let coulomb = Coulomb::symmetric(0.132 * motor.torque_constant_nm_per_a());
    let beam = LumpedBeam::new(&[span]).expect("valid beam");
    Arm::new(beam, motor, coulomb.expect("valid")).expect("one mass")
}

/// The rig of `[Feliu1989, 6.1]`: 3 ms, 4.12 A, sensors of `bits` bits over a turn (`None`: ideal).
///
/// The report prints no gains; these give a loop of 56 rad/s, damped 0.7.
///
/// # Panics
/// For more than 32 bits.
#[expect(clippy::expect_used, reason = "a test model")]
pub fn report_rig(bits: Option<u32>) -> Rig {
    let turn = std::f64::consts::TAU;
    let quantiser = bits.map(|b| Quantiser::new(b, turn).expect("1 to 32 bits"));
    let sensor = Sensor { noise: None, quantiser };
    let mut instruments = Instruments::ideal(0.003).expect("positive");
    instruments.motor = sensor;
    instruments.tips = vec![sensor];
    instruments.amplifier = Amplifier::ideal().with_limit(4.12).expect("positive");
    let controller = Pd::new(8.0, 0.2).expect("positive").into();
    Rig::new(report_arm(), instruments, controller)
}
