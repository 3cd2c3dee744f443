//! Plans for a rigid joint with an unbalanced load, made on the rig and identified.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::arm::Arm;
use lissom::beam::Beam;
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{Effort, Gravity, Options, identify};
use lissom::load::GravityLoad;
use lissom::plan::{
    ArmParameter, Kinds, Plan, PlanError, PlanNote, PlannedParameter, PlannedUnknown, Wishes, plan,
};
use lissom::record::Campaign;
use lissom::rig::{Amplifier, Instruments, Pd, Quantiser, Rig, Sensor};

/// m·g·l of the load \[N·m\].
const MGL: f64 = 0.3;
/// Largest current \[A\].
const LIMIT_A: f64 = 5.0;

/// Factor by which standard errors that the identification states may differ from those expected: it chooses its window
/// from the data. Measured over six plans: 0.32 to 3.5.
const APART: f64 = 4.0;
/// Errors in expected standard errors, at most: three of those stated, of the largest measured.
const ERROR_MOST: f64 = 6.0;

/// A joint whose load hangs at −30°.
fn loaded(mgl: f64) -> Rig {
    let motor = Motor::new(2e-3, 0.01, 0.2).unwrap();
    let arm = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(0.06).unwrap()).unwrap();
    let mut instruments = Instruments::ideal(0.002).unwrap();
    instruments.motor = Sensor::from(Quantiser::encoder(16384).unwrap());
    instruments.amplifier = Amplifier::ideal().with_limit(LIMIT_A).unwrap();
    let mut rig = Rig::new(arm, instruments, Pd::new(8.0, 0.25).unwrap().into());
    rig.scene.gravity = (mgl > 0.0).then(|| GravityLoad::of_amplitude(mgl, 30.0_f64.to_radians()));
    rig
}

fn planned(rig: &Rig) -> Plan {
    plan(rig, &Wishes { kinds: Kinds::Any, ..Wishes::default() }, |_, _| ()).unwrap()
}

fn std(plan: &Plan, parameter: PlannedParameter) -> f64 {
    plan.expected.iter().find(|e| e.parameter == parameter).unwrap().std
}

#[test]
fn a_load_is_planned_with_the_rest() {
    let rig = loaded(MGL);
    let made = planned(&rig);
    assert!(made.expected.iter().all(|e| e.std <= e.wanted), "{:?}", made.expected);
    let names: Vec<PlannedUnknown> = made.parameters.iter().map(|p| p.0).collect();
    assert!(names.ends_with(&[PlannedUnknown::GravitySine, PlannedUnknown::GravityCosine]));
    assert!(made.notes.contains(&PlanNote::GravityByRegression));
    let reserve = (1.0 - Wishes::default().current_reserve) * LIMIT_A;
    assert!(made.runs.iter().all(|run| run.peak_current_a <= reserve), "{:?}", made.runs);
    // Without a load there is none to be found, and every wish takes less.
    let bare = planned(&loaded(0.0));
    assert!(bare.expected.iter().all(|e| e.parameter != PlannedParameter::Gravity));
    assert!(!bare.notes.contains(&PlanNote::GravityByRegression));
}

/// Plans, makes the runs, identifies them by the regression, of which the plan speaks: errors and stated standard errors of every parameter are about those expected.
fn is_worth_it(mgl: f64, counts: u32, kinds: Kinds) {
    let mut rig = loaded(mgl);
    rig.instruments.motor = Sensor::from(Quantiser::encoder(counts).unwrap());
    let plan = plan(&rig, &Wishes { kinds, ..Wishes::default() }, |_, _| ()).unwrap();
    let runs = plan.runs.iter().enumerate().map(|(i, r)| {
        let e = r.motion.experiment(r.amplitude_rad, r.record_s, plan.longest_wait_s).unwrap();
        rig.run(&format!("{i}"), &e, 7 + i as u64).unwrap().run
    });
    let campaign = Campaign::new(rig.channels(0..0).unwrap(), runs.collect()).unwrap();
    let regression = Options { effort: Effort::Quick, ..Options::default() };
    let id = identify(&campaign.with_gravity().unwrap(), &regression, |_| ()).unwrap();
    // Intervals of the result count terms that are not known to be absent, too.
    let line = id.regression.as_ref().unwrap();
    let arm = &rig.arm;
    let of = PlannedParameter::Arm;
    let motor = &arm.motor;
    let (viscous, coulomb) = (motor.viscous_nm_s_per_rad(), arm.coulomb.forward());
    let gravity = |g: Option<Gravity>| g.map(|g| g.amplitude());
    for (parameter, found, by_line, truth) in [
        (of(ArmParameter::Inertia), id.inertia, line.inertia, motor.inertia_kg_m2()),
        (of(ArmParameter::Coulomb), id.friction.coulomb, line.coulomb, coulomb),
        (of(ArmParameter::Viscous), id.friction.viscous, line.viscous, viscous),
        (PlannedParameter::Gravity, gravity(id.gravity), gravity(line.gravity), mgl),
    ] {
        let (found, expected) = (found.unwrap(), std(&plan, parameter));
        let stated = by_line.unwrap().std / truth / expected;
        let error = (found.value / truth - 1.0).abs() / expected;
        let off = (1.0 / APART..APART).contains(&stated);
        assert!(off && error < ERROR_MOST, "{mgl} {counts} {parameter:?}: {stated} {error}");
    }
}

#[test]
fn a_plan_with_a_load_is_worth_what_it_says() {
    is_worth_it(0.3, 16384, Kinds::Any);
    is_worth_it(0.1, 4096, Kinds::WithPair);
}

#[test]
fn a_load_on_a_beam_is_not_planned() {
    let mut rig = lissom_testmodels::report_rig(Some(12));
    rig.scene.gravity = Some(GravityLoad::of_amplitude(MGL, 0.0));
    let error = plan(&rig, &Wishes::default(), |_, _| ()).unwrap_err();
    assert!(matches!(error, PlanError::GravityOnBeam { masses: 1 }), "{error}");
}
