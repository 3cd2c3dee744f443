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
         hint: give a file in this folder",
    );
}

#[test]
fn the_campaign_is_no_toml() {
    Bench::replacing("[drive]", "[drive").refuses(
        "error: campaign.toml, line 7, column 7: unclosed table, expected `]`\n\
         hint: the file is TOML: `key = value` lines below [table] lines",
    );
}

#[test]
fn the_campaign_is_no_text() {
    Bench::new().file("campaign.toml", b"\xff\xfe[\0s\0").refuses(
        "error: campaign.toml: cannot be read: stream did not contain valid UTF-8\n\
         hint: save the file as text in UTF-8",
    );
}

#[test]
fn the_campaign_is_a_log() {
    Bench::new().file("campaign.toml", csv(&good())).refuses(
        "error: campaign.toml, line 1, column 2: key with no value, expected `=`\n\
         hint: the file is TOML: `key = value` lines below [table] lines",
    );
}

#[test]
fn the_unit_is_unknown() {
    Bench::replacing("unit = \"A\"", "unit = \"amp\"").refuses(
        "error: campaign.toml, line 3: `signals.current.unit`: \"amp\": there is no unit `amp`\n\
         hint: write units as in \"mA\", \"deg\" or \"lbf*in/A\", with * for products and / for \
         quotients",
    );
    Bench::replacing("unit = \"rad\" }\ntips", "unit = \"Rad\" }\ntips").refuses(
        "error: campaign.toml, line 4: `signals.motor.unit`: \"Rad\": there is no unit `Rad`\n\
         hint: did you mean `rad`?",
    );
}

#[test]
fn the_unit_has_the_wrong_dimension() {
    Bench::replacing("unit = \"A\"", "unit = \"V\"").refuses(
        "error: campaign.toml, line 3: `signals.current.unit`: \"V\" is a voltage \
         [kg*m^2*s^-3*A^-1], where a current [A] is expected\n\
         hint: for a logged voltage write `voltage = …` instead of `current`, and `voltage_limit`",
    );
    Bench::replacing("unit = \"s\"", "unit = \"mm\"").refuses(
        "error: campaign.toml, line 2: `signals.time.unit`: \"mm\" is a length [m], where a \
         time [s] is expected\n\
         hint: write it as in \"3 ms\"",
    );
    Bench::replacing("0.25 N*m/A", "0.25 N*m").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant`: \"0.25 N*m\" is a torque \
         [kg*m^2*s^-2], where a torque per current (or voltage per angular rate) \
         [kg*m^2*s^-2*A^-1] is expected\n\
         hint: write it as in \"2.184 lbf*in/A\"",
    );
    Bench::replacing("unit = \"rad\" }\ntips", "unit = \"A\" }\ntips").refuses(
        "error: campaign.toml, line 4: `signals.motor.unit`: the motor is measured in a \
         current [A], which is neither an angle nor a length\n\
         hint: give \"rad\" or \"deg\" for a rotary axis, \"m\" or \"mm\" for a linear one; \
         counts: unit = \"rad\" with scale = rad per count; speeds: \"rpm\" with quantity = \"speed\"",
    );
}

#[test]
fn a_quantity_is_no_quantity() {
    Bench::replacing("0.25 N*m/A", "a quarter").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant`: \"a quarter\" does not begin \
         with a number\n\
         hint: write a number and a unit, such as \"7 in\"",
    );
    Bench::replacing("0.25 N*m/A", "0 N*m/A").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant` is \"0 N*m/A\", but must be \
         other than zero\n\
         hint: check the number and its unit",
    );
    Bench::replacing("0.25 N*m/A", "1e308 GN*m/A").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant`: \"1e308 GN*m/A\" is out of \
         range\n\
         hint: check the exponent of the number and its unit",
    );
    Bench::replacing("0.25 N*m/A", "0.25e200 N*m/A").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant` is \"0.25e200 N*m/A\", but must be \
         of a magnitude from 1e-100 to 1e100 in SI\n\
         hint: check the number and its unit",
    );
    Bench::replacing("\"0.25 N*m/A\"", "true").refuses(
        "error: campaign.toml, line 8: `drive.torque_constant` is true, where text with a unit \
         or an SI number is expected\n\
         hint: `lissom demo` writes an example",
    );
}

#[test]
fn hold_is_missing_or_misspelt() {
    Bench::replacing(", hold = \"measured\"", "").refuses(
        "error: campaign.toml, line 3: `signals.current` has no `hold`\n\
         hint: write hold = \"sampled\" for a command that is held between samples, hold = \
         \"measured\" for a measurement",
    );
    Bench::replacing("\"measured\"", "\"mesured\"").refuses(
        "error: campaign.toml, line 3: `signals.current.hold` is \"mesured\", but must be \
         \"sampled\" or \"measured\" or \"unknown\"\n\
         hint: did you mean \"measured\"?",
    );
    Bench::replacing("\"measured\"", "\"zoh\"").refuses(
        "error: campaign.toml, line 3: `signals.current.hold` is \"zoh\", but must be \
         \"sampled\" or \"measured\" or \"unknown\"\n\
         hint: write one of these words",
    );
}

#[test]
fn a_key_is_unknown() {
    Bench::replacing("torque_constant", "torque_konstant").refuses(
        "error: campaign.toml, line 8: `drive.torque_konstant` is not a known key\n\
         hint: did you mean `torque_constant`?",
    );
    Bench::adding("velocity = 3\n").refuses(
        "error: campaign.toml, line 12: `runs[1].velocity` is not a known key\n\
         hint: the known keys are `file`, `name`, `omega_rad_s`, `frequency`, `skip`, `until`, `leave_out`, `motor_file`, `tip_files`",
    );
}

#[test]
fn signals_runs_or_command_are_missing() {
    Bench::new().file("campaign.toml", "").refuses(
        "error: campaign.toml has no `signals`\n\
         hint: add the table [signals]",
    );
    Bench::replacing("[[runs]]\nfile = \"run.csv\"\n", "").refuses(
        "error: campaign.toml has no `runs`\n\
         hint: add a table [[runs]] with `file = \"...\"` for each log",
    );
    let none = format!("runs = []\n{}", CAMPAIGN.replace("[[runs]]\nfile = \"run.csv\"\n", ""));
    Bench::new().file("campaign.toml", none).refuses(
        "error: campaign.toml, line 1: `runs` is an empty list\n\
         hint: add a table [[runs]] with `file = \"...\"` for each log",
    );
    Bench::replacing("file = \"run.csv\"", "").refuses(
        "error: campaign.toml, line 10: `runs[1]` has no `file`\n\
         hint: add `file` to runs[1]",
    );
    Bench::replacing("current =", "# current =").refuses(
        "error: campaign.toml, line 1: `signals` has none of `current`, `voltage`, `command`\n\
         hint: add one of them",
    );
}

