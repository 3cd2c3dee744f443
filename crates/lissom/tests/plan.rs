//! Predicted against achieved: plan, make the runs on the rig, identify them.
#![expect(clippy::unwrap_used, reason = "tests")]

use lissom::arm::Arm;
use lissom::beam::{LumpedBeam, Span};
use lissom::drive::{Coulomb, Motor};
use lissom::identify::{Identified, Options, identify};
use lissom::plan::{Figure, Kinds, Plan, Wishes, plan};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, Tip, TipQuantity};
use lissom::rig::{Amplifier, Instruments, Noise, Pd, Quantiser, Rig, Sensor};

fn instruments(sample_time_s: f64, bits: u32, noise_steps: f64, limit_a: f64) -> Instruments {
    let quantiser = Quantiser::new(bits, std::f64::consts::TAU).unwrap();
    let noise = (noise_steps > 0.0).then(|| Noise::new(noise_steps * quantiser.step()).unwrap());
    let sensor = Sensor { noise, quantiser: Some(quantiser) };
    let mut instruments = Instruments::ideal(sample_time_s).unwrap();
    instruments.motor = sensor;
    instruments.tips = vec![sensor];
    instruments.amplifier = Amplifier::ideal().with_limit(limit_a).unwrap();
    instruments
}

fn report(noise: f64) -> Rig {
    let mut rig = lissom_testmodels::report_rig(Some(12));
    rig.instruments = instruments(0.003, 12, noise, 4.12);
    rig
}

fn two_masses(noise: f64) -> Rig {
    let span = |length_m, mass_kg| Span {
        length_m,
        flexural_rigidity_n_m2: 0.02,
        mass_kg,
        damping_n_s_per_m: 0.02 * mass_kg,
    };
    let beam = LumpedBeam::new(&[span(0.15, 0.06), span(0.15, 0.04)]).unwrap();
    let motor = Motor::new(8e-4, 2e-3, 0.3).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::by_direction(0.05, 0.04).unwrap()).unwrap();
    Rig::new(arm, instruments(0.002, 14, noise, 6.0), Pd::new(8.0, 0.15).unwrap().into())
}

fn rigid(noise: f64) -> Rig {
    let span = Span { length_m: 0.01, flexural_rigidity_n_m2: 1e-9, mass_kg: 1e-9, damping_n_s_per_m: 0.0 };
    let motor = Motor::new(2e-3, 0.01, 0.2).unwrap();
    let beam = LumpedBeam::new(&[span]).unwrap();
    let arm = Arm::new(beam, motor, Coulomb::symmetric(0.06).unwrap()).unwrap();
    Rig::new(arm, instruments(0.004, 13, noise, 5.0), Pd::new(8.0, 0.25).unwrap().into())
}

fn made(rig: &Rig, plan: &Plan, seed: u64, tips: bool) -> Campaign {
    let runs: Vec<Run> = plan
        .runs
        .iter()
        .enumerate()
        .map(|(i, r)| {
            let e = r.motion.experiment(r.amplitude_rad, r.record_s, plan.longest_wait_s).unwrap();
            let run = rig.run(&format!("{i}"), &e, 1000 * seed + i as u64).unwrap().run;
            if tips { run } else {
                Run::new(run.name(), run.time(), run.command().to_vec(), run.motor().to_vec(), vec![]).unwrap()
            }
        })
        .collect();
    let tip = |i: usize| Tip { name: format!("{i}"), quantity: TipQuantity::Angle, calibrated: true };
    let n = if tips { rig.arm.beam().len() } else { 0 };
    let channels = Channels {
        axis: Axis::Rotary,
        command: Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Sampled,
            torque_per_command: Some(rig.arm.motor.torque_constant_nm_per_a),
            back_emf_viscous: 0.0,
            limit: rig.instruments.amplifier.limit_a(),
        },
        tips: (0..n).map(tip).collect(),
    };
    Campaign::new(channels, runs).unwrap()
}

fn found(id: &Identified, figure: Figure) -> Option<lissom::identify::Estimate> {
    match figure {
        Figure::Coulomb => id.friction.coulomb,
        Figure::Viscous => id.friction.viscous,
        Figure::Inertia => id.inertia,
        Figure::Coupling => id.beam.coupling,
        Figure::Frequency(j) => id.beam.modes.get(j).map(|m| m.natural_frequency_rad_s),
        Figure::Damping(j) => id.beam.modes.get(j).map(|m| m.damping_ratio.scaled(2.0 * m.natural_frequency_rad_s.value)),
    }
}

#[test]
#[ignore]
fn explore() {
    let seeds: u64 = std::env::var("SEEDS").ok().and_then(|s| s.parse().ok()).unwrap_or(3);
    let noise: f64 = std::env::var("NOISE").ok().and_then(|s| s.parse().ok()).unwrap_or(0.5);
    for (name, rig, tips) in [("report", report(noise), true), ("two", two_masses(noise), true), ("rigid", rigid(noise), false)] {
        for kinds in [Kinds::Any, Kinds::WithPair, Kinds::Sines] {
            let t = std::time::Instant::now();
            let wishes = Wishes { kinds, ..Wishes::default() };
            let plan = plan(&rig, &wishes, |_, _| ()).unwrap();
            println!("=== {name} {kinds:?} {:.2?} total {:.1} s", t.elapsed(), plan.time_s);
            for r in &plan.runs {
                println!("  {:?} amp {} rec {:.1} wait {:.1} peak {:.2} stuck {:.3} moved {:.3} {:?}", r.motion, r.amplitude_rad, r.record_s, r.waited_s, r.peak_current_a, r.stuck_share, r.moved_rad, r.without.map(|(f, s)| (f.name(), s)));
            }
            for n in &plan.notes { println!("  note {n}"); }
            for (p, v, s) in &plan.parameters { print!("  {} {v:.4e} ± {s:.1e};", p.name()); }
            println!();
            let mut acc = vec![(0.0, 0.0, 0, 0); plan.expected.len()];
            for seed in 1..=seeds {
                let campaign = made(&rig, &plan, seed, tips);
                let t = std::time::Instant::now();
                let id = identify(&campaign, &Options::default(), |_| ()).unwrap();
                let el = t.elapsed();
                let oe = id.output_error.as_ref();
                println!("  seed {seed} identify {el:.1?} stands {:?} beyond {:?} free {:?} findings {:?}", oe.map(|o| o.stands()), oe.map(|o| o.beyond_noise), oe.map(|o| o.parameters.len()), id.findings.iter().map(|f| f.code).collect::<std::collections::BTreeSet<_>>());
                for (e, a) in plan.expected.iter().zip(&mut acc) {
                    match found(&id, e.figure) {
                        Some(f) => {
                            a.0 += ((f.value / e.value - 1.0) / e.std).powi(2);
                            a.1 += (f.std / e.value / e.std).powi(2);
                            a.2 += 1;
                        }
                        None => a.3 += 1,
                    }
                }
            }
            for (e, a) in plan.expected.iter().zip(&acc) {
                let n = f64::from(a.2);
                println!("  {:24} {:.4e} expected {:.4} % wanted {:.2} %  rms error/expected {:.2} stated/expected {:.2} refused {}", e.figure.name(), e.value, 100.0 * e.std, 100.0 * e.wanted, (a.0 / n).sqrt(), (a.1 / n).sqrt(), a.3);
            }
        }
    }
}
