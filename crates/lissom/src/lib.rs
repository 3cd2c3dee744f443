//! Models, exact simulation and identification of flexible arms and motor drives whose joint has friction.
//!
//! A first program: an arm, a virtual rig, four experiments, and the identification of the arm from their logs.
//!
//! ```
//! use lissom::prelude::*;
//!
//! # fn main() -> Result<(), lissom::Error> {
//! let arm = Arm::builder()
//!     .span(Span::new(0.25, 0.02).mass_kg(0.05)) // m, N·m²: a mass on a massless beam
//!     .motor(
//!         Motor::builder()
//!             .inertia_kg_m2(2e-3)
//!             .viscous_nm_s_per_rad(1e-3)
//!             .torque_constant_nm_per_a(0.2),
//!     )
//!     .coulomb_nm(0.02)
//!     .build()?;
//! let rig = Rig::builder(arm)
//!     .sample_time_s(3e-3)
//!     .encoder_bits(12)
//!     .controller(Pd::new(8.0, 0.25)?) // A/rad, A·s/rad
//!     .build()?;
//! let logs = rig.campaign([1.0, 3.0, 2.0, 6.0].map(|w| Experiment::sine(w, 0.5, 20.0)))?; // rad/s, rad, s
//! let found = Identify::new(&logs).run()?;
//! println!("{found}");
//!
//! let coulomb = found.coulomb().ok_or("refused").expect("these logs give it");
//! assert!((coulomb.value - 0.02).abs() < 4.0 * coulomb.std); // N·m
//! # Ok(())
//! # }
//! ```
//!
//! [`prelude`] contains what most programs need. Your own logs are read by [`io::read_campaign`], from a
//! `campaign.toml` as the command `lissom` uses it. If your data are already in memory, build a
//! [`record::Campaign`] from arrays.
//!
//! | you have | start with | and get |
//! |---|---|---|
//! | dimensions of an arm | [`arm::Arm::builder`], [`beam`] | frequencies, modes, zeros, matrices, transfer functions |
//! | an idea for an experiment | [`rig::Rig::builder`] | logs of a joint that sticks and slips like a real one |
//! | logs | [`io::read_campaign`], [`Identify::of_file`] | friction, inertia, coupling, modes, each with a standard error, and findings |
//! | approximate parameters and little time | [`plan`] | the runs that give a wanted precision |
//! | a result and another log | [`Found::validate`] | how well the result predicts that log |
//!
//! Units are SI and rad/s, and names of public numbers contain their units (`inertia_kg_m2`). Angles of motor and
//! tips are positive in the same direction, and a positive command drives that way. Each function returns the
//! error of its own module; the operator `?` converts all of them to [`Error`]. Nothing is printed, and only
//! [`io`] reads and writes files.

#[doc(inline)]
pub use lissom_core::{
    Basis, Matrix, Threshold, ThresholdValue, arm, beam, drive, identify, information, load, lti,
    plan, record, replay, rig, spectrum, thresholds,
};
#[doc(inline)]
pub use lissom_io as io;

mod described_logs;
mod equivalent_input;
mod error;
mod found;
mod identify_campaign;
mod parameter_text;
mod predict_payload;
pub mod prelude;
mod result_text;

pub use described_logs::DescribedLogs;
pub use equivalent_input::{EquivalentArmError, EquivalentInput, EquivalentInputError, KnownMotor};
pub use error::Error;
pub use found::Found;
pub use identify_campaign::Identify;
pub use predict_payload::{PayloadError, Payloads, predict_payload};
pub use result_text::ResultText;
