//! Which method's solution is taken for which group of parameters, and what speaks against it.

mod beam_choice;
mod conclude;
mod constant_velocity_findings;
mod drive_table;
mod evidence;
mod friction_law_findings;
mod output_error_findings;
mod regression_findings;
mod remarks;
pub(crate) mod thresholds;
mod unknown;

pub(crate) use conclude::{Conclusion, conclude};
pub(crate) use drive_table::{slip_phase_solution, slip_phase_terms};
pub(crate) use evidence::{Chosen, Evidence, Methods};
