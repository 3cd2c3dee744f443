//! Numbers and names in the text of other languages.

/// A number with all its digits, as Python, MATLAB, C and XML read it.
pub(super) fn number(value: f64) -> String {
    let plain = (1e-4..1e7).contains(&value.abs()) || value.abs() <= 0.0;
    let text = if plain { format!("{value}") } else { format!("{value:e}") };
    if text.contains(['.', 'e']) { text } else { format!("{text}.0") }
}

/// A list of numbers.
pub(super) fn numbers(values: &[f64], separator: &str) -> String {
    values.iter().map(|v| number(*v)).collect::<Vec<_>>().join(separator)
}

/// A comment of one line: no line ends, no end of a comment, no characters that a terminal acts on.
pub(super) fn plain(text: &str) -> String {
    let allowed = |c: char| if c.is_control() { ' ' } else { c };
    text.chars().map(allowed).collect::<String>().replace("*/", "* /").replace("--", "- -")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_kept() {
        for value in [0.1 + 0.2, -1.25e-9, 3.0, 0.0, 1e12] {
            let read: f64 = number(value).parse().unwrap();
            assert!((read - value).abs() <= 0.0, "{value}");
        }
        assert_eq!(number(3.0), "3.0");
        assert_eq!(plain("a*/b\n--c"), "a* /b - -c");
    }
}
