//! Writes a `campaign.toml`.

use std::fmt::Write as _;
use std::path::Path;

use lissom_core::record::{Hold, TipQuantity};

use super::write_error::WriteError;
use super::write_whole::write_text;

/// The contents of a written campaign, with signals in SI and time stamps in seconds.
#[derive(Debug, Clone, PartialEq)]
pub struct CampaignPlan {
    /// Comment at the top; may be empty.
    pub title: String,
    /// Name of the column of time stamps.
    pub time_column: String,
    /// The command channel.
    pub command: PlannedCommand,
    /// Name of the motor's column \[rad\].
    pub motor_column: String,
    /// Name, column and quantity of each tip.
    pub tips: Vec<(String, String, TipQuantity)>,
    /// Torque constant \[N·m/A\].
    pub torque_constant_nm_per_a: Option<f64>,
    /// Magnitude at which the current saturates \[A\].
    pub current_limit_a: Option<f64>,
    /// Whether gravity of an unbalanced load acts on the motor and is to be identified.
    pub gravity: bool,
    /// An `arm.toml` to compare with, relative to the campaign's folder.
    pub arm: Option<String>,
    /// The runs.
    pub runs: Vec<PlannedRun>,
}

/// A current channel.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedCommand {
    /// Name of its column \[A\].
    pub column: String,
    /// Whether the command is held between samples or measured.
    pub hold: Hold,
}

/// A run and its log.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// The log, relative to the campaign's folder.
    pub file: String,
    /// Drive frequency \[rad/s\].
    pub omega_rad_s: Option<f64>,
}

/// Writes a `campaign.toml`, completely or not at all.
///
/// # Errors
/// As [`write_whole`](super::write_whole).
pub fn write_campaign(path: &Path, plan: &CampaignPlan) -> Result<(), WriteError> {
    write_text(path, &campaign_text(plan))
}

/// The text of a `campaign.toml`.
pub fn campaign_text(plan: &CampaignPlan) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = put(&mut text, plan);
    text
}

fn put(text: &mut String, plan: &CampaignPlan) -> std::fmt::Result {
    for line in plan.title.lines() {
        writeln!(text, "# {}", line.replace(char::is_control, " "))?;
    }
    let hold = match plan.command.hold {
        Hold::Sampled => "sampled",
        Hold::Measured => "measured",
    };
    writeln!(text, "[signals]")?;
    writeln!(text, "time = {{ column = {}, unit = \"s\" }}", quoted(&plan.time_column))?;
    let command = quoted(&plan.command.column);
    writeln!(text, "current = {{ column = {command}, unit = \"A\", hold = \"{hold}\" }}")?;
    writeln!(text, "motor = {{ column = {}, unit = \"rad\" }}", quoted(&plan.motor_column))?;
    if !plan.tips.is_empty() {
        writeln!(text, "tips = [")?;
        for (name, column, quantity) in &plan.tips {
            let (quantity, unit) = match quantity {
                TipQuantity::Angle => ("angle", "rad"),
                TipQuantity::Deflection => ("deflection", "rad"),
                TipQuantity::Acceleration => ("acceleration", "rad/s^2"),
            };
            let (name, column) = (quoted(name), quoted(column));
            writeln!(
                text,
                "    {{ name = {name}, column = {column}, unit = \"{unit}\", quantity = \"{quantity}\" }},"
            )?;
        }
        writeln!(text, "]")?;
    }
    writeln!(text, "\n[drive]")?;
    if let Some(constant) = plan.torque_constant_nm_per_a {
        writeln!(text, "torque_constant = \"{constant} N*m/A\"")?;
    }
    if let Some(limit) = plan.current_limit_a {
        writeln!(text, "current_limit = \"{limit} A\"")?;
    }
    if let Some(arm) = &plan.arm {
        writeln!(text, "arm = {}", quoted(arm))?;
    }
    if plan.gravity {
        writeln!(text, "\n[load]\ngravity = true")?;
    }
    for run in &plan.runs {
        writeln!(text, "\n[[runs]]\nfile = {}", quoted(&run.file))?;
        if let Some(omega_rad_s) = run.omega_rad_s {
            writeln!(text, "omega_rad_s = {omega_rad_s:?}")?;
        }
    }
    Ok(())
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}
