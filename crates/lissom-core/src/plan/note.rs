//! Notes of a plan: wishes that are not met, and what the plan does not contain.

use std::collections::BTreeMap;
use std::fmt;
use strum::IntoStaticStr;

use super::known::KnownRig;
use super::sizing::Unfit;
use super::{ArmParameter, Candidate, Expected, PlannedParameter, percent};
use crate::rig::{JointFriction, Rig};

/// A note of a plan.
#[derive(Debug, Clone, PartialEq, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum PlanNote {
    /// A requested precision that is not reached within the time.
    Unreached {
        /// The parameter, with the expected and the requested precision.
        expected: Expected,
        /// Time allowed \[s\].
        within_s: f64,
        /// Time in which more of the same runs would reach the precision \[s\].
        needed_s: f64,
        /// For friction and gravity: its torque relative to the largest torque.
        torque_share: Option<f64>,
    },
    /// Modes that are not planned for, because they are too fast for the log or act too little on the motor.
    #[strum(serialize = "modes-left-out")]
    LeftOut {
        /// Their frequencies \[rad/s\].
        omega_rad_s: Vec<f64>,
    },
    /// A sensor has neither steps nor noise.
    IdealSensor,
    /// The log contains a measured current, whose noise the plan does not include.
    CurrentNoise,
    /// No pair of sines at a frequency and three times that frequency is in the plan.
    NoPair,
    /// The plan for a damped beam contains only steady sines.
    SinesAlone,
    /// Motions that were dropped.
    #[strum(serialize = "motions-of-no-use")]
    Unfit {
        /// The reason.
        reason: Unfit,
        /// Number of motions.
        motions: usize,
    },
    /// The rig has further friction terms, or something acts on its tip: the plan does not contain these.
    SceneLeftOut,
    /// Gravity acts on the load: the expected standard errors are those of the regression.
    GravityByRegression,
}

impl PlanNote {
    /// Stable name, for programs.
    pub fn code(&self) -> &'static str {
        self.into()
    }

    /// Whether a wish is not met, or an expected standard error may be too small.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            Self::Unreached { .. } | Self::CurrentNoise | Self::NoPair | Self::SinesAlone
        )
    }
}

impl fmt::Display for PlanNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreached { expected, within_s, needed_s, torque_share } => {
                let name = expected.parameter.name();
                if expected.std >= 1.0 {
                    write!(
                        f,
                        "{name} cannot be identified within {within_s} s by any motion tried"
                    )?;
                } else {
                    write!(
                        f,
                        "the standard error of {name} is at best {} within {within_s} s, but {} was requested; that would take \
                         about {}",
                        percent(expected.std),
                        percent(expected.wanted),
                        duration(*needed_s)
                    )?;
                }
                let Some(share) = torque_share else { return Ok(()) };
                let where_at = match expected.parameter {
                    PlannedParameter::Arm(ArmParameter::Viscous) => " at the highest speed",
                    _ => "",
                };
                write!(f, "; its torque is {} of the largest torque{where_at}", percent(*share))
            }
            Self::LeftOut { omega_rad_s } => {
                let all: Vec<String> = omega_rad_s.iter().map(|w| format!("{w:.4}")).collect();
                write!(
                    f,
                    "modes at {} rad/s are too fast for the log, or too light: the plan assumes that they turn with the \
                     motor",
                    all.join(", ")
                )
            }
            Self::IdealSensor => write!(
                f,
                "a sensor has neither steps nor noise: the plan assumes an error of 1 µrad; give motor_sensor and tip_sensors \
                 in [rig]"
            ),
            Self::CurrentNoise => write!(
                f,
                "the noise of the measured current is not in the plan: where it dominates, errors may be many times the \
                 expected standard errors"
            ),
            Self::NoPair => write!(
                f,
                "the plan has no sine together with one at three times its frequency: the third-harmonic method will give no \
                 estimate"
            ),
            Self::SinesAlone => write!(
                f,
                "steady sines alone hardly show which kind of damping a mode has: errors may be many times the expected \
                 standard errors; add a sweep"
            ),
            Self::Unfit { reason, motions } => {
                write!(f, "motions dropped because they {reason}: {motions}")
            }
            Self::SceneLeftOut => write!(
                f,
                "the plan assumes Coulomb and viscous friction only, and a free tip: other terms of friction, torque \
                 ripples and [tip] are not in it"
            ),
            Self::GravityByRegression => write!(
                f,
                "with gravity the expected standard errors are those of the regression, and may be wrong by a factor of up to \
                 four; if the output-error method describes the runs, its standard errors are smaller"
            ),
        }
    }
}

/// A time with its unit.
fn duration(time_s: f64) -> String {
    match time_s {
        t if t < 180.0 => format!("{t:.0} s"),
        t if t < 3.0 * 3600.0 => format!("{:.0} min", t / 60.0),
        t if t < 100.0 * 3600.0 => format!("{:.0} h", t / 3600.0),
        t => format!("{:.1e} h", t / 3600.0),
    }
}

/// Notes about parts of the rig that the plan does not contain or assumes.
pub(super) fn of_rig(rig: &Rig, known: &KnownRig<'_>) -> Vec<PlanNote> {
    let mut notes = Vec::new();
    let scene = &rig.scene;
    let ripples = !scene.torque_ripples.is_empty();
    let tip = !scene.tip.is_empty() || !scene.later.is_empty();
    if scene.friction != JointFriction::Arm || ripples || tip {
        notes.push(PlanNote::SceneLeftOut);
    }
    if known.gravity.is_some() {
        notes.push(PlanNote::GravityByRegression);
    }
    if rig.instruments.current.is_some_and(|current| current.sensor.deviation() > 0.0) {
        notes.push(PlanNote::CurrentNoise);
    }
    if known.ideal_sensor {
        notes.push(PlanNote::IdealSensor);
    }
    if !known.left_out_rad_s.is_empty() {
        notes.push(PlanNote::LeftOut { omega_rad_s: known.left_out_rad_s.clone() });
    }
    notes
}

/// Number of dropped sets of motions, by reason.
pub(super) fn reasons(found: &[Result<Vec<Candidate>, Unfit>]) -> BTreeMap<Unfit, usize> {
    let mut counts = BTreeMap::new();
    for unfit in found.iter().filter_map(|f| f.as_ref().err()) {
        *counts.entry(*unfit).or_insert(0) += 1;
    }
    counts
}

/// Notes about dropped motions.
pub(super) fn of_unfit(found: &[Result<Vec<Candidate>, Unfit>]) -> Vec<PlanNote> {
    let note = |(reason, motions)| PlanNote::Unfit { reason, motions };
    reasons(found).into_iter().map(note).collect()
}
