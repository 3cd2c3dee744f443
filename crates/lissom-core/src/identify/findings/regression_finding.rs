//! Regression in slip phases: what the motor's equation does not explain.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::{counted, later, significant, with_error};
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::regression::missing::{MissingKind, MissingTerm};
use crate::identify::methods::regression::{AngleLag, GravityPartner, LagShape};
use crate::identify::methods::regression::{HiddenMode, Moved};

/// Digits of a coefficient whose standard error is not given.
const DIGITS: usize = 3;
/// Smallest change of an estimate that is reported, in its standard errors.
const FELT: f64 = 1.0;

/// Regression in slip phases: what the motor's equation does not explain.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum RegressionFinding {
    /// The regression gives no estimates.
    RegressionRefused {
        /// Share of the windowed torque that it does not explain; `None` without enough slip phases.
        residual_share: Option<f64>,
        /// Whether another finding says why.
        explained: bool,
    },
    /// Too few reversals to show how friction scatters from one stroke to the next.
    FewPhases {
        /// Slip phases in the fit.
        phases: usize,
        /// The variation that the standard errors count, as a share of Coulomb friction; `None` where the estimates are
        /// of a method that counts none.
        counted: Option<f64>,
    },
    /// Gravity can hardly be told from another term.
    GravityUnseparated {
        /// Which.
        with: GravityPartner,
        /// Correlation of both.
        correlation: f64,
    },
    /// The load's known m·g·l and the given torque constant contradict each other.
    TorqueConstant {
        /// Torque per command by gravity \[N·m per unit of command\].
        by_gravity: Estimate,
        /// The one given.
        given: f64,
        /// Unit of the command.
        units: EstimateUnits,
    },
    /// The regression leaves much of the torque.
    UnexplainedTorque {
        /// Share of the windowed torque.
        residual_share: f64,
    },
    /// The torque left may accelerate the motor.
    InertiaShort {
        /// By what share inertia is too small then.
        short_by: f64,
    },
    /// All runs are a sine of one frequency.
    OneSine,
    /// The motor's equation lacks a term.
    MissingTerm {
        /// The term, its coefficient and how well it is known.
        term: MissingTerm,
        /// Units of the coefficient.
        units: EstimateUnits,
    },
    /// The motor's motion shows a flexible mode, which the estimates account for.
    HiddenMode {
        /// Which.
        mode: HiddenMode,
    },
    /// Friction, or a load, changes from one slip phase to the next.
    FrictionVaries {
        /// By how much, the root of its mean square, as a share of Coulomb friction.
        by: f64,
    },
    /// The angle lags behind the command.
    AngleLag {
        /// By how much, and how.
        lag: AngleLag,
    },
    /// Viscous friction differs by direction.
    ViscousByDirection {
        /// Viscous friction forward.
        forward: Estimate,
        /// Viscous friction backward.
        backward: Estimate,
        /// Share of the torque that one constant leaves.
        residual_share_of_one: f64,
        /// Share of the torque that two constants leave.
        residual_share_of_two: f64,
        /// Offset of friction with two constants.
        offset: Estimate,
        /// Units of these.
        units: EstimateUnits,
    },
}

impl RegressionFinding {
    /// Whether it is a cause that other findings may follow from.
    pub(crate) fn is_cause(&self) -> bool {
        matches!(
            self,
            Self::MissingTerm { .. }
                | Self::HiddenMode { .. }
                | Self::AngleLag { .. }
                | Self::FrictionVaries { .. }
        )
    }
}

