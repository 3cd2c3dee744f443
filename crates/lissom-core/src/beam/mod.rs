//! The beam, Sections 2-4 of the report.
//!
//! A [`LumpedBeam`] is massless between point masses (Sections 2 and 3). Whatever does not need a
//! matrix runs along the beam once, by the recursion of `chain`. A [`DistributedBeam`] has its mass along
//! it (Section 4); a [`TruncatedBeam`] keeps the first of its modes, in the form (17)-(18). A [`ModalBeam`] is known
//! by its modes alone. The [`Beam`] of an arm is lumped or modal.

mod best_point;
mod bracket;
mod chain;
mod counted;
mod damped;
mod distributed;
mod dynamics;
mod element;
mod frequencies;
mod lumped;
mod matrices;
mod modal;
mod modal_form;
mod modes;
mod of_arm;
mod payload;
mod piece;
mod properties;
mod response;
mod roots;
mod shape;
mod span;
mod sweep;
mod three_moment;
mod transfer;
mod truncated;
mod winding;
mod zeros;

pub use best_point::BestPoint;
pub use damped::{Roots, motor_poles};
pub use distributed::{DistributedBeam, Piece};
pub use dynamics::BeamDynamics;
pub use frequencies::Base;
pub use lumped::LumpedBeam;
pub use matrices::{BeamMatrices, MOST_MASSES};
pub use modal::{KnownMode, ModalBeam};
pub(crate) use modal_form::{ModalForm, completed, zero_squares};
pub use modes::Mode;
pub use of_arm::Beam;
pub use payload::zero_shift;
pub use properties::{MOST_CHECKED, Property, properties};
pub use response::BeamResponse;
pub use roots::{RootClass, class};
pub use shape::DeflectedShape;
pub use span::{BeamError, Damping, Payload, Span};
pub use transfer::{angle_per_current, motor_function};
pub use truncated::TruncatedBeam;
pub use zeros::Zeros;
