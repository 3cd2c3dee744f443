//! What the channels of a campaign are.

/// Kind of axis: decides the units of every figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Angles in rad, torques in N·m, inertia in kg·m².
    Rotary,
    /// Positions in m, forces in N, mass in kg.
    Linear,
}

/// What the drive's command or measured input is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CommandQuantity {
    /// Motor current \[A\].
    Current,
    /// Motor or drive voltage \[V\].
    Voltage,
    /// A number of unknown unit (PWM counts, percent): figures are then per unit of command.
    Arbitrary,
}

/// What a logged sample says of the signal between samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hold {
    /// Commanded and held: sample `k` acts over the whole interval from `t[k]` to `t[k+1]`.
    Sampled,
    /// Measured at `t[k]`; the signal goes on smoothly between samples.
    Measured,
}

/// The drive's input channel and what is known of it.
///
/// Torque (or force) on the motor: `τ = k·u − b·θ̇_m` with `u` the logged command, `k` the
/// [`torque_per_command`](Self::torque_per_command) and `b` the
/// [`back_emf_viscous`](Self::back_emf_viscous).
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    /// What it is.
    pub quantity: CommandQuantity,
    /// Held command or measurement.
    pub hold: Hold,
    /// Torque constant: N·m/A, N·m/V, N/A or N/V by [`quantity`](Self::quantity) and [`Axis`];
    /// for a voltage with winding resistance R it is K/R. `None` where it is not known:
    /// figures are then per unit of command.
    pub torque_per_command: Option<f64>,
    /// Damping by the back-EMF, K·K_e/R \[N·m·s/rad or N·s/m\]; 0 for a current.
    pub back_emf_viscous: f64,
    /// Magnitude at which the drive saturates, in the command's unit.
    pub limit: Option<f64>,
}

impl Command {
    /// Torque (or force) of one unit of the command: the torque constant, or 1 where it is not known.
    pub fn torque_per_unit(&self) -> f64 {
        self.torque_per_command.unwrap_or(1.0)
    }
}

/// What a tip sensor measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipQuantity {
    /// Angle of the radius to the point, fixed frame: the report's θ_i \[rad\].
    Angle,
    /// Angle from the motor's line: θ_i − θ_m \[rad\].
    Deflection,
    /// Second time derivative of θ_i \[rad/s²\] (or of the point's position, linear axes).
    Acceleration,
}

/// A sensor along the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Tip {
    /// Its name in reports.
    pub name: String,
    /// What it measures.
    pub quantity: TipQuantity,
    /// Whether its scale is known. Without one its poles and zeros can still be found, but not
    /// its gain nor the coupling.
    pub calibrated: bool,
}

/// All channels of a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Channels {
    /// Rotary or linear.
    pub axis: Axis,
    /// The drive's input.
    pub command: Command,
    /// Sensors along the beam, from base to tip; may be empty.
    pub tips: Vec<Tip>,
}
