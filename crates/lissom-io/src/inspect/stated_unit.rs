//! The unit of a channel, as the file states it.

use lissom_formats::Channel;

use super::words::words;
use crate::units::{Dimension, parse_any_unit};

/// A unit that the file states.
#[derive(Debug, Clone, PartialEq)]
pub struct StatedUnit {
    /// The unit, as a `campaign.toml` writes it; as in the file if it is not known.
    pub text: String,
    /// Where it stands.
    pub source: UnitSource,
    /// Its size in SI and its dimension; `None` if it is not known.
    pub known: Option<(f64, Dimension)>,
}

/// Where a unit stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitSource {
    /// In the file: in brackets after the name, in a row of units, or as the format has it.
    File,
    /// At the end of the name of the channel: `theta_deg`.
    Name,
}

/// Other spellings, in small letters, and the unit.
const SPELLINGS: [(&str, &str); 53] = [
    ("ncm", "cN*m"),
    ("n*cm", "cN*m"),
    ("n·cm", "cN*m"),
    ("oz-in", "ozf*in"),
    ("oz.in", "ozf*in"),
    ("oz*in", "ozf*in"),
    ("ozin", "ozf*in"),
    ("kg-cm", "kgf*cm"),
    ("kg.cm", "kgf*cm"),
    ("kgf-cm", "kgf*cm"),
    ("kgf.cm", "kgf*cm"),
    ("turns", "turn"),
    ("revs", "turn"),
    ("revolution", "turn"),
    ("revolutions", "turn"),
    ("umdr", "turn"),
    ("grad", "deg"),
    ("min^-1", "rpm"),
    ("min-1", "rpm"),
    ("min⁻¹", "rpm"),
    ("1/minute", "rpm"),
    ("sec", "s"),
    ("secs", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("msec", "ms"),
    ("millis", "ms"),
    ("milliseconds", "ms"),
    ("usec", "us"),
    ("micros", "us"),
    ("microseconds", "us"),
    ("nanoseconds", "ns"),
    ("nsec", "ns"),
    ("amp", "A"),
    ("amps", "A"),
    ("ampere", "A"),
    ("amperes", "A"),
    ("volt", "V"),
    ("volts", "V"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("rads", "rad"),
    ("rads/s", "rad/s"),
    ("rads/sec", "rad/s"),
    ("radians/s", "rad/s"),
    ("radians/sec", "rad/s"),
    ("u/min", "rpm"),
    ("1/min", "rpm"),
    ("n.m", "N*m"),
    ("n-m", "N*m"),
    ("meters", "m"),
];

/// Units of which the file does not say which they are: turns or radians in a time, a degree (in German) or a 400th of a turn, a
/// thousandth or a million.
const AMBIGUOUS: [&str; 9] = ["1/s", "s^-1", "s-1", "s⁻¹", "grad", "Mrad", "Mm", "MA", "Ms"];

/// Ends of names that state a unit, and the unit. Letters of ambiguous size, such as `m` and `s`, are not among them.
const ENDS: [(&str, &str); 25] = [
    ("rad_s", "rad/s"),
    ("rad_per_s", "rad/s"),
    ("radps", "rad/s"),
    ("rads", "rad/s"),
    ("rad/s", "rad/s"),
    ("deg_s", "deg/s"),
    ("degps", "deg/s"),
    ("deg/s", "deg/s"),
    ("rpm", "rpm"),
    ("rad", "rad"),
    ("mrad", "mrad"),
    ("deg", "deg"),
    ("A", "A"),
    ("mA", "mA"),
    ("V", "V"),
    ("mV", "mV"),
    ("Nm", "N*m"),
    ("mNm", "mN*m"),
    ("Ncm", "cN*m"),
    ("um", "um"),
    ("µm", "um"),
    ("ms", "ms"),
    ("us", "us"),
    ("ns", "ns"),
    ("mm", "mm"),
];

/// The unit that the file states for a channel.
pub(super) fn stated_unit(channel: &Channel) -> Option<StatedUnit> {
    let (text, source) = match &channel.unit {
        Some(unit) => (unit.trim().to_owned(), UnitSource::File),
        None => (of_name(&channel.name)?, UnitSource::Name),
    };
    Some(StatedUnit { source, ..known_unit(&text) })
}

/// The unit of a text, with other spellings.
pub(super) fn known_unit(text: &str) -> StatedUnit {
    // "theta in rad".
    let text = text.rsplit_once(" in ").map_or(text, |(_, unit)| unit.trim());
    let small = text.to_lowercase();
    let spelled = SPELLINGS.iter().find(|(spelling, _)| *spelling == small);
    let unit = spelled.map_or_else(|| text.to_owned(), |(_, unit)| (*unit).to_owned());
    if AMBIGUOUS.contains(&text) {
        return StatedUnit { text: text.to_owned(), source: UnitSource::File, known: None };
    }
    let known = parse_any_unit(&unit).ok();
    StatedUnit { text: unit, source: UnitSource::File, known }
}

/// The unit at the end of a name; seconds only for a name of a time.
fn of_name(name: &str) -> Option<String> {
    let name = name.trim();
    let begins = |end: &str| {
        let before = name.strip_suffix(end)?;
        (!before.is_empty() && before.ends_with(['_', '.', ' ', '-', '/'])).then_some(before)
    };
    let stated = ENDS.iter().find(|(end, _)| begins(end).is_some());
    if let Some((_, unit)) = stated {
        return Some((*unit).to_owned());
    }
    let time = |before: &str| {
        words(before).iter().any(|w| matches!(w.as_str(), "t" | "time" | "zeit" | "stamp"))
    };
    begins("s").filter(|before| time(before)).map(|_| "s".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_names() {
        let of = |name: &str| of_name(name);
        assert_eq!(of("theta_deg").as_deref(), Some("deg"));
        assert_eq!(of("speed_rad_s").as_deref(), Some("rad/s"));
        assert_eq!(of("i_A").as_deref(), Some("A"));
        assert_eq!(of("time_s").as_deref(), Some("s"));
        assert_eq!(of("q_s"), None);
        assert_eq!(of("deg"), None);
        assert_eq!(of("lima"), None);
    }

    #[test]
    fn other_spellings() {
        assert_eq!(known_unit("Seconds").text, "s");
        assert_eq!(known_unit("U/min").known.unwrap().1, Dimension::RATE);
        assert!(known_unit("inc").known.is_none());
        // A degree in German, not 10⁹ rad; a rate of turns or of radians.
        assert_eq!(known_unit("Grad").text, "deg");
        assert_eq!(known_unit("min^-1").text, "rpm");
        assert!(known_unit("1/s").known.is_none());
        assert!(known_unit("grad").known.is_none() && known_unit("MA").known.is_none());
        assert_eq!(known_unit("Theta in rad").text, "rad");
        assert_eq!(known_unit("rads/s").known.unwrap().1, Dimension::RATE);
        assert_eq!(known_unit("Ncm").text, "cN*m");
        assert_eq!(known_unit("oz-in").known.unwrap().1, Dimension::TORQUE);
    }
}
