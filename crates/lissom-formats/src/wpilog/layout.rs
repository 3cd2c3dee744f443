//! Where the numbers of an entry are in its records.
//!
//! A struct is described by a schema such as `Translation2d translation;double angle;float wheel[4]`.

use std::collections::HashMap;

use crate::number::NumberType;

/// Most numbers of an item.
const MOST_LEAVES: usize = 4096;
/// Deepest nesting of structs.
const MOST_DEPTH: usize = 16;

/// The numbers of an item of an entry.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Layout {
    /// Size of an item \[byte\].
    pub(super) size: usize,
    /// Whether a record has any number of items.
    pub(super) is_array: bool,
    pub(super) leaves: Vec<Leaf>,
}

/// A number of an item.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Leaf {
    /// Its path in a struct; empty if the item is a number.
    pub(super) path: String,
    pub(super) number: NumberType,
    /// First byte in the item.
    pub(super) offset: usize,
}

/// Schemas of structs, by the names of the structs.
pub(super) type Schemas = HashMap<String, String>;

/// The layout of a type of this name; `None` if it is unknown.
pub(super) fn of(name: &str, schemas: &Schemas) -> Option<Layout> {
    let (item, is_array) = match name.strip_suffix("[]") {
        Some(item) => (item, true),
        None => (name, false),
    };
    let mut layout = Layout { is_array, ..Layout::default() };
    if let Some(of) = item.strip_prefix("struct:") {
        layout.push_struct("", of, schemas, 0)?;
        return (!layout.leaves.is_empty()).then_some(layout);
    }
    let number = match item {
        "boolean" => NumberType::U8,
        "int64" => NumberType::I64,
        "float" => NumberType::F32,
        "double" => NumberType::F64,
        _ => return None,
    };
    layout.push(String::new(), number)?;
    Some(layout)
}

/// Type of the numbers of a struct; `None` if it is a struct or a character.
fn number_type(name: &str) -> Option<NumberType> {
    Some(match name {
        "bool" | "uint8" => NumberType::U8,
        "int8" => NumberType::I8,
        "int16" => NumberType::I16,
        "int32" => NumberType::I32,
        "int64" => NumberType::I64,
        "uint16" => NumberType::U16,
        "uint32" => NumberType::U32,
        "uint64" => NumberType::U64,
        "float" | "float32" => NumberType::F32,
        "double" | "float64" => NumberType::F64,
        _ => return None,
    })
}

impl Layout {
    fn push(&mut self, path: String, number: NumberType) -> Option<()> {
        self.leaves.push(Leaf { path, number, offset: self.size });
        self.size = self.size.checked_add(number.size())?;
        (self.leaves.len() <= MOST_LEAVES).then_some(())
    }

    /// Appends the numbers of a struct; `None` if the schema is unknown, or has bit fields.
    fn push_struct(
        &mut self,
        path: &str,
        name: &str,
        schemas: &Schemas,
        depth: usize,
    ) -> Option<()> {
        if depth > MOST_DEPTH {
            return None;
        }
        for field in schemas.get(name)?.split(';') {
            // The values of an enumeration are before its type.
            let field = field.rsplit('}').next()?.trim();
            if field.is_empty() {
                continue;
            }
            let (of, field) = field.split_once(char::is_whitespace)?;
            let (field, count) = match field.split_once('[') {
                Some((field, count)) => (field, Some(count.trim().strip_suffix(']')?)),
                None => (field, None),
            };
            let field = field.trim();
            if field.contains(':') {
                return None;
            }
            let count = count.map(|count| count.trim().parse::<usize>()).transpose().ok()?;
            if of == "char" {
                self.size = self.size.checked_add(count.unwrap_or(1))?;
                continue;
            }
            for k in 0..count.unwrap_or(1) {
                let place = count.map_or_else(String::new, |_| format!("[{}]", k + 1));
                let slash = if path.is_empty() { "" } else { "/" };
                let path = format!("{path}{slash}{field}{place}");
                if let Some(number) = number_type(of) {
                    self.push(path, number)?;
                    continue;
                }
                let before = self.leaves.len();
                self.push_struct(&path, of, schemas, depth + 1)?;
                // A struct without numbers could be repeated without end.
                (self.leaves.len() > before).then_some(())?;
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Schemas, of};

    #[test]
    fn structs_are_read_by_their_schemas() {
        let schemas: Schemas = [
            ("Pose", "Point at;double angle"),
            ("Point", "double x;double y"),
            ("Mixed", "enum {off=0, on=1} int8 mode;char name[3]; float w[2];Point p;"),
            ("Bits", "int8 a:4;int8 b:4"),
            ("Endless", "Endless e;double x"),
        ]
        .into_iter()
        .map(|(name, schema)| (name.to_owned(), schema.to_owned()))
        .collect();
        let paths = |name: &str| {
            let layout = of(name, &schemas)?;
            let leaf = |leaf: &super::Leaf| format!("{}@{}", leaf.path, leaf.offset);
            Some((layout.size, layout.leaves.iter().map(leaf).collect::<Vec<_>>().join(" ")))
        };
        assert_eq!(paths("struct:Pose[]"), Some((24, "at/x@0 at/y@8 angle@16".to_owned())));
        let mixed = "mode@0 w[1]@4 w[2]@8 p/x@12 p/y@20".to_owned();
        assert_eq!(paths("struct:Mixed"), Some((28, mixed)));
        for unknown in ["struct:Bits", "struct:Endless", "struct:Other", "raw"] {
            assert_eq!(paths(unknown), None, "{unknown}");
        }
    }
}
