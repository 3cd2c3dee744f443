//! How friction passes from its value at rest to that at speed.

use strum::IntoStaticStr;

/// How friction passes from its value at rest to its value at high speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Falloff {
    /// `e^{−|v|/v_s}`.
    Exponential,
    /// `e^{−(v/v_s)²}`.
    Gaussian,
}

impl Falloff {
    /// Name in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Share of the difference that remains at `speed_ratio` = |v|/v_s: 1 at rest, 0 at high speed.
    pub fn share(self, speed_ratio: f64) -> f64 {
        match self {
            Self::Exponential => (-speed_ratio).exp(),
            Self::Gaussian => (-speed_ratio * speed_ratio).exp(),
        }
    }
}
