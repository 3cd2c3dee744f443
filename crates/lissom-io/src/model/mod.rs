//! `model.json`: the model of a beam, and of the arm with its drive, as numbers for programs.
//!
//! Its schema is `docs/src/reference/schemas/model.schema.json`, generated from [`ModelFile`]. A key is `null` if it
//! does not apply to the model or the model is too large for it; `notes` then gives the reason.

mod beam_model;
pub(crate) mod frequency_file;
mod model_file;
mod model_responses;
mod state_space_entry;

pub use beam_model::{Function, Model, PayloadCase};
pub use frequency_file::{FrequencyError, read_frequencies};
pub use model_file::{
    ComplexEntry, FunctionEntry, ModelFile, PayloadCaseEntry, PropertyEntry, ResponsesEntry,
    TruncatedEntry, ZeroEntry,
};
pub use model_responses::Responses;
pub use state_space_entry::StateSpaceEntry;
pub(crate) use state_space_entry::matrix_rows;
