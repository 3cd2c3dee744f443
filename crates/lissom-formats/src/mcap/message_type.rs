//! Types of ROS 2 messages, from the text of their definitions.

use std::collections::HashMap;

use crate::number::NumberType;

/// Type of an item of a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Item {
    Number(NumberType),
    Text,
    /// A text of 16-bit characters.
    WideText,
    /// A message of this name, `package/Name`.
    Message(String),
}

/// How many items a field has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Count {
    One,
    Fixed(usize),
    Any,
}

/// A field of a message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) item: Item,
    pub(super) count: Count,
}

/// The definitions of a message and of all messages inside it.
#[derive(Debug, Default)]
pub(super) struct Definitions {
    messages: HashMap<String, Vec<Field>>,
}

impl Definitions {
    /// The definitions of the message `name`: its own come first, others behind lines of `=` and `MSG: package/Name`.
    /// `None` if a line is no definition.
    pub(super) fn of_text(name: &str, text: &str) -> Option<Self> {
        let mut of = Self::default();
        let mut current = plain(name);
        let mut fields = Vec::new();
        for line in text.lines() {
            let line = line.trim();
            if line.len() >= 3 && line.bytes().all(|byte| byte == b'=') {
                continue;
            }
            if let Some(next) = line.strip_prefix("MSG:") {
                of.messages.insert(current, std::mem::take(&mut fields));
                current = plain(next.trim());
                continue;
            }
            let package = current.split('/').next().unwrap_or_default();
            match Line::of(line, package)? {
                Line::Field(field) => fields.push(field),
                Line::Other => {}
            }
        }
        of.messages.insert(current, fields);
        Some(of)
    }

    pub(super) fn insert(&mut self, name: String, fields: Vec<Field>) {
        self.messages.insert(name, fields);
    }

    /// Whether any of the messages has a field of this name.
    pub(super) fn have_field(&self, name: &str) -> bool {
        self.messages.values().flatten().any(|field| field.name == name)
    }

    pub(super) fn message(&self, name: &str) -> Option<&[Field]> {
        self.messages.get(name).map(Vec::as_slice)
    }
}

/// A name without the folder `msg`.
pub(super) fn plain(name: &str) -> String {
    name.replace("/msg/", "/")
}

/// A line of a definition.
enum Line {
    Field(Field),
    /// A constant, a comment, or a blank line.
    Other,
}

impl Line {
    /// `None` if the line cannot be read.
    fn of(line: &str, package: &str) -> Option<Self> {
        // Default values and constants may contain the mark of a comment, but only behind the name.
        let mut words = line.splitn(2, char::is_whitespace);
        let of = words.next().unwrap_or_default();
        if of.is_empty() || of.starts_with('#') {
            return Some(Self::Other);
        }
        let rest = words.next()?.trim_start();
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
        let (name, behind) = rest.split_at(end);
        if name.is_empty() {
            return None;
        }
        if behind.trim_start().starts_with('=') {
            return Some(Self::Other);
        }
        let (item, count) = match of.strip_suffix(']').and_then(|of| of.rsplit_once('[')) {
            Some((item, "")) => (item, Count::Any),
            Some((item, length)) if length.starts_with("<=") => (item, Count::Any),
            Some((item, length)) => (item, Count::Fixed(length.parse().ok()?)),
            None => (of, Count::One),
        };
        Some(Self::Field(Field { name: name.to_owned(), item: item_of(item, package), count }))
    }
}

fn item_of(name: &str, package: &str) -> Item {
    let number = match name.split_once("<=").map_or(name, |(name, _)| name) {
        "bool" | "byte" | "char" | "uint8" => NumberType::U8,
        "int8" => NumberType::I8,
        "int16" => NumberType::I16,
        "int32" => NumberType::I32,
        "int64" => NumberType::I64,
        "uint16" => NumberType::U16,
        "uint32" => NumberType::U32,
        "uint64" => NumberType::U64,
        "float32" => NumberType::F32,
        "float64" => NumberType::F64,
        "string" => return Item::Text,
        "wstring" => return Item::WideText,
        "time" | "duration" => return Item::Message("builtin_interfaces/Time".to_owned()),
        "Header" => return Item::Message("std_msgs/Header".to_owned()),
        _ if name.contains('/') => return Item::Message(plain(name)),
        _ => return Item::Message(format!("{package}/{name}")),
    };
    Item::Number(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_have_fields_arrays_and_constants() {
        let text = "# a comment\nuint8 ON=1\nstring TEXT = \"a # b\"\nstd_msgs/Header header\n\
                    float64[] position # rad\nfloat32[3] force 0\nstring<=5 name \"x\"\nOther[<=2] others\n\
                    ================================================================================\n\
                    MSG: std_msgs/msg/Header\nstring frame_id\n===\nMSG: p/Other\nint8 x\n";
        let of = Definitions::of_text("p/msg/Name", text).unwrap();
        let fields = of.message("p/Name").unwrap();
        let names: Vec<&str> = fields.iter().map(|f| f.name.as_str()).collect();
        assert_eq!(names, ["header", "position", "force", "name", "others"]);
        assert_eq!(fields[0].item, Item::Message("std_msgs/Header".to_owned()));
        assert_eq!(fields[1].count, Count::Any);
        assert_eq!(fields[2].count, Count::Fixed(3));
        assert_eq!(fields[3].item, Item::Text);
        assert_eq!(fields[4].item, Item::Message("p/Other".to_owned()));
        assert_eq!(of.message("std_msgs/Header").unwrap().len(), 1);
        assert!(Definitions::of_text("p/Name", "no_name_behind_the_type").is_none());
    }
}
