//! How friction near rest falls, or grows, to that at speed.

/// How the friction at rest passes into that at speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Falloff {
    /// `e^{−|v|/v_s}`.
    Exponential,
    /// `e^{−(v/v_s)²}`.
    Gaussian,
}

impl Falloff {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Exponential => "exponential",
            Self::Gaussian => "gaussian",
        }
    }

    /// What of the difference is left at `speed_ratio` = |v|/v_s.
    pub fn share(self, speed_ratio: f64) -> f64 {
        match self {
            Self::Exponential => (-speed_ratio).exp(),
            Self::Gaussian => (-speed_ratio * speed_ratio).exp(),
        }
    }
}
