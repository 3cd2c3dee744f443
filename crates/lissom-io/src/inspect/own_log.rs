//! A channel in a log of its own: `FILE::COLUMN`.

use std::path::Path;

use super::draft_error::DraftError;
use super::inspection::{Inspection, inspect};
use super::picks::Picks;
use super::roles::Role;
use super::user_choice::{Choice, quoted};
use crate::log::{LogPath, of_run};

/// A channel in a log of its own, as the user says it.
pub(super) struct OwnLog {
    /// The file as it is said.
    file: String,
    log: Inspection,
    /// The channel within the log, without the keys of the log.
    choice: Choice,
    time: Option<Choice>,
    clock: Option<String>,
}

impl OwnLog {
    /// The log, if the column is `FILE::COLUMN` and the file exists.
    ///
    /// # Errors
    /// [`DraftError`] if the log cannot be read.
    pub(super) fn of(choice: &Choice, first: &Inspection) -> Result<Option<Self>, DraftError> {
        let at = LogPath::of(Path::new(&of_run(&choice.column, &first.file)));
        let Some(column) = at.group.filter(|_| at.file.is_file()) else { return Ok(None) };
        let said = choice.column.strip_suffix(&format!("::{column}"));
        let file = said.map_or_else(|| at.file.display().to_string(), str::to_owned);
        let log =
            inspect(&at.file).map_err(|error| DraftError::OwnLog { reason: error.to_string() })?;
        let value = |key: &str| {
            let found = choice.keys.iter().find(|(known, _)| known == key);
            found.map(|(_, value)| value.trim_matches('"').to_owned())
        };
        let time = value("time").map(|text| Choice::parse(&text)).transpose()?;
        let of_log = |key: &str| ["time", "clock"].contains(&key);
        let keys = choice.keys.iter().filter(|(key, _)| !of_log(key)).cloned().collect();
        let choice = Choice { column, unit: choice.unit.clone(), keys };
        Ok(Some(Self { file, log, choice, time, clock: value("clock") }))
    }

    /// The table of the channel in `[signals]` and its unit, or what is missing. `time` is what is said about the first log,
    /// which also holds for this one if it has such a channel.
    ///
    /// # Errors
    /// [`DraftError::NoChannel`] if there is no such channel.
    pub(super) fn table(
        &self,
        role: Role,
        time: Option<&Choice>,
    ) -> Result<Result<(String, String), DraftError>, DraftError> {
        let picks = Picks { log: &self.log };
        let time = time.filter(|choice| picks.named(choice).is_ok());
        let time = match picks.pick(Role::Time, self.time.as_ref().or(time))? {
            Ok(picked) => match picks.table(Role::Time, &picked, &[]) {
                Ok((table, _)) => table,
                Err(error) => return Ok(Err(error)),
            },
            Err(error) => return Ok(Err(error)),
        };
        let picked = picks.named(&self.choice)?;
        let mut more = vec![("file", quoted(&self.file)), ("time", time)];
        if role == Role::Tip {
            more.insert(0, ("name", quoted(&picked.channel.label())));
        }
        more.extend(self.clock.as_ref().map(|clock| ("clock", quoted(clock))));
        Ok(picks.table(role, &picked, &more))
    }
}
