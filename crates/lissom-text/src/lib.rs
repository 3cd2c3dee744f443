//! Numbers as text: with significant digits, or with their standard errors.

/// Between two columns of a table.
const GAP: &str = "  ";

/// The lines of a table: its first column aligned to the left, the others to the right.
///
/// ```
/// let rows = [vec!["inertia".to_owned(), "2.0".to_owned()], vec!["V".to_owned(), "10".to_owned()]];
/// assert_eq!(lissom_text::table_lines(&rows), ["inertia  2.0", "V         10"]);
/// ```
pub fn table_lines(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c: usize| {
        rows.iter().filter_map(|r| r.get(c)).map(|s| s.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).enumerate().map(|(c, (cell, &width))| {
            if c == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        cells.collect::<Vec<_>>().join(GAP).trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

/// The largest count of decimals written.
const MAX_DECIMALS: i32 = 15;

/// `value` with `decimals` places and a true minus sign.
pub fn fixed(value: f64, decimals: i32) -> String {
    let places = usize::try_from(decimals.clamp(0, MAX_DECIMALS)).unwrap_or(0);
    let text = format!("{value:.places$}");
    let zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "−") }
}

/// 10 to the power `exponent` in superscript digits.
pub fn power_of_ten(exponent: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        d => d.to_digit(10).and_then(|digit| char::from_u32(0x2070 + digit)).unwrap_or(d),
    };
    format!("10{}", exponent.to_string().chars().map(raise).collect::<String>())
}

/// The decimal exponent of the leading digit, 0 for zero and non-finite numbers.
pub fn exponent(value: f64) -> i32 {
    let log = value.abs().log10().floor();
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the exponent of a finite f64 lies between -324 and 308"
    )]
    if log.is_finite() { log as i32 } else { 0 }
}

/// `value` in four significant digits, in scientific form if it is very large or small.
pub fn plain(value: f64) -> String {
    significant(value, 4)
}

/// `value` in `digits` significant digits, in scientific form if it is very large or small.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "—".to_owned();
    }
    let places = digits.saturating_sub(1);
    let rounded = format!("{value:.places$e}");
    // The exponent after rounding: 9999.9 has five digits before the point once it has four in all.
    let (mantissa, e) = rounded.split_once('e').unwrap_or((&rounded, "0"));
    let e: i32 = e.parse().unwrap_or(0);
    if (-6..6).contains(&e) {
        return fixed(value, i32::try_from(places).unwrap_or(0) - e);
    }
    format!("{}×{}", mantissa.replace('-', "−"), power_of_ten(e))
}

/// `value` without its power of ten.
fn mantissa(value: f64, e: i32) -> f64 {
    // In two steps: 10^324 is no f64.
    value / 10f64.powi(e / 2) / 10f64.powi(e - e / 2)
}

/// A value with its standard error: the error with two significant digits, the value rounded to the same place.
///
/// An error below 10⁻⁵ of the value is written in percent, after six digits of the value. If both need more than four digits behind the point, the error is written in parentheses and counts units of the
/// last digit: `0.13201(12)` is 0.13201 ± 0.00012. A value that is not finite becomes a dash. A standard error that is
/// not finite and positive is not written.
///
/// ```
/// use lissom_text::with_uncertainty;
/// assert_eq!(with_uncertainty(1.2345, 0.0312), "1.234 ± 0.031");
/// assert_eq!(with_uncertainty(0.131_999_963, 2.8e-8), "0.132000 ± 0.000021 %");
/// assert_eq!(with_uncertainty(6.247e-4, 1.1e-6), "0.0006247(11)");
/// ```
pub fn with_uncertainty(value: f64, std: f64) -> String {
    let Some(layout) = Layout::of(value, std) else { return plain(value) };
    if is_sharp(value, std) {
        let percent = significant(100.0 * std / value.abs(), 2);
        return format!("{} ± {percent} %", significant(value, SHARP_DIGITS));
    }
    match layout {
        Layout::Places(places) if places > MOST_PLACES => {
            let last = (std * 10f64.powi(places)).round();
            format!("{}({last:.0})", fixed(value, places))
        }
        Layout::Scaled(e, places) => {
            let [value, std] = [value, std].map(|v| fixed(mantissa(v, e), places));
            format!("({value} ± {std})×{}", power_of_ten(e))
        }
        Layout::Places(_) => format!("{} ± {}", layout.digits(value), layout.digits(std)),
    }
}

