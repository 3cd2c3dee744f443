//! Which runs are worth making? From rough numbers of an arm to the runs, and what they give.
//!
//! `cargo run --release -p lissom --example 4_planning`
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use lissom::plan::{Kinds, Precision, Wishes, plan};
use lissom::prelude::*;

fn main() -> Result<(), lissom::Error> {
    // Half of these numbers may be wrong by a third: the plan needs their sizes.
    let rough = Arm::builder()
        .span(Span::new(0.25, 0.02).mass_kg(0.05))
        .motor(
            Motor::builder()
                .inertia_kg_m2(2e-3)
                .viscous_nm_s_per_rad(1e-3)
                .torque_constant_nm_per_a(0.2),
        )
        .coulomb_nm(0.02)
        .build()?;
    let rig = Rig::builder(rough)
        .sample_time_s(4e-3)
        .encoder_bits(12)
        .noise_rad(5e-4)
        .current_limit_a(4.0)
        .controller(Pd::new(8.0, 0.25)?)
        .build()?;

    let wishes = Wishes { precision: Precision::all(0.01), kinds: Kinds::Any, ..Wishes::default() };
    let planned = plan(&rig, &wishes, |_tried, _all| ())?;
    println!("{planned}\n");

    // Make them, here on the virtual rig, and compare what was expected with what comes out.
    let experiments = planned
        .runs
        .iter()
        .map(|run| run.motion.experiment(run.amplitude_rad, run.record_s, planned.longest_wait_s));
    let found = Identify::new(&rig.campaign(experiments)?).run()?;
    println!("{found}");
    Ok(())
}
