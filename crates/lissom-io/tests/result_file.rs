//! `docs/src/reference/schemas/result.schema.json` names every key that a result has, and a result has every key that it
//! names.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use lissom::drive::Falloff;
use lissom::identify::{
    ConstantVelocity, Estimate, FrictionLine, Identified, LawCandidate, LawEstimates, LawTerm,
    LineShape, MissingKind, ModelTerm, NearRestEstimate, Options, RippleEstimate, RunToAdd,
    SteadyPoint, UnusedTorque, geometry_check, identify,
};
use lissom::information::ArmParameter;
use lissom::load::{GravityLoad, TorqueRipple};
use lissom::plan::PlannedMotion;
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity};
use lissom::replay::{DryTerms, NearRest, Ripple, Root, WithLoad};
use lissom::rig::{Experiment, Settle};
use lissom_io::ResultFile;
use lissom_io::result::arm_of_text;
use lissom_testmodels::SchemaCheck;

/// A campaign of three sines with one pair, and one of them as a motion of any shape.
fn campaign() -> Campaign {
    let rig = lissom_testmodels::report_rig(Some(12));
    let sine = |name: &str, omega_rad_s: f64| {
        let sine = Experiment::sine(omega_rad_s, 0.7, 20.0).unwrap();
        rig.run(name, &sine.settling(Settle::Wait { wait_s: 120.0 }), 0).unwrap().run
    };
    let mut runs = vec![sine("low", 3.1), sine("triple", 9.3), sine("fast", 20.0)];
    // The last half turned about: no sinusoid any more.
    let low = runs[0].clone();
    let turned = |x: &[f64]| x.iter().chain(x.iter().rev()).copied().collect::<Vec<f64>>();
    let tips = vec![turned(&low.tips()[0])];
    let (command, motor) = (turned(low.command()), turned(low.motor()));
    runs.push(lissom::record::Run::new("other", low.time(), command, motor, tips).unwrap());
    Campaign::new(channels(Axis::Rotary, CommandQuantity::Current, Some(0.246_759)), runs).unwrap()
}

