//! What an experiment shows that its log alone does not say.

use std::fmt;

/// Where a sensor is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorPlace {
    /// At the motor.
    Motor,
    /// At a mass of the beam, from 0 at the base.
    Tip(usize),
}

impl fmt::Display for SensorPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motor => write!(f, "motor"),
            Self::Tip(mass) => write!(f, "tip {}", mass + 1),
        }
    }
}

/// Something about a simulated run that its user should know.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RigFinding {
    /// The log began before the transient had gone.
    NotSettled {
        /// What is left of it at most \[rad\]; infinite where nothing bounds it.
        left_rad: f64,
        /// What was asked for \[rad\].
        tolerance_rad: f64,
        /// How long the rig waited \[s\].
        waited_s: f64,
    },
    /// The amplifier or its converter limited the current.
    CurrentLimited {
        /// Part of the record in which it did \[1\].
        share: f64,
        /// The largest current that it gives \[A\].
        limit_a: f64,
        /// The motor's range over the reference's; `None` where the reference has none.
        reached: Option<f64>,
    },
    /// The motor stood still throughout the record.
    NeverMoved {
        /// Largest torque of the motor in the record \[N·m\].
        torque_nm: f64,
        /// Coulomb friction of the direction that has less \[N·m\].
        coulomb_nm: f64,
    },
    /// A sensor was taken beyond its range and read the range's end.
    SensorRange {
        /// Which sensor.
        sensor: SensorPlace,
        /// Part of the record in which it was \[1\].
        share: f64,
        /// Lowest and highest angle that it reads \[rad\].
        range_rad: (f64, f64),
    },
    /// The controller acts between two samples of the log: the logged current was not held from one
    /// to the next.
    CurrentBetweenSamples {
        /// Samples from one action of the controller to the next.
        control_every: usize,
        /// Samples from one row of the log to the next.
        log_every: usize,
    },
}

impl fmt::Display for RigFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSettled { left_rad, waited_s, .. } if left_rad.is_infinite() => write!(
                f,
                "not settled after {waited_s:.1} s: nothing bounds what is left of the transient (no damping, or too few periods)"
            ),
            Self::NotSettled { left_rad, tolerance_rad, waited_s } => write!(
                f,
                "not settled after {waited_s:.1} s: up to {left_rad:.2e} rad of the transient are left, {tolerance_rad:.2e} rad were asked for"
            ),
            Self::CurrentLimited { share, limit_a, reached } => {
                write!(
                    f,
                    "the current was limited to {limit_a} A for {:.2} % of the record",
                    100.0 * share
                )?;
                reached.map_or(Ok(()), |r| {
                    write!(f, "; the motor reached {:.1} % of the amplitude asked for", 100.0 * r)
                })
            }
            Self::NeverMoved { torque_nm, coulomb_nm } => write!(
                f,
                "the joint never moved: the largest torque was {torque_nm:.3e} N·m, friction holds {coulomb_nm:.3e} N·m at rest"
            ),
            Self::SensorRange { sensor, share, range_rad: (low, high) } => write!(
                f,
                "the {sensor} sensor was beyond its range of {low:.4} to {high:.4} rad for {:.2} % of the record",
                100.0 * share
            ),
            Self::CurrentBetweenSamples { control_every, log_every } => write!(
                f,
                "the controller acts every {control_every}. sample and the log holds every {log_every}.: the logged current is not the one held between two rows"
            ),
        }
    }
}
