//! A controller of your own in the virtual rig: PD with friction compensation by the sign of the reference's rate.
//!
//! `cargo run --release -p lissom --example 5_own_controller`
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use lissom::prelude::*;

struct Compensating {
    pd: Pd,
    friction_a: f64,
    last_rad: f64,
}

impl Controller for Compensating {
    fn current_a(&mut self, now: &Sensed<'_>) -> f64 {
        let rate = (now.reference_rad - self.last_rad) / now.period_s;
        self.last_rad = now.reference_rad;
        let ahead = if rate == 0.0 { 0.0 } else { self.friction_a * rate.signum() };
        self.pd.current_a(now) + ahead
    }

    fn reset(&mut self) {
        self.pd.reset();
        self.last_rad = 0.0;
    }
}

fn main() -> Result<(), lissom::Error> {
    let arm = Arm::builder()
        .motor(Motor::builder().inertia_kg_m2(2e-3).torque_constant_nm_per_a(0.2))
        .coulomb_nm(0.05)
        .build()?;
    let pd = Pd::new(8.0, 0.25)?; // A/rad, A·s/rad
    let rig = Rig::builder(arm).sample_time_s(2e-3).encoder_bits(14).controller(pd).build()?;
    let slow = Experiment::sine(1.0, 0.2, 20.0); // rad/s, rad, s

    let plain = rig.campaign([slow.clone()])?;
    let mut controller = Compensating { pd, friction_a: 0.05 / 0.2, last_rad: 0.0 };
    let compensated = rig.campaign_with(&mut controller, [slow])?;
    for (name, logs) in [("PD", &plain), ("PD with compensation", &compensated)] {
        let run = &logs.logged[0];
        let motor = run.run.motor();
        let error = motor.iter().enumerate().map(|(k, angle)| {
            let reference = 0.2 * (run.run.time().start_s + 2e-3 * k as f64).sin();
            (angle - reference).powi(2)
        });
        let rms_mrad = 1e3 * (error.sum::<f64>() / motor.len() as f64).sqrt();
        let stuck = 100.0 * run.stuck_share;
        println!(
            "{name}: error {rms_mrad:.2} mrad rms, the joint sticks for {stuck:.1} % of the time"
        );
    }
    Ok(())
}
