//! What a [`Page`](crate::Page) is made of: findings, key figures and tables.

/// How serious a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// A result is less certain than its standard error says.
    Warning,
    /// A requested result is not given.
    Refusal,
}

impl Severity {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Refusal => "refusal",
        }
    }
}

/// A statement about the data or a result that the reader must know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How serious it is.
    pub severity: Severity,
    /// A stable key.
    pub code: String,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// The run concerned.
    pub run: Option<String>,
    /// The results concerned.
    pub affects: Vec<String>,
}

impl Finding {
    /// A finding without hint, run or results concerned.
    pub fn new(severity: Severity, code: impl Into<String>, message: impl Into<String>) -> Self {
        Self {
            severity,
            code: code.into(),
            message: message.into(),
            hint: None,
            run: None,
            affects: Vec::new(),
        }
    }

    /// Adds what to do about it.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

/// An estimated parameter for [`Page::key_figures`](crate::Page::key_figures).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeyFigure {
    /// The name of the parameter.
    pub name: String,
    /// The estimate; `None` if it is refused.
    pub value: Option<f64>,
    /// Its standard error.
    pub std: Option<f64>,
    /// Its 95 % interval.
    pub ci95: Option<[f64; 2]>,
    /// Its unit.
    pub unit: String,
    /// A value that is known beforehand.
    pub known: Option<f64>,
    /// Codes of the findings that make it doubtful; their places on the page are those of [`Page::findings`](crate::Page::findings).
    pub doubted_by: Vec<String>,
    /// A remark, for example why it is refused.
    pub note: String,
}

/// The alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cells {
    /// Words: left.
    Text,
    /// Numbers: right, with digits of equal width.
    Numbers,
}

/// A table for [`Page::table`](crate::Page::table).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The caption above it.
    pub caption: String,
    /// Heading and alignment of each column.
    pub columns: Vec<(String, Cells)>,
    /// The rows; cells missing at the end stay empty, cells without a column are not shown.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table without rows.
    pub fn new(caption: impl Into<String>, columns: &[(&str, Cells)]) -> Self {
        let columns =
            columns.iter().map(|(heading, cells)| ((*heading).to_owned(), *cells)).collect();
        Self { caption: caption.into(), columns, rows: Vec::new() }
    }

    /// Adds a row.
    #[must_use]
    pub fn row<T: Into<String>>(mut self, cells: impl IntoIterator<Item = T>) -> Self {
        self.rows.push(cells.into_iter().map(Into::into).collect());
        self
    }
}
