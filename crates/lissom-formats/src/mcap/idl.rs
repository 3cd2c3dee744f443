//! Types of ROS 2 messages, from definitions in the interface definition language (IDL).

use std::collections::HashMap;

use super::message_type::{Count, Definitions, Field, Item, plain};
use crate::number::NumberType;

/// Deepest nesting of sequences and type names.
const MOST_DEPTH: usize = 8;

type Type = (Item, Count);

/// The definitions in a text; `None` if a part cannot be read.
pub(super) fn definitions(text: &str) -> Option<Definitions> {
    let mut reader = Reader { tokens: tokens(text), at: 0, types: HashMap::new() };
    let mut of = Definitions::default();
    let mut modules: Vec<String> = Vec::new();
    while let Some(token) = reader.next() {
        match token.as_str() {
            "module" => {
                modules.push(reader.next()?);
                reader.expect("{")?;
            }
            "}" => {
                modules.pop();
            }
            "struct" => {
                let name = reader.next()?;
                let package = modules.first().cloned().unwrap_or_default();
                let fields = reader.fields(&package)?;
                of.insert(format!("{package}/{name}"), fields);
            }
            "typedef" => {
                let package = modules.first().cloned().unwrap_or_default();
                let of = reader.type_of(&package, 0)?;
                let field = reader.declared(of)?;
                reader.types.insert(field.name, (field.item, field.count));
            }
            "const" => while reader.next()? != ";" {},
            ";" => {}
            _ => return None,
        }
    }
    Some(of)
}

/// The words and signs of a text, without comments, annotations and lines that separate definitions.
fn tokens(text: &str) -> Vec<String> {
    let is_left_out = |line: &&str| {
        let line = line.trim_start();
        !line.starts_with("===") && !line.starts_with("IDL:") && !line.starts_with('#')
    };
    let text = text.lines().filter(is_left_out).collect::<Vec<_>>().join("\n");
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = if rest.starts_with("//") {
            rest.find('\n')
        } else if rest.starts_with("/*") {
            rest.find("*/").map(|end| end + 2)
        } else if first == '"' {
            string_end(rest)
        } else if is_word(first) {
            rest.find(|c| !is_word(c))
        } else {
            Some(first.len_utf8())
        };
        let (token, behind) = rest.split_at(end.unwrap_or(rest.len()));
        if !token.starts_with("//") && !token.starts_with("/*") {
            tokens.push(token.to_owned());
        }
        rest = behind.trim_start();
    }
    without_annotations(tokens)
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | ':' | '.')
}

fn string_end(text: &str) -> Option<usize> {
    let mut is_escaped = false;
    let ends = |(_, c): &(usize, char)| {
        let ends = *c == '"' && !is_escaped;
        is_escaped = *c == '\\' && !is_escaped;
        ends
    };
    text.char_indices().skip(1).find(ends).map(|(at, _)| at + 1)
}

