//! An experiment on a virtual rig whose joint sticks and slips, and what can be found from its logs.
//!
//! `cargo run --release -p lissom --example 2_virtual_experiment`
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use lissom::prelude::*;

fn main() -> Result<(), lissom::Error> {
    let arm = Arm::builder()
        .span(Span::new(0.25, 0.02).mass_kg(0.05)) // m, N·m², kg
        .motor(Motor::builder().inertia_kg_m2(2e-3).torque_constant_nm_per_a(0.2))
        .coulomb_nm(0.02)
        .build()?;
    let true_coulomb_nm = arm.coulomb.forward();
    let rig = Rig::builder(arm)
        .sample_time_s(3e-3)
        .encoder_bits(12)
        .noise_rad(2e-4)
        .current_limit_a(4.0)
        .controller(Pd::new(8.0, 0.25)?) // A/rad, A·s/rad
        .build()?;

    // Sines at ω and 3ω, as the third-harmonic method needs them: rad/s, rad, s.
    let sines = [1.0, 3.0, 2.0, 6.0].map(|omega| Experiment::sine(omega, 0.5, 20.0));
    let logs = rig.campaign(sines)?;
    for one in &logs.logged {
        let (name, stuck) = (one.run.name(), 100.0 * one.stuck_share);
        println!(
            "{name}: {} samples, the joint sticks for {stuck:.1} % of the time",
            one.run.len()
        );
    }

    let found = Identify::new(&logs).run()?;
    println!("\n{found}");
    println!("\nthe true Coulomb friction is {true_coulomb_nm} N·m");
    Ok(())
}