/// An interval written to the same place as [`with_uncertainty`] writes its value.
pub fn interval([low, high]: [f64; 2], value: f64, std: f64) -> String {
    let layout = Layout::of(value, std).filter(|_| low.is_finite() && high.is_finite());
    if layout.is_some() && is_sharp(value, std) {
        return format!("± {} %", significant(50.0 * (high - low) / value.abs(), 2));
    }
    match layout {
        None => format!("{} … {}", plain(low), plain(high)),
        Some(Layout::Scaled(e, places)) => {
            let [low, high] = [low, high].map(|v| fixed(mantissa(v, e), places));
            format!("({low} … {high})×{}", power_of_ten(e))
        }
        Some(layout) => format!("{} … {}", layout.digits(low), layout.digits(high)),
    }
}

/// Relative standard error below which a value has more digits than people read.
const SHARP: f64 = 1e-5;
/// Significant digits of such a value.
const SHARP_DIGITS: usize = 6;

fn is_sharp(value: f64, std: f64) -> bool {
    std < SHARP * value.abs()
}

/// Largest number of digits behind the point for which value and standard error are written as `a ± b`.
const MOST_PLACES: i32 = 4;

/// How a value and its standard error are written.
#[derive(Debug, Clone, Copy)]
enum Layout {
    /// With this many places behind the point; if negative, rounded before the point.
    Places(i32),
    /// Divided by a power of ten, with this many places.
    Scaled(i32, i32),
}

impl Layout {
    /// The layout for a value and its standard error, if there is one.
    fn of(value: f64, std: f64) -> Option<Self> {
        if !value.is_finite() || !std.is_finite() || std <= 0.0 {
            return None;
        }
        // The place of the second digit of the standard error after rounding: 0.00996 is written 0.010.
        let place = exponent(std * 1.005_000_001) - 1;
        let e = exponent(value).max(exponent(std));
        Some(if (-6..6).contains(&e) { Self::Places(-place) } else { Self::Scaled(e, e - place) })
    }

    fn digits(self, value: f64) -> String {
        match self {
            Self::Places(places) if places < 0 => {
                let unit = 10f64.powi(-places);
                fixed((value / unit).round() * unit, 0)
            }
            Self::Places(places) => fixed(value, places),
            Self::Scaled(e, places) => fixed(mantissa(value, e), places),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minus_signs_and_zeros() {
        assert_eq!(fixed(-1.25, 1), "−1.2");
        assert_eq!(fixed(-0.001, 1), "0.0");
        assert_eq!(power_of_ten(-12), "10⁻¹²");
        assert_eq!(power_of_ten(304), "10³⁰⁴");
    }

    #[test]
    fn plain_numbers() {
        assert_eq!(plain(std::f64::consts::PI), "3.142");
        assert_eq!(plain(12_345.6), "12346");
        assert_eq!(plain(0.0), "0.000");
        assert_eq!(plain(9.99999), "10.00");
        assert_eq!(plain(1e-320), "1.000×10⁻³²⁰");
        assert_eq!(plain(-2.5e10), "−2.500×10¹⁰");
        assert_eq!(plain(f64::INFINITY), "—");
    }

    #[test]
    fn uncertainty_sets_the_place() {
        assert_eq!(with_uncertainty(12.345, 0.0996), "12.35 ± 0.10");
        assert_eq!(with_uncertainty(12.345, 0.0), "12.35");
        assert_eq!(with_uncertainty(6.247e-4, 1.1e-6), "0.0006247(11)");
        assert_eq!(interval([6.225e-4, 6.269e-4], 6.247e-4, 1.1e-6), "0.0006225 … 0.0006269");
        assert_eq!(with_uncertainty(0.13201, 9.96e-5), "0.13201(10)");
        assert_eq!(with_uncertainty(-6.247e-9, 1.1e-11), "(−6.247 ± 0.011)×10⁻⁹");
        assert_eq!(with_uncertainty(95.11, 12.0), "95 ± 12");
        assert_eq!(with_uncertainty(951.1, 120.0), "950 ± 120");
        assert_eq!(with_uncertainty(0.0, 0.02), "0.000 ± 0.020");
    }
}
