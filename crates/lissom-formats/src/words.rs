//! Words in the rows of a channel, such as the name of its run in each row.

use std::collections::HashMap;
use std::sync::Arc;

/// Most different words of a channel: with more it does not name runs.
const MOST: usize = 10_000;
/// Longest word in characters.
const LONGEST: usize = 100;

/// Words in the rows of a channel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Words {
    different: Arc<Vec<String>>,
    /// Places in `different`, from 1; 0 for a blank.
    rows: Vec<u32>,
}

impl Words {
    /// The word in a row, counted from 0.
    pub fn at(&self, row: usize) -> Option<&str> {
        let place = (*self.rows.get(row)? as usize).checked_sub(1)?;
        self.different.get(place).map(String::as_str)
    }

    /// The first word.
    pub fn first(&self) -> Option<&str> {
        self.different.first().map(String::as_str)
    }

    /// The words in some rows.
    pub(crate) fn of_rows(&self, rows: &[usize]) -> Self {
        let place = |row: &usize| self.rows.get(*row).copied().unwrap_or(0);
        Self { different: Arc::clone(&self.different), rows: rows.iter().map(place).collect() }
    }
}

/// Words while a column is read.
#[derive(Debug, Default)]
pub(crate) struct WordsBuilder {
    different: Vec<String>,
    rows: Vec<u32>,
    places: HashMap<String, u32>,
    has_too_many: bool,
}

impl WordsBuilder {
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Appends a word; the rows since the last one are blank.
    pub(crate) fn push(&mut self, row: usize, word: &str) {
        if self.has_too_many || word.is_empty() {
            return;
        }
        let place = if let Some(place) = self.places.get(word) {
            *place
        } else if self.places.len() < MOST && word.chars().count() <= LONGEST {
            self.different.push(word.to_owned());
            let place = self.places.len() as u32 + 1;
            self.places.insert(word.to_owned(), place);
            place
        } else {
            *self = Self { has_too_many: true, ..Self::default() };
            return;
        };
        self.rows.resize(row, 0);
        self.rows.push(place);
    }

    /// The words of so many rows, if there are any.
    pub(crate) fn finish(mut self, rows: usize) -> Option<Words> {
        self.rows.resize(if self.is_empty() { 0 } else { rows }, 0);
        let words = Words { different: Arc::new(self.different), rows: self.rows };
        Some(words).filter(|words| !words.rows.is_empty())
    }
}
