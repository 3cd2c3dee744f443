//! A result as JSON.

use lissom::identify::{
    BeamRegression, Candidate, ConstantVelocity, FrictionLine, GeometryCheck, Identified,
    ModelSource, MotorFit, MotorRegression, OutputError, Response, ResponsePoint, RunAnalysis,
    RunKind, Shape, StageReport, Stop, ThirdHarmonic, TipModel,
};
use lissom::lti::TransferFunction;
use lissom::record::{Channels, Tip};
use lissom::replay::Parameter;
use serde_json::{Map, Value, json};

use super::estimate_json::{axis, figure, finding, mode, quantity, torque};
use super::unit_names::UnitNames;
use super::{equivalent_json, result_arm, result_friction_law, result_geometry, result_verdict};

/// The result as JSON, SI and rad/s throughout; with what the logs say of an arm's description, where one
/// lies beside them.
pub fn result_json(
    channels: &Channels,
    id: &Identified,
    described: Option<&GeometryCheck>,
) -> Value {
    let names = UnitNames::new(channels);
    let constant = id.torque_per_command.unwrap_or(1.0);
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "axis": axis(channels.axis),
        "torque_per_command": id.torque_per_command,
        "friction": friction(names, constant, id),
        "drive": { (names.inertia_key()): figure(id.inertia) },
        "beam": beam(names, id),
        "verdict": id.separability.as_ref().map(|s| result_verdict::verdict(channels.axis, names, s)),
        "arm": id.arm.as_ref().map(|found| result_arm::arm(channels, names, found)),
        "methods": {
            "third_harmonic": id.third_harmonic.as_ref().map(|t| third(names, constant, t, &id.runs)),
            "output_error": id.output_error.as_ref().map(|o| replay(names, constant, channels, o)),
            "regression": id.regression.as_ref().map(|r| {
                regression(names, constant, r, id.beam_regression.as_ref())
            }),
            "friction_law": id.friction_law.as_ref().map(|l| result_friction_law::law(names, constant, l)),
            "constant_velocity": id.constant_velocity.as_ref().map(|c| {
                classical(names, constant, c, &id.runs)
            }),
        },
        "frequency_response": responses(channels, id),
        "models": models(channels, id),
        "geometry": described.map(result_geometry::geometry),
        "equivalent": id.equivalent.as_ref().map(|e| equivalent_json::equivalent(names, e)),
        "runs": id.runs.iter().map(run).collect::<Vec<_>>(),
        "findings": id.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}

fn friction(names: UnitNames, constant: f64, id: &Identified) -> Value {
    let f = &id.friction;
    let mut map = Map::new();
    torque(&mut map, names, constant, "coulomb", f.coulomb);
    torque(&mut map, names, constant, "forward", f.forward);
    torque(&mut map, names, constant, "backward", f.backward);
    torque(&mut map, names, constant, "offset", f.offset);
    map.insert(names.viscous_key("viscous"), figure(f.viscous));
    if let Some((forward, backward)) = f.viscous_by_direction {
        map.insert(names.viscous_key("viscous_forward"), figure(Some(forward)));
        map.insert(names.viscous_key("viscous_backward"), figure(Some(backward)));
    }
    result_friction_law::terms(&mut map, names, constant, f);
    let curve = id.friction_law.as_ref().map_or(&[][..], |law| &law.curve);
    map.insert("curve".to_owned(), result_friction_law::curve(names, constant, curve));
    Value::Object(map)
}

fn beam(names: UnitNames, id: &Identified) -> Value {
    let by_tip: Vec<Value> = id.beam.coupling_by_tip.iter().map(|e| figure(*e)).collect();
    json!({
        "modes": id.beam.modes.iter().map(mode).collect::<Vec<_>>(),
        (names.coupling_key("coupling")): figure(id.beam.coupling),
        (names.coupling_key("coupling_by_tip")): by_tip,
    })
}

