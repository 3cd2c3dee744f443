//! A `campaign.toml` made of a log and of what the user says about it.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use lissom_formats::{Format, ReadOptions};

use super::draft_error::DraftError;
use super::inspection::Inspection;
use super::own_log::OwnLog;
use super::picks::{Picked, Picks};
use super::relations::Relation;
use super::roles::Role;
use super::row_labels::LabelOrder;
use super::stated_unit::UnitSource;
use super::user_choice::{Choice, CommandKey, quoted};
use super::words::{commanded, words};
use crate::log::LogPath;
use crate::units::{Dimension, parse_any_unit};

/// Why it is not known how a command acts.
const UNKNOWN: &str = "nothing shows how it acts between its samples: taken as measured, and it is reported if that matters; hold = \
                       \"measured\" for a sensor's value, \"sampled\" for one that the controller sets";

/// What a user says about logs. What is absent is taken from the log where it is unambiguous.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Description {
    /// The time stamps.
    pub time: Option<Choice>,
    /// The sample time of logs without stamps, as in "1 ms".
    pub sample_time: Option<String>,
    /// The column with the number or name of the run, if a log has several.
    pub run: Option<String>,
    /// The command.
    pub command: Option<(CommandKey, Choice)>,
    /// The motor's angle, position or speed.
    pub motor: Option<Choice>,
    /// The motor's speed, in addition to its angle.
    pub speed: Option<Choice>,
    /// Points of the arm.
    pub tips: Vec<Choice>,
    /// Row with the names of the columns, from 1; found if absent.
    pub header_row: Option<usize>,
    /// Rows at the top of a log that do not count.
    pub skip_rows: usize,
    /// Whether the command is held between samples (`sampled`) or a sensor's value (`measured`).
    pub hold: Option<String>,
    /// The same as the motion shows it, and why, for the case that nobody says it.
    pub hold_shown: Option<(String, String)>,
    /// Keys of `[drive]`, with their values as a `campaign.toml` has them.
    pub drive: Vec<(String, String)>,
    /// Whether gravity of an unbalanced load acts.
    pub gravity: bool,
    /// m·g·l of this load, as in "2.1 N*m".
    pub mgl: Option<String>,
    /// Beginning of every run to leave out, as in "1 s".
    pub skip: Option<String>,
    /// Length of the window of the regression, as in "0.3 s"; chosen from the data if absent.
    pub window: Option<String>,
    /// What of single logs is left out.
    pub trims: Vec<LogTrim>,
}

/// What of a log is left out. Times count from its first stamp.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct LogTrim {
    /// The log, as it is given.
    pub file: PathBuf,
    /// Its beginning, as in "1 s".
    pub skip: Option<String>,
    /// The time after which everything is left out.
    pub until: Option<String>,
    /// Stretches, each from and to.
    pub leave_out: Vec<[String; 2]>,
}

/// A `campaign.toml`, with what was taken from the log.
#[derive(Debug, Clone, PartialEq)]
pub struct CampaignDraft {
    /// The lines of the file, each with what is said about it.
    lines: Vec<Line>,
    /// The first log.
    file: String,
}

/// A line of a `campaign.toml`.
#[derive(Debug, Clone, PartialEq)]
struct Line {
    /// The line; a line to complete if something is missing.
    text: String,
    /// Why it is there.
    why: String,
    /// Whether it was taken from the log, and not said by the user.
    taken: bool,
    /// What is missing.
    missing: Option<DraftError>,
    /// Whether nothing says that its command is measured.
    assumes_hold: bool,
}

impl Line {
    fn said(text: String) -> Self {
        Self { text, why: String::new(), taken: false, missing: None, assumes_hold: false }
    }
    fn taken(text: String, why: String) -> Self {
        Self { why, taken: true, ..Self::said(text) }
    }
    fn missing(text: &str, error: DraftError) -> Self {
        Self { taken: true, missing: Some(error), ..Self::said(text.to_owned()) }
    }
}

impl Description {
    /// How to read the logs.
    pub fn text_options(&self) -> ReadOptions {
        ReadOptions {
            header_row: self.header_row,
            skip_rows: self.skip_rows,
            ..ReadOptions::default()
        }
    }
}

