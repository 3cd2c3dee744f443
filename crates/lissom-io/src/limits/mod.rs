//! `limits.toml`: limits of the parameters of a drive, for a test at the end of a production line.
//!
//! ```toml
//! path = "{machine}/{time}.csv"      # what the end of a log's path says; optional
//! [[limits]]
//! parameter = "friction.coulomb"     # a key of result.json
//! unit = "N*m"                       # its unit there
//! min = 0.20
//! max = 0.30
//! ```
//!
//! A parameter passes if its whole 95 % interval is within the limits, and fails if the whole interval is outside. In
//! between the log does not decide.

mod check_file;
mod limits_file;
mod path_pattern;

pub use check_file::{CheckFile, CheckedParameterEntry, Outcome};
pub use limits_file::{Limit, LimitsFile};
pub use path_pattern::PathPattern;
