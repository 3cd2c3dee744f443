//! The output-error method: the logged command is replayed through an arm, and the arm's parameters are changed until
//! the replay shows the logged angles.

mod budget;
mod by_run;
mod coordinates;
mod covariance;
mod dampers;
mod data;
mod describes;
mod divergence;
mod extend;
mod figures;
mod fit;
mod fitting;
mod follow;
mod found;
mod law;
mod left_over;
mod modes;
mod noise;
mod repeats;
mod replay_findings;
mod replayed;
mod rigid_points;
mod schedule;
mod scores;
mod search;
mod start;
pub(crate) mod thresholds;
mod undecided;
mod windows;

pub use by_run::ByRun;
pub(crate) use data::{Masks, masks};
pub use fit::{Extension, StageReport};
pub(crate) use follow::follow;
pub use found::{OutputError, OutputErrorStart};
pub(crate) use replay_findings::{command_lag, findings};
pub use replayed::output_error;
pub use search::{Iteration, Stop};
pub use start::{starts, starts_by_motor, starts_by_responses};