impl CampaignDraft {
    /// Makes a campaign of logs that have the same channels, of which `log` is the first.
    ///
    /// # Errors
    /// [`DraftError::NoChannel`] if the user names a channel that is not in the log. What is not known is no error here:
    /// see [`text`](Self::text).
    pub fn new(
        log: &Inspection,
        files: &[PathBuf],
        said: &Description,
    ) -> Result<Self, DraftError> {
        let signals = Signals { log, picks: Picks { log }, said };
        let mut lines = vec![Line::said("[signals]".to_owned()), signals.time()?];
        lines.extend(signals.run()?);
        lines.push(signals.command()?);
        lines.push(signals.motor()?);
        lines.extend(signals.speed()?);
        lines.extend(signals.tips()?);
        let header = said.header_row.map(|row| format!("header_row = {row}"));
        let skipped = (said.skip_rows > 0).then(|| format!("skip_rows = {}", said.skip_rows));
        lines.extend(header.into_iter().chain(skipped).map(Line::said));
        if log.decimal_comma && log.format == Format::Text {
            lines.push(Line::taken(
                "decimal = \",\"".to_owned(),
                "numbers have a decimal comma".to_owned(),
            ));
        }
        let key = |key: &str, value: &str| Line::said(format!("{key} = {}", toml_value(value)));
        if !said.drive.is_empty() {
            lines.push(Line::said("\n[drive]".to_owned()));
            lines.extend(said.drive.iter().map(|(k, v)| key(k, v)));
        }
        if said.gravity || said.mgl.is_some() {
            lines.push(Line::said("\n[load]\ngravity = true".to_owned()));
            lines.extend(said.mgl.iter().map(|mgl| key("mgl", mgl)));
        }
        if said.skip.is_some() || said.window.is_some() {
            lines.push(Line::said("\n[analysis]".to_owned()));
            lines.extend(said.skip.iter().map(|skip| key("skip", skip)));
            lines.extend(said.window.iter().map(|window| key("window", window)));
        }
        lines.extend(files.iter().map(|file| run(file, files, &said.trims)));
        Ok(Self { lines, file: log.file.display().to_string() })
    }

    /// The text of the `campaign.toml`.
    ///
    /// # Errors
    /// What is neither in the log nor said by the user.
    pub fn text(&self) -> Result<String, DraftError> {
        let missing: Vec<DraftError> = self.missing().cloned().collect();
        if !missing.is_empty() {
            return Err(DraftError::incomplete(self.file.clone(), missing));
        }
        let mut text = String::new();
        for line in &self.lines {
            text.push_str(&line.text);
            text.push('\n');
        }
        Ok(text)
    }

    /// What was taken from the log, each with the reason.
    pub fn taken(&self) -> impl Iterator<Item = (&str, &str)> {
        let taken = self.lines.iter().filter(|l| l.taken && l.missing.is_none());
        taken.map(|l| (l.text.as_str(), l.why.as_str()))
    }

    /// Whether the command is taken as measured because nothing says how it acts between its samples.
    pub fn assumes_hold(&self) -> bool {
        self.lines.iter().any(|line| line.assumes_hold && line.missing.is_none())
    }

    /// What is missing.
    pub fn missing(&self) -> impl Iterator<Item = &DraftError> {
        self.lines.iter().filter_map(|l| l.missing.as_ref())
    }

    /// The text with comments; what is missing stands there as a comment to complete.
    pub fn commented(&self) -> String {
        let mut text = String::new();
        for line in &self.lines {
            if let Some(missing) = &line.missing {
                let _ = writeln!(text, "# TO DO: {}", one_line(&missing.to_string()));
                let _ = writeln!(text, "# {}", one_line(&line.text));
            } else if line.why.is_empty() {
                let _ = writeln!(text, "{}", line.text);
            } else {
                let _ = writeln!(text, "{}   # {}", line.text, one_line(&line.why));
            }
        }
        text
    }
}

/// A text as one line of a comment: names in a log may have line ends.
fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// The table of a run, named as its file if no other file has that name.
fn run(file: &Path, files: &[PathBuf], trims: &[LogTrim]) -> Line {
    let mut text = format!("\n[[runs]]\nfile = {}", quoted(&file.display().to_string()));
    let name = LogPath::of(file).name();
    let only = files.iter().filter(|f| LogPath::of(f).name() == name).count() == 1;
    if only && name != file.display().to_string() {
        let _ = write!(text, "\nname = {}", quoted(&name));
    }
    if let Some(trim) = trims.iter().find(|trim| trim.file == file) {
        for (key, time) in [("skip", &trim.skip), ("until", &trim.until)] {
            let _ = time.as_ref().map(|time| write!(text, "\n{key} = {}", toml_value(time)));
        }
        if !trim.leave_out.is_empty() {
            let stretch =
                |[from, to]: &[String; 2]| format!("[{}, {}]", toml_value(from), toml_value(to));
            let all: Vec<String> = trim.leave_out.iter().map(stretch).collect();
            let _ = write!(text, "\nleave_out = [{}]", all.join(", "));
        }
    }
    Line::said(text)
}

/// A value of TOML: a number as it is, another one as a text.
fn toml_value(value: &str) -> String {
    if value.parse::<f64>().is_ok_and(f64::is_finite) { value.to_owned() } else { quoted(value) }
}

