//! Writes the experiments that `cargo xtask external` gives to other simulators, and what lissom
//! makes of them: `cargo run --release -p lissom-core --example external -- FOLDER`.
//!
//! `experiments.json` has each arm by its dimensions, the loop, and lissom's time; `NAME.csv` has the
//! trajectory, a row a sample: current \[A\], angles and speeds \[rad, rad/s\] as the state has them.
#![expect(clippy::unwrap_used, reason = "the models are fixed and valid")]

use std::{env, fmt::Write, fs, hint::black_box, path::Path, time::Instant};

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::Coulomb;
use lissom::rig::{ControlLaw, HeldArm, HeldMotion, Motion, Rig};
use lissom_testmodels::{report_arm, report_rig};
use serde_json::json;

const SAMPLES: usize = 20_000;
/// A run is shorter than the slices that a busy machine deals out: the median of many is undisturbed.
const REPEATS: usize = 51;

struct Experiment {
    name: &'static str,
    arm: Arm,
    amplitude_rad: f64,
    omega_rad_s: f64,
}

/// The loop on `A·sin(ω·t)` from rest with ideal sensors: what each sample calls for, and the state
/// there. All that touches the rig's interface is here.
fn run(rig: &Rig, e: &Experiment) -> Vec<(f64, Vec<f64>)> {
    let t = rig.instruments.sample_time_s;
    let (p, d, limit) = gains(rig);
    let held = HeldArm::new(&e.arm, &[t]).unwrap().unwrap();
    let mut motion = HeldMotion::at_rest(&held);
    let mut before = 0.0;
    let mut log = Vec::with_capacity(SAMPLES);
    for k in 0..SAMPLES {
        let state = motion.state().to_vec();
        let error = e.amplitude_rad * (e.omega_rad_s * (k as f64 * t)).sin() - state[0];
        let current = (p * error + d * (error - before) / t).clamp(-limit, limit);
        before = error;
        log.push((current, state));
        motion.advance(e.arm.motor.torque_constant_nm_per_a() * current, t).unwrap();
    }
    log
}

/// The same without a log, as the others' steps are timed; gives the last angle.
fn timed(rig: &Rig, e: &Experiment) -> f64 {
    let t = rig.instruments.sample_time_s;
    let (p, d, limit) = gains(rig);
    let held = HeldArm::new(&e.arm, &[t]).unwrap().unwrap();
    let mut motion = HeldMotion::at_rest(&held);
    let (mut before, rate) = (0.0, d / t);
    for k in 0..SAMPLES {
        let error =
            e.amplitude_rad * (e.omega_rad_s * (k as f64 * t)).sin() - motion.motor_angle_rad();
        let current = (p * error + rate * (error - before)).clamp(-limit, limit);
        before = error;
        motion.advance(e.arm.motor.torque_constant_nm_per_a() * current, t).unwrap();
    }
    motion.motor_angle_rad()
}

/// Of the report's loop: proportional \[A/rad\], derivative \[A·s/rad\], limit \[A\].
fn gains(rig: &Rig) -> (f64, f64, f64) {
    let ControlLaw::Pd(pd) = &rig.controller else { panic!("the report has a PD loop") };
    let limit = rig.instruments.amplifier.most_a();
    (pd.proportional_a_per_rad(), pd.derivative_a_s_per_rad(), limit)
}

fn experiments() -> Vec<Experiment> {
    let one = report_arm();
    let ampere = one.motor.torque_constant_nm_per_a();
    let coulomb = Coulomb::by_direction(0.16 * ampere, 0.10 * ampere).unwrap();
    let uneven = Arm::new(one.beam().clone(), one.motor, coulomb).unwrap();
    // [Feliu1989, 6.3]: two masses 6 in apart on 0.047 in wire; motor and air table as in 6.2.
    let first = one.beam().spans()[0];
    let span = Span {
        length_m: 6.0 * 0.0254,
        flexural_rigidity_n_m2: first.flexural_rigidity_n_m2 * (0.047_f64 / 0.032).powi(4),
        ..first
    };
    let two = Arm::new(LumpedBeam::new(&[span, span]).unwrap(), one.motor, one.coulomb).unwrap();
    let make = |name, arm: &Arm, amplitude_rad, omega_rad_s| Experiment {
        name,
        arm: arm.clone(),
        amplitude_rad,
        omega_rad_s,
    };
    vec![
        make("one mass, slow", &one, 0.5, 3.0),
        make("one mass, fast", &one, 0.2, 9.0),
        make("one mass, uneven friction", &uneven, 0.5, 3.0),
        make("two masses", &two, 0.5, 3.0),
    ]
}

fn main() {
    let folder = env::args().nth(1).unwrap();
    let folder = Path::new(&folder);
    let rig = report_rig(None);
    let (p, d, limit) = gains(&rig);
    let mut written = Vec::new();
    for e in experiments() {
        let mut times: Vec<f64> = (0..REPEATS)
            .map(|_| {
                let start = Instant::now();
                black_box(timed(&rig, &e));
                start.elapsed().as_secs_f64()
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let mut rows = String::new();
        for (current, state) in run(&rig, &e) {
            let numbers: Vec<String> =
                std::iter::once(&current).chain(&state).map(f64::to_string).collect();
            writeln!(rows, "{}", numbers.join(",")).unwrap();
        }
        fs::write(folder.join(format!("{}.csv", e.name)), rows).unwrap();
        let spans = e.arm.beam().spans();
        written.push(json!({
            "name": e.name,
            "spans": spans.iter().map(|s| json!({
                "length_m": s.length_m,
                "flexural_rigidity_n_m2": s.flexural_rigidity_n_m2,
                "mass_kg": s.mass_kg,
                "damping_n_s_per_m": s.damping_n_s_per_m,
            })).collect::<Vec<_>>(),
            "inertia_kg_m2": e.arm.motor.inertia_kg_m2(),
            "viscous_nm_s_per_rad": e.arm.motor.viscous_nm_s_per_rad(),
            "torque_constant_nm_per_a": e.arm.motor.torque_constant_nm_per_a(),
            "forward_nm": e.arm.coulomb.forward(),
            "backward_nm": e.arm.coulomb.backward(),
            "proportional_a_per_rad": p,
            "derivative_a_s_per_rad": d,
            "limit_a": limit,
            "sample_time_s": rig.instruments.sample_time_s,
            "samples": SAMPLES,
            "amplitude_rad": e.amplitude_rad,
            "omega_rad_s": e.omega_rad_s,
            "lissom_s": times[REPEATS / 2],
        }));
    }
    fs::write(folder.join("experiments.json"), json!(written).to_string()).unwrap();
}