fn fit(names: UnitNames, m: &MotorFit) -> Value {
    json!({
        (names.inertia_key()): figure(Some(m.inertia)),
        (names.viscous_key("viscous")): figure(Some(m.viscous)),
        (names.coupling_key("coupling_by_mode")):
            m.coupling.iter().map(|c| figure(Some(*c))).collect::<Vec<_>>(),
        "motor": transfer_function(&m.transfer_function),
        "weighted_rms": m.weighted_rms,
    })
}

fn third(names: UnitNames, constant: f64, t: &ThirdHarmonic, runs: &[RunAnalysis]) -> Value {
    let mut map = Map::new();
    torque(&mut map, names, constant, "coulomb", Some(t.coulomb_command.scaled(constant)));
    map.insert(format!("spread_{}", names.command()), json!(t.spread_command));
    let pairs: Vec<Value> = t
        .pairs
        .iter()
        .zip(&t.used)
        .map(|(p, used)| {
            json!({
                "omega_rad_s": p.omega_rad_s,
                "run": runs[p.run].name,
                "triple_run": runs[p.triple_run].name,
                (format!("coulomb_{}", names.command())): figure(Some(p.coulomb_command)),
                "cost": p.cost,
                "used": used,
            })
        })
        .collect();
    map.insert("pairs".to_owned(), Value::Array(pairs));
    map.insert("fit".to_owned(), t.motor.as_ref().map_or(Value::Null, |m| fit(names, m)));
    Value::Object(map)
}

fn candidates(list: &[Candidate]) -> Vec<Value> {
    list.iter()
        .map(|c| {
            json!({
                "window_s": c.window_s,
                "rows": c.rows,
                "phases": c.clusters,
                "relative_residual": c.relative_residual,
                "sensitivity": Some(c.sensitivity).filter(|s| s.is_finite()),
            })
        })
        .collect()
}

fn regression(
    names: UnitNames,
    constant: f64,
    r: &MotorRegression,
    beam: Option<&BeamRegression>,
) -> Value {
    let mut map = Map::new();
    torque(&mut map, names, constant, "coulomb", r.coulomb);
    torque(&mut map, names, constant, "forward", r.forward);
    torque(&mut map, names, constant, "backward", r.backward);
    torque(&mut map, names, constant, "offset", r.offset);
    map.insert(names.viscous_key("viscous"), figure(r.viscous));
    map.insert(names.inertia_key(), figure(r.inertia));
    let coupling: Vec<Value> = r.coupling.iter().map(|e| figure(*e)).collect();
    map.insert(names.coupling_key("coupling_by_tip"), Value::Array(coupling));
    let split = r.viscous_by_direction.map(|d| {
        json!({
            (names.viscous_key("forward")): figure(Some(d.forward)),
            (names.viscous_key("backward")): figure(Some(d.backward)),
            (format!("offset_{}", names.torque())): figure(Some(d.offset)),
            "relative_residual": d.relative_residual,
        })
    });
    map.insert("viscous_by_direction".to_owned(), split.unwrap_or(Value::Null));
    map.insert("window_s".to_owned(), json!(r.window_s));
    map.insert("window_given".to_owned(), json!(r.window_given));
    map.insert("rows".to_owned(), json!(r.rows));
    map.insert("phases".to_owned(), json!(r.phases));
    map.insert("relative_residual".to_owned(), json!(r.relative_residual));
    map.insert("candidates".to_owned(), json!(candidates(&r.candidates)));
    let beam = beam.map(|b| {
        json!({
            "modes": b.modes.iter().map(mode).collect::<Vec<_>>(),
            "window_s": b.window_s,
            "relative_residual": b.relative_residual,
        })
    });
    map.insert("beam".to_owned(), beam.unwrap_or(Value::Null));
    Value::Object(map)
}

