//! `model.json`: a beam, and the arm that it makes with its drive, as numbers for programs.
//!
//! Its schema is `docs/src/reference/schemas/model.schema.json`, generated from [`ModelFile`]. A key is `null` where the model has no such thing or is
//! too large for it; a sentence in `notes` then says why.

mod beam_model;
pub(crate) mod frequency_file;
mod model_file;
mod model_responses;
mod state_space_entry;

pub use beam_model::{Function, Model, PayloadCase};
pub use frequency_file::{FrequencyError, read_frequencies};
pub use model_file::{
    BeamKindName, ComplexEntry, FunctionEntry, ModeShapeEntry, ModelFile, PayloadCaseEntry,
    PropertyEntry, ResponsesEntry, RootClassName, TipPayloadEntry, TruncatedEntry, ZeroEntry,
};
pub use model_responses::Responses;
pub use state_space_entry::StateSpaceEntry;
pub(crate) use state_space_entry::matrix_rows;