/// Makes the lines of `[signals]`.
struct Signals<'a> {
    log: &'a Inspection,
    picks: Picks<'a>,
    said: &'a Description,
}

impl Signals<'_> {
    /// The line for a channel, or what is missing.
    fn line(&self, key: &str, role: Role, picked: &Picked<'_>, more: &[(&str, String)]) -> Line {
        match self.picks.table(role, picked, more) {
            Ok((table, unit)) => {
                let text = format!("{key} = {table}");
                let unit_from = picked.channel.unit.as_ref().map(|u| u.source);
                let unit_said = picked.choice.is_some_and(|c| c.unit.is_some());
                let of_name = !unit_said && unit_from == Some(UnitSource::Name);
                let stated = picked.channel.unit.as_ref().filter(|u| u.known.is_some());
                let unit_why = match stated {
                    _ if of_name => "the unit is the end of its name".to_owned(),
                    Some(stated) if unit_said && stated.text != unit => {
                        format!("{unit} is given, the log states {}", stated.text)
                    }
                    _ => String::new(),
                };
                let whys = picked.why.iter().map(String::as_str).chain([unit_why.as_str()]);
                let why = whys.filter(|w| !w.is_empty()).collect::<Vec<_>>().join("; ");
                if why.is_empty() { Line::said(text) } else { Line::taken(text, why) }
            }
            Err(error) => {
                let column = self.picks.column(picked.channel);
                Line::missing(&format!("{key} = {{ column = {column}, unit = \"?\" }}"), error)
            }
        }
    }

    fn time(&self) -> Result<Line, DraftError> {
        if let Some(sample_time) = &self.said.sample_time {
            return Ok(self.sample_time(sample_time));
        }
        Ok(match self.picks.pick(Role::Time, self.said.time.as_ref())? {
            Ok(picked) => self.line("time", Role::Time, &picked, &[]),
            Err(error) => Line::missing("time = { column = \"?\", unit = \"s\" }", error),
        })
    }

    /// The line for a sample time, which says so if time stamps are then not used.
    fn sample_time(&self, sample_time: &str) -> Line {
        let text = format!("sample_time = {}", quoted(sample_time));
        let Some(stamps) = self.log.roles.of(Role::Time) else { return Line::said(text) };
        let channel = &self.log.channels[stamps.channel];
        let step = self.log.clock.as_ref().map_or_else(String::new, |clock| {
            let unit = channel.unit.as_ref().map_or("", |unit| unit.text.as_str());
            format!(", whose usual step is {:.3e} {unit}", clock.step)
        });
        let why = format!("in place of the time stamps of {}{}", channel.label(), step.trim_end());
        Line::taken(text, why)
    }

    fn run(&self) -> Result<Option<Line>, DraftError> {
        let Some(column) = &self.said.run else { return Ok(self.labels()) };
        let choice = Choice { column: column.clone(), unit: None, keys: Vec::new() };
        let channel = self.picks.named(&choice)?.channel;
        Ok(Some(Line::said(format!("run = {}", self.picks.column(channel)))))
    }

    /// The line for the column that tells the rows of a log apart.
    fn labels(&self) -> Option<Line> {
        let labels = self.log.labels.as_ref()?;
        let channel = &self.log.channels[labels.channel];
        match labels.order {
            LabelOrder::Restarts => Some(Line::taken(
                format!("run = {}", self.picks.column(channel)),
                format!("the time starts again with each of its {} values", labels.values.len()),
            )),
            LabelOrder::Blocks => None,
            LabelOrder::InTurn => Some(Line::missing(
                "run = ?",
                DraftError::RowsInTurn {
                    file: self.log.file.display().to_string(),
                    column: channel.asked(),
                    values: labels.values.clone(),
                },
            )),
        }
    }

    fn command(&self) -> Result<Line, DraftError> {
        let (key, role, picked) = if let Some((key, choice)) = &self.said.command {
            let role = match key {
                CommandKey::Current => Role::Current,
                CommandKey::Voltage => Role::Voltage,
                CommandKey::Torque | CommandKey::Goal => Role::Torque,
            };
            (*key, role, Ok(self.picks.named(choice)?))
        } else {
            let roles = [
                (CommandKey::Current, Role::Current),
                (CommandKey::Torque, Role::Torque),
                (CommandKey::Voltage, Role::Voltage),
            ];
            let known = |role: &Role| {
                self.log.roles.of(*role).is_some() || self.log.roles.several(*role).is_some()
            };
            let (key, role) = roles.into_iter().find(|(_, role)| known(role)).unwrap_or(roles[0]);
            (key, role, self.picks.pick(role, None)?)
        };
        Ok(match picked {
            Ok(picked) => {
                let (hold, why) = self.hold(&picked);
                let mut more = vec![("hold", quoted(hold))];
                if key == CommandKey::Goal {
                    more.push(("quantity", quoted("goal")));
                }
                let mut line = self.line(key.name(), role, &picked, &more);
                if line.missing.is_none()
                    && let Some(why) = why
                {
                    line.assumes_hold = why == UNKNOWN;
                    line.why =
                        if line.why.is_empty() { why } else { format!("{}; {why}", line.why) };
                    line.taken = true;
                }
                line
            }
            Err(error) => Line::missing(
                "current = { column = \"?\", unit = \"A\", hold = \"measured\" }",
                error,
            ),
        })
    }

    /// `hold` of the command, and why if the user does not say it.
    fn hold(&self, picked: &Picked<'_>) -> (&str, Option<String>) {
        if let Some(hold) = &self.said.hold {
            return (hold, None);
        }
        if picked.choice.is_some_and(|c| c.keys.iter().any(|(key, _)| key == "hold")) {
            return ("measured", None);
        }
        if let Some((hold, why)) = &self.said.hold_shown {
            return (hold, Some(why.clone()));
        }
        let words = words(&picked.channel.name);
        // A voltage that a drive puts on the winding is its command.
        let drive = words.iter().find(|w| ["pwm", "duty"].contains(&w.as_str()));
        match commanded(&words).or(drive.map(String::as_str)) {
            Some(word) => ("sampled", Some(format!("taken as commanded: its name has \"{word}\""))),
            None => ("unknown", Some(UNKNOWN.to_owned())),
        }
    }

    fn motor(&self) -> Result<Line, DraftError> {
        if let Some(choice) = &self.said.motor
            && let Some(own) = OwnLog::of(choice, self.log)?
        {
            return Ok(match own.table(Role::Motor, self.said.time.as_ref())? {
                Ok((table, _)) => Line::said(format!("motor = {table}")),
                Err(error) => Line::missing("motor = { column = \"?\" }", error),
            });
        }
        let mut picked = self.picks.pick(Role::Motor, self.said.motor.as_ref())?;
        if matches!(picked, Err(DraftError::NoRole { .. }))
            && let Ok(speed) = self.picks.pick(Role::Speed, None)?
        {
            picked = Ok(speed);
        }
        Ok(match picked {
            Ok(picked) => {
                let said = picked.choice.and_then(|c| c.unit.as_deref());
                let dimension = match said {
                    Some(unit) => parse_any_unit(unit).ok().map(|(_, dimension)| dimension),
                    None => picked.channel.dimension(),
                };
                let rate = [Dimension::RATE, Dimension::VELOCITY];
                let speed = dimension.is_some_and(|d| rate.contains(&d));
                let more = speed.then(|| ("quantity", quoted("speed")));
                self.line("motor", Role::Motor, &picked, &more.into_iter().collect::<Vec<_>>())
            }
            Err(error) => Line::missing("motor = { column = \"?\", unit = \"rad\" }", error),
        })
    }

    fn speed(&self) -> Result<Option<Line>, DraftError> {
        if let Some(choice) = &self.said.speed {
            return Ok(Some(self.line("speed", Role::Speed, &self.picks.named(choice)?, &[])));
        }
        // A channel that is the rate of the motor's checks its unit and that of the time stamps.
        if let Some(choice) = &self.said.motor
            && OwnLog::of(choice, self.log)?.is_some()
        {
            return Ok(None);
        }
        let Ok(motor) = self.picks.pick(Role::Motor, self.said.motor.as_ref())? else {
            return Ok(None);
        };
        let Some(guess) = self.log.roles.of(Role::Speed) else { return Ok(None) };
        let channel = &self.log.channels[guess.channel];
        let rate_of = match channel.relation {
            Some(Relation::Rate { of, .. }) => Some(of + 1),
            _ => None,
        };
        if rate_of != Some(motor.channel.number) || channel.size().is_none() {
            return Ok(None);
        }
        let why = format!("it is the rate of {}: compared with it", motor.channel.label());
        let picked = Picked { channel, why: Some(why), choice: None };
        Ok(Some(self.line("speed", Role::Speed, &picked, &[])))
    }

    fn tips(&self) -> Result<Option<Line>, DraftError> {
        let mut tables = Vec::new();
        for choice in &self.said.tips {
            let table = if let Some(own) = OwnLog::of(choice, self.log)? {
                own.table(Role::Tip, self.said.time.as_ref())?
            } else {
                let picked = self.picks.named(choice)?;
                let name = [("name", quoted(&picked.channel.label()))];
                self.picks.table(Role::Tip, &picked, &name)
            };
            match table {
                Ok((table, _)) => tables.push(table),
                Err(error) => return Ok(Some(Line::missing("tips = [{ column = \"?\" }]", error))),
            }
        }
        let text = format!("tips = [{}]", tables.join(", "));
        Ok((!tables.is_empty()).then(|| Line::said(text)))
    }
}
