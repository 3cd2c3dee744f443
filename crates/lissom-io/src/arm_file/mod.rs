//! `arm.toml`: an arm's beam, drive and rig in the units of a drawing or data sheet.
//!
//! ```toml
//! [beam]
//! young_modulus = "30e6 psi"                # with section; or flexural_rigidity = "0.00443 N*m^2"
//! section = { round = "0.032 in" }          # or { rectangle = ["25.4 mm", "0.8 mm"] }: width,
//!                                           # thickness in bending
//! spans = [{ length = "7 in", mass = "0.121 lb" }]
//! [drive]
//! inertia = "0.005529 lbf*in*s^2"
//! viscous = "0.01216 lbf*in*s/rad"          # absent: none
//! torque_constant = "2.184 lbf*in/A"
//! coulomb = "0.132 A"                       # current or torque, or { forward, backward }; absent: none
//! [rig]
//! sample_time = "3 ms"
//! current_limit = "4.12 A"                  # absent: none
//! motor_sensor = { bits = 12, range = "360 deg" }
//! controller = { proportional = "9 A/rad", derivative = "0.2 A*s/rad" }
//! [tip]                                     # what acts on the tip; absent: nothing
//! viscous = "0.003 N*s/m"
//! ```
//!
//! A bare number is in SI; for `damping` of a span in N·s/m, for `coulomb` in N·m.
//!
//! Each span may have its own `young_modulus`, `section` or `flexural_rigidity`, `damping` at the
//! mass at its end (N·s/m, or N·s/rad as the report's ν) and `count`, which repeats it. The last
//! may have `inertia`. The beam may begin at a hub's rim, carry a payload, be damped as a whole,
//! and have its mass along its length:
//!
//! ```toml
//! [beam]
//! young_modulus = "200 GPa"
//! section = { rectangle = ["25 mm", "2 mm"] }
//! density = "7850 kg/m^3"                   # or mass_per_length = "0.39 kg/m"; also per span
//! hub_radius = "20 mm"
//! spans = [{ length = "100 mm", count = 5 }]  # a point mass at each end is optional now
//! payload = { mass = "0.2 kg", inertia = "1e-4 kg*m^2", offset = "30 mm" }
//! damping = { mass_proportional = "0.1 1/s", stiffness_proportional = "1e-4 s" }
//!                                           # or { ratio = 0.01 }, { ratios = [0.01, 0.02] }
//! ```
//!
//! A beam whose dimensions nobody knows may be given by its modes, as many as points:
//!
//! ```toml
//! [beam]
//! modes = [{ frequency = "6.8 Hz", damping_ratio = 0.004, coupling = "0.5 N*m", gains = [1] }]
//! ```
//!
//! Every key is in `docs/arm.md`.

mod beam;
mod build;
mod build_rig;
mod drive;
mod material;
mod modes;
mod rig;
#[cfg(test)]
mod tests;
mod tip;

pub use beam::{BeamKind, BeamSpec, SpanSpec};
pub use build::ArmError;
pub use drive::{BristlesSpec, DriveSpec, RestSpec, RippleSpec};
pub use rig::{ControllerSpec, ConverterSpec, IntegerSpec, RigSpec, SensorSpec, SensorSteps};
pub(crate) use tip::omega;
pub use tip::{SignalSpec, TipSpec};

use std::path::Path;

use lissom::beam::KnownMode;

use crate::config::{ConfigError, Source};
use crate::error::Error;

/// What an `arm.toml` says, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArmFile {
    /// The beam, by its spans.
    pub beam: Option<BeamSpec>,
    /// The beam, by its modes, in place of that.
    pub modes: Option<Vec<KnownMode>>,
    /// The motor.
    pub drive: Option<DriveSpec>,
    /// The world at the tip.
    pub tip: Option<TipSpec>,
    /// Sampling, limits, sensors and controller.
    pub rig: Option<RigSpec>,
}

impl ArmFile {
    /// Reads an `arm.toml`.
    ///
    /// # Errors
    /// [`Error::Config`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        Ok(Self::from_source(&Source::read(path)?)?)
    }

    /// Reads the text of an `arm.toml`; `path` stands in errors.
    ///
    /// ```
    /// let text = "[rig]\nsample_time = \"3 ms\"";
    /// let arm = lissom_io::ArmFile::from_text("arm.toml".as_ref(), text)?;
    /// assert_eq!(arm.rig.map(|rig| rig.sample_time_s), Some(0.003));
    /// # Ok::<(), lissom_io::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Config`].
    pub fn from_text(path: &Path, text: &str) -> Result<Self, Error> {
        Ok(Self::from_source(&Source::new(path, text.to_owned()))?)
    }

    fn from_source(source: &Source) -> Result<Self, ConfigError> {
        let document = source.parse()?;
        let root = source.root(&document);
        root.only(&["beam", "drive", "tip", "rig"])?;
        let table = root.get("beam").map(|v| v.table()).transpose()?;
        let (by_modes, by_spans) = match table {
            Some(table) if table.get("modes").is_some() => (Some(table), None),
            other => (None, other),
        };
        Ok(Self {
            beam: by_spans.map(|t| beam::beam(&t)).transpose()?,
            modes: by_modes.map(|t| modes::modes(&t)).transpose()?,
            drive: root.get("drive").map(|v| drive::drive(&v.table()?)).transpose()?,
            tip: root.get("tip").map(|v| tip::tip(&v.table()?)).transpose()?,
            rig: root.get("rig").map(|v| rig::rig(&v.table()?)).transpose()?,
        })
    }
}
