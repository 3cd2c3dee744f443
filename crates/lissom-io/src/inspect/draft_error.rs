//! Why no campaign can be made of a log and what the user says.

use thiserror::Error;

use super::roles::Role;
use super::row_labels::RowLabels;
use crate::log::beside;
use crate::units::UnitError;

/// Why no campaign can be made of a log and what the user says.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum DraftError {
    /// No log is given.
    #[error("no log is given")]
    NoLog,
    /// What is said about a channel cannot be read.
    #[error("\"{text}\": {reason}")]
    Choice {
        /// What was said.
        text: String,
        /// What is wrong.
        reason: String,
    },
    /// The log of a channel that has one of its own cannot be read.
    #[error("{reason}")]
    OwnLog {
        /// Why, with its name.
        reason: String,
    },
    /// The unit is not known.
    #[error("\"{text}\": {source}")]
    Unit {
        /// What was said.
        text: String,
        /// What is wrong with the unit.
        source: UnitError,
    },
    /// There is no such channel.
    #[error("{file}: there is no channel \"{column}\"; the channels are {}", list(.names))]
    NoChannel {
        /// The log.
        file: String,
        /// What was asked for.
        column: String,
        /// The channels.
        names: Vec<String>,
    },
    /// Nothing shows which channel has this role.
    #[error("{file}: no channel is clearly the {}; the channels are {}", .role.name(), list(.names))]
    NoRole {
        /// The log.
        file: String,
        /// The role.
        role: Role,
        /// The channels.
        names: Vec<String>,
    },
    /// Several channels fit.
    #[error("{file}: several channels may be the {}: {}", .role.name(), list(.names))]
    Several {
        /// The log.
        file: String,
        /// The role.
        role: Role,
        /// These channels.
        names: Vec<String>,
    },
    /// The unit of a channel is not stated.
    #[error("{file}: the unit of the {}, channel \"{name}\", is not stated{}", .role.name(), not_known(.stated.as_deref()))]
    NoUnit {
        /// The log.
        file: String,
        /// The role of the channel.
        role: Role,
        /// Its name, or its number.
        name: String,
        /// A unit that the file states and that is not known.
        stated: Option<String>,
    },
    /// A channel has another unit in another log.
    #[error("{file}: the unit of \"{channel}\" is {unit}, {of_first}")]
    OtherUnit {
        /// The log.
        file: String,
        /// The channel.
        channel: String,
        /// Its unit there.
        unit: String,
        /// Its unit in the first log, in words.
        of_first: String,
    },
    /// The rows are of several joints.
    #[error("{file}: {}", RowLabels::in_turn(.column, .file, .values))]
    RowsInTurn {
        /// The log.
        file: String,
        /// The column that tells them apart.
        column: String,
        /// Its values.
        values: Vec<String>,
    },
    /// Several things are missing.
    #[error("{file}: {}", joined(.file, .missing))]
    Incomplete {
        /// The log.
        file: String,
        /// What is missing.
        missing: Vec<DraftError>,
    },
}

/// What is missing, with the names of all channels once.
fn joined(file: &str, missing: &[DraftError]) -> String {
    let before = format!("{file}: ");
    let mut parts = Vec::new();
    let roles = missing.iter().filter_map(|error| match error {
        DraftError::NoRole { role, .. } => Some(role.name()),
        _ => None,
    });
    let roles: Vec<&str> = roles.collect();
    if let Some(DraftError::NoRole { names, .. }) =
        missing.iter().find(|e| matches!(e, DraftError::NoRole { .. }))
    {
        parts.push(format!(
            "no channel is clearly the {}; the channels are {}",
            roles.join(", the "),
            list(names)
        ));
    }
    let units = missing.iter().filter_map(|error| match error {
        DraftError::NoUnit { role, name, stated, .. } => {
            Some(format!("{} \"{name}\"{}", role.name(), not_known(stated.as_deref())))
        }
        _ => None,
    });
    let units: Vec<String> = units.collect();
    if !units.is_empty() {
        parts.push(format!("the unit is not stated of the {}", units.join(", the ")));
    }
    let others = missing
        .iter()
        .filter(|e| !matches!(e, DraftError::NoRole { .. } | DraftError::NoUnit { .. }));
    parts.extend(others.map(|error| {
        let text = error.to_string();
        text.strip_prefix(&before).map_or(text.clone(), str::to_owned)
    }));
    parts.join("; ")
}

/// Channels that are named in a message at most.
const MOST: usize = 30;

fn list(names: &[String]) -> String {
    let mut text =
        names.iter().take(MOST).map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ");
    if names.len() > MOST {
        text.push_str(", …");
    }
    text
}

fn not_known(stated: Option<&str>) -> String {
    stated.map_or_else(String::new, |unit| {
        format!(" in a unit that is known (the file says \"{unit}\")")
    })
}

impl DraftError {
    /// All that is missing, as one error.
    pub(super) fn incomplete(file: String, missing: Vec<Self>) -> Self {
        match <[Self; 1]>::try_from(missing) {
            Ok([only]) => only,
            Err(missing) => Self::Incomplete { file, missing },
        }
    }

