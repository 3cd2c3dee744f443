//! Words in names of channels.

/// Words that name a value that the controller asks for, not what the drive did.
const COMMANDED: &str = "ref reference set setpoint soll cmd command commanded des desired target goal \
                         demand req error err";

/// Whether a word is in a list, whose words are separated by spaces.
pub(super) fn is_among(word: &str, list: &str) -> bool {
    list.split(' ').any(|known| known == word)
}

/// The word that says that a value is asked for by the controller.
pub(super) fn commanded(words: &[String]) -> Option<&str> {
    let asked = |w: &&String| is_among(w, COMMANDED) || w.contains("soll");
    words.iter().find(asked).map(String::as_str)
}

/// The words of a name in small letters, without numbers at their ends: `["field", "position"]` for `field.position0`,
/// `["motor", "current"]` for `motorCurrent [A]`.
pub(super) fn words(name: &str) -> Vec<String> {
    let end = name.trim_end().rfind(['[', '(']).filter(|at| *at > 0).unwrap_or(name.len());
    let mut found = Vec::new();
    let mut word = String::new();
    let mut small_before = false;
    for letter in name[..end].chars() {
        let begins = letter.is_uppercase() && small_before;
        if begins || !letter.is_alphanumeric() {
            push(&mut found, &word);
            word.clear();
        }
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        }
        small_before = letter.is_lowercase();
    }
    push(&mut found, &word);
    found
}

fn push(found: &mut Vec<String>, word: &str) {
    let bare = word.trim_end_matches(|c: char| c.is_ascii_digit());
    if !bare.is_empty() {
        found.push(bare.to_owned());
    }
}

#[cfg(test)]
mod tests {
    use super::{commanded, words};

    #[test]
    fn parts_of_names() {
        assert_eq!(words("field.position0"), ["field", "position"]);
        assert_eq!(words("motorCurrent [A]"), ["motor", "current"]);
        assert_eq!(words("Axis 1: ActPos"), ["axis", "act", "pos"]);
        assert_eq!(words("%time"), ["time"]);
        assert_eq!(words("2"), Vec::<String>::new());
        assert_eq!(commanded(&words("Stromsollwert")), Some("stromsollwert"));
        assert_eq!(commanded(&words("iq_des")), Some("des"));
        assert_eq!(commanded(&words("iq actual")), None);
    }
}
