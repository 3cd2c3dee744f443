//! Summary of a fleet: distributions, outliers and drift of each parameter.

mod chances;
mod common_course;
mod common_scatter;
mod distribution;
mod drift;
mod histogram;
mod line_fit;
mod log_value;
mod machines;
mod outliers;
mod robust;
mod summarise;

pub use summarise::{SummaryOptions, summarise};
