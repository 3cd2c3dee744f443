//! Loads, and a speed beside the angle, that cannot be used.

use std::fmt::Write as _;

use crate::bench::{Bench, CAMPAIGN, good};

/// The campaign of a rigid joint: gravity acts on these.
fn rigid() -> String {
    let tips = "tips = [{ name = \"tip\", column = \"p\", unit = \"rad\" }]\n";
    assert!(CAMPAIGN.contains(tips));
    CAMPAIGN.replace(tips, "")
}

#[track_caller]
fn refused(campaign: &str, message: &str) {
    Bench::new().file("campaign.toml", campaign).refuses(message);
}

#[test]
fn gravity_of_the_wrong_kind() {
    let with = |load: &str| rigid() + "\n[load]\n" + load;
    refused(
        &with("gravity = 9.81"),
        "error: campaign.toml, line 13: `load.gravity` is 9.81, where true or false is expected\n\
         hint: write true or false without quotes",
    );
    refused(
        &with("gravity = \"yes\""),
        "error: campaign.toml, line 13: `load.gravity` is \"yes\", where true or false is expected\n\
         hint: write true or false without quotes",
    );
    refused(
        &(CAMPAIGN.to_owned() + "\n[load]\ngravity = true\n"),
        "error: campaign.toml, line 14: `load.gravity`: gravity is identified only for a rigid joint, but this campaign has tips\n\
         hint: remove `gravity`, or the tips",
    );
    let linear = with("gravity = true").replace("unit = \"rad\"", "unit = \"mm\"");
    refused(
        &linear.replace("0.25 N*m/A", "0.25 N/A"),
        "error: campaign.toml, line 13: `load.gravity`: gravity on a linear axis is a constant force\n\
         hint: remove it: every result has this force as the offset of friction",
    );
}

#[test]
fn a_load_of_the_wrong_size() {
    let with = |load: &str| rigid() + "\n[load]\n" + load;
    refused(
        &with("mgl = \"2 N*m\""),
        "error: campaign.toml, line 13: `load.mgl` has no effect without `gravity = true`\n\
         hint: add gravity = true, or remove `mgl`",
    );
    refused(
        &with("gravity = true\nmgl = \"2 kg\""),
        "error: campaign.toml, line 14: `load.mgl`: \"2 kg\" is a mass [kg], where a torque \
         [kg*m^2*s^-2] is expected\n\
         hint: write it as in \"0.25 N*m\"",
    );
    refused(
        &with("gravity = true\nmgl = \"-2 N*m\""),
        "error: campaign.toml, line 14: `load.mgl` is \"-2 N*m\", but must be greater than zero\n\
         hint: check its sign",
    );
    refused(
        &with("mass = \"2 kg\""),
        "error: campaign.toml, line 13: `load.mass` is not a known key\n\
         hint: the known keys are `gravity`, `mgl`",
    );
}

/// A log with the angle's rate in another column, times a factor.
fn with_speed(factor: f64) -> Bench {
    let mut text = String::from("t,i,m,w\n");
    let rows = good();
    for k in 1..rows.len() - 1 {
        let [t, i, m, _] = rows[k];
        let rate = (rows[k + 1][2] - rows[k - 1][2]) / 0.01;
        writeln!(text, "{t:.6},{i:.6},{m:.6},{:.6}", factor * rate).unwrap();
    }
    let motor = "motor = { column = \"m\", unit = \"rad\" }";
    let speed = "speed = { column = \"w\", unit = \"rad/s\" }";
    let campaign = rigid().replace(motor, &format!("{motor}\n{speed}"));
    Bench::log(text).file("campaign.toml", campaign)
}

#[test]
fn a_speed_that_contradicts_the_angle() {
    let agrees = with_speed(1.0).identify(&["campaign.toml"]);
    assert!(agrees.status.code().is_some_and(|code| code != 1), "{agrees:?}");
    with_speed(-1.0).refuses(
        "error: run.csv: the speed contradicts the motor's angle: it is -1.000 times the angle's rate (correlation -1.00)\n\
         hint: the sign of one of them is reversed: add scale = -1 to it",
    );
    with_speed(9.549_3).refuses(
        "error: run.csv: the speed contradicts the motor's angle: it is 9.548 times the angle's rate (correlation 1.00)\n\
         hint: the speed seems to be in rpm: give unit = \"rpm\", or check the unit of the angle",
    );
    let motor = "motor = { column = \"m\", unit = \"rad\" }";
    let two = "motor = { column = \"m\", unit = \"rad/s\", quantity = \"speed\" }\n\
               speed = { column = \"p\", unit = \"rad/s\" }";
    refused(
        &rigid().replace(motor, two),
        "error: campaign.toml, line 5: `signals.speed`: the motor's channel is a speed already\n\
         hint: remove `speed`, or give the angle as `motor`",
    );
    let speed = "speed = { column = \"p\", unit = \"rad\" }";
    refused(
        &rigid().replace(motor, &format!("{motor}\n{speed}")),
        "error: campaign.toml, line 5: `signals.speed.unit`: \"rad\" is a plain number or angle, where an angular rate or frequency [s^-1] is expected\n\
         hint: write it as in \"5 Hz\"",
    );
}
