//! Lines of a universal file, and the header of a dataset 58.

/// Lines of a file.
#[derive(Debug, Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    row: usize,
    is_open: bool,
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, row: 0, is_open: false }
    }

    /// The number of lines that were read.
    pub(super) fn row(&self) -> usize {
        self.row
    }

    /// Whether the file ended inside the last line that was read.
    pub(super) fn is_open(&self) -> bool {
        self.is_open
    }

    /// The next line, without its end.
    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.row += 1;
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest.get(1..).unwrap_or_default();
        self.is_open = end.is_none();
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }

    /// The next bytes; fewer if the file ends.
    pub(super) fn bytes(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.rest.split_at(count.min(self.rest.len()));
        self.rest = rest;
        taken
    }

    /// Skips ends of lines.
    pub(super) fn skip_line_ends(&mut self) {
        while let [b'\r' | b'\n', rest @ ..] = self.rest {
            self.rest = rest;
        }
    }
}

/// Time response.
const TIME_RESPONSE: i64 = 1;
/// A function or an abscissa whose type is not stated.
const UNKNOWN: i64 = 0;
/// Frequency response.
const FREQUENCY_RESPONSE: i64 = 4;
/// The abscissa is the time.
const TIME: i64 = 17;
/// The abscissa is the frequency.
const FREQUENCY: i64 = 18;
/// Directions 1 to 6.
const DIRECTIONS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// Header of a dataset 58.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    first_line: Option<String>,
    function: i64,
    entity: Option<String>,
    node: i64,
    direction: i64,
    /// 2 and 4 are real, 5 and 6 complex; 2 and 5 are of single precision.
    ordinate: i64,
    pub(super) points: usize,
    pub(super) is_even: bool,
    start: f64,
    step: f64,
    abscissa: i64,
    pub(super) abscissa_unit: Option<String>,
    label: Option<String>,
    ordinate_unit: Option<String>,
    /// The unit by which that of the ordinate is divided.
    denominator_unit: Option<String>,
}

/// The columns of a line as text.
fn columns(line: &[u8], from: usize, count: usize) -> String {
    let end = (from + count).min(line.len());
    String::from_utf8_lossy(line.get(from..end).unwrap_or_default()).trim().to_owned()
}

/// A word, unless the file says that there is none.
fn word(line: &[u8], from: usize, count: usize) -> Option<String> {
    Some(columns(line, from, count)).filter(|word| !word.is_empty() && word != "NONE")
}

/// An integer; zero if the columns are empty.
fn integer(line: &[u8], from: usize, count: usize) -> Option<i64> {
    let text = columns(line, from, count);
    if text.is_empty() { Some(0) } else { text.parse().ok() }
}

impl Header {
    /// The eleven lines behind the first one of a dataset.
    pub(super) fn of(lines: &mut Lines) -> Option<Self> {
        let first_line = word(lines.next()?, 0, 80);
        for _ in 0..4 {
            lines.next()?;
        }
        let response = lines.next()?;
        let form = lines.next()?;
        let abscissa = lines.next()?;
        let ordinate = lines.next()?;
        let denominator = lines.next()?;
        lines.next()?;
        let float = |from: usize| super::fortran_number::number(columns(form, from, 13).as_bytes());
        Some(Self {
            first_line,
            function: integer(response, 0, 5)?,
            entity: word(response, 31, 10),
            node: integer(response, 41, 10)?,
            direction: integer(response, 51, 4)?,
            ordinate: integer(form, 0, 10).filter(|kind| [2, 4, 5, 6].contains(kind))?,
            points: usize::try_from(integer(form, 10, 10)?).ok()?,
            is_even: integer(form, 20, 10)? != 0,
            start: float(30).unwrap_or(0.0),
            step: float(43).unwrap_or(0.0),
            abscissa: integer(abscissa, 0, 10)?,
            abscissa_unit: word(abscissa, 47, 20),
            label: word(ordinate, 26, 20),
            ordinate_unit: word(ordinate, 47, 20),
            denominator_unit: word(denominator, 47, 20),
        })
    }

    pub(super) fn is_time_response(&self) -> bool {
        self.function == TIME_RESPONSE || (self.function == UNKNOWN && self.abscissa == TIME)
    }

    pub(super) fn is_of_frequency(&self) -> bool {
        self.abscissa == FREQUENCY
            || (self.function == FREQUENCY_RESPONSE && self.abscissa == UNKNOWN)
    }

    /// The unit of the ordinate, per that of the excitation.
    pub(super) fn unit(&self) -> Option<String> {
        let unit = self.ordinate_unit.clone();
        match &self.denominator_unit {
            Some(per) if per.contains(['/', '*', '·']) => {
                Some(format!("{}/({per})", unit.as_deref().unwrap_or("1")))
            }
            Some(per) => Some(format!("{}/{per}", unit.as_deref().unwrap_or("1"))),
            None => unit,
        }
    }

    /// First abscissa, and distance of two, if they are even.
    pub(super) fn even(&self) -> Option<(f64, f64)> {
        self.is_even.then_some((self.start, self.step))
    }

    pub(super) fn is_complex(&self) -> bool {
        self.ordinate >= 5
    }

    pub(super) fn is_double(&self) -> bool {
        matches!(self.ordinate, 4 | 6)
    }

    /// Numbers of a sample.
    pub(super) fn numbers_of_point(&self) -> usize {
        1 + usize::from(self.is_complex()) + usize::from(!self.is_even)
    }

    /// Seconds of a unit of the abscissa.
    fn unit_s(&self) -> f64 {
        match self.abscissa_unit.as_deref() {
            Some("ms" | "msec") => 1e-3,
            Some("us" | "µs") => 1e-6,
            Some("min") => 60.0,
            _ => 1.0,
        }
    }

    /// Time between two values, if it is stated \[s\].
    pub(super) fn step_s(&self) -> Option<f64> {
        Some(self.step * self.unit_s()).filter(|step| self.is_even && *step > 0.0)
    }

    /// Time of the first value \[s\].
    pub(super) fn start_s(&self) -> f64 {
        self.start * self.unit_s()
    }

    pub(super) fn name(&self) -> String {
        let axis = usize::try_from(self.direction.unsigned_abs()).ok();
        let axis = axis.and_then(|axis| DIRECTIONS.get(axis.checked_sub(1)?));
        let sign = if self.direction < 0 { "-" } else { "+" };
        let direction = axis.map_or_else(String::new, |axis| format!("{sign}{axis}"));
        match (&self.entity, self.node) {
            (Some(entity), 0) => entity.clone(),
            (Some(entity), node) => format!("{entity}/{node}{direction}"),
            (None, 0) => {
                let name = self.label.as_ref().or(self.first_line.as_ref());
                name.map_or_else(|| "data".to_owned(), Clone::clone)
            }
            (None, node) => format!("{node}{direction}"),
        }
    }
}
