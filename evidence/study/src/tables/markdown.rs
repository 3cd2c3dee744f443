//! Cells and tables.

/// A table with its header.
pub(crate) fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: Vec<&str>| format!("| {} |", cells.join(" | "));
    let mut lines = vec![line(header.to_vec()), line(vec!["---"; header.len()])];
    lines.extend(rows.iter().map(|row| line(row.iter().map(String::as_str).collect())));
    lines.join("\n")
}

/// A share or error in percent with two significant digits; a dash if there is none.
pub(super) fn percent(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |v| format!("{} %", significant(100.0 * v)))
}

/// Two significant digits; whole numbers from 10 on.
pub(super) fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if value.abs() >= 1e5 {
        return format!("{value:.0e}");
    }
    let digits = (1.0 - value.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    format!("{value:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_two_digits() {
        let cases = [(0.0123, "1.2 %"), (1.234, "123 %"), (2.0e-5, "0.0020 %"), (5e4, "5e6 %")];
        for (value, text) in cases {
            assert_eq!(percent(Some(value)), text);
        }
        assert_eq!(percent(None), "–");
    }
}
