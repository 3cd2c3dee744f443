//! A term of a friction law: its name, its function, and how it is represented in an arm.

use strum::IntoStaticStr;

use crate::drive::Falloff;
use crate::friction::{Root, WithLoad};
use crate::load::GravityLoad;
use crate::replay::{DryTerms, NearRest, Ripple};

/// The speed of a term near rest is found to this share: neighbours tried last are as far apart.
pub(crate) const NEAR_REST_STEP: f64 = 0.05;

/// A term of a friction law in addition to Coulomb friction, one viscous constant and an offset. s = ±1 is the
/// direction of motion, v the velocity and θ the angle.
#[derive(Debug, Clone, Copy, PartialEq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum LawTerm {
    /// `s·D·v`: viscous friction is V + D forward and V − D backward.
    ViscousByDirection,
    /// `s·A_s·e^{−|v|/v_s}` or `s·A_s·e^{−(v/v_s)²}`: friction at rest is CF + A_s (A_s > 0: Stribeck effect).
    NearRest {
        /// v_s \[rad/s\].
        speed: f64,
        /// Exponential or Gaussian.
        falloff: Falloff,
    },
    /// `s·A·√|v|`.
    Root,
    /// `s·(A_1·cos kθ + A_2·sin kθ)`.
    Ripple {
        /// k: phase of the ripple per angle \[rad/rad\], or per length on a linear axis \[1/m\].
        per_angle: f64,
    },
    /// `A_1·cos kθ + A_2·sin kθ`: cogging, or another torque of the position that acts in both directions alike.
    TorqueRipple {
        /// k: phase of the ripple per angle \[rad/rad\], or per length on a linear axis \[1/m\].
        per_angle: f64,
    },
    /// `s·A·|g_s·sin θ + g_c·cos θ|`: friction that grows with the torque of gravity; A is a
    /// coefficient of friction μ \[1\].
    WithLoad {
        /// The load, as estimated by the regression.
        load: GravityLoad,
    },
    /// The command acts later than it is logged; the amplitude is this time \[s\].
    CommandLag,
}

/// What a row holds beside inertia, viscous and dry friction and the tips: `∫w·f` of a function of speed
/// or angle, or what a lag of the command adds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Column {
    /// `∫ẇ·τ`: of a command that acts later.
    Lag,
    /// `e^{−|v|/v_s}` or `e^{−(v/v_s)²}`.
    NearRest(f64, Falloff),
    /// `√|v|`.
    Root,
    /// `|g_s·sin θ + g_c·cos θ|`.
    Load(GravityLoad),
    /// `cos kθ`.
    Cosine(f64),
    /// `sin kθ`.
    Sine(f64),
    /// `θ·(−a·sin kθ + b·cos kθ)`, for (k, a, b): what a·cos kθ + b·sin kθ gains with k.
    Turned(f64, f64, f64),
    /// What a·e^{−|v|/v_s} or a·e^{−(v/v_s)²} gains with v_s, for (v_s, a).
    NearRestGain(f64, Falloff, f64),
    /// `((θ − middle)/half)^power`: position on a travel.
    Position {
        /// Middle of the travel.
        middle: f64,
        /// Half of the travel.
        half: f64,
        /// Power.
        power: i32,
    },
    /// `∫w(θ̇_m − θ̇_i)` of the coupled tip of this number: damping within the beam.
    Rate(usize),
    /// A hat over speed: one at the knot of this number, zero at its neighbours.
    Hat(usize),
}

impl Column {
    /// Its function of speed and angle; zero of what is none.
    pub(super) fn at(self, speed: f64, angle: f64) -> f64 {
        match self {
            Self::NearRest(fall, falloff) => falloff.share(speed / fall),
            Self::Root => Root::growth(speed),
            Self::Load(load) => WithLoad { coefficient: 1.0, load }.load_nm(angle),
            Self::Cosine(k) => (k * angle).cos(),
            Self::Sine(k) => (k * angle).sin(),
            Self::Turned(k, a, b) => {
                let (sin, cos) = (k * angle).sin_cos();
                angle * (b * cos - a * sin)
            }
            Self::NearRestGain(fall, falloff, size) => {
                let ratio = speed / fall;
                let steeper = match falloff {
                    Falloff::Exponential => 1.0,
                    Falloff::Gaussian => 2.0 * ratio,
                };
                size * ratio / fall * steeper * falloff.share(ratio)
            }
            Self::Position { middle, half, power } => ((angle - middle) / half).powi(power),
            Self::Lag | Self::Rate(_) | Self::Hat(_) => 0.0,
        }
    }
}