    /// The key that states what is missing, and its value, `COLUMN:UNIT`; `UNIT` stands for the unit, which only the user
    /// knows.
    pub fn statement(&self) -> Option<(&'static str, String)> {
        let (role, name) = match self {
            Self::NoRole { role, .. } | Self::Several { role, .. } => (role, None),
            Self::NoUnit { role, name, .. } => (role, Some(name.as_str())),
            _ => return None,
        };
        let key = match role {
            Role::Time => "time",
            Role::Current => "current",
            Role::Torque => "command",
            Role::Voltage => "voltage",
            Role::Motor => "motor",
            Role::Speed => "speed",
            Role::Tip => "tips",
        };
        Some((key, format!("{}:UNIT", name.unwrap_or("COLUMN"))))
    }

    /// What the user can do, with keys written as `key = "value"`.
    pub fn hint(&self) -> Option<String> {
        self.hint_with(&|key, value| format!("{key} = \"{value}\""))
    }

    /// What the user can do; `write` writes a key with its value.
    pub fn hint_with(&self, write: &dyn Fn(&str, &str) -> String) -> Option<String> {
        let written = |error: &Self| error.statement().map(|(key, value)| write(key, &value));
        match self {
            Self::NoLog | Self::OwnLog { .. } | Self::RowsInTurn { .. } => None,
            Self::OtherUnit { .. } => Some(
                "identify logs with different units apart, or bring them to the same units"
                    .to_owned(),
            ),
            Self::Choice { .. } => {
                Some("write COLUMN:UNIT, as in q:deg, or counts:rad,scale=0.001534".to_owned())
            }
            Self::Unit { source, .. } => source.hint(),
            Self::NoChannel { column, names, .. }
                if names.iter().filter(|name| *name == column).count() > 1 =>
            {
                let of_name = (1..).zip(names).filter(|(_, name)| *name == column);
                let numbers: Vec<String> =
                    of_name.map(|(k, _): (usize, _)| k.to_string()).collect();
                Some(format!(
                    "several channels have this name: give the number of one of them, {}",
                    numbers.join(" or ")
                ))
            }
            Self::NoChannel { file, column, names }
                if names.iter().filter(|n| n.rsplit('/').next() == Some(column)).count() > 1 =>
            {
                let groups = of_group(names, column);
                Some(format!(
                    "channels of this name are in several groups: if these are runs, give the log as \"{file}::{groups}\", or \
                     one of them by its group"
                ))
            }
            Self::NoChannel { .. } => {
                Some("give the name of a channel as in this list, or its number from 1".to_owned())
            }
            Self::Several { file, names, .. } if are_in_groups(names) => {
                let groups = of_group(names, names[0].rsplit('/').next().unwrap_or_default());
                Some(format!(
                    "if these are runs, give the log as \"{file}::{groups}\", or one of them by its group"
                ))
            }
            Self::NoRole { role, .. } | Self::Several { role, .. } | Self::NoUnit { role, .. } => {
                Some(format!("{}{}", with_right_units(written(self)), more(*role, write)))
            }
            Self::Incomplete { missing, .. } => {
                let statements: Vec<String> = missing.iter().filter_map(written).collect();
                Some(with_right_units(Some(statements.join(" "))))
            }
        }
    }
}

/// The pattern of the groups that have a channel.
fn of_group(names: &[String], channel: &str) -> String {
    let end = format!("/{channel}");
    let group = names.iter().find_map(|name| name.trim_start_matches('/').strip_suffix(&end));
    beside(group.unwrap_or_default())
}

/// Whether the names are those of one channel in several groups.
fn are_in_groups(names: &[String]) -> bool {
    let inner = |name: &String| name.rsplit_once('/').map(|(_, inner)| inner.to_owned());
    let first = names.first().and_then(inner);
    first.is_some() && names.iter().all(|name| inner(name) == first)
}

fn with_right_units(statements: Option<String>) -> String {
    format!(
        "state it, with units such as s, ms, A, mA, rad, deg, rpm in place of UNIT: {}",
        statements.unwrap_or_default()
    )
}

/// Other ways to say what has this role.
fn more(role: Role, write: &dyn Fn(&str, &str) -> String) -> String {
    match role {
        Role::Time => format!("; without time stamps {}", write("sample_time", "1 ms")),
        Role::Current => format!(
            "; another input of the drive as {}, {}, or {} if its unit is unknown",
            write("voltage", "u:V"),
            write("command", "tau:N*m"),
            write("command", "v:1")
        ),
        Role::Torque => format!("; {} if its unit is unknown", write("command", "v:1")),
        Role::Motor => format!(
            "; a speed as {}, counts of an encoder as {} (2π divided by the counts per turn)",
            write("motor", "n:rpm"),
            write("motor", "counts:rad,scale=0.001534")
        ),
        Role::Voltage | Role::Speed | Role::Tip => String::new(),
    }
}