#[test]
fn a_voltage_needs_the_resistance() {
    let voltage = CAMPAIGN.replace("current =", "voltage =").replace("\"A\"", "\"V\"");
    Bench::new().file("campaign.toml", &voltage).refuses(
        "error: campaign.toml, line 8: `drive.torque_constant`: a torque constant per ampere \
         needs `resistance` if the command is a voltage\n\
         hint: give `resistance` and `back_emf`, or the torque constant per volt, as in \"0.15 \
         N*m/V\"",
    );
    let constant = "torque_constant = \"0.25 N*m/A\"";
    let resistance = voltage.replace(constant, &format!("{constant}\nresistance = \"2 ohm\""));
    Bench::new().file("campaign.toml", resistance).refuses(
        "error: campaign.toml, line 8: `drive.torque_constant`: a torque constant per ampere \
         needs `back_emf` if the command is a voltage\n\
         hint: for a DC motor `back_emf` equals the torque constant in SI, as in \"0.0107 \
         V*s/rad\"; with 0 its damping is part of viscous friction",
    );
}

#[test]
fn the_drive_frequency_is_above_nyquist() {
    Bench::adding("omega_rad_s = 700\n").refuses(
        "error: campaign.toml, line 12: `runs[1].omega_rad_s` is 700.0000 rad/s, but must be \
         below 628.3185 rad/s, the Nyquist frequency of run.csv\n\
         hint: `omega_rad_s` is in rad/s; `frequency = \"5 Hz\"` has a unit; check also the \
         unit of the time stamps",
    );
    Bench::adding("frequency = \"101 Hz\"\n").refuses(
        "error: campaign.toml, line 12: `runs[1].frequency` is 634.6017 rad/s, but must be \
         below 628.3185 rad/s, the Nyquist frequency of run.csv\n\
         hint: `omega_rad_s` is in rad/s; `frequency = \"5 Hz\"` has a unit; check also the \
         unit of the time stamps",
    );
    Bench::adding("omega_rad_s = 0\n").refuses(
        "error: campaign.toml, line 12: `runs[1].omega_rad_s` is 0, but must be greater than \
         zero\n\
         hint: check the number and its unit",
    );
    Bench::adding("omega_rad_s = \"4 rad/s\"\n").refuses(
        "error: campaign.toml, line 12: `runs[1].omega_rad_s` is \"4 rad/s\", where a number \
         is expected\n\
         hint: write the number without unit and quotes",
    );
}

#[test]
fn the_arm_has_a_negative_inertia() {
    let arm = "[drive]\ninertia = \"-0.01 kg*m^2\"\ntorque_constant = \"0.25 N*m/A\"\n";
    let constant = "torque_constant = \"0.25 N*m/A\"";
    let with_arm = format!("{constant}\narm = \"arm.toml\"");
    Bench::replacing(constant, &with_arm).file("arm.toml", arm).refuses(
        "error: arm.toml, line 2: `drive.inertia` is \"-0.01 kg*m^2\", but must be greater \
         than zero\n\
         hint: check its sign",
    );
    Bench::replacing(constant, &with_arm).refuses(
        "error: arm.toml: cannot be read: No such file or directory (os error 2)\n\
         hint: check the path; `lissom demo` writes an example",
    );
}

#[test]
fn skipping_leaves_nothing() {
    Bench::adding("skip = \"1 min\"\n").refuses(
        "error: run.csv: leaving out what is asked for leaves 0 rows of a log of 19.995 s\n\
         hint: leave out less: see `skip`, `until` and `leave_out`",
    );
}
