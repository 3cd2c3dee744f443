//! Changes of the model, each proposed where the residual calls for it and accepted by one rule.

pub(crate) mod dampers;
pub(crate) mod extend;
pub(crate) mod modes;
pub(crate) mod rigid_points;
pub(crate) mod scores;
