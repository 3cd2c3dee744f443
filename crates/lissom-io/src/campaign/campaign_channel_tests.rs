//! What a channel may be: torques, goals, speeds, negative constants, whole turns.
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use std::f64::consts::PI;
use std::fmt::Write as _;

use lissom_core::record::{Axis, CommandQuantity, note};

use super::campaign_tests::{PLAIN, fails, read, read_logs, signal};

/// The plain campaign with other `command` and `[drive]`.
fn commanded(keys: &str, drive: &str) -> String {
    PLAIN
        .replace(
            "current = { column = \"u\", unit = \"A\", hold = \"sampled\"",
            &format!("command = {{ column = \"u\", {keys}, hold = \"sampled\""),
        )
        .replace("torque_constant = \"0.25 N*m/A\"", drive)
}

#[test]
fn a_tip_with_the_samples_of_the_motor_is_refused() {
    let with = |tip: &str| PLAIN.replace("[drive]", &format!("tips = [{{ {tip} }}]\n[drive]"));
    fails(
        &with("column = \"x\", unit = \"rad\", name = \"end\""),
        "tip \"end\" has the same samples as the motor in every run: it shows no bending of the arm",
        Some("give the channel of the sensor at the tip; for a rigid axis, leave the tip out"),
    );
    assert!(read(&with("column = \"x\", unit = \"rad\", offset = 0.1")).is_ok());
}

#[test]
fn a_command_in_torque_needs_no_constant() {
    let command = |text: &str| read(text).unwrap().campaign.channels.command;
    let torque = command(&commanded("unit = \"N*m\"", "limit = \"2 N*m\""));
    assert_eq!((torque.quantity, torque.torque_per_command), (CommandQuantity::Effort, Some(1.0)));
    assert_eq!(torque.limit, Some(2.0));
    let force = commanded("unit = \"kgf\"", "").replace("unit = \"rad\"", "unit = \"mm\"");
    assert_eq!(command(&force).torque_per_command, Some(1.0));
    fails(
        &commanded("unit = \"N*m\"", "torque_constant = \"1 N*m\""),
        "campaign.toml, line 7: `drive.torque_constant` does not apply if the command is a torque",
        Some("remove it, or describe the channel that it belongs to"),
    );
    fails(
        &commanded("unit = \"N*m\"", "limit = \"2 A\""),
        "campaign.toml, line 7: `drive.limit`: \"2 A\" is a current [A], where a torque [kg*m^2*s^-2] is expected",
        Some("write it as in \"0.25 N*m\""),
    );
}

#[test]
fn a_negative_torque_constant_turns_the_current_round() {
    let text = PLAIN.replace("\"0.25 N*m/A\"", "\"-0.25 N*m/A\"");
    let text = text.replace("unit = \"A\"", "unit = \"A\", offset = 1");
    let file = read(&text).unwrap();
    assert_eq!(file.campaign.channels.command.torque_per_command, Some(0.25));
    assert_eq!(file.known.torque_constant, Some(0.25));
    assert_eq!(file.campaign.runs[0].command()[..4], [-1.0, -2.0, -3.0, -4.0]);
}

#[test]
fn a_goal_less_the_angle_is_the_command() {
    let goal = "unit = \"deg\", quantity = \"goal\"";
    let file = read(&commanded(goal, "")).unwrap();
    let command = &file.campaign.channels.command;
    let found = (command.quantity, command.torque_per_command);
    assert_eq!(found, (CommandQuantity::PositionError, None));
    let expected = 3.0 * PI / 180.0 - f64::midpoint(signal(7), signal(8));
    assert!((file.campaign.runs[0].command()[7] - expected).abs() < 1e-15);
    let measured =
        commanded(goal, "position_gain = \"12 N*m/rad\"").replace("\"sampled\"", "\"measured\"");
    let file = read(&measured).unwrap();
    assert_eq!(file.campaign.channels.command.torque_per_command, Some(12.0));
    assert!((file.campaign.runs[0].command()[7] - (3.0 * PI / 180.0 - signal(7))).abs() < 1e-15);
    let linear = commanded("unit = \"mm\", quantity = \"goal\"", "position_gain = \"12 N/mm\"")
        .replace("unit = \"rad\"", "unit = \"m\"");
    let gain = read(&linear).unwrap().campaign.channels.command.torque_per_command.unwrap();
    assert!((gain - 12e3).abs() < 1e-9);
}

