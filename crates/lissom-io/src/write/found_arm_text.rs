//! Writes the arm of a result as an `arm.toml`, for plans and virtual experiments.

use std::f64::consts::SQRT_2;
use std::fmt::{self, Write as _};

use lissom_core::drive::{Coulomb, DryFriction};
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
    let _ = put(&mut text, &found.arm.clone().without_light_modes(), campaign);
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
    writeln!(text, "\n[drive]\ninertia = \"{:?} kg*m^2\"", arm.inertia_kg_m2)?;
    let [forward, backward] = arm.viscous_nm_s_per_rad.map(|viscous| viscous.max(0.0));
    if (forward - backward).abs() > 0.0 {
        writeln!(
            text,
            "viscous = {{ forward = \"{forward:?} N*m*s/rad\", backward = \"{backward:?} N*m*s/rad\" }}"
        )?;
    } else {
        writeln!(text, "viscous = \"{forward:?} N*m*s/rad\"")?;
    }
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
    dry_terms(text, arm, [forward, backward])?;
    torque_ripples(text, arm)?;
    if let Some(load) = arm.gravity.filter(|load| load.amplitude_nm() > 0.0) {
        let (torque, phase) = (load.amplitude_nm(), load.phase_rad());
        writeln!(text, "\n[load]\ngravity_torque = \"{torque:?} N*m\"\nphase = \"{phase:?} rad\"")?;
    }
    rig(text, arm, campaign, constant)
}

/// Further terms of friction, of ripples one, where a joint can have them: where its friction always brakes.
fn dry_terms(text: &mut String, arm: &ModalArm, [forward, backward]: [f64; 2]) -> fmt::Result {
    let terms = &arm.dry_terms;
    let Ok(sliding) = Coulomb::by_direction(forward, backward) else { return Ok(()) };
    let mut law = DryFriction::from(sliding);
    if let Some(near) = terms.near_rest {
        let rest =
            [forward + near.torque_nm + near.offset_nm, backward + near.torque_nm - near.offset_nm];
        let with_rest = Coulomb::by_direction(rest[0], rest[1])
            .and_then(|rest| law.clone().with_rest(rest, near.speed_rad_s, near.falloff));
        if let Ok(with_rest) = with_rest {
            law = with_rest;
            writeln!(
                text,
                "rest = {{ friction = {{ forward = \"{:?} N*m\", backward = \"{:?} N*m\" }}, velocity = \"{:?} \
                 rad/s\", falloff = \"{}\" }}",
                rest[0],
                rest[1],
                near.speed_rad_s,
                near.falloff.name()
            )?;
        } else {
            writeln!(text, "# Left out: friction near rest, which would drive the joint.")?;
        }
    }
    if let [wave] = terms.ripples.as_slice() {
        let share = wave.cosine_nm.hypot(wave.sine_nm) / (0.5 * (forward + backward));
        let phase_rad = (-wave.sine_nm).atan2(wave.cosine_nm);
        if law.with_ripple(share, wave.per_rad, phase_rad).is_ok() {
            writeln!(
                text,
                "ripple = {{ share = {share:?}, per_turn = {:?}, phase = \"{phase_rad:?} rad\" }}",
                wave.per_rad
            )?;
        } else {
            writeln!(text, "# Left out: a ripple of friction, which would drive the joint.")?;
        }
    } else if !terms.ripples.is_empty() {
        writeln!(text, "# Left out: ripples of friction; a joint here has one.")?;
    }
    if let Some(root) = terms.root {
        let size = root.torque_nm_per_root_rad_s;
        if size >= 0.0 {
            writeln!(text, "root = {{ friction = \"{size:?} N*m\", velocity = \"1 rad/s\" }}")?;
        } else {
            writeln!(text, "# Left out: friction that falls with the square root of speed.")?;
        }
    }
    if let Some(term) = terms.with_load.filter(|term| term.load.amplitude_nm() > 0.0) {
        let (coefficient, load) = (term.coefficient, term.load);
        if coefficient >= 0.0 {
            writeln!(
                text,
                "with_load = {{ coefficient = {coefficient:?}, gravity_torque = \"{:?} N*m\", phase = \"{:?} rad\" }}",
                load.amplitude_nm(),
                load.phase_rad()
            )?;
        } else {
            writeln!(text, "# Left out: friction that falls with the torque of gravity.")?;
        }
    }
    Ok(())
}

