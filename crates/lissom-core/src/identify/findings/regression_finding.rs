//! Regression in slip phases: quality of the fit, and effects that the motor's equation does not contain.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, significant, with_error};
use crate::identify::findings::regression_words::{
    DIGITS, hold_assumed, looks_like, moved, moved_by, moved_by_hold, possible, without_mode,
};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::{
    AngleLag, LagShape, MissingKind, MissingTerm, MovingTerm,
};
use crate::identify::methods::regression::GravityPartner;
use crate::identify::methods::regression::{HiddenMode, OtherHold};

/// Regression in slip phases: quality of the fit, and effects that the motor's equation does not contain.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum RegressionFinding {
    /// The regression gives no estimates.
    RegressionRefused {
        /// Residual relative to the windowed torque; `None` if there are too few slip phases.
        residual_share: Option<f64>,
        /// Whether another finding reports the reason.
        explained: bool,
        /// Whether ordinary least squares give the estimates.
        by_least_squares: bool,
    },
    /// There are too few strokes to show how friction varies from one stroke to the next.
    FewPhases {
        /// Slip phases in the fit.
        phases: usize,
        /// The variation that the standard errors include, as a share of Coulomb friction; `None` if the estimates come
        /// from a method that includes none.
        counted: Option<f64>,
    },
    /// Gravity can hardly be separated from another term.
    GravityUnseparated {
        /// The other term.
        with: GravityPartner,
        /// Correlation of the two estimates.
        correlation: f64,
    },
    /// The load's known m·g·l and the given torque constant contradict each other.
    TorqueConstant {
        /// Torque per command from gravity \[N·m per unit of command\].
        by_gravity: Estimate,
        /// Torque per command given in the campaign \[N·m per unit of command\].
        given: f64,
        /// Unit of the command.
        units: EstimateUnits,
    },
    /// The regression does not explain a large part of the torque.
    UnexplainedTorque {
        /// Residual relative to the windowed torque.
        residual_share: f64,
    },
    /// The inertia may be too small, because the residual torque may accelerate the motor.
    InertiaShort {
        /// Error of the inertia in this case, as a share.
        short_by: f64,
    },
    /// All runs are a sine of one frequency.
    OneSine,
    /// The motor's equation lacks a term.
    MissingTerm {
        /// The term, its coefficient and its standard error.
        term: MissingTerm,
        /// Units of the coefficient.
        units: EstimateUnits,
    },
    /// A term that is not known to be absent would change estimates by many of their standard errors.
    PossibleTerm {
        /// The term.
        term: MovingTerm,
    },
    /// The motor's motion shows a flexible mode, which the estimates account for.
    HiddenMode {
        /// The mode.
        mode: HiddenMode,
    },
    /// Friction, or a load, changes from one slip phase to the next.
    FrictionVaries {
        /// Root mean square of the variation, as a share of Coulomb friction.
        by: f64,
    },
    /// The angle lags behind the command.
    AngleLag {
        /// Time and kind of the lag.
        lag: AngleLag,
    },
    /// A tip is read later than the motor, if viscous friction is not negative.
    TipReadLate {
        /// Name of the tip.
        tip: String,
        /// The delay \[s\].
        lag_s: Estimate,
    },
    /// It is not known whether the command is held between its samples, and estimates depend on it.
    HoldAssumed {
        /// What the other one would change.
        other: OtherHold,
        /// Units of the estimates.
        units: EstimateUnits,
    },
}

impl RegressionFinding {
    /// Whether it may be the cause of other findings.
    pub(crate) fn is_cause(&self) -> bool {
        matches!(
            self,
            Self::MissingTerm { .. }
                | Self::HiddenMode { .. }
                | Self::AngleLag { .. }
                | Self::TipReadLate { .. }
                | Self::FrictionVaries { .. }
        )
    }
}

/// A lag in words.
fn lags(f: &mut fmt::Formatter<'_>, lag: &AngleLag) -> fmt::Result {
    write!(
        f,
        "the {} by {} of {} ms ({:.2} samples): with this lag the residual torque is {:.2} times as large. The estimates \
         account for it",
        if lag.time_s < 0.0 {
            "command is logged late and lags behind the angle"
        } else {
            "angle lags behind the command"
        },
        match lag.shape {
            LagShape::Filter => "a first-order filter",
            LagShape::Delay => "a delay",
            LagShape::Either => "a filter or a delay",
        },
        significant(1e3 * lag.time_s.abs(), 2),
        lag.samples.abs(),
        lag.residual_ratio
    )
}

fn few_phases(f: &mut fmt::Formatter<'_>, phases: usize, variation: Option<f64>) -> fmt::Result {
    let strokes = counted(phases, "stroke", "strokes");
    write!(f, "{strokes} cannot show how friction varies from one stroke to the next: ")?;
    match variation {
        None => f.write_str(
            "standard errors include only the variation within a stroke, and may be too small",
        ),
        Some(share) => {
            let percent = 100.0 * share;
            write!(
                f,
                "standard errors include a usual variation of {percent:.0} % of Coulomb friction"
            )
        }
    }
}

