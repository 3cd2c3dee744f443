//! What is known of a virtual campaign beside its logs: `rig.json`.

use lissom::beam::Base;
use lissom::rig::{JointFriction, Logged, Rig, RigFinding};
use lissom_io::{PlanFile, PlanRun};
use serde_json::{Value, json};

/// One run.
pub(crate) fn run(run: &PlanRun, logged: &Logged) -> Value {
    // JSON has no infinity: what nothing bounds is null.
    let finite = |v: Option<f64>| v.filter(|v| v.is_finite());
    let findings: Vec<Value> = logged
        .findings
        .iter()
        .map(|f| json!({ "code": code(f), "message": f.to_string() }))
        .collect();
    json!({
        "file": format!("{}.csv", run.name),
        "samples": logged.run.len(),
        "sample_time_s": logged.run.sample_time_s(),
        "omega_rad_s": run.omega_rad_s,
        "seed": run.seed.to_string(),
        "waited_s": logged.settled.waited_s,
        "transient_left_rad": finite(logged.settled.left_rad),
        "transient_allowed_rad": finite(logged.settled.tolerance_rad),
        "stuck_share": logged.stuck_share,
        "findings": findings,
    })
}

fn code(finding: &RigFinding) -> &'static str {
    match finding {
        RigFinding::NotSettled { .. } => "not_settled",
        RigFinding::CurrentLimited { .. } => "current_limited",
        RigFinding::NeverMoved { .. } => "never_moved",
        RigFinding::SensorRange { .. } => "sensor_range",
        RigFinding::CurrentBetweenSamples { .. } => "current_between_samples",
        _ => "other",
    }
}

/// The campaign, and the truth that identification is to find.
pub(crate) fn campaign(rig: &Rig, plan: &PlanFile, runs: &[Value]) -> Value {
    let (arm, motor) = (&rig.arm, &rig.arm.motor);
    let (sliding, rest) = match &rig.scene.friction {
        JointFriction::Dry(law) => (law.sliding(), law.at(0.0, 0.0)),
        JointFriction::Bristles { law, .. } => (law.coulomb(), law.at_rest()),
        _ => (arm.coulomb, arm.coulomb),
    };
    json!({
        "lissom": env!("CARGO_PKG_VERSION"),
        "title": plan.title,
        "seed": plan.seed.to_string(),
        "tolerance": rig.scene.tolerance(),
        "masses": arm.beam().len(),
        "truth": {
            "inertia_kg_m2": motor.inertia_kg_m2,
            "viscous_nm_s_per_rad": motor.viscous_nm_s_per_rad,
            "torque_constant_nm_per_a": motor.torque_constant_nm_per_a,
            "forward_nm": sliding.forward,
            "backward_nm": sliding.backward,
            "rest_forward_nm": rest.forward,
            "rest_backward_nm": rest.backward,
            "coupling_nm_per_rad": arm.dynamics().coupling_motor,
            "natural_frequencies_rad_s": arm.beam().frequencies_rad_s(Base::Clamped, usize::MAX),
        },
        "runs": runs,
    })
}
