//! A term of a friction law: its name, what it does, and how an arm has it.

use crate::drive::Falloff;
use crate::replay::{DryTerms, NearRest, Ripple};

/// The speed of a term near rest is found to this share: neighbours tried last are as far apart.
pub(crate) const NEAR_REST_STEP: f64 = 0.05;

/// A term beside Coulomb friction, one viscous constant and an offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawTerm {
    /// `s·D·v`: viscous friction V + D forward, V − D backward.
    ViscousByDirection,
    /// `s·A·e^{−|v|/v_s}` or `s·A·e^{−(v/v_s)²}`: friction at rest is C + A (A > 0: Stribeck).
    NearRest {
        /// v_s \[rad/s\].
        speed: f64,
        /// Which of the two.
        falloff: Falloff,
    },
    /// No amplitude of its own: friction that has not grown to its level yet, over so much travel since a
    /// reversal (presliding), is left out.
    AfterTravel {
        /// That travel \[rad\].
        travel: f64,
    },
    /// `s·A·√|v|`.
    Root,
    /// `s·(A_1·cos kθ + A_2·sin kθ)`.
    Ripple {
        /// k, radians of ripple per radian of angle (1/m on linear axes).
        per_angle: f64,
    },
    /// The command acts later than it is logged; its amplitude is that time \[s\].
    CommandLag,
}

impl LawTerm {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::ViscousByDirection => "viscous-by-direction",
            Self::NearRest { .. } => "near-rest",
            Self::AfterTravel { .. } => "after-travel",
            Self::Root => "root",
            Self::Ripple { .. } => "ripple",
            Self::CommandLag => "command-lag",
        }
    }

    /// Friction against the motion at a speed in a direction (+1 or −1), where its amplitude is `amplitude`; of what is
    /// no function of speed nothing.
    pub(super) fn at_speed(self, amplitude: f64, speed: f64, direction: f64) -> f64 {
        match self {
            Self::ViscousByDirection => direction * amplitude * speed,
            Self::NearRest { speed: fall, falloff } => amplitude * falloff.share(speed / fall),
            Self::Root => amplitude * speed.sqrt(),
            Self::CommandLag | Self::Ripple { .. } | Self::AfterTravel { .. } => 0.0,
        }
    }

    /// Whether it is a function of speed.
    pub(super) fn is_by_speed(self) -> bool {
        !matches!(self, Self::CommandLag | Self::Ripple { .. })
    }

    /// Whether an arm can have it. One that has friction near rest has it with an exponential.
    pub(super) fn is_of_arms(self) -> bool {
        match self {
            Self::Root | Self::AfterTravel { .. } => false,
            Self::NearRest { falloff, .. } => falloff == Falloff::Exponential,
            _ => true,
        }
    }

    /// Amplitudes with which it does nothing.
    pub(crate) fn without_effect(self) -> &'static [f64] {
        match self {
            Self::Ripple { .. } => &[0.0; 2],
            _ => &[0.0],
        }
    }

    /// Gives it to an arm's friction, with its amplitudes; does nothing where it is none of these terms.
    pub(crate) fn put_into(self, terms: &mut DryTerms, amplitude: &[f64]) {
        match (self, amplitude) {
            (Self::NearRest { speed, falloff }, [torque_nm]) => {
                let torque_nm = *torque_nm;
                let near = NearRest { torque_nm, offset_nm: 0.0, speed_rad_s: speed, falloff };
                terms.near_rest = Some(near);
            }
            (Self::Ripple { per_angle }, [cosine_nm, sine_nm, ..]) => {
                let (cosine_nm, sine_nm) = (*cosine_nm, *sine_nm);
                terms.ripples.push(Ripple { per_rad: per_angle, cosine_nm, sine_nm });
            }
            _ => {}
        }
    }

    pub(super) fn is_near_rest(self) -> bool {
        matches!(self, Self::NearRest { .. })
    }

    pub(super) fn is_ripple(self) -> bool {
        matches!(self, Self::Ripple { .. })
    }
}
