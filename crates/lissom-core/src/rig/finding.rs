//! Findings about a simulated experiment that its log alone does not show.

use std::fmt;

use strum::IntoStaticStr;

/// Place of a sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SensorPlace {
    /// At the motor.
    Motor,
    /// At a mass of the beam; masses are counted from 0 at the base.
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
#[derive(Debug, Clone, PartialEq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[non_exhaustive]
pub enum RigFinding {
    /// The log began before the transient had decayed.
    NotSettled {
        /// Largest remaining transient \[rad\]; infinite if it cannot be bounded.
        left_rad: f64,
        /// Largest transient allowed \[rad\].
        tolerance_rad: f64,
        /// Waiting time before the log \[s\].
        waited_s: f64,
    },
    /// The amplifier or its converter limited the current.
    CurrentLimited {
        /// Share of the record with limited current \[1\].
        share: f64,
        /// Largest current of the amplifier \[A\].
        limit_a: f64,
        /// Range of the motor's angle relative to that of the reference; `None` if the reference is constant.
        reached: Option<f64>,
    },
    /// The motor stood still during the whole record.
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
        /// Share of the record beyond the range \[1\].
        share: f64,
        /// Lowest and highest angle that it can read \[rad\].
        range_rad: (f64, f64),
    },
    /// The controller acts between two rows of the log, so the logged current was not constant until the next row.
    CurrentBetweenSamples {
        /// Number of samples between two actions of the controller.
        control_every: usize,
        /// Number of samples between two rows of the log.
        log_every: usize,
    },
}

/// `sample`, `3 samples`.
fn samples(count: usize) -> String {
    if count == 1 { "sample".to_owned() } else { format!("{count} samples") }
}

/// Three digits without an exponent.
fn plain(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

impl RigFinding {
    /// Stable name, for programs.
    pub fn code(&self) -> &'static str {
        self.into()
    }
}

impl fmt::Display for RigFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSettled { left_rad, waited_s, .. } if left_rad.is_infinite() => write!(
                f,
                "the transient had not decayed after {waited_s:.1} s, and its remaining size is not known (no damping, or too \
                 few periods)"
            ),
            Self::NotSettled { left_rad, tolerance_rad, waited_s } => write!(
                f,
                "the transient had not decayed after {waited_s:.1} s: up to {} rad remain, and {} rad were allowed",
                plain(*left_rad),
                plain(*tolerance_rad)
            ),
            Self::CurrentLimited { share, limit_a, reached } => {
                write!(
                    f,
                    "the current was limited to {limit_a} A for {:.2} % of the record",
                    100.0 * share
                )?;
                reached.map_or(Ok(()), |r| {
                    write!(f, "; the motor reached {:.1} % of the requested amplitude", 100.0 * r)
                })
            }
            Self::NeverMoved { torque_nm, coulomb_nm } => write!(
                f,
                "the joint never moved: the largest torque was {} N·m, but friction holds up to {} N·m at rest",
                plain(*torque_nm),
                plain(*coulomb_nm)
            ),
            Self::SensorRange { sensor, share, range_rad: (low, high) } => write!(
                f,
                "the {sensor} sensor was beyond its range of {low:.4} to {high:.4} rad for {:.2} % of the record: the log has \
                 the end of the range there",
                100.0 * share
            ),
            Self::CurrentBetweenSamples { control_every, log_every } => write!(
                f,
                "the controller acts every {}, but the log has a row every {}: the logged current was not constant until \
                 the next row",
                samples(*control_every),
                samples(*log_every)
            ),
        }
    }
}
