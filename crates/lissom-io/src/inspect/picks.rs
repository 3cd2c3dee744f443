//! Channels of a log by what the user says, or by what they probably are.

use std::fmt::Write as _;

use super::draft_error::DraftError;
use super::inspected_channel::InspectedChannel;
use super::inspection::Inspection;
use super::roles::Role;
use super::user_choice::{Choice, quoted};
use lissom_formats::bare_name;

/// A channel for a role: which, why, and what the user says about it.
pub(super) struct Picked<'a> {
    pub(super) channel: &'a InspectedChannel,
    pub(super) why: Option<String>,
    pub(super) choice: Option<&'a Choice>,
}

/// Picks channels of a log, and writes them as a `campaign.toml` does.
pub(super) struct Picks<'a> {
    pub(super) log: &'a Inspection,
}

impl<'a> Picks<'a> {
    fn file(&self) -> String {
        self.log.file.display().to_string()
    }

    fn names(&self) -> Vec<String> {
        self.log.channels.iter().map(InspectedChannel::label).collect()
    }

    /// The channel that the user names.
    pub(super) fn named(&self, choice: &'a Choice) -> Result<Picked<'a>, DraftError> {
        let wanted = choice.column.as_str();
        let channels = &self.log.channels;
        let by = |fits: &dyn Fn(&str) -> bool| {
            let mut found = channels.iter().filter(|c| fits(&c.name));
            found.next().filter(|_| found.next().is_none())
        };
        let number = || wanted.parse::<usize>().ok().and_then(|n| channels.get(n.checked_sub(1)?));
        let bare = bare_name(wanted);
        let channel = by(&|name| name == bare)
            .or_else(|| by(&|name| name.rsplit('/').next() == Some(wanted)))
            .or_else(|| by(&|name| without_unit(name) == wanted))
            .or_else(number);
        let Some(channel) = channel else {
            let (file, column, names) = (self.file(), wanted.to_owned(), self.names());
            return Err(DraftError::NoChannel { file, column, names });
        };
        Ok(Picked { channel, why: None, choice: Some(choice) })
    }

    /// The channel for a role: the one that the user names, or the one that is guessed.
    pub(super) fn pick(
        &self,
        role: Role,
        said: Option<&'a Choice>,
    ) -> Result<Result<Picked<'a>, DraftError>, DraftError> {
        if let Some(choice) = said {
            return self.named(choice).map(Ok);
        }
        let labels = |all: &[usize]| all.iter().map(|k| self.log.channels[*k].label()).collect();
        Ok(match (self.log.roles.of(role), self.log.roles.several(role)) {
            (Some(guess), _) => Ok(Picked {
                channel: &self.log.channels[guess.channel],
                why: Some(guess.why.clone()),
                choice: None,
            }),
            (None, Some(all)) => {
                Err(DraftError::Several { file: self.file(), role, names: labels(all) })
            }
            (None, None) => {
                Err(DraftError::NoRole { file: self.file(), role, names: self.names() })
            }
        })
    }

    /// A table `{ column = …, unit = … }` with further keys.
    pub(super) fn table(
        &self,
        role: Role,
        picked: &Picked<'_>,
        more: &[(&str, String)],
    ) -> Result<(String, String), DraftError> {
        let channel = picked.channel;
        let said = picked.choice.and_then(|c| c.unit.clone());
        let stated = channel.unit.as_ref().filter(|u| u.known.is_some());
        let Some(unit) = said.or_else(|| stated.map(|u| u.text.clone())) else {
            let stated = channel.unit.as_ref().map(|u| u.text.clone());
            let (file, name) = (self.file(), self.spelled(channel));
            return Err(DraftError::NoUnit { file, role, name, stated });
        };
        let mut table = format!("{{ column = {}, unit = {}", self.column(channel), quoted(&unit));
        let keys = picked.choice.iter().flat_map(|c| &c.keys);
        let said: Vec<&str> = keys.clone().map(|(key, _)| key.as_str()).collect();
        let more = more.iter().filter(|(key, _)| !said.contains(key));
        for (key, value) in more.map(|(k, v)| (*k, v)).chain(keys.map(|(k, v)| (k.as_str(), v))) {
            let _ = write!(table, ", {key} = {value}");
        }
        table.push_str(" }");
        Ok((table, unit))
    }

    /// A column as a `campaign.toml` names it: by its name if it is the only one with it.
    pub(super) fn column(&self, channel: &InspectedChannel) -> String {
        let same = self.log.channels.iter().filter(|c| c.name == channel.name).count();
        if channel.name.is_empty() || same > 1 {
            channel.number.to_string()
        } else {
            quoted(&channel.name)
        }
    }

    /// A channel as an option names it.
    fn spelled(&self, channel: &InspectedChannel) -> String {
        if self.column(channel) == channel.number.to_string() {
            channel.number.to_string()
        } else {
            channel.name.clone()
        }
    }
}

/// A name without the unit in brackets at its end.
fn without_unit(name: &str) -> &str {
    let end = name.rfind(['[', '(']).filter(|at| *at > 0).unwrap_or(name.len());
    name[..end].trim_end()
}