/// Quantity of a term's scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScaleUnit {
    /// A speed \[rad/s\].
    Speed,
    /// An angle \[rad\].
    Angle,
}

impl LawTerm {
    /// The speed or the frequency of a term that has one; zero of others.
    pub(super) fn scanned(self) -> f64 {
        match self {
            Self::NearRest { speed, .. } => speed,
            Self::Ripple { per_angle } | Self::TorqueRipple { per_angle } => per_angle,
            _ => 0.0,
        }
    }

    /// The same term at another one.
    pub(super) fn with_scanned(self, scanned: f64) -> Self {
        match self {
            Self::NearRest { falloff, .. } => Self::NearRest { speed: scanned, falloff },
            Self::Ripple { .. } => Self::Ripple { per_angle: scanned },
            Self::TorqueRipple { .. } => Self::TorqueRipple { per_angle: scanned },
            other => other,
        }
    }

    /// What the term with these amplitudes gains with it.
    pub(super) fn gain(self, amplitudes: &[f64]) -> Column {
        match (self, amplitudes) {
            (Self::NearRest { speed, falloff }, [size, ..]) => {
                Column::NearRestGain(speed, falloff, *size)
            }
            (_, [cosine, sine, ..]) => Column::Turned(self.scanned(), *cosine, *sine),
            _ => Column::Root,
        }
    }

    /// Speed or angle over which the term changes; `None` if it has no scale.
    pub fn scale(self) -> Option<(f64, ScaleUnit)> {
        match self {
            Self::NearRest { speed, .. } => Some((speed, ScaleUnit::Speed)),
            Self::Ripple { per_angle } | Self::TorqueRipple { per_angle } => {
                Some((std::f64::consts::TAU / per_angle, ScaleUnit::Angle))
            }
            Self::ViscousByDirection | Self::Root | Self::WithLoad { .. } | Self::CommandLag => {
                None
            }
        }
    }

    /// Name in results.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Friction against the motion at a speed in a direction (+1 or −1), where its amplitude is `amplitude`; of what is
    /// no function of speed nothing.
    pub(super) fn at_speed(self, amplitude: f64, speed: f64, direction: f64) -> f64 {
        match self {
            Self::ViscousByDirection => direction * amplitude * speed,
            Self::NearRest { speed: fall, falloff } => amplitude * falloff.share(speed / fall),
            Self::Root => amplitude * Root::growth(speed),
            Self::CommandLag
            | Self::Ripple { .. }
            | Self::TorqueRipple { .. }
            | Self::WithLoad { .. } => 0.0,
        }
    }

    /// Whether it is a function of speed.
    pub(super) fn is_by_speed(self) -> bool {
        matches!(self, Self::ViscousByDirection | Self::NearRest { .. } | Self::Root)
    }

    /// Whether an arm's friction has a term of this kind.
    pub(crate) fn is_in(self, terms: &DryTerms) -> bool {
        match self {
            Self::NearRest { .. } => terms.near_rest.is_some(),
            Self::Ripple { .. } => !terms.ripples.is_empty(),
            Self::Root => terms.root.is_some(),
            Self::WithLoad { .. } => terms.with_load.is_some(),
            Self::ViscousByDirection | Self::TorqueRipple { .. } | Self::CommandLag => false,
        }
    }

    /// Gives it to an arm's friction, with its amplitudes; does nothing where it is none of these terms.
    pub(crate) fn put_into(self, terms: &mut DryTerms, amplitude: &[f64]) {
        match self {
            Self::NearRest { speed, falloff } => {
                let [torque_nm, ..] = *amplitude else { return };
                let near = NearRest { torque_nm, offset_nm: 0.0, speed_rad_s: speed, falloff };
                terms.near_rest = Some(near);
            }
            Self::Ripple { per_angle } => {
                let [cosine_nm, sine_nm, ref rate @ ..] = *amplitude else { return };
                let per_rad = rate.first().copied().unwrap_or(per_angle);
                terms.ripples.push(Ripple { per_rad, cosine_nm, sine_nm });
            }
            Self::Root => {
                let [torque_nm_per_root_rad_s, ..] = *amplitude else { return };
                terms.root = Some(Root { torque_nm_per_root_rad_s });
            }
            Self::WithLoad { load } => {
                let [coefficient, ..] = *amplitude else { return };
                terms.with_load = Some(WithLoad { coefficient, load });
            }
            Self::ViscousByDirection | Self::TorqueRipple { .. } | Self::CommandLag => {}
        }
    }
}
