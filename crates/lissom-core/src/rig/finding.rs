//! Findings about a simulated run, which its log alone does not show.

use std::fmt;

/// Place of a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorPlace {
    /// At the motor.
    Motor,
    /// At a mass of the beam, counted from 0 at the base.
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

/// A finding about a simulated run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RigFinding {
    /// The log began before the transient had decayed.
    NotSettled {
        /// Bound on the remaining transient \[rad\]; infinite if there is no bound.
        left_rad: f64,
        /// Tolerance that was requested \[rad\].
        tolerance_rad: f64,
        /// Time that the rig waited \[s\].
        waited_s: f64,
    },
    /// The amplifier or its converter limited the current.
    CurrentLimited {
        /// Share of the record in which it did \[1\].
        share: f64,
        /// Largest current of the amplifier \[A\].
        limit_a: f64,
        /// Travel of the motor over the travel of the reference \[1\]; `None` without a reference for the angle.
        reached: Option<f64>,
    },
    /// The motor stood still throughout the record.
    NeverMoved {
        /// Largest torque of the motor in the record \[N·m\].
        torque_nm: f64,
        /// Coulomb friction of the direction that has less \[N·m\].
        coulomb_nm: f64,
    },
    /// A sensor was beyond its range and read the end of the range.
    SensorRange {
        /// The sensor.
        sensor: SensorPlace,
        /// Share of the record in which this happened \[1\].
        share: f64,
        /// Lowest and highest angle that the sensor reads \[rad\].
        range_rad: (f64, f64),
    },
    /// The controller acts between two rows of the log, so the logged current was not constant from row to row.
    CurrentBetweenSamples {
        /// Number of samples from one action of the controller to the next.
        control_every: usize,
        /// Number of samples from one row of the log to the next.
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
