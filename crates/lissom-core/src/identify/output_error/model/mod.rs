//! The arm that is fitted: where it starts, what is free in it, and whether it describes the runs.

pub(crate) mod describes;
pub(crate) mod divergence;
pub(crate) mod fit;
pub(crate) mod fitting;
pub(crate) mod left_over;
pub(crate) mod repeats;
pub(crate) mod start;
