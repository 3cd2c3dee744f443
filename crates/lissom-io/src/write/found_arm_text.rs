//! Writes the arm of a result as an `arm.toml`, for plans and virtual experiments.

use std::f64::consts::SQRT_2;
use std::fmt::{self, Write as _};

use lissom_core::drive::Coulomb;
use lissom_core::identify::FoundArm;
use lissom_core::record::{Axis, Campaign, CommandQuantity};
use lissom_core::replay::ModalArm;

/// First line of such an arm.
const HEAD: &str = "# The identified arm, for plans and virtual experiments. [rig] is a proposal: change it to what you have.";
/// Rate of the proposed position loop: at most this \[rad/s\], and so much per sample \[rad\].
const LOOP_RAD_S: f64 = 60.0;
const LOOP_PER_SAMPLE_RAD: f64 = 0.15;
/// Damping ratio of the proposed loop.
const LOOP_DAMPING: f64 = 0.5 * SQRT_2;
/// The gains of a point add up to one to this.
const SUM: f64 = 1e-9;
/// Variance of the third difference of white noise of variance one.
const THIRD_DIFFERENCE: f64 = 20.0;

/// The text of an `arm.toml` with the arm of a result and a rig like that of its logs: their sample time, the noise of the
/// motor's sensor, the largest command as the limit, and a position loop. `None` on a linear axis, and for an arm that
/// predicts only torque. Where the torque constant is unknown, torques are in units of the command; where the command is no
/// current, its unit takes the place of the ampere.
pub fn found_arm_text(found: &FoundArm, campaign: &Campaign) -> Option<String> {
    if campaign.channels.axis == Axis::Linear || !found.coupling_alone_nm_per_rad.is_empty() {
        return None;
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = put(&mut text, &found.arm, campaign);
    Some(text)
}

fn put(text: &mut String, arm: &ModalArm, campaign: &Campaign) -> fmt::Result {
    let command = &campaign.channels.command;
    writeln!(text, "{HEAD}")?;
    if command.torque_per_command.is_none() {
        writeln!(text, "# The torque constant is unknown: torques are in units of the command.")?;
    }
    if command.quantity != CommandQuantity::Current {
        writeln!(text, "# The command is no current: A stands for its unit.")?;
    }
    writeln!(text, "[beam]")?;
    beam(text, arm)?;
    let constant = command.torque_per_unit();
    let [forward, backward] = arm.viscous_nm_s_per_rad;
    writeln!(text, "\n[drive]\ninertia = \"{:?} kg*m^2\"", arm.inertia_kg_m2)?;
    writeln!(text, "viscous = \"{:?} N*m*s/rad\"", (0.5 * (forward + backward)).max(0.0))?;
    writeln!(text, "torque_constant = \"{constant:?} N*m/A\"")?;
    let by_direction = [arm.coulomb_nm + arm.offset_nm, arm.coulomb_nm - arm.offset_nm];
    let [forward, backward] = match Coulomb::by_direction(by_direction[0], by_direction[1]) {
        Ok(_) => by_direction,
        Err(_) => [arm.coulomb_nm; 2],
    };
    writeln!(
        text,
        "coulomb = {{ forward = \"{forward:?} N*m\", backward = \"{backward:?} N*m\" }}"
    )?;
    if let Some(load) = arm.gravity.filter(|load| load.amplitude_nm() > 0.0) {
        let (torque, phase) = (load.amplitude_nm(), load.phase_rad());
        writeln!(text, "\n[load]\ngravity_torque = \"{torque:?} N*m\"\nphase = \"{phase:?} rad\"")?;
    }
    rig(text, arm, campaign, constant)
}

/// The beam by its modes. Where the tips do not show all of them, the points are the oscillators themselves.
fn beam(text: &mut String, arm: &ModalArm) -> fmt::Result {
    let count = arm.modes.len();
    if count == 0 {
        return writeln!(text, "rigid = true");
    }
    let whole = |gains: &Vec<f64>| (gains.iter().sum::<f64>() - 1.0).abs() < SUM;
    let points = arm.shapes.len() == count && arm.shapes.iter().all(whole);
    if !points {
        writeln!(
            text,
            "# The points are the oscillators of the modes: the tips do not show all modes."
        )?;
    }
    writeln!(text, "modes = [")?;
    for (k, (mode, (omega_rad_s, damping_ratio))) in
        arm.modes.iter().zip(arm.clamped_modes()).enumerate()
    {
        let own = |i: usize| if i == k { 1.0 } else { 0.0 };
        let gain = |i: usize| if points { arm.shapes[i][k] } else { own(i) };
        let gains: Vec<String> = (0..count).map(|i| format!("{:?}", gain(i))).collect();
        writeln!(
            text,
            "  {{ omega_rad_s = {omega_rad_s:?}, damping_ratio = {:?}, coupling = \"{:?} N*m\", gains = [{}] }},",
            damping_ratio.max(0.0),
            mode.stiffness_nm_per_rad,
            gains.join(", ")
        )?;
    }
    writeln!(text, "]")
}

fn rig(text: &mut String, arm: &ModalArm, campaign: &Campaign, constant: f64) -> fmt::Result {
    let runs = &campaign.runs;
    let step_s = runs.iter().map(lissom_core::record::Run::sample_time_s).fold(0.0, f64::max);
    let commands = runs.iter().flat_map(|run| run.command().iter().copied());
    let largest = commands.fold(0.0, |most: f64, value| most.max(value.abs()));
    let mut noise: Vec<f64> = runs.iter().map(|run| noise(run.motor())).collect();
    noise.sort_by(f64::total_cmp);
    let noise_rad = noise.get(noise.len() / 2).copied().unwrap_or(0.0);
    writeln!(text, "\n[rig]\nsample_time = \"{step_s:?} s\"")?;
    writeln!(text, "# the largest command of the logs\ncurrent_limit = \"{largest:.4} A\"")?;
    if noise_rad > 0.0 {
        writeln!(
            text,
            "# the noise of the logs\nmotor_sensor = {{ noise = \"{noise_rad:.3e} rad\" }}"
        )?;
    }
    let omega = LOOP_RAD_S.min(LOOP_PER_SAMPLE_RAD / step_s);
    let proportional = arm.inertia_kg_m2 * omega * omega / constant;
    let derivative = 2.0 * LOOP_DAMPING * arm.inertia_kg_m2 * omega / constant;
    writeln!(text, "# a loop of {omega:.0} rad/s")?;
    writeln!(
        text,
        "controller = {{ proportional = \"{proportional:.4e} A/rad\", derivative = \"{derivative:.4e} A*s/rad\" }}"
    )
}

/// Standard deviation of the noise of samples of a smooth motion, from their third differences.
fn noise(samples: &[f64]) -> f64 {
    let thirds = samples.windows(4).map(|s| s[3] - 3.0 * s[2] + 3.0 * s[1] - s[0]);
    let (sum, count) = thirds.fold((0.0, 0), |(sum, count), d| (sum + d * d, count + 1));
    (sum / f64::from(count.max(1)) / THIRD_DIFFERENCE).sqrt()
}
