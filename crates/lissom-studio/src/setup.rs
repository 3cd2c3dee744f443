//! What the user says about the logs, as the page has it, and as the description of a campaign.

use std::path::PathBuf;

use lissom_io::EffortName;
use lissom_io::inspect::{
    Choice, CommandKey, Description, InspectedChannel, Inspection, LogTrim, Role,
};
use lissom_io::units::{Dimension, parse_quantity, parse_unit};
use serde::{Deserialize, Serialize};

use crate::problem::Problem;

/// What the user says about the logs. An empty text says nothing.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Setup {
    pub(crate) time: Option<Pick>,
    pub(crate) sample_time: String,
    pub(crate) run: String,
    pub(crate) header_row: Option<usize>,
    pub(crate) skip_rows: usize,
    pub(crate) command: Option<CommandPick>,
    pub(crate) hold: String,
    pub(crate) motor: Option<Pick>,
    pub(crate) speed: Option<Pick>,
    pub(crate) tips: Vec<Pick>,
    pub(crate) torque_constant: String,
    pub(crate) resistance: String,
    pub(crate) back_emf: String,
    pub(crate) gear_ratio: String,
    pub(crate) gravity: bool,
    pub(crate) mgl: String,
    pub(crate) skip: String,
    pub(crate) window: String,
    pub(crate) effort: EffortName,
    /// Logs that are not used.
    pub(crate) left_out: Vec<u64>,
    pub(crate) trims: Vec<Trim>,
}

/// A channel with its unit.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Pick {
    /// Name of the channel, or its number from 1.
    pub(crate) column: String,
    pub(crate) unit: String,
    pub(crate) scale: String,
    pub(crate) quantity: String,
    pub(crate) radius: String,
}

/// The command, and what it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CommandPick {
    pub(crate) kind: CommandKey,
    pub(crate) channel: Pick,
}

/// What of a log is left out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Trim {
    pub(crate) log: u64,
    pub(crate) skip: String,
    pub(crate) until: String,
    pub(crate) leave_out: Vec<[String; 2]>,
}

/// A text that says something.
fn said(text: &str) -> Option<String> {
    let text = text.trim();
    (!text.is_empty()).then(|| text.to_owned())
}

impl Pick {
    /// The channel of the log with this name or number.
    pub(crate) fn channel<'a>(&self, log: &'a Inspection) -> Option<&'a InspectedChannel> {
        let column = self.column.trim();
        let is_named = |c: &&InspectedChannel| c.name == column || c.number.to_string() == column;
        log.channels.iter().find(is_named)
    }

    /// The channel, which must be one of the log: names of other files are no channels here.
    fn choice(&self, log: &Inspection) -> Result<Option<Choice>, Problem> {
        let Some(column) = said(&self.column) else { return Ok(None) };
        if self.channel(log).is_none() {
            let error = format!("{}: there is no channel \"{column}\"", log.file.display());
            return Err(Problem::input(error, Some("choose one of its channels".to_owned())));
        }
        let mut keys = Vec::new();
        if let Some(scale) = said(&self.scale) {
            if !scale.parse::<f64>().is_ok_and(f64::is_finite) {
                let error =
                    format!("the scale of \"{column}\" must be a number, and \"{scale}\" is none");
                return Err(Problem::input(error, None));
            }
            keys.push(("scale".to_owned(), scale));
        }
        for (key, value) in [("quantity", &self.quantity), ("radius", &self.radius)] {
            keys.extend(said(value).map(|value| (key.to_owned(), quoted(&value))));
        }
        Ok(Some(Choice { column, unit: said(&self.unit), keys }))
    }

    /// The channel that is probably a point of the arm, if its unit is known.
    fn of_guessed_tip(log: &Inspection) -> Option<Self> {
        let channel = &log.channels[log.guess(Role::Tip)?.channel];
        let unit = channel.unit.as_ref().filter(|unit| unit.known.is_some())?;
        Some(Self { column: channel.asked(), unit: unit.text.clone(), ..Self::default() })
    }
}

/// A text as TOML writes it.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

impl Setup {
    /// The setup of a log about which nothing is said: a channel that is probably a point of the arm is one.
    pub(crate) fn guessed(log: &Inspection) -> Self {
        Self { tips: Pick::of_guessed_tip(log).into_iter().collect(), ..Self::default() }
    }

    /// Index of the channel with the time stamps; none if a sample time takes their place.
    pub(crate) fn time_channel(&self, log: &Inspection) -> Option<usize> {
        if said(&self.sample_time).is_some() {
            return None;
        }
        match &self.time {
            Some(pick) => Some(pick.channel(log)?.number - 1),
            None => Some(log.guess(Role::Time)?.channel),
        }
    }