#[test]
fn goals_that_are_none() {
    let angles = Some(
        "give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; counts: unit = \"rad\" with scale = rad per count",
    );
    for unit in ["A", "mm", "1"] {
        fails(
            &commanded(&format!("unit = \"{unit}\", quantity = \"goal\""), ""),
            &format!(
                "campaign.toml, line 4: `signals.command.unit`: a position goal is an angle, and \"{unit}\" is not a unit of an angle"
            ),
            angles,
        );
    }
    fails(
        &commanded("unit = \"deg\", quantity = \"target\"", ""),
        "campaign.toml, line 4: `signals.command.quantity` is \"target\", but must be \"goal\"",
        Some("write one of these words"),
    );
    fails(
        &commanded("unit = \"deg\", quantity = \"goal\"", "position_gain = \"-1 N*m/rad\""),
        "campaign.toml, line 7: `drive.position_gain` is \"-1 N*m/rad\", but must be greater than zero",
        Some("check its sign"),
    );
    fails(
        &commanded("unit = \"deg\", quantity = \"goal\"", "position_gain = \"1 N/m\""),
        "campaign.toml, line 7: `drive.position_gain`: \"1 N/m\" is a quantity in [kg*s^-2], where a torque [kg*m^2*s^-2] is expected",
        Some("write it as in \"0.25 N*m\""),
    );
    fails(
        &PLAIN.replace("torque_constant = \"0.25 N*m/A\"", "position_gain = 12"),
        "campaign.toml, line 7: `drive.position_gain` does not apply if the command is a current",
        Some("remove it, or describe the channel that it belongs to"),
    );
    fails(
        &PLAIN.replace("hold =", "quantity = \"goal\", hold ="),
        "campaign.toml, line 4: `signals.current.quantity` is not a known key",
        Some("the known keys are `column`, `unit`, `scale`, `offset`, `hold`"),
    );
    let speed = commanded("unit = \"deg\", quantity = \"goal\"", "")
        .replace("unit = \"rad\"", "unit = \"rpm\", quantity = \"speed\"");
    fails(
        &speed,
        "campaign.toml, line 4: `signals.command`: a position goal needs the motor's position, but the log has its speed",
        Some("give the column of the motor's angle, or the motor current instead of the goal"),
    );
}

#[test]
fn a_speed_is_integrated() {
    for (unit, axis, size) in [("rpm", Axis::Rotary, PI / 30.0), ("m/s", Axis::Linear, 1.0)] {
        let text = PLAIN
            .replace("unit = \"rad\"", &format!("unit = \"{unit}\", quantity = \"speed\""))
            .replace("torque_constant = \"0.25 N*m/A\"", "");
        let file = read(&text).unwrap();
        assert_eq!(file.campaign.channels.axis, axis);
        let run = &file.campaign.runs[0];
        assert_eq!(run.motor()[0], 0.0);
        let sum: f64 = (0..7).map(|k| f64::midpoint(signal(k), signal(k + 1))).sum();
        assert!((run.motor()[7] - sum * size * 1e-3).abs() < 1e-15);
        assert_eq!(run.notes(), [note::SpeedIntegrated {}.into()]);
    }
    fails(
        &PLAIN.replace("unit = \"rad\"", "unit = \"rpm\""),
        "campaign.toml, line 5: `signals.motor.unit`: \"rpm\" is a unit of speed, but the motor's `quantity` is not \"speed\"",
        Some("add `quantity = \"speed\"`: the angle is then integrated from the speed"),
    );
    fails(
        &PLAIN.replace("unit = \"rad\"", "unit = \"rad\", quantity = \"speed\""),
        "campaign.toml, line 5: `signals.motor.unit`: \"rad\" is not a unit of speed, but the motor's `quantity` is \"speed\"",
        Some(
            "give \"rad/s\", \"deg/s\" or \"rpm\" for a rotary axis, \"m/s\" for a linear one, or remove `quantity` if the channel is an angle",
        ),
    );
    fails(
        &PLAIN.replace("unit = \"rad\"", "unit = \"rad\", quantity = \"velocity\""),
        "campaign.toml, line 5: `signals.motor.quantity` is \"velocity\", but must be \"angle\" or \"speed\"",
        Some("write one of these words"),
    );
}

#[test]
fn turns_of_an_absolute_encoder_are_removed() {
    let mut text = String::from("t,u,x\n");
    for k in 0..400 {
        writeln!(text, "{},1,{}", f64::from(k) * 1e-3, f64::from(k * 4 % 360)).unwrap();
    }
    let degrees = PLAIN.replace("unit = \"rad\"", "unit = \"deg\"");
    let file = read_logs(&degrees, &[("a.csv", &text)]).unwrap();
    let run = &file.campaign.runs[0];
    assert!((run.motor()[399] - 399.0 * 4.0 * PI / 180.0).abs() < 1e-12);
    assert_eq!(run.notes(), [note::TurnsRemoved { count: 4 }.into()]);
}
