//! The amplifier: D/A converter, current limit, dead band.

use super::Quantiser;
use crate::rig::RigError;
use crate::rig::error::{not_negative, positive};

/// A current amplifier after a D/A converter.
///
/// The command is the requested current after rounding by the converter and limiting; logs contain the command. The
/// current equals the command except for a dead zone: `i = 0` if `|u| ≤ d`, else `i = u − d·sign u`, with the command u
/// and the width d \[A\].
///
/// ```
/// # use lissom::rig::Amplifier;
/// let amplifier = Amplifier::ideal().with_limit(4.0)?.with_dead_band(0.5)?;
/// assert_eq!(amplifier.command_a(9.0), 4.0);
/// assert_eq!((amplifier.current_a(0.4), amplifier.current_a(-2.0)), (0.0, -1.5));
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 6.1]`: 4.12 A, 12 bits. The source has no dead zone; this one is usual in control engineering
/// and continuous at its edges.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Amplifier {
    limit_a: Option<f64>,
    dead_band_a: Option<f64>,
    converter: Option<Quantiser>,
}

impl Amplifier {
    /// An amplifier without limit, converter and dead zone.
    pub fn ideal() -> Self {
        Self::default()
    }

    /// Limits the magnitude of the current \[A\].
    ///
    /// # Errors
    /// [`RigError::NotPositive`] if the limit is not positive and finite.
    pub fn with_limit(mut self, limit_a: f64) -> Result<Self, RigError> {
        self.limit_a = Some(positive("limit_a", limit_a)?);
        Ok(self)
    }

    /// Adds a dead zone: commands up to `dead_band_a` \[A\] give no current.
    ///
    /// # Errors
    /// [`RigError::Negative`] if it is negative or not finite.
    pub fn with_dead_band(mut self, dead_band_a: f64) -> Result<Self, RigError> {
        self.dead_band_a = Some(not_negative("dead_band_a", dead_band_a)?);
        Ok(self)
    }

    /// Adds a D/A converter before the amplifier; its range is in A.
    #[must_use]
    pub fn with_converter(mut self, converter: Quantiser) -> Self {
        self.converter = Some(converter);
        self
    }

    /// Limit of the current \[A\], if there is one.
    pub fn limit_a(&self) -> Option<f64> {
        self.limit_a
    }
    /// Width of the dead zone \[A\], if there is one.
    pub fn dead_band_a(&self) -> Option<f64> {
        self.dead_band_a
    }
    /// D/A converter, if there is one.
    pub fn converter(&self) -> Option<Quantiser> {
        self.converter
    }

    /// Largest magnitude of a command that is possible in both directions \[A\]; infinite without a limit.
    pub fn most_a(&self) -> f64 {
        let limit = self.limit_a.unwrap_or(f64::INFINITY);
        self.converter.map_or(limit, |c| limit.min(c.ends().1))
    }

    /// Command after rounding and limiting \[A\].
    pub fn command_a(&self, demand_a: f64) -> f64 {
        let converted = self.converter.map_or(demand_a, |c| c.read(demand_a));
        self.limit_a.map_or(converted, |limit| converted.clamp(-limit, limit))
    }

    /// Current of the motor under a command \[A\].
    pub fn current_a(&self, command_a: f64) -> f64 {
        match self.dead_band_a {
            None => command_a,
            Some(d) if command_a.abs() <= d => 0.0,
            Some(d) => command_a - d.copysign(command_a),
        }
    }

    /// Whether a demand is cut off by the limit or by the converter's range.
    pub(in crate::rig) fn limits(&self, demand_a: f64) -> bool {
        self.limit_a.is_some_and(|limit| demand_a.abs() > limit)
            || self.converter.is_some_and(|c| c.exceeded(demand_a))
    }
}
