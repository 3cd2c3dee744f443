//! Models of the beam (Sections 2 to 4 of the 1989 report).
//!
//! - [`LumpedBeam`]: point masses on massless spans (Sections 2 and 3). Methods that need no matrix run along the beam
//!   once, by a recursion.
//! - [`DistributedBeam`]: mass along the beam (Section 4). [`TruncatedBeam`] keeps its first
//!   modes, in the form (17)-(18).
//! - [`ModalBeam`]: known only by its modes at some points, for example from measured responses.
//!
//! The [`Beam`] of an arm is lumped, modal, or absent (a rigid axis).

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
