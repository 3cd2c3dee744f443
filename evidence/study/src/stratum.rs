//! The part of a campaign that is kept while the rest is drawn again.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::draw::Draw;

/// Share of friction in the campaign's peak torque, CF/τ_max \[1\].
pub(crate) const COULOMB_SHARE: (f64, f64) = (0.05, 0.60);
/// The same share when planned: sensors and repeated runs lead to higher peaks.
const PLANNED_SHARE: (f64, f64) = (0.05, 0.80);

/// The kind of runs of a campaign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// Stepped sines, at frequencies and three times these.
    Sines,
    /// Odd multisines.
    Multisines,
    /// Logarithmic sweeps.
    Chirps,
    /// Some of each.
    Mixed,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Sines, Self::Multisines, Self::Chirps, Self::Mixed];
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sines => "stepped sines",
            Self::Multisines => "multisines",
            Self::Chirps => "chirps",
            Self::Mixed => "mixed",
        })
    }
}

/// The properties that a campaign must have.
///
/// A draw outside the ranges is repeated with the same stratum, so that properties with which draws
/// fail often (much friction, coarse encoders) do not become rare.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Stratum {
    /// Masses n, 1 to 3.
    pub masses: usize,
    /// Kind of its runs.
    pub kind: Kind,
    /// Bits over 360° of the motor's encoder, 10 to 16.
    pub motor_bits: u32,
    /// Bits over 360° of each tip's encoder, 10 to 16.
    pub tip_bits: u32,
    /// Sample time \[s\], 1 to 4 ms.
    pub sample_time_s: f64,
    /// CF over the planned peak torque; the share of the logs is lower by about a third.
    pub coulomb_share: f64,
    /// Noise of every sensor before rounding, in its steps; `None`: none.
    pub noise_steps: Option<f64>,
    /// Damping ratio of the beam's first mode, 0.001 to 0.05.
    pub damping_ratio: f64,
}

impl Stratum {
    pub(crate) fn draw(draw: &mut Draw) -> Self {
        Self {
            masses: draw.whole(1, 3) as usize,
            kind: Kind::ALL[draw.whole(0, 3) as usize],
            motor_bits: draw.whole(10, 16),
            tip_bits: draw.whole(10, 16),
            sample_time_s: 0.25e-3 * f64::from(draw.whole(4, 16)),
            coulomb_share: draw.uniform(PLANNED_SHARE.0, PLANNED_SHARE.1),
            noise_steps: draw.chance(0.75).then(|| draw.decade(0.1, 1.0)),
            damping_ratio: draw.decade(0.001, 0.05),
        }
    }

    /// Step of the motor's encoder \[rad\].
    pub(crate) fn motor_step_rad(&self) -> f64 {
        std::f64::consts::TAU / f64::from(1_u32 << self.motor_bits)
    }

    /// The largest change of the motor's reading between two samples while it rests: one step, and four
    /// standard deviations of its noise \[rad\].
    pub(crate) fn motor_jump_rad(&self) -> f64 {
        (1.0 + 4.0 * self.noise_steps.unwrap_or(0.0)) * self.motor_step_rad()
    }
}
