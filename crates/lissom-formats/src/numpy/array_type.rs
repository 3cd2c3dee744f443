//! Types of the items of NumPy arrays.

use super::literal::Literal;
use crate::array::{Axis, axes, items};
use crate::collected::LeftOut;
use crate::number::{Number, NumberType};

pub(super) const OBJECTS: LeftOut = LeftOut {
    what: "pickled Python objects, which are never loaded because they can run programs",
    way_out: "in Python: numpy.save(\"log.npy\", \
              numpy.array(numpy.load(FILE, allow_pickle=True).tolist(), dtype=float)), \
              if you trust the file",
};
const WIDE: LeftOut = LeftOut {
    what: "numbers of more than 64 bits",
    way_out: "in Python: numpy.save(\"log.npy\", a.astype(float))",
};
const TEXT: LeftOut = LeftOut {
    what: "texts",
    way_out: "in Python: numpy.save(\"log.npy\", a.astype(float)) if they are numbers",
};
const CALENDAR: LeftOut = LeftOut {
    what: "dates in months or years",
    way_out: "in Python: a.astype(\"datetime64[ns]\")",
};
/// Deepest nesting of fields.
const MOST_DEPTH: usize = 16;
/// Most fields of a record.
const MOST_FIELDS: usize = 4096;

/// Type of the items of an array.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ArrayType {
    pub(super) kind: Kind,
    /// Size with its own axes \[byte\].
    pub(super) size: usize,
    /// Axes of the items themselves.
    pub(super) axes: Vec<Axis>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    Number(Number),
    /// Complex numbers of two such numbers.
    Complex(Number),
    /// Dates, or time spans, counted in a unit of `unit_s` seconds.
    Time {
        big_endian: bool,
        unit_s: f64,
        are_dates: bool,
    },
    Record(Vec<Field>),
    /// Bytes between fields.
    Padding,
    LeftOut(&'static LeftOut),
}

/// A field of a record.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) of: ArrayType,
    /// Where it begins in the record \[byte\].
    pub(super) offset: usize,
}

impl ArrayType {
    /// The type that a header describes; `None` if it is unknown.
    pub(super) fn of(described: &Literal, depth: usize) -> Option<Self> {
        match described {
            Literal::Text(code) => scalar(code),
            Literal::Items(fields) if depth < MOST_DEPTH && fields.len() <= MOST_FIELDS => {
                record(fields, depth)
            }
            _ => None,
        }
    }

    /// Whether the items contain objects of Python: then all are pickled.
    pub(super) fn has_objects(&self) -> bool {
        match &self.kind {
            Kind::Record(fields) => fields.iter().any(|field| field.of.has_objects()),
            kind => *kind == Kind::LeftOut(&OBJECTS),
        }
    }

    /// An array of such items as one item.
    fn shaped(mut self, shape: &[usize]) -> Option<Self> {
        let mut axes = axes(shape, self.size, false)?;
        self.size = self.size.checked_mul(items(shape)?)?;
        axes.append(&mut self.axes);
        self.axes = axes;
        Some(self)
    }
}

fn record(fields: &[Literal], depth: usize) -> Option<ArrayType> {
    let mut offset = 0_usize;
    let mut record = Vec::with_capacity(fields.len());
    for field in fields {
        let Literal::Items(parts) = field else { return None };
        let (name, described) = (parts.first()?, parts.get(1)?);
        // A field may have a title: (title, name).
        let name = match name {
            Literal::Items(pair) => pair.get(1)?,
            name => name,
        };
        let Literal::Text(name) = name else { return None };
        let mut of = ArrayType::of(described, depth + 1)?;
        if let Some(shape) = parts.get(2) {
            of = of.shaped(&shape.counts()?)?;
        }
        let size = of.size;
        record.push(Field { name: name.clone(), of, offset });
        offset = offset.checked_add(size)?;
    }
    Some(ArrayType { kind: Kind::Record(record), size: offset, axes: Vec::new() })
}

/// The type of a code such as `<f8`.
fn scalar(code: &str) -> Option<ArrayType> {
    let (order, code) = match code.chars().next()? {
        order @ ('<' | '>' | '|' | '=') => (order, code.get(1..)?),
        _ => ('=', code),
    };
    let big_endian = order == '>';
    let (letter, rest) = code.split_at_checked(1)?;
    let (count, unit) = rest.split_once('[').unwrap_or((rest, ""));
    let count: usize = if count.is_empty() { 0 } else { count.parse().ok()? };
    let size = if letter == "U" { count.checked_mul(4)? } else { count };
    let number = |kind| Kind::Number(Number::new(kind, big_endian));
    let complex = |kind| Kind::Complex(Number::new(kind, big_endian));
    let kind = match (letter, count) {
        ("i", 1) => number(NumberType::I8),
        ("b" | "u", 1) => number(NumberType::U8),
        ("i", 2) => number(NumberType::I16),
        ("i", 4) => number(NumberType::I32),
        ("i", 8) => number(NumberType::I64),
        ("u", 2) => number(NumberType::U16),
        ("u", 4) => number(NumberType::U32),
        ("u", 8) => number(NumberType::U64),
        ("f", 2) => number(NumberType::F16),
        ("f", 4) => number(NumberType::F32),
        ("f", 8) => number(NumberType::F64),
        ("c", 8) => complex(NumberType::F32),
        ("c", 16) => complex(NumberType::F64),
        ("f" | "i" | "u" | "c", _) => Kind::LeftOut(&WIDE),
        ("O", _) => Kind::LeftOut(&OBJECTS),
        ("S" | "a" | "U", _) => Kind::LeftOut(&TEXT),
        ("V", _) => Kind::Padding,
        ("M" | "m", 8) => match unit_s(unit.trim_end_matches(']')) {
            Some(unit_s) => Kind::Time { big_endian, unit_s, are_dates: letter == "M" },
            None => Kind::LeftOut(&CALENDAR),
        },
        _ => return None,
    };
    Some(ArrayType { kind, size, axes: Vec::new() })
}

/// A unit of dates, as `ns` or `25us`, in seconds; `None` for months and years.
fn unit_s(unit: &str) -> Option<f64> {
    let digits = unit.find(|c: char| !c.is_ascii_digit())?;
    let (count, unit) = unit.split_at_checked(digits)?;
    let count: f64 = if count.is_empty() { 1.0 } else { count.parse().ok()? };
    let unit = match unit {
        "W" => 604_800.0,
        "D" => 86_400.0,
        "h" => 3600.0,
        "m" => 60.0,
        "s" => 1.0,
        "ms" => 1e-3,
        "us" => 1e-6,
        "ns" => 1e-9,
        "ps" => 1e-12,
        "fs" => 1e-15,
        "as" => 1e-18,
        _ => return None,
    };
    Some(count * unit)
}