fn replay(names: UnitNames, constant: f64, channels: &Channels, oe: &OutputError) -> Value {
    let mut map = Map::new();
    let friction = oe.friction(channels.command.back_emf_viscous);
    torque(&mut map, names, constant, "coulomb", friction.coulomb);
    torque(&mut map, names, constant, "forward", friction.forward);
    torque(&mut map, names, constant, "backward", friction.backward);
    torque(&mut map, names, constant, "offset", friction.offset);
    map.insert(names.viscous_key("viscous"), figure(friction.viscous));
    map.insert(names.inertia_key(), figure(oe.inertia()));
    let beam = oe.beam(channels);
    map.insert(names.coupling_key("coupling"), figure(beam.coupling));
    map.insert("modes".to_owned(), json!(beam.modes.iter().map(mode).collect::<Vec<_>>()));
    let lag = oe.estimate(Parameter::CommandLag);
    map.insert("command_lag_s".to_owned(), figure(lag));
    let tips = 0..channels.tips.len();
    let lags = tips.map(|i| figure(oe.estimate(Parameter::TipLag(i))));
    map.insert("tip_lags_s".to_owned(), lags.collect());
    map.insert("whole_runs".to_owned(), json!(oe.whole_runs));
    let stages: Vec<Value> = oe.stages.iter().map(stage).collect();
    map.insert("stages".to_owned(), Value::Array(stages));
    let tried: Vec<Value> = oe
        .extensions
        .iter()
        .map(|e| {
            json!({
                "parameter": e.parameter.name(),
                "value": e.value,
                "std": e.std,
                "share_of_cost": e.share,
                "added": e.added,
            })
        })
        .collect();
    map.insert("tried".to_owned(), Value::Array(tried));
    Value::Object(map)
}

fn stage(s: &StageReport) -> Value {
    let stop = match s.stop {
        Stop::Converged => "converged",
        Stop::NoStepHelps => "no-step-helps",
        Stop::StepsUsedUp => "steps-used-up",
    };
    json!({
        "window_s": s.window_s,
        "windows": s.windows,
        "cost": s.iterations.iter().map(|i| i.cost).collect::<Vec<_>>(),
        "steps_taken": s.iterations.iter().filter(|i| i.taken).count(),
        "stop": stop,
        "noise_sigma": s.noise.iter().map(|n| n.sigma).collect::<Vec<_>>(),
        "noise_step": s.noise.iter().map(|n| n.step).collect::<Vec<_>>(),
        "residual_std": s.residual,
    })
}

fn classical(names: UnitNames, constant: f64, c: &ConstantVelocity, runs: &[RunAnalysis]) -> Value {
    let mut map = Map::new();
    let forward = c.forward.as_ref().ok();
    let backward = c.backward.as_ref().ok();
    torque(&mut map, names, constant, "coulomb", c.coulomb);
    torque(&mut map, names, constant, "forward", forward.map(|l| l.coulomb));
    torque(&mut map, names, constant, "backward", backward.map(|l| l.coulomb));
    torque(&mut map, names, constant, "offset", c.offset);
    map.insert(names.viscous_key("viscous"), figure(c.viscous));
    let lines: Vec<Value> = c.lines().map(|(name, l)| line(names, constant, name, l)).collect();
    map.insert("lines".to_owned(), Value::Array(lines));
    let points: Vec<Value> = c
        .points
        .iter()
        .map(|p| {
            json!({
                "run": runs[p.run].name,
                "direction": if p.velocity.value > 0.0 { "forward" } else { "backward" },
                "start_s": p.start_s,
                "end_s": p.end_s,
                (format!("velocity_{}_per_s", names.angle())): figure(Some(p.velocity)),
                (format!("command_{}", names.command())): figure(Some(p.command)),
            })
        })
        .collect();
    map.insert("points".to_owned(), Value::Array(points));
    Value::Object(map)
}

