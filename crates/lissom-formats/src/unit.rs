//! Units as files state them.

/// Units that stand alone, in small letters.
const UNITS: [&str; 59] = [
    "s", "sec", "ms", "us", "µs", "ns", "a", "ma", "v", "mv", "rad", "mrad", "deg", "°", "grad",
    "rad/s", "deg/s", "°/s", "rpm", "1/min", "nm", "n*m", "n·m", "mnm", "n", "m", "mm", "m/s",
    "mm/s", "hz", "khz", "-", "1", "%", "w", "°c", "counts", "count", "cnt", "inc", "rev", "turns",
    "turn", "second", "seconds", "volt", "volts", "ampere", "amperes", "amp", "amps", "degree",
    "degrees", "radian", "radians", "hertz", "db", "watt", "g",
];

/// Whether a text is a unit, alone or in brackets.
pub(crate) fn is_unit(text: &str) -> bool {
    let bare = bare(text);
    UNITS.contains(&bare.to_lowercase().as_str()) || (bare != text && !bare.is_empty())
}

/// Whether a unit is one of time.
pub(crate) fn is_time(unit: &str) -> bool {
    const TIMES: [&str; 8] = ["s", "sec", "second", "seconds", "ms", "us", "µs", "ns"];
    TIMES.contains(&unit.to_lowercase().as_str())
}

/// A unit without brackets around it.
pub(crate) fn bare(unit: &str) -> &str {
    let inner = |open: char, close: char| unit.strip_prefix(open)?.strip_suffix(close);
    inner('[', ']').or_else(|| inner('(', ')')).unwrap_or(unit).trim()
}

/// The unit in brackets at the end of a name, before its index and its part if it has them: `current [A]`,
/// `angle (deg)[2]`, `H [rad/A]/real`.
pub(crate) fn in_name(name: &str) -> Option<String> {
    let name = name.trim_end();
    let part = name.strip_suffix("/real").or_else(|| name.strip_suffix("/imag"));
    let name = without_index(part.unwrap_or(name));
    let open = match name.chars().last()? {
        ']' => '[',
        ')' => '(',
        _ => return None,
    };
    let at = name.rfind(open)?;
    let unit = name[at + 1..name.len() - 1].trim();
    let is_word = unit.starts_with(|c: char| c.is_alphabetic() || "°%µ".contains(c));
    (at > 0 && (is_word || unit.starts_with("1/"))).then(|| unit.to_owned())
}

/// A name without `[2]` or `[2,1]` at its end.
fn without_index(name: &str) -> &str {
    let is_index = |c: char| c.is_ascii_digit() || c == ',';
    match name.strip_suffix(']').map(|inner| inner.trim_end_matches(is_index)) {
        Some(before) if before.len() > 1 && before.ends_with('[') => {
            before[..before.len() - 1].trim_end()
        }
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::in_name;

    #[test]
    fn units_in_names() {
        let cases = [
            ("current [A]", Some("A")),
            ("arm/angle (deg)", Some("deg")),
            ("angle (deg)[2,1]", Some("deg")),
            ("H [rad/A][2]/imag", Some("rad/A")),
            ("position [turns]", Some("turns")),
            ("encoder [cnt]", Some("cnt")),
            ("speed [1/min]", Some("1/min")),
            ("q[1]", None),
            ("[A]", None),
            ("q", None),
        ];
        for (name, unit) in cases {
            assert_eq!(in_name(name).as_deref(), unit, "{name}");
        }
    }
}