    /// Seconds for one unit of the time stamps, or for one row; none if that is not known.
    pub(crate) fn stamp_s(&self, log: &Inspection) -> Option<f64> {
        if let Some(sample_time) = said(&self.sample_time) {
            return parse_quantity(&sample_time, Dimension::TIME).ok();
        }
        let channel = &log.channels[self.time_channel(log)?];
        let own = self.time.as_ref().and_then(|pick| said(&pick.unit));
        let unit = own.or_else(|| Some(channel.unit.as_ref()?.text.clone()))?;
        parse_unit(&unit, Dimension::TIME).ok()
    }

    /// The description of a campaign of the logs that are used, of which `log` is the first; `file` gives the path of a log.
    pub(crate) fn description(
        &self,
        log: &Inspection,
        file: impl Fn(u64) -> Option<PathBuf>,
    ) -> Result<Description, Problem> {
        let choice = |pick: &Option<Pick>| match pick {
            Some(pick) => pick.choice(log),
            None => Ok(None),
        };
        let mut tips = Vec::new();
        for tip in &self.tips {
            tips.extend(tip.choice(log)?);
        }
        let drive = [
            ("torque_constant", &self.torque_constant),
            ("resistance", &self.resistance),
            ("back_emf", &self.back_emf),
            ("gear_ratio", &self.gear_ratio),
        ];
        let drive =
            drive.into_iter().filter_map(|(key, value)| Some((key.to_owned(), said(value)?)));
        let trims = self.trims.iter().filter_map(|trim| {
            let file = file(trim.log)?;
            let (skip, until) = (said(&trim.skip), said(&trim.until));
            Some(LogTrim { file, skip, until, leave_out: trim.leave_out.clone() })
        });
        Ok(Description {
            time: choice(&self.time)?,
            sample_time: said(&self.sample_time),
            run: said(&self.run),
            command: self.command(log)?,
            motor: choice(&self.motor)?,
            speed: choice(&self.speed)?,
            tips,
            header_row: self.header_row,
            skip_rows: self.skip_rows,
            hold: said(&self.hold),
            drive: drive.collect(),
            gravity: self.gravity,
            mgl: said(&self.mgl),
            skip: said(&self.skip),
            window: said(&self.window),
            trims: trims.collect(),
            ..Description::default()
        })
    }

    fn command(&self, log: &Inspection) -> Result<Option<(CommandKey, Choice)>, Problem> {
        let Some(command) = &self.command else { return Ok(None) };
        Ok(command.channel.choice(log)?.map(|choice| (command.kind, choice)))
    }

    /// Says that the command is held between its samples, if nothing is said.
    pub(crate) fn say_sampled(&mut self) {
        if self.hold.is_empty() {
            "sampled".clone_into(&mut self.hold);
        }
    }

    /// Names of channels of the first log that are used, and that `log` does not have.
    pub(crate) fn lacking(&self, first: &Inspection, log: &Inspection) -> Vec<String> {
        let command = self.command.as_ref().map(|command| &command.channel);
        let picks = [self.time.as_ref(), self.motor.as_ref(), self.speed.as_ref(), command];
        let picked = picks.into_iter().flatten().chain(&self.tips).map(|pick| pick.column.clone());
        let guessed = [
            (Role::Time, self.time.is_none() && said(&self.sample_time).is_none()),
            (Role::Motor, self.motor.is_none()),
        ];
        let guessed = guessed.into_iter().filter(|(_, is_guessed)| *is_guessed);
        let guessed = guessed
            .filter_map(|(role, _)| Some(first.channels[first.guess(role)?.channel].asked()));
        let has = |column: &String| {
            let pick = Pick { column: column.clone(), ..Pick::default() };
            column.trim().is_empty() || pick.channel(log).is_some()
        };
        picked.chain(guessed).filter(|column| !has(column)).collect()
    }

    /// Takes the channels of another setup.
    pub(crate) fn pick_as(&mut self, other: Self) {
        let Self { time, command, motor, speed, tips, .. } = other;
        (self.time, self.command, self.motor, self.speed, self.tips) =
            (time, command, motor, speed, tips);
    }

    /// Removes what is said about logs that are not there.
    pub(crate) fn forget(&mut self, is_there: impl Fn(u64) -> bool) {
        self.left_out.retain(|log| is_there(*log));
        self.trims.retain(|trim| is_there(trim.log));
    }
}
