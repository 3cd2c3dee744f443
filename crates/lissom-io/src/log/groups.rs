//! Groups of channels in a file.

use std::collections::HashSet;

use lissom_formats::LogData;

/// The groups that are runs perhaps: two of them have a channel of the same name.
pub(crate) fn alike_groups(data: &LogData) -> Option<Vec<String>> {
    let before = common_path(data);
    let mut names = HashSet::new();
    let within = |name: &str| within(name, &before).map(|(_, name)| name.to_owned());
    let twice = paths(data).filter_map(within).any(|name| !names.insert(name));
    twice.then(|| groups(data))
}

/// The pattern that all groups fit.
pub(crate) fn all_groups(data: &LogData) -> String {
    format!("{}*", common_path(data))
}

/// The pattern that a group and those beside it fit.
pub(crate) fn beside(group: &str) -> String {
    let before = group.rsplit_once('/').map_or(String::new(), |(before, _)| format!("{before}/"));
    format!("{before}*")
}

/// The groups at the beginnings of the paths of channels, behind what all have in common.
pub(crate) fn groups(data: &LogData) -> Vec<String> {
    let before = common_path(data);
    let mut found: Vec<String> = Vec::new();
    for (group, _) in paths(data).filter_map(|name| within(name, &before)) {
        if !found.iter().rev().any(|known| known == group) {
            found.push(group.to_owned());
        }
    }
    found
}

fn paths(data: &LogData) -> impl Iterator<Item = &str> {
    data.channels.iter().map(|channel| channel.name.trim_start_matches('/'))
}

/// The group of a channel, with the path before it, and the name within the group.
fn within<'a>(name: &'a str, before: &str) -> Option<(&'a str, &'a str)> {
    let rest = name.strip_prefix(before)?;
    let at = slashes(rest).next()?;
    Some((&name[..before.len() + at], &rest[at + 1..]))
}

/// Places of the slashes in a name; those of a unit in brackets do not count.
fn slashes(name: &str) -> impl Iterator<Item = usize> {
    let mut depth = 0_usize;
    name.char_indices().filter_map(move |(at, c)| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        (c == '/' && depth == 0).then_some(at)
    })
}

/// The path that all channels in groups have before their groups, as `measurements/`.
fn common_path(data: &LogData) -> String {
    let has_group = |name: &str| slashes(name).next().is_some();
    let mut names = paths(data).filter(|name| has_group(name));
    let Some(first) = names.next() else { return String::new() };
    let others: Vec<&str> = names.collect();
    let ends = slashes(first).map(|at| at + 1);
    // Behind it there must be groups.
    let is_common = |end: &usize| {
        others.iter().all(|name| name.strip_prefix(&first[..*end]).is_some_and(has_group))
            && has_group(&first[*end..])
    };
    ends.take_while(is_common).last().map_or_else(String::new, |end| first[..end].to_owned())
}
