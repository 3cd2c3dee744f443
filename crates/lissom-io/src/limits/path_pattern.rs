//! What the path of a log says: `{machine}/{time}.csv`.

use std::collections::BTreeMap;

/// A pattern of the end of a path, with names in braces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathPattern {
    /// Texts and names in turn: a text first and last.
    texts: Vec<String>,
    names: Vec<String>,
}

impl PathPattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// What is expected in its place.
    pub fn parse(pattern: &str) -> Result<Self, &'static str> {
        let (mut texts, mut names) = (Vec::new(), Vec::new());
        let mut rest = pattern;
        while let Some(at) = rest.find('{') {
            let Some(end) = rest[at..].find('}') else {
                return Err("a name in braces that is closed");
            };
            let name = rest[at + 1..at + end].trim();
            if name.is_empty() || name.contains('{') || names.iter().any(|n| n == name) {
                return Err("names in braces that are not empty and differ");
            }
            if !names.is_empty() && at == 0 {
                return Err("a text between two names in braces");
            }
            texts.push(rest[..at].to_owned());
            names.push(name.to_owned());
            rest = &rest[at + end + 1..];
        }
        if names.is_empty() {
            return Err("at least one name in braces, as in {machine}");
        }
        texts.push(rest.to_owned());
        Ok(Self { texts, names })
    }

    /// What a path says; `None` if it does not end in this way. A name in braces is as short as possible, counted from the
    /// end, and has no `/`.
    pub fn read(&self, path: &str) -> Option<BTreeMap<String, String>> {
        let path = path.replace('\\', "/");
        let mut rest = path.strip_suffix(self.texts.last()?.as_str())?;
        let mut found = BTreeMap::new();
        for (k, name) in self.names.iter().enumerate().rev() {
            let before = self.texts[k].as_str();
            let at = if before.is_empty() {
                rest.rfind('/').map_or(0, |at| at + 1)
            } else {
                rest.rfind(before)? + before.len()
            };
            let value = &rest[at..];
            if value.is_empty() || value.contains('/') {
                return None;
            }
            found.insert(name.clone(), value.to_owned());
            rest = &rest[..at - before.len()];
        }
        Some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::PathPattern;

    #[test]
    fn machine_and_time() {
        let pattern = PathPattern::parse("{machine}/{time}.csv").unwrap();
        let found = pattern.read("/data/line 2/drive-17/2026-11-27T08.csv").unwrap();
        assert_eq!(found["machine"], "drive-17");
        assert_eq!(found["time"], "2026-11-27T08");
        assert!(
            pattern.read("run.csv").is_none() || pattern.read("run.csv").unwrap()["time"] == "run"
        );
        assert!(pattern.read("a/b.txt").is_none());
        let parts = PathPattern::parse("eol_{machine}_{time}.csv").unwrap();
        assert_eq!(parts.read("x/eol_A7_0815.csv").unwrap()["machine"], "A7");
        for wrong in ["none", "{}", "{a/{b}.csv", "{a}{b}", "{a", "{a}/{a}"] {
            assert!(PathPattern::parse(wrong).is_err(), "{wrong}");
        }
    }
}
