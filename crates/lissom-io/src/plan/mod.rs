//! `plan.toml`: the experiments of a virtual campaign.
//!
//! ```toml
//! seed = 1                                  # of noise and random phases; 1 when absent
//! settle = "detected"                       # or a time, "none", { tolerance, longest }
//! [[runs]]
//! sine = { frequency = ["0.2 Hz", "0.6 Hz"], amplitude = ["0.5 rad", "1 rad"] }  # all combinations
//! periods = 12                              # or record = "60 s"
//! [[runs]]
//! multisine = { frequency = "0.1 Hz", to = "5 Hz", amplitude = "0.5 rad", crest = 1.7 }
//! [[runs]]
//! release = "0.05 N"                        # the tip is released
//! record = "60 s"
//! ```
//!
//! `docs/src/reference/plan.md` explains every key.

mod plan_experiment;
mod plan_file;
mod plan_settle;
#[cfg(test)]
mod plan_tests;
mod read_plan;

pub use plan_file::{PlanFile, PlanRun};
