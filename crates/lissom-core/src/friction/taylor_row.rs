//! Storage for the Taylor coefficients of one quantity along a motion.

/// Most Taylor coefficients of a friction torque.
pub(crate) const COEFFICIENTS: usize = 25;

/// Coefficients by order.
pub(crate) type Row = [f64; COEFFICIENTS];
