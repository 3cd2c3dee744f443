//! The header of a NumPy array: a literal of Python.

/// Deepest nesting of a literal.
const MOST_DEPTH: usize = 32;

/// A value of Python.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Literal {
    Text(String),
    Count(usize),
    Truth(bool),
    /// `None`, or a number that is no count.
    Other,
    /// A list or a tuple.
    Items(Vec<Literal>),
    /// A dictionary.
    Entries(Vec<(Literal, Literal)>),
}

impl Literal {
    /// The value of a key of a dictionary.
    pub(super) fn entry(&self, key: &str) -> Option<&Self> {
        let Self::Entries(entries) = self else { return None };
        entries.iter().find(|(k, _)| matches!(k, Self::Text(text) if text == key)).map(|(_, v)| v)
    }

    /// The items, if all are counts; a count alone is one item.
    pub(super) fn counts(&self) -> Option<Vec<usize>> {
        match self {
            Self::Count(count) => Some(vec![*count]),
            Self::Items(items) => {
                let count = |item: &Self| match item {
                    Self::Count(count) => Some(*count),
                    _ => None,
                };
                items.iter().map(count).collect()
            }
            _ => None,
        }
    }
}

/// Reads a literal; `None` if it is none.
pub(super) fn parsed(text: &str) -> Option<Literal> {
    let mut rest = text;
    let value = value(&mut rest, 0)?;
    rest.trim().is_empty().then_some(value)
}

/// Takes a character, if it is the next one.
fn take(rest: &mut &str, character: char) -> bool {
    *rest = rest.trim_start();
    match rest.strip_prefix(character) {
        Some(after) => {
            *rest = after;
            true
        }
        None => false,
    }
}

fn value(rest: &mut &str, depth: usize) -> Option<Literal> {
    if depth > MOST_DEPTH {
        return None;
    }
    for (open, close) in [('(', ')'), ('[', ']')] {
        if take(rest, open) {
            return items(rest, close, depth).map(Literal::Items);
        }
    }
    if take(rest, '{') {
        let mut entries = Vec::new();
        while !take(rest, '}') {
            let key = value(rest, depth + 1)?;
            let value = take(rest, ':').then(|| value(rest, depth + 1))??;
            entries.push((key, value));
            if !take(rest, ',') {
                return take(rest, '}').then_some(Literal::Entries(entries));
            }
        }
        return Some(Literal::Entries(entries));
    }
    // Python 2 marks texts with `u` or `b`, and long numbers with `L`.
    let bare = rest.trim_start_matches(['u', 'b']);
    for quote in ['\'', '"'] {
        if let Some(after) = bare.strip_prefix(quote) {
            return text(rest, after, quote);
        }
    }
    let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '-').unwrap_or(rest.len());
    let (word, after) = rest.split_at_checked(end)?;
    *rest = after;
    match word {
        "" => None,
        "True" => Some(Literal::Truth(true)),
        "False" => Some(Literal::Truth(false)),
        word => Some(word.trim_end_matches('L').parse().map_or(Literal::Other, Literal::Count)),
    }
}

fn items(rest: &mut &str, close: char, depth: usize) -> Option<Vec<Literal>> {
    let mut items = Vec::new();
    while !take(rest, close) {
        items.push(value(rest, depth + 1)?);
        if !take(rest, ',') {
            return take(rest, close).then_some(items);
        }
    }
    Some(items)
}

/// A text up to its closing quote. Of escapes only the character itself is kept.
fn text(rest: &mut &str, after: &str, quote: char) -> Option<Literal> {
    let mut text = String::new();
    let mut characters = after.chars();
    loop {
        match characters.next()? {
            '\\' => text.push(characters.next()?),
            c if c == quote => break,
            c => text.push(c),
        }
    }
    // The characters are of the same text as `rest`.
    let end = rest.len().checked_sub(characters.as_str().len())?;
    *rest = rest.get(end..)?;
    Some(Literal::Text(text))
}