/// What the data look like when a term is missing, with its coefficient.
fn looks_like(term: &MissingTerm, units: EstimateUnits) -> String {
    let size = significant(term.value.abs(), DIGITS);
    let grows = if term.value < 0.0 { "falls" } else { "grows" };
    match term.kind {
        MissingKind::Delay => format!(
            "the command acts {} ms {} than it is logged",
            significant(1e3 * term.value.abs(), DIGITS),
            later(term.value)
        ),
        MissingKind::Gravity => format!(
            "the command depends on the angle like gravity, with an amplitude of {size} {}",
            units.torque()
        ),
        MissingKind::Position => {
            format!("a torque {grows} with position, by {size} {}", units.stiffness())
        }
        MissingKind::Stribeck => format!(
            "friction near zero speed is {size} {} {} than Coulomb and viscous friction",
            units.torque(),
            if term.value < 0.0 { "lower" } else { "higher" }
        ),
        MissingKind::BeamDamping => format!(
            "the beam has internal damping of {} ms times its stiffness",
            significant(1e3 * term.value, DIGITS)
        ),
        MissingKind::CommandBySign => format!(
            "positive commands give {:.1} % {} torque than negative ones",
            200.0 * term.value.abs(),
            if term.value > 0.0 { "more" } else { "less" }
        ),
        MissingKind::CoulombDrift => format!(
            "Coulomb friction {grows} by {size} {} from the beginning of the campaign to its end",
            units.torque()
        ),
        MissingKind::ViscousDrift => format!(
            "viscous friction {grows} by {size} {} from the beginning of the campaign to its end",
            units.viscous()
        ),
    }
}

/// The estimates that a term changes by more than their standard errors, with their names, result keys and changes.
fn moved(moves: &[Moved; 3]) -> Vec<(&'static str, &'static str, f64)> {
    let names = [
        ("inertia", key::INERTIA),
        ("viscous friction", key::VISCOUS),
        ("Coulomb friction", key::COULOMB),
    ];
    let felt = names.into_iter().zip(moves);
    let felt = felt.filter(|(_, moved)| moved.standard_errors.abs() > FELT);
    felt.map(|((name, key), moved)| (name, key, moved.share)).collect()
}

