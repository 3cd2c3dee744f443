//! The meaning of the columns of a table, from their names.

use std::f64::consts::{PI, TAU};

use super::response_error::ResponseError;
use crate::nearest::nearest;
use crate::units::{Dimension, parse_any_unit, parse_unit};

/// The part of a response in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ComplexPart {
    Real,
    Imaginary,
    Magnitude,
    Decibel,
    Phase,
    Deviation,
}

impl ComplexPart {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Real => "real part",
            Self::Imaginary => "imaginary part",
            Self::Magnitude => "magnitude",
            Self::Decibel => "magnitude in dB",
            Self::Phase => "phase",
            Self::Deviation => "standard error",
        }
    }
}

/// A column of a response.
#[derive(Debug, Clone)]
pub(super) struct PartColumn {
    pub(super) index: usize,
    /// Name of the output; empty if the column's name has none.
    pub(super) output: String,
    pub(super) part: ComplexPart,
    /// Factor from its numbers to SI.
    pub(super) factor: f64,
    /// Dimension of the response, if there is a unit.
    pub(super) dimension: Option<Dimension>,
}

/// The columns of a table; columns that are neither a frequency nor part of a response are skipped.
#[derive(Debug)]
pub(super) struct Columns {
    pub(super) frequency: usize,
    /// Factor from the unit of the frequency to rad/s.
    pub(super) rad_s: f64,
    pub(super) parts: Vec<PartColumn>,
}

/// Words of a frequency's name.
const FREQUENCY: [&str; 7] = ["omega", "ω", "w", "frequency", "freq", "f", "frequenz"];

impl Columns {
    pub(super) fn of(file: &str, names: &[String]) -> Result<Self, ResponseError> {
        let mut frequency: Option<(usize, f64)> = None;
        let mut parts = Vec::new();
        for (index, name) in names.iter().enumerate() {
            let split = Split::of(name);
            if let Some(unit) = split.frequency() {
                let rad_s = rate(file, name, &unit)?;
                if let Some((first, _)) = frequency {
                    let (first, second) = (names[first].clone(), name.clone());
                    let file = file.to_owned();
                    return Err(ResponseError::TwoFrequencies { file, first, second });
                }
                frequency = Some((index, rad_s));
            } else if let Some((output, part)) = split.part() {
                let (factor, dimension) = factor(file, name, part, &split)?;
                parts.push(PartColumn { index, output, part, factor, dimension });
            }
        }
        let Some((frequency, rad_s)) = frequency else {
            let nearest = nearest("frequency_hz", names.iter().map(String::as_str));
            let (file, names) = (file.to_owned(), names.to_vec());
            return Err(ResponseError::NoFrequency { file, names, nearest });
        };
        one_response(&mut parts);
        Ok(Self { frequency, rad_s, parts })
    }

    /// Indices of the columns that are needed.
    pub(super) fn wanted(&self) -> impl Iterator<Item = usize> {
        std::iter::once(self.frequency).chain(self.parts.iter().map(|part| part.index))
    }
}

/// Two columns that are the two parts of one response, whatever they are named: `|G| [dB]` and `phi [deg]`.
fn one_response(parts: &mut [PartColumn]) {
    use ComplexPart::{Decibel, Imaginary, Magnitude, Phase, Real};
    let [first, second] = parts else { return };
    let pair =
        |of: [ComplexPart; 2]| of == [first.part, second.part] || of == [second.part, first.part];
    let is_pair = [[Real, Imaginary], [Magnitude, Phase], [Decibel, Phase]].into_iter().any(pair);
    if is_pair && first.output != second.output {
        first.output.clear();
        second.output.clear();
    }
}

/// The name of a column, split into words and unit.
struct Split {
    words: Vec<String>,
    /// The unit in brackets.
    unit: Option<String>,
}

impl Split {
    fn of(name: &str) -> Self {
        let name = name.trim();
        let open = name.find(['[', '(']);
        let (plain, unit) = match open {
            Some(at) => {
                let unit = name[at + 1..].trim_end_matches([']', ')', ' ']).trim().to_owned();
                (&name[..at], Some(unit))
            }
            None => (name, None),
        };
        // Some instruments write `Gain in dB`.
        let (plain, unit) = match (plain.rsplit_once(" in "), unit) {
            (Some((plain, unit)), None) => (plain, Some(unit.trim().to_owned())),
            (_, unit) => (plain, unit),
        };
        let words = plain.split(['_', ' ', '.', '-', '/', ':', '|']).filter(|w| !w.is_empty());
        Self { words: words.map(str::to_owned).collect(), unit }
    }

    fn lower(&self) -> Vec<String> {
        self.words.iter().map(|w| w.to_lowercase()).collect()
    }

