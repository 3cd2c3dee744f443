//! Text from a file as shown in an error.

/// Largest number of characters of a text in an error.
const MOST: usize = 60;

/// The beginning of `text` on one line, without control characters of a terminal.
pub(crate) fn excerpt(text: &str) -> String {
    let plain = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let mut shown: String = text.chars().take(MOST).map(plain).collect();
    if text.chars().nth(MOST).is_some() {
        shown.push('…');
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::excerpt;

    #[test]
    fn long_text_is_cut_and_control_characters_are_not_obeyed() {
        assert_eq!(excerpt("N*m"), "N*m");
        assert_eq!(excerpt("a\u{1b}[2J\nb"), "a\u{fffd}[2J\u{fffd}b");
        assert_eq!(excerpt(&"µ".repeat(100)), "µ".repeat(60) + "…");
    }
}
