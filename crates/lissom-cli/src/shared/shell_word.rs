//! Words of commands that people copy.

/// A text as one word of a shell: in quotes if it needs them.
pub(crate) fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./:=,@%+".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.to_owned();
    }
    let mut word = String::from("\"");
    for c in text.chars() {
        if "\"\\$`".contains(c) {
            word.push('\\');
        }
        word.push(c);
    }
    word.push('"');
    word
}

#[cfg(test)]
mod tests {
    use super::shell_word;

    #[test]
    fn words_with_blanks_are_quoted() {
        assert_eq!(shell_word("logs/run_1.csv"), "logs/run_1.csv");
        assert_eq!(shell_word("log.h5::run*"), "\"log.h5::run*\"");
        assert_eq!(shell_word("my log $1.csv"), "\"my log \\$1.csv\"");
    }
}