    /// The unit of a frequency, empty if it has none; `None` if the column is not a frequency.
    fn frequency(&self) -> Option<String> {
        let words = self.lower();
        let (first, rest) = words.split_first()?;
        let is_part = |w: &String| w != "rad" && part_of(w).is_some();
        if !FREQUENCY.contains(&first.as_str()) || rest.iter().any(is_part) {
            return None;
        }
        match (&self.unit, rest) {
            (Some(unit), []) => Some(unit.clone()),
            (None, []) => Some(String::new()),
            (None, rest) => {
                let per: Vec<&str> =
                    rest.iter().map(String::as_str).filter(|w| *w != "per").collect();
                Some(per.join("/"))
            }
            // A response with such a name.
            (Some(_), _) => None,
        }
    }

    /// The name of the output, and the part of its response, which the last words give.
    fn part(&self) -> Option<(String, ComplexPart)> {
        let lower = self.lower();
        let mut count = lower.len();
        let mut part = None;
        // The unit may be a word, too, as in `phase_deg` and `mag_db`.
        while let Some(found) = count.checked_sub(1).and_then(|i| part_of(&lower[i])) {
            part = Some(match (part, found) {
                (Some(ComplexPart::Decibel), ComplexPart::Magnitude) => ComplexPart::Decibel,
                (Some(ComplexPart::Phase) | None, ComplexPart::Phase) => ComplexPart::Phase,
                (None, found) => found,
                // A word of the output's name.
                (Some(_), _) => break,
            });
            count -= 1;
        }
        let decibel = self.unit.as_deref().is_some_and(|u| u.eq_ignore_ascii_case("db"));
        match part {
            Some(ComplexPart::Magnitude) if decibel => {
                Some((self.words[..count].join("_"), ComplexPart::Decibel))
            }
            Some(part) => Some((self.words[..count].join("_"), part)),
            // A unit may be enough, as in `tip [dB]` and `tip [deg]`.
            None if decibel => Some((self.words.join("_"), ComplexPart::Decibel)),
            None => {
                let degrees = self.unit.as_deref().is_some_and(|u| u == "deg" || u == "°");
                degrees.then(|| (self.words.join("_"), ComplexPart::Phase))
            }
        }
    }

    /// The unit of a phase, degrees or radians, if a word gives it.
    fn phase_unit(&self) -> Option<String> {
        let word = |w: &String| matches!(w.as_str(), "deg" | "degree" | "degrees" | "rad");
        self.unit.clone().or_else(|| self.lower().into_iter().rev().find(word))
    }
}

fn part_of(word: &str) -> Option<ComplexPart> {
    Some(match word {
        "re" | "real" => ComplexPart::Real,
        "im" | "imag" | "imaginary" => ComplexPart::Imaginary,
        "mag" | "magnitude" | "abs" | "gain" | "amplitude" | "betrag" => ComplexPart::Magnitude,
        "db" => ComplexPart::Decibel,
        "phase" | "deg" | "degree" | "degrees" | "arg" | "rad" => ComplexPart::Phase,
        "std" | "sigma" | "deviation" => ComplexPart::Deviation,
        _ => return None,
    })
}

/// The factor from a unit of frequency to rad/s.
fn rate(file: &str, column: &str, unit: &str) -> Result<f64, ResponseError> {
    let (file, column) = (file.to_owned(), column.to_owned());
    match unit.to_lowercase().as_str() {
        "" => Err(ResponseError::NoUnit { file, column }),
        "hz" => Ok(TAU),
        "khz" => Ok(1e3 * TAU),
        "rad/s" | "rad/sec" | "1/s" => Ok(1.0),
        _ => parse_unit(unit, Dimension::RATE).map_err(|_| ResponseError::Unit {
            file,
            column,
            unit: unit.to_owned(),
        }),
    }
}

/// The factor of a part's numbers to SI, and the dimension of the response.
fn factor(
    file: &str,
    column: &str,
    part: ComplexPart,
    split: &Split,
) -> Result<(f64, Option<Dimension>), ResponseError> {
    let wrong = |unit: &str| ResponseError::Unit {
        file: file.to_owned(),
        column: column.to_owned(),
        unit: unit.to_owned(),
    };
    match (part, split.unit.as_deref()) {
        (ComplexPart::Phase, _) => match split.phase_unit().map(|u| u.to_lowercase()).as_deref() {
            Some("deg" | "degree" | "degrees" | "°") => Ok((PI / 180.0, None)),
            Some("rad") => Ok((1.0, None)),
            Some(unit) => Err(wrong(unit)),
            None => Err(ResponseError::NoUnit { file: file.to_owned(), column: column.to_owned() }),
        },
        (ComplexPart::Decibel, None | Some("" | "dB" | "db" | "DB")) => Ok((1.0, None)),
        (ComplexPart::Decibel, Some(unit)) => Err(wrong(unit)),
        (_, None | Some("" | "-" | "1")) => Ok((1.0, None)),
        (_, Some(unit)) => match parse_any_unit(unit) {
            Ok((factor, dimension)) => Ok((factor, Some(dimension))),
            Err(_) => Err(wrong(unit)),
        },
    }
}
