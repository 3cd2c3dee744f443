//! What a user should know of a plan.

use std::collections::BTreeMap;
use std::fmt;

use super::known::KnownRig;
use super::sizing::Unfit;
use super::{Candidate, Expected, Figure, PlannedFigure, percent};
use crate::rig::{JointFriction, Rig};

/// Something that a user should know of a plan.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PlanNote {
    /// A wish that the time does not allow.
    Unreached {
        /// What is expected.
        expected: Expected,
        /// The time given \[s\].
        within_s: f64,
        /// Time in which more of the same runs would do \[s\].
        needed_s: f64,
        /// Share of the largest torque, of a friction.
        torque_share: Option<f64>,
    },
    /// Modes that are too fast for the log, or carry too little to be seen.
    LeftOut {
        /// Their frequencies \[rad/s\].
        omega_rad_s: Vec<f64>,
    },
    /// A sensor without steps and noise.
    IdealSensor,
    /// No sine and its triple fits.
    NoPair,
    /// Steady sines alone on a beam that is damped.
    SinesAlone,
    /// Motions of no use.
    Unfit {
        /// Why.
        reason: Unfit,
        /// How many.
        motions: usize,
    },
    /// Friction that is not Coulomb's, or a world at the tip.
    SceneLeftOut,
    /// A load with gravity, for which the standard errors of the regression are planned.
    GravityByRegression,
}

impl PlanNote {
    /// A name for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreached { .. } => "unreached",
            Self::LeftOut { .. } => "modes-left-out",
            Self::IdealSensor => "ideal-sensor",
            Self::NoPair => "no-pair",
            Self::SinesAlone => "sines-alone",
            Self::Unfit { .. } => "motions-of-no-use",
            Self::SceneLeftOut => "scene-left-out",
            Self::GravityByRegression => "gravity-by-regression",
        }
    }

    /// Whether a wish is not met, or what is expected may not come.
    pub fn is_warning(&self) -> bool {
        matches!(self, Self::Unreached { .. } | Self::NoPair | Self::SinesAlone)
    }
}

impl fmt::Display for PlanNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreached { expected, within_s, needed_s, torque_share } => {
                let name = expected.figure.name();
                if expected.std >= 1.0 {
                    write!(f, "{name}: not to be found within {within_s} s by any motion tried")?;
                } else {
                    write!(
                        f,
                        "{name}: {} at best within {within_s} s, {} was wanted; it would take about {}",
                        percent(expected.std),
                        percent(expected.wanted),
                        duration(*needed_s)
                    )?;
                }
                let Some(share) = torque_share else { return Ok(()) };
                let where_at = match expected.figure {
                    PlannedFigure::Arm(Figure::Viscous) => " at the highest speed",
                    _ => "",
                };
                write!(f, "; it is {} of the largest torque{where_at}", percent(*share))
            }
            Self::LeftOut { omega_rad_s } => {
                let all: Vec<String> = omega_rad_s.iter().map(|w| format!("{w:.4}")).collect();
                write!(
                    f,
                    "modes taken to turn with the motor, too fast for the log or too light: {} rad/s",
                    all.join(", ")
                )
            }
            Self::IdealSensor => write!(
                f,
                "a sensor has neither steps nor noise: it is taken to be off by 1e-6 rad; give \
                 motor_sensor and tip_sensors in [rig]"
            ),
            Self::NoPair => write!(
                f,
                "no sine with its triple fits: the third-harmonic method will have no figure"
            ),
            Self::SinesAlone => write!(
                f,
                "steady sines alone hardly show which kind of damping a mode has: errors may be many \
                 times the deviations expected; a sweep beside them tells"
            ),
            Self::Unfit { reason, motions } => {
                write!(f, "{motions} motions were dropped: they {reason}")
            }
            Self::SceneLeftOut => write!(
                f,
                "planned for Coulomb friction alone and a free tip: rest, ripple, bristles and [tip] \
                 are left out"
            ),
            Self::GravityByRegression => write!(
                f,
                "with a load of gravity the expected standard errors are those of the regression, and may be off by a \
                 factor of up to four; where the output error describes the runs, its own are smaller"
            ),
        }
    }
}

/// Time in words.
fn duration(time_s: f64) -> String {
    match time_s {
        t if t < 180.0 => format!("{t:.0} s"),
        t if t < 3.0 * 3600.0 => format!("{:.0} min", t / 60.0),
        t if t < 100.0 * 3600.0 => format!("{:.0} h", t / 3600.0),
        t => format!("{:.1e} h", t / 3600.0),
    }
}

/// What of the rig is not planned with.
pub(super) fn of_rig(rig: &Rig, known: &KnownRig<'_>) -> Vec<PlanNote> {
    let mut notes = Vec::new();
    let scene = &rig.scene;
    if scene.friction != JointFriction::Arm || !scene.tip.is_empty() || !scene.later.is_empty() {
        notes.push(PlanNote::SceneLeftOut);
    }
    if known.gravity.is_some() {
        notes.push(PlanNote::GravityByRegression);
    }
    if known.ideal_sensor {
        notes.push(PlanNote::IdealSensor);
    }
    if !known.left_out_rad_s.is_empty() {
        notes.push(PlanNote::LeftOut { omega_rad_s: known.left_out_rad_s.clone() });
    }
    notes
}

/// How many sets of motions were of no use, by reason.
pub(super) fn reasons(found: &[Result<Vec<Candidate>, Unfit>]) -> BTreeMap<Unfit, usize> {
    let mut counts = BTreeMap::new();
    for unfit in found.iter().filter_map(|f| f.as_ref().err()) {
        *counts.entry(*unfit).or_insert(0) += 1;
    }
    counts
}

/// The same as notes.
pub(super) fn of_unfit(found: &[Result<Vec<Candidate>, Unfit>]) -> Vec<PlanNote> {
    let note = |(reason, motions)| PlanNote::Unfit { reason, motions };
    reasons(found).into_iter().map(note).collect()
}
