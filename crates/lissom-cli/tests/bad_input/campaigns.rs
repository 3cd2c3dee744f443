//! Campaigns that cannot be used.

use crate::bench::{Bench, CAMPAIGN, csv, good};

#[test]
fn the_campaign_is_missing() {
    Bench::new().refuses_with(
        &["absent.toml", "--json", "out.json"],
        1,
        "error: absent.toml: cannot be read: No such file or directory (os error 2)\n\
         hint: check the path; `lissom demo` writes an example",
    );
}

#[test]
fn the_campaign_is_a_folder() {
    Bench::new().refuses_with(
        &["."],
        1,
        "error: .: cannot be read: Is a directory (os error 21)\n\
         hint: name the file in it",
    );
}

#[test]
fn the_campaign_is_no_toml() {
    Bench::replacing("[drive]", "[drive").refuses("");
}

#[test]
fn the_campaign_is_no_text() {
    Bench::new().file("campaign.toml", b"\xff\xfe[\0s\0").refuses("");
}

#[test]
fn the_campaign_is_a_log() {
    Bench::new().file("campaign.toml", csv(&good())).refuses("");
}

#[test]
fn the_unit_is_unknown() {
    Bench::replacing("unit = \"A\"", "unit = \"amp\"").refuses("");
    Bench::replacing("unit = \"rad\" }\ntips", "unit = \"Rad\" }\ntips").refuses("");
}

#[test]
fn the_unit_has_the_wrong_dimension() {
    Bench::replacing("unit = \"A\"", "unit = \"V\"").refuses("");
    Bench::replacing("unit = \"s\"", "unit = \"mm\"").refuses("");
    Bench::replacing("0.25 N*m/A", "0.25 N*m").refuses("");
    Bench::replacing("unit = \"rad\" }\ntips", "unit = \"A\" }\ntips").refuses("");
}

#[test]
fn a_quantity_is_no_quantity() {
    Bench::replacing("0.25 N*m/A", "a quarter").refuses("");
    Bench::replacing("0.25 N*m/A", "-0.25 N*m/A").refuses("");
    Bench::replacing("0.25 N*m/A", "1e308 GA").refuses("");
    Bench::replacing("\"0.25 N*m/A\"", "true").refuses("");
}

#[test]
fn hold_is_missing_or_misspelt() {
    Bench::replacing(", hold = \"measured\"", "").refuses("");
    Bench::replacing("\"measured\"", "\"mesured\"").refuses("");
    Bench::replacing("\"measured\"", "\"zoh\"").refuses("");
}

#[test]
fn a_key_is_unknown() {
    Bench::replacing("torque_constant", "torque_konstant").refuses("");
    Bench::adding("velocity = 3\n").refuses("");
}

#[test]
fn signals_runs_or_command_are_missing() {
    Bench::new().file("campaign.toml", "").refuses("");
    Bench::replacing("[[runs]]\nfile = \"run.csv\"\n", "").refuses("");
    let none = format!("runs = []\n{}", CAMPAIGN.replace("[[runs]]\nfile = \"run.csv\"\n", ""));
    Bench::new().file("campaign.toml", none).refuses("");
    Bench::replacing("file = \"run.csv\"", "").refuses("");
    Bench::replacing("current =", "# current =").refuses("");
}

#[test]
fn a_voltage_needs_the_resistance() {
    let voltage = CAMPAIGN.replace("current =", "voltage =").replace("\"A\"", "\"V\"");
    Bench::new().file("campaign.toml", &voltage).refuses("");
    let constant = "torque_constant = \"0.25 N*m/A\"";
    let resistance = voltage.replace(constant, &format!("{constant}\nresistance = \"2 ohm\""));
    Bench::new().file("campaign.toml", resistance).refuses("");
}

#[test]
fn the_drive_frequency_is_above_nyquist() {
    Bench::adding("omega_rad_s = 700\n").refuses("");
    Bench::adding("frequency = \"101 Hz\"\n").refuses("");
    Bench::adding("omega_rad_s = 0\n").refuses("");
    Bench::adding("omega_rad_s = \"4 rad/s\"\n").refuses("");
}

#[test]
fn the_arm_has_a_negative_inertia() {
    let arm = "[drive]\ninertia = \"-0.01 kg*m^2\"\ntorque_constant = \"0.25 N*m/A\"\n";
    let constant = "torque_constant = \"0.25 N*m/A\"";
    let with_arm = format!("{constant}\narm = \"arm.toml\"");
    Bench::replacing(constant, &with_arm).file("arm.toml", arm).refuses("");
    Bench::replacing(constant, &with_arm).refuses("");
}

#[test]
fn skipping_leaves_nothing() {
    Bench::adding("skip = \"1 min\"\n").refuses("");
}
