//! The methods: each gives its own complete estimates.

pub(crate) mod constant_velocity;
pub(crate) mod friction_law;
pub(crate) mod least_squares;
pub(crate) mod regression;
pub(crate) mod rigid_equation;
pub(crate) mod third_harmonic;
pub(crate) mod thresholds;
pub(crate) mod unlike_runs;
