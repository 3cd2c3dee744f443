//! From dimensions to frequencies, zeros and a transfer function: the arm of two masses of Feliu et al. (1989), Section 6.3.
//!
//! `cargo run -p lissom --example 1_arm_from_dimensions`
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use lissom::prelude::*;

fn main() -> Result<(), lissom::Error> {
    let span = Span::new(0.1524, 0.020_622).mass_kg(0.054_885); // m, N·m², kg
    let arm = Arm::builder()
        .span(span)
        .span(span)
        .motor(Motor::builder().inertia_kg_m2(6.2e-4).torque_constant_nm_per_a(0.247))
        .coulomb_nm(0.033)
        .build()?;
    println!(
        "modes with the motor clamped [rad/s]: {:.3?}",
        arm.beam().natural_frequencies_rad_s()
    );

    // θ_2/i as a transfer function; a real pair of zeros means that a controller cannot invert it.
    if let Some(tip) = arm.angle_function(1) {
        println!("θ_2/i is minimum phase: {}", tip.minimum_phase());
        if let Some(function) = tip.transfer_function() {
            println!("numerator {:.4?}, denominator {:.4?}", function.num, function.den);
        }
    }
    let space = arm.state_space();
    println!("state space of {} states", space.a.nrows());

    // Another load at the tip moves the poles of the tip's response, and not its zeros.
    let beam = LumpedBeam::new(&[span, span])?;
    for times in [0.5, 1.0, 2.0, 5.0] {
        let loaded = beam.with_load_times(times)?;
        println!("load times {times}: modes {:.3?} rad/s", loaded.natural_frequencies_rad_s());
    }
    Ok(())
}
