//! Trial.
use lissom::identify::*;
use lissom::record::*;
use lissom::replay::*;
use lissom::rig::*;
use lissom_testmodels::*;
fn main() {
    let arg = |i: usize, d: f64| std::env::args().nth(i).map_or(d, |s| s.parse::<f64>().unwrap());
    let bits = arg(1, 12.0) as u32;
    let noise_lsb = arg(2, 0.0);
    let trials = arg(3, 40.0) as u64;
    let block_s = arg(4, 0.1);
    let truth = ModalArm::of_arm(&report_arm()).unwrap();
    let free = vec![
        Parameter::Inertia,
        Parameter::Viscous,
        Parameter::Coulomb,
        Parameter::Offset,
        Parameter::Frequency(0),
        Parameter::Stiffness(0),
        Parameter::DampingGrounded(0),
    ];
    let mut z: Vec<Vec<[f64; 4]>> = vec![vec![]; free.len()];
    for trial in 0..trials {
        let mut seed = trial * 7919 + 13;
        let mut rnd = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1u64 << 31) as f64
        };
        let mut rig = report_rig(Some(bits));
        let q = std::f64::consts::TAU / f64::from(2u32.pow(bits));
        if noise_lsb > 0.0 {
            rig.instruments.motor.noise = Some(Noise::new(noise_lsb * q).unwrap());
            for t in &mut rig.instruments.tips {
                t.noise = rig.instruments.motor.noise;
            }
        }
        let amp = 0.3 + 0.3 * rnd();
        let runs: Vec<Run> = (0..8)
            .map(|i| {
                let w = [0.8, 1.2, 2.2, 3.6, 4.5, 10.0, 14.0, 19.0][i] * (1.0 + 0.1 * rnd());
                let e =
                    Experiment::sine(w, amp, 12.0).unwrap().settling(Settle::Wait { wait_s: 10.0 });
                rig.run(&format!("{w}"), &e, trial * 100 + i as u64)
                    .unwrap()
                    .run
                    .with_omega(w)
                    .unwrap()
            })
            .collect();
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Sampled,
            torque_per_command: Some(report_arm().motor.torque_constant_nm_per_a),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let channels = Channels {
            axis: Axis::Rotary,
            command,
            tips: vec![Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true }],
        };
        let omega_rad_s: Vec<Option<f64>> = runs.iter().map(|r| r.omega_rad_s()).collect();
        let campaign = Campaign::new(channels, runs).unwrap();
        let t = std::time::Instant::now();
        let mut start = OutputErrorStart { arm: truth.clone(), omega_rad_s, first_window_s: None };
        if block_s > 0.2 {
            for (i, p) in free.iter().enumerate() {
                let v = p.of(&truth)
                    * if (i as u64 + trial) % 2 == 0 { block_s } else { 1.0 / block_s };
                p.set(&mut start.arm, v);
            }
            start.first_window_s = Some(0.12);
        }
        let oe = output_error(&campaign, &start).unwrap();
        if trial < 3 {
            for e in &oe.extensions {
                println!("{e:?}");
            }
        }
        if trial < 4 {
            println!(
                "{:?} {:?}",
                t.elapsed(),
                oe.stages
                    .iter()
                    .map(|s| (s.iterations.len(), s.stop, s.window_s, s.residual.clone()))
                    .collect::<Vec<_>>()
            );
        }
        for (i, p) in free.iter().enumerate() {
            let e = p.of(&oe.arm) - p.of(&truth);
            z[i].push([
                e,
                {
                    let i = oe.parameters.iter().position(|q| q == p);
                    i.map_or(f64::NAN, |i| oe.covariance[(i, i)].sqrt())
                },
                {
                    let i = oe.parameters.iter().position(|q| q == p);
                    i.map_or(f64::NAN, |i| oe.white[(i, i)].sqrt())
                },
                {
                    let i = oe.parameters.iter().position(|q| q == p);
                    i.map_or(f64::NAN, |i| oe.blocks[(i, i)].sqrt())
                },
            ]);
        }
    }
    for (i, p) in free.iter().enumerate() {
        let rms =
            |k: usize| (z[i].iter().map(|v| v[k] * v[k]).sum::<f64>() / z[i].len() as f64).sqrt();
        let zz = |k: usize| {
            (z[i].iter().map(|v| (v[0] / v[k]).powi(2)).sum::<f64>() / z[i].len() as f64).sqrt()
        };
        let cover = |k: usize| {
            z[i].iter().filter(|v| v[0].abs() < 1.96 * v[k]).count() as f64 / z[i].len() as f64
        };
        println!(
            "{:22} error rms {:.3e} ({:.5} %) std {:.2e} white {:.2e} blocks {:.2e} | z {:.2} white {:.2} blocks {:.2} | cover {:.3} {:.3} {:.3}",
            format!("{p:?}"),
            rms(0),
            100.0 * rms(0) / p.of(&truth).abs().max(1e-9),
            rms(1),
            rms(2),
            rms(3),
            zz(1),
            zz(2),
            zz(3),
            cover(1),
            cover(2),
            cover(3)
        );
    }
}