impl fmt::Display for RegressionFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RegressionRefused { residual_share, by_least_squares, .. } => {
                match residual_share {
                    Some(share) => write!(
                        f,
                        "{:.0} % of the windowed torque is not explained by the motor's equation",
                        100.0 * share
                    )?,
                    None => f.write_str("too few slip phases are long enough for a window")?,
                }
                f.write_str(": the regression gives no estimates")?;
                if *by_least_squares {
                    f.write_str(
                        ". Those of ordinary least squares may be wrong by many of their standard errors, which count only noise",
                    )?;
                }
                Ok(())
            }
            Self::FewPhases { phases, counted } => few_phases(f, *phases, *counted),
            Self::GravityUnseparated { with, correlation } => write!(
                f,
                "these runs hardly separate gravity from {} (correlation {correlation:.2}): both are uncertain",
                match with {
                    GravityPartner::Inertia => "inertia",
                    GravityPartner::Offset => "a constant load",
                }
            ),
            Self::TorqueConstant { by_gravity, given, units } => write!(
                f,
                "the known m·g·l of the load gives a torque constant of {} N·m per {}, but the campaign gives {}: all \
                 estimates in N·m use the value of the campaign",
                with_error(*by_gravity),
                units.command(),
                significant(*given, DIGITS)
            ),
            Self::UnexplainedTorque { residual_share } => write!(
                f,
                "{:.0} % of the windowed torque is not explained by the motor's equation: errors of the estimates may be \
                 larger than their standard errors",
                100.0 * residual_share
            ),
            Self::InertiaShort { short_by } => write!(
                f,
                "inertia is up to {:.0} % too small if the residual torque is friction that wanders, because it then \
                 accelerates the motor as the command does",
                100.0 * short_by
            ),
            Self::OneSine => f.write_str(
                "all runs are a sine of one frequency: only the harmonics due to friction separate motor and beam, and \
                 systematic errors repeat in every period. Errors of the estimates may be larger than their standard \
                 errors",
            ),
            Self::MissingTerm { term, units } => write!(
                f,
                "it looks as if {} (blocks that were left out are predicted better by {:.0} standard errors; with this term the \
                 residual torque is {:.2} times as large). The model has no such term: {}",
                looks_like(term, *units),
                term.standard_errors,
                term.residual_ratio,
                moved_by(term)
            ),
            Self::PossibleTerm { term } => f.write_str(&possible(term)),
            Self::HiddenMode { mode } => write!(
                f,
                "no tip whose angle is known is measured, but the motor's motion shows a flexible mode at {} Hz (motor \
                 clamped) with a damping ratio of {}. {} % of the inertia is on the motor's side of the spring. The \
                 estimates account for the mode, and the inertia given is the total. {}",
                significant(mode.omega_rad_s.value / std::f64::consts::TAU, DIGITS),
                significant(mode.damping_ratio.value, 2),
                significant(100.0 * mode.inertia_share.value, 2),
                without_mode(mode)
            ),
            Self::HoldAssumed { other, units } => f.write_str(&hold_assumed(other, *units)),
            Self::FrictionVaries { by } => write!(
                f,
                "friction, or a load, changes from one slip phase to the next by {} % of Coulomb friction (rms). The \
                 estimates are means over the logs, and their standard errors include this variation",
                significant(100.0 * by, 2)
            ),
            Self::AngleLag { lag } => lags(f, lag),
            Self::TipReadLate { tip, lag_s } => write!(
                f,
                "tip {tip} is read {} ms later than the motor, if nothing but load and spring moves it; with its readings as they \
                 are logged viscous friction is negative. The estimates account for it, the measured frequency responses do not",
                with_error(lag_s.scaled(1e3))
            ),
        }
    }
}

