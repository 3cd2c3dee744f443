//! Replays, sums and searches: what lowers the cost of an arm whose parameters are given.

pub(crate) mod budget;
pub(crate) mod by_run;
pub(crate) mod covariance;
pub(crate) mod data;
pub(crate) mod noise;
pub(crate) mod search;
pub(crate) mod windows;
