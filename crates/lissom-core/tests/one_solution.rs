//! Friction, inertia and coupling of a result are one method's whole solution, never parts of two.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::identify::{DriveEstimates, Effort, Identified, Method, Options, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};

const SAMPLE_S: f64 = 2e-3;
const INERTIA: f64 = 0.02;

/// A motion: angle, velocity and acceleration over time.
type Motion = fn(f64) -> [f64; 3];

/// Two sines that are no multiples of each other.
fn sines(t: f64) -> [f64; 3] {
    let (a, b) = (3.0_f64, 1.2_f64);
    [
        (a * t).sin() + 1.5 * (b * t).sin(),
        a * (a * t).cos() + 1.5 * b * (b * t).cos(),
        -a * a * (a * t).sin() - 1.5 * b * b * (b * t).sin(),
    ]
}

/// One slow stroke forward and back.
fn two_strokes(t: f64) -> [f64; 3] {
    let w = std::f64::consts::TAU / 8.0;
    [1.0 - (w * t).cos(), w * (w * t).sin(), w * w * (w * t).cos()]
}

fn found(motion: Motion, seconds: f64, friction: fn(f64) -> f64) -> Identified {
    let samples = (seconds / SAMPLE_S) as u32;
    let of = |value: &dyn Fn(f64) -> f64| -> Vec<f64> {
        (0..samples).map(|k| value(SAMPLE_S * f64::from(k))).collect()
    };
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24) - 0.5
    };
    let motor = of(&|t| motion(t)[0]);
    let torque = of(&|t| INERTIA * motion(t)[2] + friction(motion(t)[1]));
    let torque = torque.into_iter().map(|u| u + 2e-3 * noise()).collect();
    let run = Run::new("run", TimeBase::uniform(0.0, SAMPLE_S), torque, motor, vec![]).unwrap();
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured,
        torque_per_command: Some(1.0),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let channels = Channels { axis: Axis::Rotary, command, tips: vec![] };
    let campaign = Campaign::new(channels, vec![run]).unwrap();
    let options = Options { effort: Effort::Quick, ..Options::default() };
    identify(&campaign, &options, |_| ()).unwrap()
}

/// That what is printed is this solution, all of it, and that the arm has its numbers.
#[track_caller]
fn is_whole(id: &Identified, method: Method, solution: &DriveEstimates) {
    assert_eq!(id.method, Some(method));
    assert_eq!(id.friction, solution.friction);
    assert_eq!(id.inertia, solution.inertia);
    assert_eq!(id.beam.coupling, solution.coupling);
    assert_eq!(id.beam.coupling_by_tip, solution.coupling_by_tip);
    let (Some(arm), friction) = (&id.arm, &solution.friction) else { return };
    let (coulomb, viscous) = match &friction.law {
        Some(law) => {
            let mean = law.viscous.unwrap();
            let by_direction = law.viscous_by_direction.unwrap_or((mean, mean));
            (law.coulomb.unwrap(), [by_direction.0.value, by_direction.1.value])
        }
        None => (friction.coulomb.unwrap(), [friction.viscous.unwrap().value; 2]),
    };
    assert_eq!(arm.arm.coulomb_nm.to_bits(), coulomb.value.to_bits());
    assert_eq!(arm.arm.offset_nm.to_bits(), friction.offset.unwrap().value.to_bits());
    assert_eq!(arm.arm.inertia_kg_m2.to_bits(), solution.inertia.unwrap().value.to_bits());
    for (of_arm, printed) in arm.arm.viscous_nm_s_per_rad.iter().zip(viscous) {
        assert!((of_arm - printed).abs() < 1e-12 * printed.abs(), "{of_arm} {printed}");
    }
}

#[test]
fn one_viscous_coefficient_is_the_regression() {
    let id = found(sines, 40.0, |v| 0.3 * v.signum() + 0.05 * v);
    let solution = id.regression.as_ref().unwrap().estimates();
    is_whole(&id, Method::Regression, &solution);
    assert!((id.inertia.unwrap().value / INERTIA - 1.0).abs() < 0.01);
}

/// Friction by direction with an offset: Coulomb friction of the fit with one slope is another.
#[test]
fn viscous_friction_by_direction_comes_with_its_own_coulomb_friction() {
    let friction = |v: f64| if v > 0.0 { 0.36 + 0.05 * v } else { -0.24 + 0.12 * v };
    let id = found(sines, 40.0, friction);
    let law = id.friction_law.as_ref().unwrap();
    is_whole(&id, Method::FrictionLaw, &law.chosen.estimates());
    let law = id.friction.law.as_ref().unwrap();
    assert!(law.viscous_by_direction.is_some());
    let (forward, backward) = (law.forward.unwrap(), law.backward.unwrap());
    assert!((forward.value - 0.36).abs() < 0.01 && (backward.value - 0.24).abs() < 0.01);
}

#[test]
fn friction_near_rest_is_the_law() {
    let friction = |v: f64| v.signum() * (0.3 + 0.15 * (-v.abs() / 0.3).exp()) + 0.05 * v;
    let id = found(sines, 60.0, friction);
    let law = id.friction_law.as_ref().unwrap();
    is_whole(&id, Method::FrictionLaw, &law.chosen.estimates());
}

#[test]
fn two_strokes_are_a_regression_with_a_warning() {
    let id = found(two_strokes, 8.0, |v| 0.3 * v.signum() + 0.05 * v);
    is_whole(&id, Method::Regression, &id.regression.as_ref().unwrap().estimates());
    assert!(id.findings.iter().any(|f| f.code() == "few-phases"));
    let (coulomb, viscous) = (id.friction.coulomb.unwrap(), id.friction.viscous.unwrap());
    assert!((coulomb.value / 0.3 - 1.0).abs() < 0.03 && (viscous.value / 0.05 - 1.0).abs() < 0.05);
}
