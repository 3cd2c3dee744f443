//! Numbers in messages.

use crate::identify::estimate::Estimate;

/// Powers of ten for which a number is written without an exponent.
const PLAIN: std::ops::Range<i32> = -4..6;

/// A number with `digits` significant digits: `0.132`, or `1.32e-7` if a plain number would be too long.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { "unknown".to_owned() };
    }
    let places = digits.saturating_sub(1);
    let scientific = format!("{value:.places$e}");
    match exponent(&scientific) {
        Some(e) if PLAIN.contains(&e) => minus(&fixed(value, e, digits)),
        _ => minus(&scientific),
    }
}

/// The same with a minus sign in place of a hyphen.
pub(super) fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// A plain number without trailing zeros: `0.25` for `0.25000`.
pub(super) fn trimmed(number: &str) -> &str {
    if !number.contains('.') || number.contains('e') {
        return number;
    }
    number.trim_end_matches('0').trim_end_matches('.')
}

/// A value with its standard error: two digits of the error, and the value to the same place.
pub(super) fn with_error(estimate: Estimate) -> String {
    let Estimate { value, std } = estimate;
    if !value.is_finite() || !std.is_finite() || std <= 0.0 {
        return significant(value, 4);
    }
    let (size, error) = (exponent(&format!("{value:.1e}")), exponent(&format!("{std:.1e}")));
    let (Some(size), Some(error)) = (size, error) else { return significant(value, 4) };
    let largest = size.max(error);
    if PLAIN.contains(&largest) && error < 3 {
        let places = usize::try_from(1 - error).unwrap_or(0);
        return minus(&format!("{value:.places$} ± {std:.places$}"));
    }
    let places = usize::try_from(largest - error + 1).unwrap_or(0);
    let scale = 10f64.powi(-largest);
    minus(&format!("({:.places$} ± {:.places$})e{largest}", value * scale, std * scale))
}

/// The power of ten of a number in scientific notation.
fn exponent(scientific: &str) -> Option<i32> {
    scientific.split_once('e')?.1.parse().ok()
}

fn fixed(value: f64, exponent: i32, digits: usize) -> String {
    let digits = i32::try_from(digits).unwrap_or(i32::MAX);
    let places = usize::try_from(digits - 1 - exponent).unwrap_or(0);
    format!("{value:.places$}")
}

/// `one mode`, `3 modes`.
pub(super) fn counted(number: usize, one: &str, many: &str) -> String {
    if number == 1 { format!("one {one}") } else { format!("{number} {many}") }
}

/// `later` for a positive delay, `earlier` for a negative one.
pub(super) fn later(delay_s: f64) -> &'static str {
    if delay_s < 0.0 { "earlier" } else { "later" }
}

/// The size of a delay in milliseconds, without its sign.
pub(super) fn milliseconds(delay: Estimate) -> String {
    let in_ms = Estimate { value: 1e3 * delay.value.abs(), std: 1e3 * delay.std };
    format!("{} ms", with_error(in_ms))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain_where_that_is_short() {
        for (value, text) in [
            (0.131_96, "0.132"),
            (-1234.5, "−1234"),
            (1.5e-7, "1.50e−7"),
            (0.0, "0"),
            (9.999, "10.0"),
            (f64::NAN, "unknown"),
        ] {
            assert_eq!(significant(value, 3), text);
        }
        assert_eq!(["0.2500", "2.00", "100"].map(trimmed), ["0.25", "2", "100"]);
    }

    #[test]
    fn errors_have_two_digits() {
        for (value, std, text) in [
            (0.131_972, 0.001_24, "0.1320 ± 0.0012"),
            (120.0, 3.4, "120.0 ± 3.4"),
            (120.0, 34.0, "120 ± 34"),
            (1.234e-9, 5e-12, "(1.2340 ± 0.0050)e−9"),
            (2.0, f64::INFINITY, "2.000"),
            (-0.011, 0.000_3, "−0.01100 ± 0.00030"),
        ] {
            assert_eq!(with_error(Estimate { value, std }), text);
        }
    }
}
