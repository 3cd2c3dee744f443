//! `model.json`: a beam, and the arm that it makes with its drive, as numbers for programs.
//!
//! Its schema is `docs/model.schema.json`. A key is `null` where the model has no such thing or is
//! too large for it; a sentence in `notes` then says why.

mod beam_model;
pub(crate) mod frequency_file;
mod model_json;
mod model_responses;

pub use beam_model::{Function, Model, PayloadCase};
pub use frequency_file::{FrequencyError, read_frequencies};
pub use model_json::model_json;
pub(crate) use model_json::{rows, state_space};
pub use model_responses::Responses;