impl Describe for RegressionFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        match self {
            Self::RegressionRefused { .. } => Severity::Refusal,
            Self::HiddenMode { .. }
            | Self::PossibleTerm { .. }
            | Self::FrictionVaries { .. }
            | Self::FewPhases { counted: Some(_), .. } => Severity::Info,
            Self::FewPhases { .. }
            | Self::GravityUnseparated { .. }
            | Self::TorqueConstant { .. }
            | Self::UnexplainedTorque { .. }
            | Self::InertiaShort { .. }
            | Self::OneSine
            | Self::MissingTerm { .. }
            | Self::AngleLag { .. }
            | Self::TipReadLate { .. }
            | Self::HoldAssumed { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::RegressionRefused { .. }
            | Self::FewPhases { .. }
            | Self::TorqueConstant { .. }
            | Self::UnexplainedTorque { .. }
            | Self::AngleLag { .. } => {
                let joint = [key::COULOMB, key::OFFSET, key::VISCOUS, key::INERTIA];
                [&joint[..], &[key::GRAVITY, key::COUPLING]].concat()
            }
            Self::TipReadLate { .. } => vec![key::VISCOUS, key::TIP_RESPONSES],
            // A load may be most of the torque: it moves all.
            Self::MissingTerm { term, .. } if term.kind == MissingKind::Gravity => {
                vec![key::COULOMB, key::OFFSET, key::VISCOUS, key::INERTIA]
            }
            Self::MissingTerm { term, .. } => {
                let mut keys: Vec<_> =
                    moved(&term.moves).into_iter().map(|(_, key, _)| key).collect();
                keys.extend([key::OFFSET, key::GRAVITY, key::COUPLING]);
                keys.extend((term.kind == MissingKind::BeamDamping).then_some(key::MODES));
                keys
            }
            Self::FrictionVaries { .. } => vec![key::COULOMB, key::VISCOUS],
            Self::PossibleTerm { term } => {
                moved(&term.moves).into_iter().map(|(_, key, _)| key).collect()
            }
            Self::HiddenMode { mode } => {
                moved(&mode.moves).into_iter().map(|(_, key, _)| key).collect()
            }
            Self::GravityUnseparated { with: GravityPartner::Inertia, .. } => {
                vec![key::INERTIA, key::GRAVITY]
            }
            Self::GravityUnseparated { with: GravityPartner::Offset, .. } => {
                vec![key::COULOMB, key::OFFSET, key::GRAVITY]
            }
            Self::InertiaShort { .. } => vec![key::INERTIA],
            Self::HoldAssumed { other, units } => {
                moved_by_hold(other, *units).into_iter().map(|(key, _)| key).collect()
            }
            Self::OneSine => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES]
            }
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::RegressionRefused { explained: true, .. } => {
                "first add the missing term that another finding reports"
            }
            Self::RegressionRefused { .. } => {
                "use longer moves in both directions at a measured current, with more samples in each; measure the tip of a flexible beam; check \
                 columns, units and signs"
            }
            Self::FewPhases { .. } => "log four strokes or more in each direction",
            Self::GravityUnseparated { with: GravityPartner::Inertia, .. } => {
                "move over a larger angle, or at other frequencies: the torque of inertia grows with the square of the \
                 frequency, that of gravity does not"
            }
            Self::GravityUnseparated { with: GravityPartner::Offset, .. } => {
                "move over a longer arc: over a short one gravity is nearly constant"
            }
            Self::TorqueConstant { .. } => {
                "check both values, and gear_ratio; if you leave out torque_constant, the load gives it"
            }
            Self::UnexplainedTorque { .. } => {
                "check units and signs; look for a delay, a load, other friction, or a flexible mode without a tip"
            }
            Self::InertiaShort { .. } => {
                "accelerate more: faster and larger moves, under control of position or speed"
            }
            Self::OneSine => "use the output-error method, or add a run at another frequency",
            Self::PossibleTerm { .. } => {
                "log motion that separates the two: other speeds, other accelerations, both directions, more of the travel"
            }
            Self::MissingTerm { term, .. } => match term.kind {
                MissingKind::Gravity => "add [load] gravity = true to the campaign",
                MissingKind::Position => {
                    "look for gravity, a spring, cogging, a wrong scale of a tip, or a position loop between the logged command \
                     and the motor"
                }
                MissingKind::BeamDamping => {
                    "use the output-error method: it identifies damping within the beam"
                }
                MissingKind::CommandBySign => {
                    "the cause may be an amplifier that is stronger in one direction, or a current sensor with two gains: log \
                     the current itself, and calibrate it in both directions"
                }
                MissingKind::WithTorque => {
                    "a gear's friction may grow with the torque that it carries: compare results only at similar loads"
                }
                MissingKind::OverTravel => {
                    "the estimates are means over the travel: identify parts of it separately, or look for a bent or worn part"
                }
                MissingKind::CoulombDrift => {
                    "the joint may have warmed up, worn or been lubricated: warm it up first, or identify the runs separately"
                }
                MissingKind::ViscousDrift => {
                    "the joint may have warmed up: warm it up first, or identify the runs separately"
                }
            },
            Self::HiddenMode { .. } => {
                "to see how the flexible part moves, measure the angle behind it as a tip"
            }
            Self::FrictionVaries { .. } => {
                "nothing to do for the estimates; a simulation with constant friction departs from the log by this amount. \
                 Warm up the joint, or log for longer, to see whether friction settles"
            }
            Self::AngleLag { lag } if lag.is_half_a_sample() => {
                "half a sample is the difference between a held and a measured command: check `hold`"
            }
            Self::AngleLag { lag } if lag.time_s < 0.0 => {
                "log the current before it is filtered; near reversals friction may differ from the estimates by more than \
                 their standard errors"
            }
            Self::AngleLag { .. } => {
                "log the angle before the drive filters it; near reversals friction may differ from the estimates by more than \
                 their standard errors"
            }
            Self::TipReadLate { .. } => {
                "check for a delay of the bus, camera or filter of this tip. If there is none, the load is damped against the frame, \
                 and viscous friction is that of both sides"
            }
            Self::HoldAssumed { .. } => {
                "say how the command was logged: hold = \"sampled\" for a value that the controller sets and holds, hold = \
                 \"measured\" for that of a sensor"
            }
        }
    }
}
