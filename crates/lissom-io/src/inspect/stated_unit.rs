//! The unit of a channel, as the file states it.

use lissom_formats::Channel;

use super::words::{is_among, words};
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

/// Units, and other spellings of them in small letters.
const SPELLINGS: [(&str, &str); 16] = [
    ("cN*m", "ncm n*cm n·cm"),
    ("ozf*in", "oz-in oz.in oz*in ozin"),
    ("kgf*cm", "kg-cm kg.cm kgf-cm kgf.cm"),
    ("turn", "turns revs revolution revolutions umdr"),
    ("deg", "grad degree degrees"),
    ("rpm", "min^-1 min-1 min⁻¹ 1/minute u/min 1/min"),
    ("s", "sec secs second seconds"),
    ("ms", "msec millis milliseconds"),
    ("us", "usec micros microseconds"),
    ("ns", "nanoseconds nsec"),
    ("A", "amp amps ampere amperes"),
    ("V", "volt volts"),
    ("rad", "radian radians rads"),
    ("rad/s", "rads/s rads/sec radians/s radians/sec"),
    ("N*m", "n.m n-m"),
    ("m", "meters"),
];

/// Units of which the file does not say which they are: turns or radians in a time, a degree (in German) or a 400th of a turn, a
/// thousandth or a million.
const AMBIGUOUS: [&str; 9] = ["1/s", "s^-1", "s-1", "s⁻¹", "grad", "Mrad", "Mm", "MA", "Ms"];

/// Units, and ends of names that state them. Letters of ambiguous size, such as `m` and `s`, are not among them.
const ENDS: [(&str, &str); 18] = [
    ("rad/s", "rad_s rad_per_s radps rads rad/s"),
    ("deg/s", "deg_s degps deg/s"),
    ("rpm", "rpm"),
    ("rad", "rad"),
    ("mrad", "mrad"),
    ("deg", "deg"),
    ("A", "A"),
    ("mA", "mA"),
    ("V", "V"),
    ("mV", "mV"),
    ("N*m", "Nm"),
    ("mN*m", "mNm"),
    ("cN*m", "Ncm"),
    ("um", "um µm"),
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
    let spelled = SPELLINGS.iter().find(|(_, spellings)| is_among(&small, spellings));
    let unit = spelled.map_or(text, |(unit, _)| unit).to_owned();
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
    let stated = ENDS.iter().find(|(_, ends)| ends.split(' ').any(|end| begins(end).is_some()));
    if let Some((unit, _)) = stated {
        return Some((*unit).to_owned());
    }
    let time = |before: &str| words(before).iter().any(|w| is_among(w, "t time zeit stamp"));
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
