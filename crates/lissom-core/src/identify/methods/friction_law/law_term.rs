//! A term of a friction law: its name, its function, and how it is represented in an arm.

use crate::drive::Falloff;
use crate::identify::methods::friction_law::thresholds::NEAR_REST_MOST;
use crate::load::GravityLoad;
use crate::replay::{DryTerms, NearRest, Ripple};

/// The speed of a term near rest is found to this share: neighbours tried last are as far apart.
pub(crate) const NEAR_REST_STEP: f64 = 0.05;

/// A term of a friction law in addition to Coulomb friction, one viscous constant and an offset. s = ±1 is the
/// direction of motion, v the velocity and θ the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Presliding: friction has not reached its level in the first travel after a reversal, and that travel is left
    /// out. The term has no amplitude.
    AfterTravel {
        /// Travel that is left out \[rad\].
        travel: f64,
    },
    /// `s·A·√|v|`.
    Root,
    /// `s·(A_1·cos kθ + A_2·sin kθ)`.
    Ripple {
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

/// Speeds over which friction near rest may change, as shares of the fastest.
pub(super) const NEAR_REST: [f64; 8] = [0.02, 0.03, 0.05, 0.08, 0.12, 0.2, 0.3, NEAR_REST_MOST];

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
            Self::Root => speed.sqrt(),
            Self::Load(load) => load.torque_nm(angle).abs(),
            Self::Cosine(k) => (k * angle).cos(),
            Self::Sine(k) => (k * angle).sin(),
            Self::Turned(k, a, b) => {
                let (sin, cos) = (k * angle).sin_cos();
                angle * (b * cos - a * sin)
            }
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
    /// The terms that are tried first; ripples are offered when the rest is found. `whole` says whether the travel
    /// after reversals is used: without it the shape near rest shows.
    /// The `load` is gravity's, where it acts.
    pub(super) fn offered(fastest: f64, whole: bool, load: Option<GravityLoad>) -> Vec<Self> {
        let shapes: &[Falloff] = if whole {
            &[Falloff::Exponential]
        } else {
            &[Falloff::Exponential, Falloff::Gaussian]
        };
        let near_rest = shapes.iter().flat_map(|&falloff| {
            NEAR_REST.map(|share| Self::NearRest { speed: share * fastest, falloff })
        });
        [Self::ViscousByDirection, Self::CommandLag, Self::Root]
            .into_iter()
            .chain(load.map(|load| Self::WithLoad { load }))
            .chain(near_rest)
            .collect()
    }

    /// The columns that it needs in addition to those of the motor's equation.
    pub(super) fn columns(self) -> Vec<Column> {
        match self {
            Self::ViscousByDirection | Self::AfterTravel { .. } => Vec::new(),
            Self::NearRest { speed, falloff } => vec![Column::NearRest(speed, falloff)],
            Self::Root => vec![Column::Root],
            Self::WithLoad { load } => vec![Column::Load(load)],
            Self::Ripple { per_angle } => vec![Column::Cosine(per_angle), Column::Sine(per_angle)],
            Self::CommandLag => vec![Column::Lag],
        }
    }

    /// Whether an arm with these terms may get it too.
    pub(crate) fn may_join(self, terms: &DryTerms, ripples_most: usize) -> bool {
        let near = |k: f64, r: &Ripple| (r.per_rad / k).ln().abs() < std::f64::consts::LN_2 / 2.0;
        match self {
            Self::NearRest { speed, .. } => terms.near_rest.is_none() && speed > 0.0,
            Self::Ripple { per_angle } => {
                terms.ripples.len() < ripples_most
                    && !terms.ripples.iter().any(|r| near(per_angle, r))
            }
            Self::ViscousByDirection
            | Self::AfterTravel { .. }
            | Self::Root
            | Self::WithLoad { .. }
            | Self::CommandLag => false,
        }
    }

    /// Speed or angle over which the term changes; `None` if it has no scale.
    pub fn scale(self) -> Option<(f64, ScaleUnit)> {
        match self {
            Self::NearRest { speed, .. } => Some((speed, ScaleUnit::Speed)),
            Self::AfterTravel { travel } => Some((travel, ScaleUnit::Angle)),
            Self::Ripple { per_angle } => {
                Some((std::f64::consts::TAU / per_angle, ScaleUnit::Angle))
            }
            Self::ViscousByDirection | Self::Root | Self::WithLoad { .. } | Self::CommandLag => {
                None
            }
        }
    }

    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::ViscousByDirection => "viscous-by-direction",
            Self::NearRest { .. } => "near-rest",
            Self::AfterTravel { .. } => "after-travel",
            Self::Root => "root",
            Self::WithLoad { .. } => "with-load",
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
            Self::CommandLag
            | Self::Ripple { .. }
            | Self::WithLoad { .. }
            | Self::AfterTravel { .. } => 0.0,
        }
    }

    /// Whether it is a function of speed.
    pub(super) fn is_by_speed(self) -> bool {
        !matches!(self, Self::CommandLag | Self::Ripple { .. } | Self::WithLoad { .. })
    }

    /// Whether an arm can have it. One that has friction near rest has it with an exponential.
    pub(super) fn is_of_arms(self) -> bool {
        match self {
            Self::Root | Self::AfterTravel { .. } | Self::WithLoad { .. } => false,
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
        match self {
            Self::NearRest { speed, falloff } => {
                let [torque_nm, ..] = *amplitude else { return };
                let near = NearRest { torque_nm, offset_nm: 0.0, speed_rad_s: speed, falloff };
                terms.near_rest = Some(near);
            }
            Self::Ripple { per_angle } => {
                let [cosine_nm, sine_nm, ..] = *amplitude else { return };
                terms.ripples.push(Ripple { per_rad: per_angle, cosine_nm, sine_nm });
            }
            Self::ViscousByDirection
            | Self::AfterTravel { .. }
            | Self::Root
            | Self::WithLoad { .. }
            | Self::CommandLag => {}
        }
    }

    pub(super) fn is_near_rest(self) -> bool {
        matches!(self, Self::NearRest { .. })
    }

    pub(super) fn is_ripple(self) -> bool {
        matches!(self, Self::Ripple { .. })
    }
}
