//! Arguments that describe logs in place of a campaign.toml.

use clap::Args;
use lissom_io::inspect::{Choice, CommandKey, Description};

use super::positive_time::positive_time;

/// What is said about logs that no campaign.toml describes.
#[derive(Debug, Args)]
#[command(next_help_heading = "Logs without a campaign.toml (COLUMN:UNIT, as in q:deg)")]
pub(crate) struct LogArgs {
    /// Time stamps [default: found]
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice, conflicts_with = "sample_time")]
    time: Option<Choice>,
    /// Sample time of logs without time stamps, e.g. "1 ms"
    #[arg(long, value_name = "TIME", value_parser = time_text)]
    sample_time: Option<String>,
    /// Column with the number or name of the run, if a log has several
    #[arg(long, value_name = "COLUMN")]
    run: Option<String>,
    /// Row of a text with the names, from 1 [default: found]
    #[arg(long, value_name = "ROW", value_parser = row)]
    header_row: Option<usize>,
    /// Rows at the top of a text that do not count
    #[arg(long, value_name = "ROWS", default_value_t = 0, hide_default_value = true)]
    skip_rows: usize,
    /// Motor current [default: found]
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice, group = "drive_input")]
    current: Option<Choice>,
    /// Motor voltage
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice, group = "drive_input")]
    voltage: Option<Choice>,
    /// Torque (tau:N*m), or a command of unknown unit (v:1)
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice, group = "drive_input")]
    command: Option<Choice>,
    /// Position reference of a servo
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice, group = "drive_input")]
    goal: Option<Choice>,
    /// Input commanded (sampled), measured, or unknown
    #[arg(long, value_name = "HOLD", value_parser = ["sampled", "measured", "unknown"], hide_possible_values = true)]
    hold: Option<String>,
    /// Angle, position or speed of the motor [default: found]
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice)]
    motor: Option<Choice>,
    /// Speed of the motor, to be compared with its angle
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice)]
    speed: Option<Choice>,
    /// A point of the arm (repeatable); FILE::COLUMN in another log
    #[arg(long, value_name = "COLUMN:UNIT", value_parser = choice)]
    tip: Vec<Choice>,
    /// Torque constant, e.g. "0.1 N*m/A"
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    torque_constant: Option<String>,
    /// Resistance of the winding, e.g. "1.2 ohm"
    #[arg(long, value_name = "QUANTITY")]
    resistance: Option<String>,
    /// Back-EMF constant, e.g. "0.1 V*s/rad"
    #[arg(long, value_name = "QUANTITY")]
    back_emf: Option<String>,
    /// Turns of the motor for one turn of the joint
    #[arg(long, value_name = "NUMBER")]
    gear_ratio: Option<f64>,
    /// Gravity of an unbalanced load acts: identify its torque
    #[arg(long)]
    gravity: bool,
    /// Known torque m·g·l of this load, e.g. "2.1 N*m"
    #[arg(long, value_name = "QUANTITY")]
    mgl: Option<String>,
    /// Beginning of every log to leave out, e.g. "1 s"
    #[arg(long, value_name = "TIME", value_parser = time_text)]
    skip: Option<String>,
}

fn choice(text: &str) -> Result<Choice, String> {
    Choice::parse(text).map_err(|error| match error.hint() {
        Some(hint) => format!("{error}\nhint: {hint}"),
        None => error.to_string(),
    })
}

/// A row of a text, counted from 1.
pub(super) fn row(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok().filter(|row| *row > 0);
    number.ok_or_else(|| "rows are counted from 1".to_owned())
}

fn time_text(text: &str) -> Result<String, String> {
    positive_time(text).map(|_| text.to_owned())
}

impl LogArgs {
    /// Whether nothing is said.
    pub(crate) fn is_empty(&self) -> bool {
        self.description() == Description::default()
    }

    /// What is said.
    pub(crate) fn description(&self) -> Description {
        let inputs = [
            (CommandKey::Current, self.current.clone()),
            (CommandKey::Voltage, self.voltage.clone()),
            (CommandKey::Torque, self.command.clone()),
            (CommandKey::Goal, self.goal.clone()),
        ];
        let drive = [
            ("torque_constant", self.torque_constant.clone()),
            ("resistance", self.resistance.clone()),
            ("back_emf", self.back_emf.clone()),
            ("gear_ratio", self.gear_ratio.map(|ratio| ratio.to_string())),
        ];
        Description {
            time: self.time.clone(),
            sample_time: self.sample_time.clone(),
            run: self.run.clone(),
            header_row: self.header_row,
            skip_rows: self.skip_rows,
            command: inputs.into_iter().find_map(|(key, said)| Some((key, said?))),
            motor: self.motor.clone(),
            speed: self.speed.clone(),
            tips: self.tip.clone(),
            hold: self.hold.clone(),
            drive: drive.into_iter().filter_map(|(k, v)| Some((k.to_owned(), v?))).collect(),
            gravity: self.gravity,
            mgl: self.mgl.clone(),
            skip: self.skip.clone(),
            ..Description::default()
        }
    }
}
