//! Numbers as Fortran writes them.

/// A number as Fortran writes it: `1.5E+00`, `1.5D+00`, or `1.5+100`.
pub(super) fn number(field: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(field).ok()?.trim();
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let text = text.replace(['d', 'D'], "E");
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let sign = text.rfind(['+', '-']).filter(|place| *place > 0)?;
    let (fraction, exponent) = text.split_at_checked(sign)?;
    format!("{fraction}E{exponent}").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_of_fortran_are_read() {
        let cases = [("1.5E+00", 1.5), ("-1.5D+002", -150.0), ("1.5-100", 1.5e-100), ("2", 2.0)];
        for (text, value) in cases {
            let found = number(text.as_bytes()).unwrap_or(f64::NAN);
            assert!((found - value).abs() <= 1e-12 * value.abs(), "{text}: {found}");
        }
        assert_eq!(number(b"1.5E"), None);
    }
}
