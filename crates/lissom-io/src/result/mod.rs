//! `result.json`: what identification found, with stable keys that carry their units.
//!
//! Its schema is `docs/result.schema.json`. A figure is `{value, std, ci95}`, or `null` where it
//! is refused; a finding then says why.

mod arm_reader;
mod equivalent_json;
mod estimate_json;
mod payload_json;
mod result_arm;
mod result_dry_terms;
pub(crate) mod result_error;
mod result_friction_law;
mod result_geometry;
mod result_json;
mod result_verdict;
mod unit_names;
mod validation_json;

pub use equivalent_json::equivalent_json;
pub use payload_json::{PayloadPrediction, PredictedPayload, payload_json};
pub use result_arm::read_arm;
pub use result_error::ResultError;
pub use result_json::result_json;
pub use unit_names::UnitNames;
pub use validation_json::{channel_name_unit, validation_json};
