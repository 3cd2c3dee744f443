//! The beam, Sections 2-3 of the report: massless spans between point masses.

mod lumped;

pub use lumped::{BeamError, LumpedBeam, Span};
