//! Documents against the JSON Schema that describes them.
#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use serde_json::{Map, Value};

/// As much of JSON Schema as the file uses.
#[derive(Debug)]
pub struct SchemaCheck {
    root: Value,
    name: &'static str,
    /// Keys and patterns of the schema that a document had, with the object they belong to.
    met: BTreeSet<String>,
    /// All those of the objects that were met.
    named: BTreeSet<String>,
    wrong: Vec<String>,
}

impl SchemaCheck {
    /// A check against the schema of this text; `name` stands for the document in what it says.
    ///
    /// # Panics
    /// Where the text is no JSON.
    pub fn new(schema: &str, name: &'static str) -> Self {
        let root = serde_json::from_str(schema).expect("a schema is JSON");
        Self { root, name, met: BTreeSet::new(), named: BTreeSet::new(), wrong: Vec::new() }
    }

    /// Looks at a document.
    pub fn look_at(&mut self, document: &Value) {
        let root = self.root.clone();
        self.value(&root, document, self.name);
    }

    /// Fails unless every key of every document was in the schema and of its type, some document
    /// had each key of the schema, and each of `needed` (a dotted path, `[]` for items) was met.
    ///
    /// # Panics
    /// As said.
    pub fn holds(&self, needed: &[&str]) {
        assert!(self.wrong.is_empty(), "{:#?}", self.wrong);
        let never: Vec<_> = self.named.difference(&self.met).collect();
        assert!(never.is_empty(), "no document has {never:#?}");
        for key in needed {
            assert!(self.met.contains(&format!("{}.{key}", self.name)), "no document has {key}");
        }
    }

    fn value(&mut self, schema: &Value, value: &Value, at: &str) {
        if let Some(reference) = schema["$ref"].as_str() {
            let target = self.root.pointer(reference.trim_start_matches('#')).unwrap().clone();
            self.value(&target, value, at);
        }
        if let Some(options) = schema["anyOf"].as_array() {
            let fits = options.iter().find(|o| match &o["type"] {
                Value::Null => !value.is_null(),
                kind => has_type(kind, value),
            });
            match fits {
                Some(option) => self.value(option, value, at),
                None => self.wrong.push(format!("{at} fits nothing")),
            }
        }
        if let Some(choices) = schema["oneOf"].as_array()
            && !choices.iter().any(|choice| choice["const"] == *value)
        {
            self.wrong.push(format!("{at} is {value}"));
        }
        if let Some(choices) = schema["enum"].as_array()
            && !choices.contains(value)
        {
            self.wrong.push(format!("{at} is {value}"));
        }
        if !schema["type"].is_null() && !has_type(&schema["type"], value) {
            self.wrong.push(format!("{at} is {value} and not {}", schema["type"]));
        }
        if let Some(items) = value.as_array() {
            for item in items {
                self.value(&schema["items"], item, &format!("{at}[]"));
            }
        }
        if let Some(object) = value.as_object()
            && schema["type"] == "object"
        {
            self.object(schema, object, at);
        }
    }

    fn object(&mut self, schema: &Value, object: &Map<String, Value>, at: &str) {
        let none = Map::new();
        let properties = schema["properties"].as_object().unwrap_or(&none);
        let patterns = schema["patternProperties"].as_object().unwrap_or(&none);
        self.named.extend(properties.keys().chain(patterns.keys()).map(|k| format!("{at}.{k}")));
        for required in schema["required"].as_array().into_iter().flatten() {
            if !object.contains_key(required.as_str().unwrap()) {
                self.wrong.push(format!("{at} has no {required}"));
            }
        }
        let limit = |key: &str| schema[key].as_u64().map(|n| usize::try_from(n).unwrap());
        if limit("minProperties").is_some_and(|n| object.len() < n)
            || limit("maxProperties").is_some_and(|n| object.len() > n)
        {
            self.wrong.push(format!("{at} has {} keys", object.len()));
        }
        for (key, value) in object {
            let by_pattern = || patterns.iter().find(|(pattern, _)| expand(pattern).contains(key));
            match properties.get_key_value(key).or_else(by_pattern) {
                Some((name, schema)) => {
                    self.met.insert(format!("{at}.{name}"));
                    self.value(schema, value, &format!("{at}.{name}"));
                }
                None => self.wrong.push(format!("{at}.{key} is not in the schema")),
            }
        }
    }
}

fn has_type(wanted: &Value, value: &Value) -> bool {
    if let Some(several) = wanted.as_array() {
        return several.iter().any(|one| has_type(one, value));
    }
    match wanted.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_i64() || value.is_u64(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        _ => false,
    }
}

/// All texts that a pattern of literals and groups of choices, `^a_(b|c)$`, stands for.
fn expand(pattern: &str) -> Vec<String> {
    let text = pattern.trim_start_matches('^').trim_end_matches('$');
    let Some(open) = text.find('(') else { return vec![text.to_owned()] };
    let mut depth = 0;
    let mut cuts = vec![open];
    for (at, c) in text.char_indices().skip(open) {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if c == '|' && depth == 1 || c == ')' && depth == 0 {
            cuts.push(at);
        }
        if depth == 0 {
            break;
        }
    }
    let rest = expand(&text[cuts[cuts.len() - 1] + 1..]);
    let choices = cuts.windows(2).flat_map(|cut| expand(&text[cut[0] + 1..cut[1]]));
    let joined = |choice: String| {
        rest.iter().map(|end| format!("{}{choice}{end}", &text[..open])).collect::<Vec<_>>()
    };
    choices.flat_map(joined).collect()
}

#[cfg(test)]
mod tests {
    use super::expand;

    #[test]
    fn patterns_are_read_as_they_are_meant() {
        assert_eq!(expand("^a_(b|c_(d|e)|f)_g$"), ["a_b_g", "a_c_d_g", "a_c_e_g", "a_f_g"]);
    }
}
