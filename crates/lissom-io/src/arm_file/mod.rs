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
//! Every key is in `docs/arm.md`.

mod beam;
mod build;
mod material;
#[cfg(test)]
mod tests;

pub use beam::{BeamKind, BeamSpec, SpanSpec};
pub use build::ArmError;

use std::path::Path;

use crate::config::{ConfigError, Source, Table, Value};
use crate::error::Error;
use crate::units::Dimension;

/// What an `arm.toml` says, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArmFile {
    /// The beam.
    pub beam: Option<BeamSpec>,
    /// The motor.
    pub drive: Option<DriveSpec>,
    /// Sampling, limits, sensors and controller.
    pub rig: Option<RigSpec>,
}

/// A motor with friction, referred to the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveSpec {
    /// Inertia \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Viscous friction \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// Torque constant \[N·m/A\].
    pub torque_constant_nm_per_a: f64,
    /// Coulomb friction in forward motion, a magnitude \[N·m\].
    pub coulomb_forward_nm: f64,
    /// Coulomb friction in backward motion, a magnitude \[N·m\].
    pub coulomb_backward_nm: f64,
}

/// A sampled control rig.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigSpec {
    /// Sample time \[s\].
    pub sample_time_s: f64,
    /// Magnitude at which the current saturates \[A\].
    pub current_limit_a: Option<f64>,
    /// The motor's angle sensor.
    pub motor_sensor: Option<SensorSpec>,
    /// The motor's position controller.
    pub controller: Option<ControllerSpec>,
}

/// A sensor that counts equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorSpec {
    /// Bits of a reading.
    pub bits: u32,
    /// Angle over which all readings occur once \[rad\].
    pub range_rad: f64,
}

/// A proportional and derivative controller from angle to current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControllerSpec {
    /// Proportional gain \[A/rad\].
    pub proportional_a_per_rad: f64,
    /// Derivative gain \[A·s/rad\].
    pub derivative_a_s_per_rad: f64,
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
        root.only(&["beam", "drive", "rig"])?;
        Ok(Self {
            beam: root.get("beam").map(|v| beam::beam(&v.table()?)).transpose()?,
            drive: root.get("drive").map(|v| drive(&v.table()?)).transpose()?,
            rig: root.get("rig").map(|v| rig(&v.table()?)).transpose()?,
        })
    }
}

fn drive(table: &Table<'_>) -> Result<DriveSpec, ConfigError> {
    table.only(&["inertia", "viscous", "torque_constant", "coulomb"])?;
    let torque_constant = table.need("torque_constant")?.positive(Dimension::TORQUE_PER_CURRENT)?;
    let viscous = table.get("viscous").map(|v| v.not_negative(Dimension::VISCOUS_ROTARY));
    let (forward, backward) = match table.get("coulomb") {
        Some(value) => coulomb(&value, torque_constant)?,
        None => (0.0, 0.0),
    };
    Ok(DriveSpec {
        inertia_kg_m2: table.need("inertia")?.positive(Dimension::INERTIA)?,
        viscous_nm_s_per_rad: viscous.transpose()?.unwrap_or(0.0),
        torque_constant_nm_per_a: torque_constant,
        coulomb_forward_nm: forward,
        coulomb_backward_nm: backward,
    })
}

fn coulomb(value: &Value<'_>, torque_constant: f64) -> Result<(f64, f64), ConfigError> {
    let torque = |value: &Value<'_>| {
        let (index, size) = value.quantity_of(&[Dimension::TORQUE, Dimension::CURRENT])?;
        if size < 0.0 {
            return Err(value.range(crate::config::Rule::NotNegative));
        }
        Ok(if index == 0 { size } else { size * torque_constant })
    };
    match value.as_table() {
        Some(table) => {
            table.only(&["forward", "backward"])?;
            Ok((torque(&table.need("forward")?)?, torque(&table.need("backward")?)?))
        }
        None => torque(value).map(|both| (both, both)),
    }
}

fn rig(table: &Table<'_>) -> Result<RigSpec, ConfigError> {
    table.only(&["sample_time", "current_limit", "motor_sensor", "controller"])?;
    let limit = table.get("current_limit").map(|v| v.positive(Dimension::CURRENT));
    Ok(RigSpec {
        sample_time_s: table.need("sample_time")?.positive(Dimension::TIME)?,
        current_limit_a: limit.transpose()?,
        motor_sensor: table.get("motor_sensor").map(|v| sensor(&v.table()?)).transpose()?,
        controller: table.get("controller").map(|v| controller(&v.table()?)).transpose()?,
    })
}

fn sensor(table: &Table<'_>) -> Result<SensorSpec, ConfigError> {
    table.only(&["bits", "range"])?;
    let bits = table.need("bits")?.whole(1, 32)?;
    Ok(SensorSpec {
        bits: u32::try_from(bits).unwrap_or(32),
        range_rad: table.need("range")?.positive(Dimension::NUMBER)?,
    })
}

fn controller(table: &Table<'_>) -> Result<ControllerSpec, ConfigError> {
    table.only(&["proportional", "derivative"])?;
    let derivative = table.get("derivative").map(|v| v.quantity(Dimension::TORQUE_PER_VOLTAGE));
    Ok(ControllerSpec {
        proportional_a_per_rad: table.need("proportional")?.quantity(Dimension::CURRENT)?,
        derivative_a_s_per_rad: derivative.transpose()?.unwrap_or(0.0),
    })
}
