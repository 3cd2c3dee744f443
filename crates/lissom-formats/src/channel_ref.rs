//! Channels asked for, by name or number.

use std::fmt;
use std::slice;

/// A channel of a log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ChannelRef {
    /// By its name, without blanks and comment marks around it, or by the end of its path.
    Name(String),
    /// By its number in the file, from 1.
    Number(usize),
}

impl fmt::Display for ChannelRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "\"{name}\""),
            Self::Number(number) => write!(f, "{number}"),
        }
    }
}

/// A name without blanks and the mark of a comment before it.
pub fn bare_name(name: &str) -> &str {
    name.trim().trim_start_matches(['#', '%', ' '])
}

/// The channels of a file whose values are read; others have no values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wanted<'a>(Option<&'a [ChannelRef]>);

impl<'a> Wanted<'a> {
    pub(crate) const ALL: Self = Self(None);

    pub(crate) fn of(channels: &'a [ChannelRef]) -> Self {
        Self(Some(channels))
    }

    /// Whether all names asked for are among these: others may be of channels that are made of several ones.
    pub(crate) fn are_all_in(self, names: &[&str]) -> bool {
        self.0.is_none_or(|channels| {
            let is_in = |channel: &ChannelRef| match channel {
                ChannelRef::Name(_) => {
                    names.iter().any(|name| Wanted::of(slice::from_ref(channel)).has(name))
                }
                ChannelRef::Number(number) => *number <= names.len(),
            };
            channels.iter().all(is_in)
        })
    }

    /// Whether a channel may be asked for by this name or by any number.
    pub(crate) fn has(self, name: &str) -> bool {
        self.has_at(name, None)
    }

    /// Whether a channel `BEFORE[PLACE]AFTER` may be asked for, with any place.
    pub(crate) fn has_place(self, before: &str, after: &str) -> bool {
        let before = bare_name(before);
        let last = match after.rsplit_once('/') {
            Some((_, last)) => last,
            None => before.rsplit('/').next().unwrap_or_default(),
        };
        let is_place = |place: &str| place.starts_with('[') && place.ends_with(']');
        let has = |wanted: &str| {
            let of = wanted.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
            let of_last = if after.contains('/') {
                wanted == last
            } else {
                wanted.strip_prefix(last).is_some_and(is_place)
            };
            of.is_some_and(is_place) || of_last
        };
        self.0.is_none_or(|channels| {
            channels.iter().any(|channel| match channel {
                ChannelRef::Name(wanted) => has(bare_name(wanted)),
                ChannelRef::Number(_) => true,
            })
        })
    }

    /// Whether a channel of a group may be asked for: by a path in it, or by a name that `may_be_in` it.
    #[cfg(feature = "mcap")]
    pub(crate) fn has_in(self, group: &str, may_be_in: impl Fn(&str) -> bool) -> bool {
        self.0.is_none_or(|channels| {
            channels.iter().any(|channel| match channel {
                ChannelRef::Name(wanted) => {
                    let wanted = bare_name(wanted);
                    wanted.starts_with(bare_name(group))
                        || (!wanted.contains('/') && may_be_in(wanted))
                }
                ChannelRef::Number(_) => true,
            })
        })
    }

    /// Whether a channel may be asked for by this name or this number, from 1; `None` if its number is not known yet.
    pub(crate) fn has_at(self, name: &str, number: Option<usize>) -> bool {
        let name = bare_name(name);
        let last = name.rsplit('/').next();
        self.0.is_none_or(|channels| {
            channels.iter().any(|channel| match channel {
                ChannelRef::Name(wanted) => {
                    let wanted = bare_name(wanted);
                    name == wanted || last == Some(wanted)
                }
                ChannelRef::Number(wanted) => number.is_none_or(|number| number == *wanted),
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_that_are_asked_for() {
        let channels = [ChannelRef::Name("# q".to_owned()), ChannelRef::Name("a/i".to_owned())];
        let wanted = Wanted::of(&channels);
        for (name, expected) in [("q", true), ("run1/q", true), ("a/i", true), ("b/i", false)] {
            assert_eq!(wanted.has(name), expected, "{name}");
        }
        let third = [ChannelRef::Number(3)];
        let third = Wanted::of(&third);
        assert!(third.has("q") && third.has_at("q", Some(3)) && !third.has_at("q", Some(2)));
        assert!(Wanted::ALL.has("q"));
    }

    #[test]
    fn places_that_are_asked_for() {
        let has = |wanted: &str, before: &str, after: &str| {
            Wanted::of(&[ChannelRef::Name(wanted.to_owned())]).has_place(before, after)
        };
        assert!(has("a/q[2]", "a/q", "") && has("q[2]", "a/q", "") && has("x", "a/q", "/p/x"));
        assert!(has("a/q[2]/x", "a/q", "/x") && !has("q[2]", "a/q", "/x") && !has("q", "a/q", ""));
    }
}
