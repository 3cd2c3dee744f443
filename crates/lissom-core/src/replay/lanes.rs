//! Parameters side by side: so many derivatives are computed at a time.

/// Unknowns that are worked on together: their loops become vectors.
pub(super) const LANES: usize = 8;
/// A number of each of them.
pub(super) type Lanes = [f64; LANES];

/// `∂x/∂u` of [`LANES`] unknowns u, state by state.
pub(super) type Pack<const D: usize> = [Lanes; D];

/// Derivatives of a matrix and a vector by [`LANES`] parameters, row by row.
pub(super) type MatrixPack<const D: usize> = [[Lanes; D]; D];
