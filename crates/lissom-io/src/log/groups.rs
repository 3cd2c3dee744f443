//! Groups of channels in a file.

use std::collections::HashSet;

use lissom_formats::{Channel, LogData};

/// The groups at the beginnings, if two of them have a channel of the same name: they may be runs.
pub(crate) fn alike_groups(data: &LogData) -> Option<Vec<String>> {
    let mut names = HashSet::new();
    let within =
        |c: &'_ Channel| c.name.trim_start_matches('/').split_once('/').map(|(_, n)| n.to_owned());
    let twice = data.channels.iter().filter_map(within).any(|name| !names.insert(name));
    twice.then(|| groups(data))
}

/// The groups at the beginnings of the paths of channels.
pub(crate) fn groups(data: &LogData) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for channel in &data.channels {
        if let Some((group, _)) = channel.name.trim_start_matches('/').split_once('/')
            && found.last().is_none_or(|last| last != group)
            && !found.iter().any(|known| known == group)
        {
            found.push(group.to_owned());
        }
    }
    found
}