/// Torque ripples of the motor.
fn torque_ripples(text: &mut String, arm: &ModalArm) -> fmt::Result {
    if arm.torque_ripples.is_empty() {
        return Ok(());
    }
    writeln!(text, "torque_ripples = [")?;
    for ripple in &arm.torque_ripples {
        let (torque, per_turn, phase) = (ripple.amplitude_nm(), ripple.per_rad, ripple.phase_rad());
        writeln!(
            text,
            "  {{ torque = \"{torque:?} N*m\", per_turn = {per_turn:?}, phase = \"{phase:?} rad\" }},"
        )?;
    }
    writeln!(text, "]")
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use lissom_core::drive::Falloff;
    use lissom_core::identify::{ArmSource, LagShape};
    use lissom_core::load::{GravityLoad, TorqueRipple};
    use lissom_core::record::{Channels, Command, Hold, Run, TimeBase};
    use lissom_core::replay::{DryTerms, NearRest, Ripple, Root, WithLoad};
    use lissom_core::rig::JointFriction;

    use super::*;
    use crate::ArmFile;

    fn campaign() -> Campaign {
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Sampled,
            torque_per_command: Some(0.5),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let channels = Channels { axis: Axis::Rotary, command, tips: Vec::new() };
        let wave: Vec<f64> = (0..500).map(|k| (0.05 * f64::from(k)).sin()).collect();
        let time =
            TimeBase { start_s: 0.0, sample_time_s: 1e-3, jitter_max_s: 0.0, jitter_rms_s: 0.0 };
        let run = Run::new("run", time, wave.clone(), wave, Vec::new()).unwrap();
        Campaign::new(channels, vec![run]).unwrap()
    }

    const LOAD: GravityLoad = GravityLoad { sine_nm: 1.5, cosine_nm: -0.4 };
    const COGGING: TorqueRipple = TorqueRipple { per_rad: 12.0, cosine_nm: 0.05, sine_nm: 0.02 };

    fn found(near_nm: f64) -> FoundArm {
        let near = NearRest {
            torque_nm: near_nm,
            offset_nm: 0.01,
            speed_rad_s: 0.2,
            falloff: Falloff::Gaussian,
        };
        let ripple = Ripple { per_rad: 7.0, cosine_nm: 0.03, sine_nm: -0.04 };
        let arm = ModalArm {
            inertia_kg_m2: 0.02,
            viscous_nm_s_per_rad: [0.03, 0.05],
            coulomb_nm: 0.4,
            offset_nm: 0.02,
            dry_terms: DryTerms {
                near_rest: Some(near),
                ripples: vec![ripple],
                root: Some(Root { torque_nm_per_root_rad_s: 0.07 }),
                with_load: Some(WithLoad { coefficient: 0.06, load: LOAD }),
            },
            modes: Vec::new(),
            shapes: Vec::new(),
            at_points_per_s: Vec::new(),
            gravity: None,
            torque_ripples: vec![COGGING],
            command_lag_s: 0.0,
            tip_lags_s: Vec::new(),
        };
        let source = ArmSource::Regression;
        FoundArm {
            arm,
            coupling_alone_nm_per_rad: Vec::new(),
            source,
            lag_shape: LagShape::Delay,
            torque_used: None,
        }
    }

    #[test]
    fn the_friction_law_is_that_of_the_arm() {
        let text = found_arm_text(&found(-0.2), &campaign()).unwrap();
        let file = ArmFile::from_text(Path::new("arm.toml"), &text).unwrap();
        let rig = file.rig(Path::new("arm.toml")).unwrap();
        let JointFriction::Dry(law) = &rig.scene.friction else { panic!("{text}") };
        let arm = found(-0.2).arm;
        for (velocity, angle) in [(0.0, 0.3), (0.1, -1.0), (0.4, 2.0), (30.0, 0.1)] {
            let limits = law.at(velocity, angle);
            let near = -0.2 * (-(velocity / 0.2_f64).powi(2)).exp();
            let apart = 0.01 * (-(velocity / 0.2_f64).powi(2)).exp();
            let (sine, cosine) = (7.0 * angle).sin_cos();
            let wave = 0.03 * cosine - 0.04 * sine;
            let root = 0.07 * velocity.sqrt();
            let load = 0.06 * LOAD.torque_nm(angle).abs();
            let [forward, backward] = [1.0, -1.0].map(|direction| {
                arm.coulomb_nm + near + wave + root + load + direction * (arm.offset_nm + apart)
            });
            let viscous = 0.5 * (0.03 - 0.05) * velocity;
            // The root and the load are smoothed.
            assert!((limits.forward() - forward - viscous).abs() < 1e-5, "{velocity} {limits:?}");
            assert!((limits.backward() - backward + viscous).abs() < 1e-5, "{velocity} {limits:?}");
        }
        let [ripple] = rig.scene.torque_ripples[..] else { panic!("{text}") };
        for angle in [0.0, 0.4, 2.0] {
            assert!((ripple.torque_nm(angle) - COGGING.torque_nm(angle)).abs() < 1e-15, "{text}");
        }
        let terms = (law.terms().root, law.terms().with_load);
        assert_eq!(terms.0, arm.dry_terms.root);
        let load = terms.1.unwrap().load;
        assert!((load.torque_nm(1.0) - LOAD.torque_nm(1.0)).abs() < 1e-14, "{text}");
    }

    #[test]
    fn friction_that_would_drive_is_left_out_and_said() {
        let text = found_arm_text(&found(-0.5), &campaign()).unwrap();
        assert!(text.contains("# Left out: friction near rest"), "{text}");
        assert!(ArmFile::from_text(Path::new("arm.toml"), &text).is_ok(), "{text}");
    }
}
