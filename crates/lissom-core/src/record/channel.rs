//! The channels of a campaign: what each one is, and what is known of it.

use strum::IntoStaticStr;

/// Kind of axis; it decides the units of all parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Axis {
    /// Angles in rad, torques in N·m, inertia in kg·m².
    Rotary,
    /// Positions in m, forces in N, mass in kg.
    Linear,
}

impl Axis {
    /// Name in texts and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Quantity of the drive's command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CommandQuantity {
    /// Motor current \[A\].
    Current,
    /// Motor or drive voltage \[V\].
    Voltage,
    /// Position goal minus angle of a servo \[rad or m\]; its torque constant is the position gain.
    PositionError,
    /// Torque \[N·m\], or force \[N\] on a linear axis.
    Effort,
    /// A number of unknown unit (PWM counts, percent). Parameters are then per unit of command.
    Arbitrary,
}

/// How a logged signal behaves between its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hold {
    /// A value that the controller wrote: sample `k` acts over the whole interval from `t[k]`
    /// to `t[k+1]` (zero-order hold).
    Sampled,
    /// A measurement at `t[k]`; the signal is smooth between samples.
    Measured,
}

impl Hold {
    /// The angle that a servo compares with its goal in step `k`: the mean over the step where the goal is held, because the
    /// servo continues to measure.
    pub fn acting(self, angle: &[f64], k: usize) -> f64 {
        match self {
            Self::Sampled => f64::midpoint(angle[k], angle[(k + 1).min(angle.len() - 1)]),
            Self::Measured => angle[k],
        }
    }
}

/// The command channel of the drive, and what is known of it.
///
/// The torque (or force) on the motor is `τ = k·u − b·θ̇_m`, with the logged command `u`, the torque constant `k`
/// ([`torque_per_command`](Self::torque_per_command)) and the damping by back-EMF `b`
/// ([`back_emf_viscous`](Self::back_emf_viscous)).
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// Quantity of the command.
    pub quantity: CommandQuantity,
    /// How the command acts between samples.
    pub hold: Hold,
    /// Torque constant \[N·m/A, N·m/V, N/A or N/V, by [`quantity`](Self::quantity) and [`Axis`]\]; for a voltage at a
    /// winding of resistance R it is K/R. `None` if it is unknown: parameters are then per unit of command.
    pub torque_per_command: Option<f64>,
    /// Damping by back-EMF, K·K_e/R \[N·m·s/rad or N·s/m\]; 0 for a current.
    pub back_emf_viscous: f64,
    /// Magnitude at which the drive saturates, in the unit of the command, if it is known.
    pub limit: Option<f64>,
}

impl Command {
    /// Torque (or force) per unit of command: the torque constant, or 1 if it is unknown.
    pub fn torque_per_unit(&self) -> f64 {
        self.torque_per_command.unwrap_or(1.0)
    }
}

/// Quantity that a tip sensor measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum TipQuantity {
    /// Angle of the radius to the point in the fixed frame \[rad\], θ_i in the 1989 report.
    Angle,
    /// Angle relative to the motor's line, θ_i − θ_m \[rad\].
    Deflection,
    /// Second time derivative of θ_i \[rad/s²\], or of the point's position on a linear axis \[m/s²\].
    Acceleration,
}

impl TipQuantity {
    /// Name in texts and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A sensor along the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Tip {
    /// Name in results and messages.
    pub name: String,
    /// Quantity that it measures.
    pub quantity: TipQuantity,
    /// Whether its scale is known. If it is not, poles and zeros of its response can still be identified, but not the
    /// gain and the coupling.
    pub calibrated: bool,
}

/// All channels of a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Channels {
    /// Rotary or linear.
    pub axis: Axis,
    /// The command of the drive.
    pub command: Command,
    /// Sensors along the beam, from base to tip; may be empty.
    pub tips: Vec<Tip>,
}
