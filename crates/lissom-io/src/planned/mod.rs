//! A plan as JSON, as written by `lissom plan --json`.
//!
//! Its schema is `docs/src/reference/schemas/planned.schema.json`, generated from [`PlannedFile`]. The `plan.toml` of
//! the same runs is written by [`plan_text`](crate::write::plan_text) and read by [`PlanFile`](crate::PlanFile).

mod plan_note_entry;
mod planned_file;

pub use plan_note_entry::PlanNoteEntry;
pub use planned_file::{
    ExpectedEntry, PlannedFile, PlannedParameterEntry, PlannedRunEntry, WithoutRunEntry,
};
