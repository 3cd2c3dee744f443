//! Numbers as text, for cells and sentences.

use num_complex::Complex64;

/// Magnitudes that are written without a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e6;

/// Formats `value` with `digits` significant digits.
pub fn shown(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { value.to_string() };
    }
    let scientific = format!("{value:.*e}", digits - 1);
    // The exponent after rounding: 9.9999 may become 10.000.
    let exponent = scientific.split_once('e').and_then(|(_, e)| e.parse::<isize>().ok());
    match exponent {
        Some(exponent) if PLAIN.contains(&value.abs()) => {
            // Digits after the point; at least none.
            let after = (digits - 1).saturating_add_signed(-exponent);
            format!("{value:.after$}")
        }
        _ => scientific,
    }
}

/// Formats `value` with at most `digits` significant digits, without zeros at the end.
pub fn trimmed(value: f64, digits: usize) -> String {
    let text = shown(value, digits);
    if !text.contains('.') || text.contains('e') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number with its noun, as in "1 run" and "2 runs".
pub fn counted(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

/// Formats a root with its mirror images, by the classes of the 1989 report.
pub fn roots_of(z: Complex64, digits: usize) -> String {
    let s = z.sqrt();
    match lissom::beam::class(z) {
        lissom::beam::RootClass::Imaginary => format!("±j·{}", shown(s.im.abs(), digits)),
        lissom::beam::RootClass::Real => format!("±{}", shown(s.re, digits)),
        lissom::beam::RootClass::Quadruple => {
            format!("±{} ± j·{}", shown(s.re, digits), shown(s.im.abs(), digits))
        }
    }
}

/// A relative change in percent, with its sign.
pub fn change(value: f64, from: f64) -> String {
    signed_percent(value / from - 1.0)
}

/// A share in percent, with its sign.
pub fn signed_percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent.abs() < 0.005 { "0 %".to_owned() } else { format!("{percent:+.2} %") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_digits() {
        for (value, text) in [
            (6.014_96, "6.0150"),
            (99_999.6, "100000"),
            (0.001_234_56, "0.0012346"),
            (1.5e-7, "1.5000e-7"),
            (-2.5e9, "-2.5000e9"),
            (0.0, "0"),
            (9.999_999, "10.000"),
        ] {
            assert_eq!(shown(value, 5), text);
        }
        assert_eq!((trimmed(2.0, 4), trimmed(0.5, 4)), ("2".to_owned(), "0.5".to_owned()));
        assert_eq!((trimmed(100.0, 3), trimmed(5.466, 3)), ("100".to_owned(), "5.47".to_owned()));
    }

    #[test]
    fn roots_show_their_class() {
        let z = |re, im| roots_of(Complex64::new(re, im), 3);
        assert_eq!(z(-4.0, 0.0), "±j·2.00");
        assert_eq!(z(4.0, 0.0), "±2.00");
        assert_eq!(z(3.0, 4.0), "±2.00 ± j·1.00");
        assert_eq!(z(3.0, -4.0), "±2.00 ± j·1.00");
    }
}
