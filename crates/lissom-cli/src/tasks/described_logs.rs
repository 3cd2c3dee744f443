//! Logs that no campaign.toml describes.

use std::path::Path;

use lissom::DescribedLogs;
use lissom_io::inspect::{Description, Inspection, Role};

use crate::shared::shell_word::shell_word;

/// The option for a channel that is probably a point of the arm, if its unit is known.
pub(crate) fn tip_option(log: &Inspection) -> Option<String> {
    let tip = log.roles.of(Role::Tip)?;
    let channel = &log.channels[tip.channel];
    let unit = channel.unit.as_ref().filter(|unit| unit.known.is_some())?;
    Some(format!("--tip {}", shell_word(&format!("{}:{}", channel.label(), unit.text))))
}

/// What does not agree in the first log, and what of it is not used.
pub(crate) fn notes(logs: &DescribedLogs, said: &Description) -> Vec<String> {
    let unused = tip_option(&logs.log).filter(|_| said.tips.is_empty());
    let unused = unused.map(|option| {
        format!("a channel that is probably a point of the arm is not used: add {option}")
    });
    logs.log.notes.iter().cloned().chain(unused).collect()
}

/// Whether a path is that of a campaign.toml.
pub(crate) fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}
