//! The output-error method: it simulates the arm under the logged command, and changes the arm's parameters until the
//! simulated motion is the logged one.

mod command_noise;
mod engine;
mod estimates;
mod follow;
mod found;
mod model;
mod moves;
mod replayed;
mod schedule;
pub(crate) mod starting_arms;
pub(crate) mod thresholds;
mod undecided;

pub use engine::by_run::ByRun;
pub(crate) use engine::data::{Masks, masks};
pub use engine::search::{Iteration, Stop};
pub(crate) use follow::follow;
pub use found::{OutputError, OutputErrorStart, SearchEnd};
pub(crate) use model::describes::is_left;
pub use model::fit::{Extension, StageReport};
pub(crate) use model::start::rigid;
pub(crate) use model::start::with_hidden_mode;
pub use model::start::{starts, starts_by_motor, starts_by_responses};
pub(crate) use moves::modes::highest;
pub use replayed::output_error;
