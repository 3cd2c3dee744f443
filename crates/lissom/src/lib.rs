//! Flexible arms and motor drives whose joint has friction: models, exact simulation, identification.
//!
//! An arm, a virtual rig around it, four experiments, and what can be found from their logs alone:
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
//! [`prelude`] has what most programs need. Your own logs are read by [`io::read_campaign`], described by a
//! `campaign.toml` as the command `lissom` takes it; or make a [`record::Campaign`] of arrays.
//!
//! | you have | begin with | and get |
//! |---|---|---|
//! | dimensions of an arm | [`arm::Arm::builder`], [`beam`] | frequencies, modes, zeros, matrices, transfer functions |
//! | an idea for an experiment | [`rig::Rig::builder`] | logs of a joint that sticks and slips, as a real one gives them |
//! | logs | [`io::read_campaign`], [`Identify`] | friction, inertia, coupling, modes, each with a standard error, and findings |
//! | rough numbers and little time | [`plan`] | the runs that give a wanted precision |
//! | a result and another log | [`Found::validate`] | how well the result predicts it |
//!
//! Units are SI and rad/s; names of public numbers carry them (`inertia_kg_m2`). Angles are positive in one direction
//! of the motor, torques in the same. Functions return the error of their own module; all become [`Error`] by `?`.
//! Nothing is printed, and no file is touched outside [`io`].

#[doc(inline)]
pub use lissom_core::{
    Basis, Matrix, Threshold, ThresholdValue, arm, beam, drive, identify, information, load, lti,
    plan, record, replay, rig, spectrum, thresholds,
};
#[doc(inline)]
pub use lissom_io as io;

mod error;
mod found;
mod identify_campaign;
mod parameter_text;
pub mod prelude;

pub use error::Error;
pub use found::Found;
pub use identify_campaign::Identify;