fn channels(axis: Axis, quantity: CommandQuantity, constant: Option<f64>) -> Channels {
    let command = Command {
        quantity,
        hold: Hold::Sampled,
        torque_per_command: constant,
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    Channels { axis, command, tips: vec![tip] }
}

/// Results of every axis and command, with every estimate that may be absent.
fn results() -> Vec<ResultFile> {
    let mut id = identify(&campaign(), &Options::default(), |_| ()).unwrap();
    let described =
        geometry_check(&lissom_testmodels::report_arm(), id.output_error.as_ref().unwrap());
    assert!(described.is_some());
    let mut results = Vec::new();
    for axis in [Axis::Rotary, Axis::Linear] {
        for quantity in
            [CommandQuantity::Current, CommandQuantity::Voltage, CommandQuantity::Arbitrary]
        {
            for constant in [None, Some(0.246_759)] {
                id.torque_per_command = constant;
                let channels = channels(axis, quantity, constant);
                results.push(ResultFile::of(&channels, &id, None));
                let split = with_directions(id.clone());
                results.push(ResultFile::of(&channels, &split, described.as_ref()));
            }
        }
    }
    results
}

fn with_directions(mut id: Identified) -> Identified {
    let estimate = Estimate { value: 1.0, std: 0.1 };
    let line = |shape| FrictionLine {
        coulomb: estimate,
        viscous: estimate,
        correlation: -0.8,
        points: 3,
        speeds: 3,
        shape,
        slowest: Some(estimate),
    };
    id.constant_velocity = Some(ConstantVelocity {
        coulomb: Some(estimate),
        offset: Some(estimate),
        viscous: Some(estimate),
        forward: Ok(line(LineShape::Concave { standard_errors: 4.0 })),
        backward: Ok(line(LineShape::Straight)),
        points: vec![SteadyPoint {
            run: 0,
            start_s: 0.0,
            end_s: 1.0,
            velocity: estimate,
            command: estimate,
        }],
    });
    id.unused_torque = Some(UnusedTorque { line: 0.05, model: 0.02 });
    if let Some(law) = &mut id.friction_law {
        let terms = [
            LawTerm::NearRest { speed: 0.1, falloff: Falloff::Gaussian },
            LawTerm::Root,
            LawTerm::TorqueRipple { per_angle: 12.0 },
        ];
        law.chosen.terms = terms.map(|term| (term, vec![estimate])).to_vec();
        let tried = law.candidates[0];
        let tried_terms = terms.map(ModelTerm::Law).into_iter();
        let all = tried_terms.chain([ModelTerm::Missing(MissingKind::WithTorque)]);
        law.candidates = all.map(|term| LawCandidate { term, ..tried }).collect();
    }
    let falloff = Falloff::Exponential;
    let ripple = RippleEstimate { torque: estimate, per_angle: estimate, phase_rad: 0.5 };
    id.friction.law = Some(LawEstimates {
        coulomb: Some(estimate),
        forward: Some(estimate),
        backward: Some(estimate),
        viscous: Some(estimate),
        viscous_by_direction: Some((estimate, estimate)),
        near_rest: Some(NearRestEstimate {
            torque: estimate,
            at_rest: estimate,
            speed: estimate,
            falloff,
        }),
        root: Some(estimate),
        with_load: Some(estimate),
        ripples: vec![ripple],
        torque_ripples: vec![ripple],
    });
    if let Some(found) = &mut id.arm {
        found.coupling_alone_nm_per_rad = vec![estimate.value];
        found.arm.dry_terms = DryTerms {
            near_rest: Some(NearRest {
                torque_nm: 0.1,
                offset_nm: 0.0,
                speed_rad_s: 0.2,
                falloff: Falloff::Exponential,
            }),
            ripples: vec![Ripple { per_rad: 9.0, cosine_nm: 0.1, sine_nm: 0.0 }],
            root: Some(Root { torque_nm_per_root_rad_s: 0.2 }),
            with_load: Some(WithLoad {
                coefficient: 0.05,
                load: GravityLoad { sine_nm: 1.5, cosine_nm: -0.4 },
            }),
        };
        found.arm.torque_ripples =
            vec![TorqueRipple { per_rad: 12.0, cosine_nm: 0.05, sine_nm: 0.02 }];
    }
    if let Some(verdict) = &mut id.separability {
        verdict.run_to_add = Some(RunToAdd {
            motion: PlannedMotion::Sine { omega_rad_s: 2.0 },
            amplitude_rad: 0.3,
            record_s: 20.0,
            parameter: ArmParameter::Viscous,
            std_now: 0.1,
            std_then: 0.02,
        });
    }
    id
}

#[test]
fn a_result_and_its_schema_name_the_same_keys() {
    let mut check = SchemaCheck::new(
        include_str!("../../../docs/src/reference/schemas/result.schema.json"),
        "result",
    );
    for result in results() {
        let json = serde_json::to_value(&result).unwrap();
        check.look_at(&json);
        // What was written is read back, every key of it.
        let read: ResultFile = serde_json::from_value(json.clone()).unwrap();
        assert_eq!(read, result);
        assert_eq!(serde_json::to_string(&read).unwrap(), json.to_string());
    }
    // What may be null is not: its keys were looked at too.
    check.holds(&[
        "verdict.directions[].parts[].share_of_variance",
        "verdict.runs[].parameters[].std_growth_without",
        "verdict.run_to_add.record_s",
        "arm.modes[].damping_within_per_s",
        "arm.tips[].shape",
        "methods.third_harmonic.fit.weighted_rms",
        "methods.regression.beam.modes",
        "methods.friction_law.candidates[].standard_errors",
        "friction.curve[].windows",
        "friction.law.near_rest",
        "friction.law.ripples",
        "friction.law.torque_ripples",
        "arm.near_rest",
        "arm.ripples",
        "arm.root",
        "arm.with_load.coefficient",
        "arm.torque_ripples",
        "methods.constant_velocity.lines[].standard_errors",
        "methods.constant_velocity.points[].start_s",
        "models.from",
        "models.motor.den",
        "models.state_space.outputs",
        "runs[].stuck_share",
        "findings[].code",
    ]);
}

/// An arm with every term is the same after it is written and read.
#[test]
fn the_arm_of_a_result_is_read_as_it_was_written() {
    let campaign = campaign();
    let mut id = identify(&campaign, &Options::default(), |_| ()).unwrap();
    id = with_directions(id);
    let found = id.arm.as_mut().unwrap();
    found.coupling_alone_nm_per_rad.clear();
    let written = found.arm.clone();
    let text = serde_json::to_string(&ResultFile::of(&campaign.channels, &id, None)).unwrap();
    let read = arm_of_text("result.json", &text, &campaign.channels).unwrap().arm;
    assert_eq!(read.dry_terms.root, written.dry_terms.root);
    assert_eq!(read.dry_terms.with_load, written.dry_terms.with_load);
    assert_eq!(read.torque_ripples, written.torque_ripples);
    // Without these terms they are null or empty.
    let arm = &mut id.arm.as_mut().unwrap().arm;
    (arm.dry_terms, arm.torque_ripples) = (DryTerms::default(), Vec::new());
    let json = serde_json::to_value(ResultFile::of(&campaign.channels, &id, None)).unwrap();
    assert_eq!(json["arm"]["root"], serde_json::Value::Null);
    assert_eq!(json["arm"]["with_load"], serde_json::Value::Null);
    assert_eq!(json["arm"]["torque_ripples"], serde_json::json!([]));
}