/// The tokens without `@name` and `@name(...)`.
fn without_annotations(tokens: Vec<String>) -> Vec<String> {
    let mut kept = Vec::new();
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        if token != "@" {
            kept.push(token);
            continue;
        }
        tokens.next();
        if tokens.peek().is_none_or(|token| token != "(") {
            continue;
        }
        let mut depth = 0_usize;
        for token in tokens.by_ref() {
            match token.as_str() {
                "(" => depth += 1,
                ")" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
    }
    kept
}

struct Reader {
    tokens: Vec<String>,
    at: usize,
    /// Types with a name of their own.
    types: HashMap<String, Type>,
}

impl Reader {
    fn next(&mut self) -> Option<String> {
        let token = self.tokens.get(self.at).cloned();
        self.at += 1;
        token
    }

    fn next_is(&mut self, token: &str) -> bool {
        let is_it = self.tokens.get(self.at).is_some_and(|next| next == token);
        self.at += usize::from(is_it);
        is_it
    }

    fn expect(&mut self, token: &str) -> Option<()> {
        self.next_is(token).then_some(())
    }

    fn fields(&mut self, package: &str) -> Option<Vec<Field>> {
        self.expect("{")?;
        let mut fields = Vec::new();
        while !self.next_is("}") {
            let of = self.type_of(package, 0)?;
            fields.push(self.declared(of)?);
        }
        Some(fields)
    }

    /// A name of a type, with the length of an array behind it.
    fn declared(&mut self, (item, mut count): Type) -> Option<Field> {
        let name = self.next()?;
        if self.next_is("[") {
            let length = self.next()?.parse().ok()?;
            self.expect("]")?;
            (count == Count::One).then_some(())?;
            count = Count::Fixed(length);
        }
        self.expect(";")?;
        Some(Field { name, item, count })
    }

    fn type_of(&mut self, package: &str, depth: usize) -> Option<Type> {
        (depth < MOST_DEPTH).then_some(())?;
        let word = self.next()?;
        if word == "sequence" {
            self.expect("<")?;
            let (item, count) = self.type_of(package, depth + 1)?;
            if self.next_is(",") {
                self.next()?;
            }
            self.expect(">")?;
            return (count == Count::One).then_some((item, Count::Any));
        }
        if word == "string" {
            if self.next_is("<") {
                self.next()?;
                self.expect(">")?;
            }
            return Some((Item::Text, Count::One));
        }
        if let Some(number) = self.number(&word) {
            return Some((Item::Number(number), Count::One));
        }
        let last = word.rsplit("::").next().unwrap_or_default();
        if let Some(of) = self.types.get(last) {
            return Some(of.clone());
        }
        let name = if word.contains("::") {
            plain(&word.trim_start_matches(':').replace("::", "/"))
        } else {
            format!("{package}/{word}")
        };
        Some((Item::Message(name), Count::One))
    }

    /// The type of a number, whose name may have several words.
    fn number(&mut self, word: &str) -> Option<NumberType> {
        Some(match word {
            "boolean" | "octet" | "char" | "uint8" => NumberType::U8,
            "int8" => NumberType::I8,
            "short" | "int16" => NumberType::I16,
            "uint16" => NumberType::U16,
            "long" if self.next_is("long") => NumberType::I64,
            "long" | "int32" => NumberType::I32,
            "uint32" => NumberType::U32,
            "int64" => NumberType::I64,
            "uint64" => NumberType::U64,
            "float" => NumberType::F32,
            "double" => NumberType::F64,
            "unsigned" => match self.next()?.as_str() {
                "short" => NumberType::U16,
                "long" if self.next_is("long") => NumberType::U64,
                "long" => NumberType::U32,
                _ => return None,
            },
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_have_sequences_type_names_and_annotations() {
        let text = "===\nIDL: p/msg/Name\n// a comment\n#include \"std_msgs/msg/Header.idl\"\n\
                    module p { module msg {\n typedef double double__9[9];\n\
                    module Name_Constants { const octet ON = 1; };\n\
                    @verbatim (language=\"comment\", text=\"a (b\" \"; c\")\n struct Name {\n\
                    std_msgs::msg::Header header; @unit(value=\"rad\") sequence<double, 3> position;\n\
                    double__9 covariance; unsigned long long n; long long m; string<5> name; Other other; };\n};};\n";
        let of = definitions(text).unwrap();
        let fields = of.message("p/Name").unwrap();
        let field = |k: usize| (fields[k].item.clone(), fields[k].count);
        assert_eq!(field(0), (Item::Message("std_msgs/Header".to_owned()), Count::One));
        assert_eq!(field(1), (Item::Number(NumberType::F64), Count::Any));
        assert_eq!(field(2), (Item::Number(NumberType::F64), Count::Fixed(9)));
        assert_eq!(field(3), (Item::Number(NumberType::U64), Count::One));
        assert_eq!(field(4), (Item::Number(NumberType::I64), Count::One));
        assert_eq!(field(6), (Item::Message("p/Other".to_owned()), Count::One));
        for wrong in ["struct A { double x }", "enum E { A };", "module", "struct A { sequence<"] {
            assert!(definitions(wrong).is_none(), "{wrong}");
        }
    }
}
