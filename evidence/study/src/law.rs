//! The friction laws of the study.

use std::fmt;

use lissom::drive::{Coulomb, DriveError, DryFriction, Falloff, LuGre};
use lissom::rig::JointFriction;
use serde::{Deserialize, Serialize};

use crate::draw::Draw;

/// How the simulated arm differs from the equations that lissom fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
pub enum Law {
    /// Not at all: one Coulomb constant, dampers at the masses.
    None,
    /// Friction at rest is higher than at speed.
    Stribeck,
    /// Coulomb friction that differs by direction.
    Direction,
    /// Viscous friction that differs by direction.
    ViscousDirection,
    /// Friction that changes with the angle.
    Ripple,
    /// Friction that grows less than in proportion to speed.
    Sublinear,
    /// Bristles, with friction at rest higher than at speed.
    Lugre,
    /// Coulomb friction, and a beam that is damped within itself.
    BeamDamping,
}

impl Law {
    /// Its name on the command line.
    pub(crate) fn option(self) -> String {
        let value = clap::ValueEnum::to_possible_value(&self);
        value.map_or_else(String::new, |v| v.get_name().to_owned())
    }

    /// Whether lissom's simplest equations describe it; an alarm about the law is then false.
    pub fn is_described(self) -> bool {
        matches!(self, Self::None | Self::BeamDamping)
    }

    /// All laws except [`Self::None`].
    pub fn wrong() -> Vec<Self> {
        vec![
            Self::Stribeck,
            Self::Direction,
            Self::ViscousDirection,
            Self::Ripple,
            Self::Sublinear,
            Self::BeamDamping,
            Self::Lugre,
        ]
    }
}

impl fmt::Display for Law {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "Coulomb",
            Self::Stribeck => "Stribeck",
            Self::Direction => "by direction",
            Self::ViscousDirection => "viscous by direction",
            Self::Ripple => "ripple",
            Self::Sublinear => "sub-linear viscous",
            Self::Lugre => "LuGre",
            Self::BeamDamping => "damping in the beam",
        })
    }
}

/// Relative tolerance of a step of the bristles. Errors of 300 samples add up to about 15 times as much, which is far
/// below the errors of an identified arm.
const BRISTLE_TOLERANCE: f64 = 1e-8;

/// The joint of a law: Coulomb friction of the arm, and the friction that is simulated instead of it.
///
/// `coulomb_nm` is the friction at speed, `speed_rad_s` a speed at which the campaign works.
pub(crate) fn joint(
    law: Law,
    draw: &mut Draw,
    (coulomb_nm, viscous_nm_s_per_rad, inertia_kg_m2): (f64, f64, f64),
    speed_rad_s: f64,
) -> Result<(Coulomb, JointFriction), DriveError> {
    let sliding = Coulomb::symmetric(coulomb_nm)?;
    let times = |factor: f64| Coulomb::symmetric(factor * coulomb_nm);
    let friction = match law {
        Law::None | Law::BeamDamping => JointFriction::Arm,
        Law::Direction => {
            let apart = draw.decade(0.05, 0.3);
            let by = Coulomb::by_direction(coulomb_nm * (1.0 + apart), coulomb_nm * (1.0 - apart))?;
            return Ok((by, JointFriction::Arm));
        }
        Law::ViscousDirection => {
            let apart = viscous_nm_s_per_rad * draw.decade(0.1, 0.6);
            JointFriction::Dry(DryFriction::from(sliding).with_viscous_apart(apart)?)
        }
        Law::Stribeck => {
            let rest = times(draw.uniform(1.2, 2.0))?;
            let fall = speed_rad_s * draw.decade(0.02, 0.3);
            let law = DryFriction::from(sliding).with_rest(rest, fall, Falloff::Exponential)?;
            JointFriction::Dry(law)
        }
        Law::Ripple => {
            let (share, per_turn) = (draw.uniform(0.05, 0.3), f64::from(draw.whole(4, 30)));
            let phase = draw.uniform(0.0, std::f64::consts::TAU);
            JointFriction::Dry(DryFriction::from(sliding).with_ripple(share, per_turn, phase)?)
        }
        Law::Sublinear => {
            let rest = times(draw.uniform(0.4, 0.8))?;
            let grows = speed_rad_s * draw.decade(0.5, 2.0);
            let law = DryFriction::from(sliding).with_rest(rest, grows, Falloff::Exponential)?;
            JointFriction::Dry(law)
        }
        Law::Lugre => {
            let rest = times(draw.uniform(1.0, 1.5))?;
            // Bristles break away after this angle.
            let breakaway_rad = draw.decade(2e-4, 2e-3);
            let stiffness = coulomb_nm / breakaway_rad;
            let damping = (stiffness * inertia_kg_m2).sqrt();
            let fall = speed_rad_s * draw.decade(0.02, 0.3);
            let law = LuGre::new(stiffness, damping, sliding, rest, fall)?;
            JointFriction::Bristles { law, tolerance: BRISTLE_TOLERANCE }
        }
    };
    Ok((sliding, friction))
}
