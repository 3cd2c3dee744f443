//! Findings: what the logs cannot show, what is wrong with them, and what to know before an estimate is used.
//!
//! All findings are rows of tables, which the macro `findings` declares: `record/note.rs` for what was done to a log when
//! it was read, and `identify/findings` for the others. Codes are stable; `docs/src/reference/findings.md` explains each
//! of them.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use strum::IntoStaticStr;

pub(crate) mod result_key;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// The affected estimates are less certain than their standard errors say.
    Warning,
    /// The affected estimates are not given.
    Refusal,
}

impl Severity {
    /// Name in texts and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A statement about what the logs cannot show, what is wrong with them, or what to know before an estimate is used.
///
/// Its [`Display`](fmt::Display) is the message. The row of the table that it is made from has its numbers.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Name of the run concerned; `None` if the finding concerns the whole campaign.
    pub run: Option<String>,
    pub(crate) code: &'static str,
    pub(crate) severity: Severity,
    pub(crate) affects: Vec<&'static str>,
    pub(crate) message: String,
    pub(crate) hint: &'static str,
    pub(crate) row: Arc<dyn Any + Send + Sync>,
}

impl Finding {
    /// Creates a finding about the whole campaign.
    pub fn new(row: impl Into<Self>) -> Self {
        row.into()
    }

    /// Creates a finding about one run.
    pub fn of_run(run: &str, row: impl Into<Self>) -> Self {
        Self { run: Some(run.to_owned()), ..row.into() }
    }

    /// Stable name, e.g. `saturation`.
    pub fn code(&self) -> &'static str {
        self.code
    }

    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.severity
    }

    /// Result keys that it affects, without the suffix of their unit, e.g. `friction.viscous`.
    pub fn affects(&self) -> &[&'static str] {
        &self.affects
    }

    /// What was found, with its numbers, and what it does to the results.
    pub fn message(&self) -> String {
        self.message.clone()
    }

    /// What to do about it; empty where there is nothing to do.
    pub fn hint(&self) -> &'static str {
        self.hint
    }

    /// The numbers of the finding, if it is made from this row of the table.
    pub fn get<Row: Any>(&self) -> Option<&Row> {
        self.row.downcast_ref()
    }

    /// Whether it is made from this row of the table.
    pub fn is<Row: Any>(&self) -> bool {
        self.row.is::<Row>()
    }
}

impl PartialEq for Finding {
    fn eq(&self, other: &Self) -> bool {
        (self.code, &self.run, &self.message) == (other.code, &other.run, &other.message)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// `one mode`, `3 modes`.
pub(crate) fn counted(number: usize, one: &str, many: &str) -> String {
    if number == 1 { format!("one {one}") } else { format!("{number} {many}") }
}

/// A plain number without trailing zeros: `0.25` for `0.25000`.
pub(crate) fn trimmed(number: &str) -> &str {
    if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// Declares rows of the table of findings: code, severity, affected result keys, message and hint of each in one place.
///
/// A row is a struct of the numbers in the message, and its conversion into a [`Finding`]. Rows may share a code. The
/// codes are in the list `CODES`.
macro_rules! findings {
    ($(
        $(#[doc = $doc:literal])+
        $code:literal $row:ident { $($field:ident: $type:ty),* }
        $severity:expr, $affects:expr, $message:expr, $hint:expr;
    )+) => {
        pub(crate) const CODES: &[&str] = &[$($code),+];

        $(
            $(#[doc = $doc])+
            #[derive(Debug, Clone, PartialEq)]
            pub struct $row {
                $(#[doc = "See the message."] pub $field: $type,)*
            }

            impl $row {
                /// Its code.
                pub const CODE: &'static str = $code;
            }

            impl From<$row> for $crate::finding::Finding {
                fn from(row: $row) -> Self {
                    let $row { $($field),* } = &row;
                    Self {
                        run: None,
                        code: $row::CODE,
                        severity: $severity,
                        affects: Vec::from($affects),
                        message: String::from($message),
                        hint: $hint,
                        row: std::sync::Arc::new(row),
                    }
                }
            }
        )+
    };
}
pub(crate) use findings;