fn line(names: UnitNames, constant: f64, direction: &str, l: &FrictionLine) -> Value {
    let (shape, deviations) = match l.shape {
        Shape::Unchecked => ("unchecked", None),
        Shape::Straight => ("straight", None),
        Shape::Concave { deviations } => ("concave", Some(deviations)),
        Shape::Convex { deviations } => ("convex", Some(deviations)),
        Shape::Scattered { rms } => ("scattered", Some(rms)),
    };
    let mut map = Map::new();
    map.insert("direction".to_owned(), json!(direction));
    torque(&mut map, names, constant, "coulomb", Some(l.coulomb));
    map.insert(names.viscous_key("viscous"), figure(Some(l.viscous)));
    map.insert("correlation".to_owned(), json!(l.correlation));
    map.insert("points".to_owned(), json!(l.points));
    map.insert("speeds".to_owned(), json!(l.speeds));
    map.insert("shape".to_owned(), json!(shape));
    map.insert("deviations".to_owned(), json!(deviations));
    torque(&mut map, names, constant, "slowest", l.slowest);
    Value::Object(map)
}

/// Complex series as parallel lists, `null` where a point has none.
fn series(points: &[ResponsePoint], get: impl Fn(&ResponsePoint) -> Option<Response>) -> Value {
    let list = |part: fn(&Response) -> f64| -> Vec<Option<f64>> {
        points.iter().map(|p| get(p).map(|r| part(&r))).collect()
    };
    json!({ "re": list(|r| r.value.re), "im": list(|r| r.value.im), "std": list(|r| r.std) })
}

fn responses(channels: &Channels, id: &Identified) -> Value {
    let points = &id.responses;
    let tips: Vec<Value> = channels
        .tips
        .iter()
        .enumerate()
        .map(|(i, tip)| {
            let mut value = series(points, |p| p.tips.get(i).copied().flatten());
            value["name"] = json!(tip.name);
            value["quantity"] = json!(quantity(tip.quantity));
            value
        })
        .collect();
    json!({
        "omega_rad_s": points.iter().map(|p| p.omega_rad_s).collect::<Vec<_>>(),
        "run": points.iter().map(|p| p.run.map(|r| &id.runs[r].name)).collect::<Vec<_>>(),
        "flagged": points.iter().map(|p| p.flagged).collect::<Vec<_>>(),
        "vouched_for": points.iter().map(ResponsePoint::is_vouched_for).collect::<Vec<_>>(),
        "motor_raw": series(points, |p| Some(p.motor_raw)),
        "motor_corrected": series(points, |p| p.motor_corrected),
        "tips": tips,
    })
}

fn transfer_function(g: &TransferFunction) -> Value {
    json!({ "num": g.num, "den": g.den })
}

fn models(channels: &Channels, id: &Identified) -> Value {
    let models = &id.models;
    let tip = |(tip, model): (&Tip, &TipModel)| {
        let g = &model.function;
        json!({ "name": tip.name, "num": g.num, "den": g.den, "delay_s": model.delay_s })
    };
    let tips: Vec<Value> = channels.tips.iter().zip(&models.tips).map(tip).collect();
    json!({
        "from": match models.source {
            ModelSource::Arm => "arm",
            ModelSource::Responses => "responses",
        },
        "motor": models.motor.as_ref().map(transfer_function),
        "motor_delay_s": figure(models.motor_delay),
        "tips": tips,
        "state_space": models.state_space.as_ref().map(crate::model::state_space),
    })
}

fn run(r: &RunAnalysis) -> Value {
    let mut value = json!({
        "name": r.name,
        "samples": r.samples,
        "sample_time_s": r.sample_time_s,
        "kind": "general",
        "saturated_share": r.saturated_share,
        "usable": r.usable,
    });
    if r.is_constant_velocity() {
        value["kind"] = json!("constant_velocity");
    }
    if let RunKind::Sinusoidal(s) = &r.kind {
        value["kind"] = json!("sinusoidal");
        value["omega_rad_s"] = json!(s.omega_rad_s);
        value["omega_given"] = json!(s.omega_given);
        value["periods"] = json!(s.steady.periods);
        value["dropped_periods"] = json!(s.steady.dropped);
        value["stuck_share"] = json!(r.stuck_share);
    }
    value
}
