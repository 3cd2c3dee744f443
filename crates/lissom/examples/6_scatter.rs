//! Many campaigns with other noise: do the estimates scatter as their standard errors say?
//!
//! `cargo run --release -p lissom --example 6_scatter -- 200`
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use std::time::Instant;

use lissom::prelude::*;

fn main() -> Result<(), lissom::Error> {
    let campaigns = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(50);
    let arm = Arm::builder()
        .motor(
            Motor::builder()
                .inertia_kg_m2(2e-3)
                .viscous_nm_s_per_rad(5e-3)
                .torque_constant_nm_per_a(0.2),
        )
        .coulomb_nm(0.02)
        .build()?;
    let rig = Rig::builder(arm)
        .sample_time_s(2e-3)
        .encoder_counts(1 << 20)
        .noise_rad(5e-4)
        .current_limit_a(5.0)
        .controller(Pd::new(4.0, 0.15)?) // A/rad, A·s/rad
        .build()?;

    let begin = Instant::now();
    let mut inertia = Vec::new();
    for seed in 0..campaigns {
        // Sines at ω and 3ω: rad/s, rad, s.
        let sines = [3.0, 9.0].map(|omega| Experiment::sine(omega, 0.5, 12.0));
        let logs = rig.campaign_from_seed(1000 * seed, sines)?;
        inertia.extend(Identify::new(&logs).effort(Effort::Quick).run()?.inertia());
    }
    let took_s = begin.elapsed().as_secs_f64();

    let count = inertia.len() as f64;
    let mean = inertia.iter().map(|e| e.value).sum::<f64>() / count;
    let scatter = (inertia.iter().map(|e| (e.value - mean).powi(2)).sum::<f64>() / count).sqrt();
    let stated = inertia.iter().map(|e| e.std).sum::<f64>() / count;
    println!("{} of {campaigns} campaigns give the inertia: {mean:.6e} kg·m²", inertia.len());
    println!("scatter {scatter:.2e} kg·m², mean of the standard errors {stated:.2e} kg·m²");
    println!("{took_s:.3} s");
    Ok(())
}
