//! Frequency responses, corrected for friction, and rational models that are fitted to them.

pub(crate) mod bands;
pub(crate) mod correct;
pub(crate) mod model;
pub(crate) mod models;
pub(crate) mod rational;
pub(crate) mod response_point;
pub(crate) mod response_table;
pub(crate) mod thresholds;