/// Changes as shares of estimates, in words; `None` where there are none.
fn changed(shares: impl Iterator<Item = (&'static str, f64)>) -> Option<String> {
    let parts = shares.map(|(name, share)| {
        let more = if share < 0.0 { "lower" } else { "higher" };
        format!("{name} {} % {more}", significant(100.0 * share.abs(), 2))
    });
    Some(parts.collect::<Vec<_>>().join(", ")).filter(|text| !text.is_empty())
}

/// What a missing term changes, in words.
fn moved_by(term: &MissingTerm) -> String {
    let moved = moved(&term.moves).into_iter();
    match changed(moved.map(|(name, _, share)| (name, share))) {
        None => "with it no estimate changes by more than its standard error".to_owned(),
        Some(changes) => format!("with it the estimates would be other ones, {changes}"),
    }
}

/// What the estimates would be without a mode, in words.
fn without_mode(mode: &HiddenMode) -> String {
    let moved = moved(&mode.moves).into_iter();
    match changed(moved.map(|(name, _, share)| (name, 1.0 / (1.0 + share) - 1.0))) {
        None => "Without the mode no estimate changes by more than its standard error".to_owned(),
        Some(changes) => format!("Without the mode the estimates would differ: {changes}"),
    }
}

/// A lag in words.
fn lags(f: &mut fmt::Formatter<'_>, lag: &AngleLag) -> fmt::Result {
    write!(
        f,
        "the {} by {} of {} ms ({:.2} samples): with it the residual torque drops to {:.0} %. The estimates count it",
        if lag.time_s < 0.0 {
            "command is logged late: it lags behind the angle"
        } else {
            "angle lags behind the command"
        },
        match lag.shape {
            LagShape::Filter => "a first-order filter",
            LagShape::Delay => "a delay",
            LagShape::Either => "a filter or delay",
        },
        significant(1e3 * lag.time_s.abs(), 2),
        lag.samples.abs(),
        100.0 * lag.residual_ratio
    )
}

impl fmt::Display for RegressionFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RegressionRefused { residual_share: Some(share), .. } => write!(
                f,
                "{:.0} % of the windowed torque is not explained by the motor's equation: the regression gives no estimates",
                100.0 * share
            ),
            Self::RegressionRefused { residual_share: None, .. } => f.write_str(
                "too few slip phases are long enough for a window: the regression gives no estimates",
            ),
            Self::FewPhases { phases, counted: variation } => write!(
                f,
                "{} cannot show how friction scatters from one stroke to the next: {}",
                counted(*phases, "stroke", "strokes"),
                variation.map_or_else(
                    || "standard errors count the scatter within a stroke alone, and may be too small".to_owned(),
                    |share| {
                        let percent = 100.0 * share;
                        format!("standard errors count {percent:.0} % of Coulomb friction for it, as is usual")
                    }
                )
            ),
            Self::GravityUnseparated { with, correlation } => write!(
                f,
                "gravity and {} can hardly be told apart in these runs (correlation {correlation:.2})",
                match with {
                    GravityPartner::Inertia => "inertia",
                    GravityPartner::Offset => "a constant load",
                }
            ),
            Self::TorqueConstant { by_gravity, given, units } => write!(
                f,
                "by the load's known m·g·l the torque constant is {} N·m per {}, and {} is given: all figures in N·m follow \
                 the given one",
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
                "inertia is up to {:.0} % too small if friction wanders: the residual torque then accelerates the motor, as \
                 the command does",
                100.0 * short_by
            ),
            Self::OneSine => f.write_str(
                "all runs are a sine of one frequency: only the harmonics due to friction then separate motor and \
                 beam, and systematic errors repeat in every period. Errors of the estimates may be larger than their \
                 standard errors",
            ),
            Self::MissingTerm { term, units } => write!(
                f,
                "it looks as if {} ({:.0} standard errors; with this term the residual torque drops to {:.1} %). The \
                 equation has no such term: {}",
                looks_like(term, *units),
                term.deviations,
                100.0 * term.residual_ratio,
                moved_by(term)
            ),
            Self::HiddenMode { mode } => write!(
                f,
                "no tip is measured, and the motor's motion shows a flexible mode, at {} Hz with the motor clamped, with a \
                 damping ratio of {}; {} % of the inertia is before its spring. The estimates account for the \
                 mode: inertia is that of all that turns. {}",
                significant(mode.omega_rad_s.value / std::f64::consts::TAU, DIGITS),
                significant(mode.damping_ratio.value, 2),
                significant(100.0 * mode.inertia_share.value, 2),
                without_mode(mode)
            ),
            Self::FrictionVaries { by } => write!(
                f,
                "friction, or a load, changes from one slip phase to the next, by {} % of Coulomb friction (rms). The \
                 estimates are its mean over the logs, and their standard errors count that it changes",
                significant(100.0 * by, 2)
            ),
            Self::AngleLag { lag } => lags(f, lag),
            Self::ViscousByDirection {
                forward,
                backward,
                residual_share_of_one,
                residual_share_of_two,
                offset,
                units,
            } => write!(
                f,
                "viscous friction differs by direction: {} {viscous} forward, {} {viscous} backward. With two \
                 constants the residual torque drops from {:.1} % to {:.1} %, and the offset of friction is {} {}",
                with_error(*forward),
                with_error(*backward),
                100.0 * residual_share_of_one,
                100.0 * residual_share_of_two,
                with_error(*offset),
                units.torque(),
                viscous = units.viscous()
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
            | Self::ViscousByDirection { .. } => Severity::Warning,
        }
    }

    fn affects(&self) -> Vec<&'static str> {
        match self {
            Self::RegressionRefused { .. }
            | Self::FewPhases { .. }
            | Self::TorqueConstant { .. }
            | Self::UnexplainedTorque { .. }
            | Self::AngleLag { .. } => {
                vec![key::COULOMB, key::OFFSET, key::VISCOUS, key::INERTIA, key::COUPLING]
            }
            // A load may be most of the torque: it moves all.
            Self::MissingTerm { term, .. } if term.kind == MissingKind::Gravity => {
                vec![key::COULOMB, key::OFFSET, key::VISCOUS, key::INERTIA]
            }
            Self::MissingTerm { term, .. } => {
                let mut keys: Vec<_> =
                    moved(&term.moves).into_iter().map(|(_, key, _)| key).collect();
                keys.extend([key::OFFSET, key::COUPLING]);
                keys
            }
            Self::FrictionVaries { .. } => vec![key::COULOMB, key::VISCOUS],
            Self::HiddenMode { mode } => {
                moved(&mode.moves).into_iter().map(|(_, key, _)| key).collect()
            }
            Self::GravityUnseparated { with: GravityPartner::Inertia, .. } => {
                vec![key::INERTIA, key::GRAVITY]
            }
            Self::GravityUnseparated { with: GravityPartner::Offset, .. } => {
                vec![key::OFFSET, key::GRAVITY]
            }
            Self::InertiaShort { .. } => vec![key::INERTIA],
            Self::OneSine => {
                vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES]
            }
            Self::ViscousByDirection { .. } => vec![key::VISCOUS, key::OFFSET],
        }
    }

    fn hint(&self) -> &'static str {
        match self {
            Self::RegressionRefused { explained: true, .. } => "add the missing term first",
            Self::RegressionRefused { .. } => {
                "use longer moves in both directions at a measured current; measure the tip of a flexible beam; check \
                 columns, units and signs"
            }
            Self::FewPhases { .. } => "log four strokes or more in each direction",
            Self::GravityUnseparated { with: GravityPartner::Inertia, .. } => {
                "move over a larger angle, or at other frequencies: inertia grows with the square of the frequency, gravity does not"
            }
            Self::GravityUnseparated { with: GravityPartner::Offset, .. } => {
                "move over a longer arc: over a short one gravity is a constant"
            }
            Self::TorqueConstant { .. } => {
                "check both, and gear_ratio; leave torque_constant out, and the load gives it"
            }
            Self::UnexplainedTorque { .. } => {
                "look for a delay, a load, other friction, or a flexible mode without a tip; check units and signs"
            }
            Self::InertiaShort { .. } => {
                "accelerate more: faster and larger moves, under control of position or speed"
            }
            Self::OneSine => "use the output-error method, or add a run at another frequency",
            Self::MissingTerm { term, .. } => match term.kind {
                MissingKind::Delay => {
                    "shift the channels against each other, or log the current where it is measured"
                }
                MissingKind::Gravity => "add [load] gravity = true to the campaign",
                MissingKind::Position => {
                    "look for gravity, a spring, cogging, or a wrong scale of a tip"
                }
                MissingKind::Stribeck => {
                    "Stribeck friction or presliding: one constant and one slope do not describe it"
                }
                MissingKind::BeamDamping => {
                    "use the output-error method: it identifies damping within the beam"
                }
                MissingKind::CommandBySign => {
                    "an amplifier that is stronger one way, or a current sensor with two gains: log the current itself, \
                     and calibrate it in both directions"
                }
                MissingKind::CoulombDrift => {
                    "the joint warms up, wears or was lubricated: warm it up first, or identify the runs separately"
                }
                MissingKind::ViscousDrift => {
                    "the joint warms up: warm it up first, or identify the runs separately"
                }
            },
            Self::HiddenMode { .. } => {
                "measure the angle behind the flexible part as a tip to see how it moves"
            }
            Self::FrictionVaries { .. } => {
                "nothing to do for the estimates; a simulation with constant friction departs from the log by that much. \
                 Warm the joint up, or log for longer, to see whether it settles"
            }
            Self::AngleLag { lag } if lag.is_half_a_sample() => {
                "half a sample is the difference between a held and a measured command: check `hold`"
            }
            Self::AngleLag { lag } if lag.time_s < 0.0 => {
                "log the current before it is filtered; figures near reversals may be off by more than their standard errors"
            }
            Self::AngleLag { .. } => {
                "log the angle before the drive filters it; figures near reversals may be off by more than their standard errors"
            }
            Self::ViscousByDirection { .. } => {
                "the scalar estimate is the mean of both; the offset depends on which law is chosen: look for a brush, \
                 a screw or a cable"
            }
        }
    }
}
