//! Your own log: arrays of time, current and angle become a campaign; a second log is predicted with the result.
//!
//! `cargo run --release -p lissom --example 3_own_log`. For files use `read_campaign("campaign.toml".as_ref())?`.
#![expect(clippy::print_stdout, reason = "an example shows what it finds")]

use lissom::identify::Severity;
use lissom::prelude::*;

const SAMPLE_TIME_S: f64 = 1e-3;
const NM_PER_A: f64 = 0.12;

/// What a drive logged: current and angle. Here both are computed, of a sweep from 1 to 13 rad/s.
fn log(amplitude_rad: f64) -> (Vec<f64>, Vec<f64>) {
    let (inertia, viscous, coulomb) = (4e-3, 0.02, 0.08); // kg·m², N·m·s/rad, N·m
    let sample = |k: u32| {
        let time = f64::from(k) * SAMPLE_TIME_S;
        let (phase, omega) = (time + 0.5 * time * time, 1.0 + time);
        let speed = amplitude_rad * omega * phase.cos();
        let acceleration = amplitude_rad * (phase.cos() - omega * omega * phase.sin());
        let torque = inertia * acceleration + viscous * speed + coulomb * speed.signum();
        let angle = amplitude_rad * phase.sin();
        // A current sensor with steps of 5 mA, an encoder with 65536 counts a turn.
        let steps = |value: f64, step: f64| (value / step).round() * step;
        (steps(torque / NM_PER_A, 5e-3), steps(angle, std::f64::consts::TAU / 65_536.0))
    };
    (0..12_000).map(sample).unzip()
}

fn campaign_of(
    name: &str,
    current_a: Vec<f64>,
    angle_rad: Vec<f64>,
) -> Result<Campaign, lissom::Error> {
    let command = Command {
        quantity: CommandQuantity::Current,
        hold: Hold::Measured, // `Sampled` for a commanded current that is held between samples
        torque_per_command: Some(NM_PER_A),
        back_emf_viscous: 0.0,
        limit: None,
    };
    let time = TimeBase::uniform(0.0, SAMPLE_TIME_S);
    let run = Run::new(name, time, current_a, angle_rad, vec![])?;
    Ok(Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, vec![run])?)
}

fn main() -> Result<(), lissom::Error> {
    let (current, angle) = log(0.8);
    let campaign = campaign_of("monday", current, angle)?;
    let found = Identify::new(&campaign).run()?;
    println!("{found}");
    let serious = found.findings().iter().filter(|f| f.severity() != Severity::Info);
    println!("\nwarnings and refusals, to read before you use the numbers: {}", serious.count());

    let (current, angle) = log(0.5);
    if let Some(validation) = found.validate(&campaign_of("tuesday", current, angle)?)? {
        println!("\nanother day is predicted so:\n{validation}");
    }
    Ok(())
}
