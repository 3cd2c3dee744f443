//! Notes of a plan in JSON.

use lissom_core::identify::Severity;
use lissom_core::plan::PlanNote;
use serde::{Deserialize, Serialize};

/// A note of a plan: something that its user should know.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlanNoteEntry {
    /// What the note is about; the page about planning in the book lists all codes.
    pub code: String,
    /// A warning if a wanted precision is not reached, or the expected precision may not be reached; otherwise info.
    pub severity: Severity,
    /// The note in words, with numbers.
    pub message: String,
}

impl PlanNoteEntry {
    pub(super) fn of(note: &PlanNote) -> Self {
        Self {
            code: note.code().to_owned(),
            severity: if note.is_warning() { Severity::Warning } else { Severity::Info },
            message: note.to_string(),
        }
    }
}
