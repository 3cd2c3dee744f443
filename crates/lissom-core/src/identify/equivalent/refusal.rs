//! Reasons why there is no equivalent arm, and what to do about them.

use thiserror::Error;

use crate::identify::equivalent::equivalent_error::EquivalentError;
use crate::identify::estimate::Estimate;
use crate::identify::responses::rational::SharedPolesError;

/// A response with an imaginary part that damping does not explain.
#[derive(Debug, Clone, PartialEq)]
pub struct PartOutside {
    /// Name of the point.
    pub name: String,
    /// Size of that part as a share of the response, median.
    pub share: f64,
    /// The same in standard errors, rms; `None` if these are not known.
    pub standard_errors: Option<f64>,
    /// The delay of the response, if a delay explains that part \[s\].
    pub delay_s: Option<Estimate>,
}

/// Reason why responses make no equivalent arm.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum EquivalentRefusal {
    /// No poles can be fitted.
    #[error("{}", fit_words(source, names))]
    Fit {
        /// The error of the fit.
        source: SharedPolesError,
        /// Names of the points.
        names: Vec<String>,
    },
    /// The numbers of names and points differ.
    #[error("{names} names for {points} points")]
    Names {
        /// Names given.
        names: usize,
        /// Points measured.
        points: usize,
    },
    /// Responses whose phase has the wrong sign.
    #[error(
        "{} {} clearly better with the sign of the phase reversed: as given, {} would have poles that gain energy",
        names.join(", "),
        if names.len() == 1 { "fits" } else { "fit" },
        if names.len() == 1 { "it" } else { "they" }
    )]
    TurnedRound {
        /// Names of the points.
        names: Vec<String>,
    },
    /// Numbers so large or small that products of them leave the range of a double.
    #[error("{name} has the magnitude {size:.1e}, which is not possible for an arm")]
    Size {
        /// Name of the response, or a frequency.
        name: String,
        /// Its magnitude.
        size: f64,
    },
    /// A standard error that does not fit its response.
    #[error(
        "{name}, frequency {} ({omega_rad_s:.6} rad/s): the standard error {std:.1e} does not fit a response of magnitude \
         {size:.1e}",
        index + 1
    )]
    Deviation {
        /// Name of the point, or `motor`.
        name: String,
        /// Index of the frequency, from 0.
        index: usize,
        /// The frequency \[rad/s\].
        omega_rad_s: f64,
        /// The standard error.
        std: f64,
        /// Magnitude of the response.
        size: f64,
    },
    /// No point is measured as an angle.
    #[error("no tip is measured as an angle, or as a deflection that can be converted to one")]
    NoAngle,
    /// The responses contain only noise.
    #[error(
        "the responses are all noise: none of the {poles} fitted poles has a gain at least four standard errors from \
         zero, or none describes the responses better than zero"
    )]
    Noise {
        /// Number of fitted poles.
        poles: usize,
    },
    /// All modes lie outside the measured frequencies.
    #[error(
        "no mode lies within the measured frequencies, {:.4} to {:.4} rad/s",
        range_rad_s.0,
        range_rad_s.1
    )]
    NoModeWithin {
        /// The lowest and the highest frequency \[rad/s\].
        range_rad_s: (f64, f64),
    },
    /// A response with an imaginary part that damping does not explain: it is not even in s.
    #[error("{}", uneven_words(.0))]
    Uneven(PartOutside),
    /// There are fewer points than modes.
    #[error(
        "{points} {} for {} modes, at {} rad/s: each mode needs a point of its own",
        if *points == 1 { "point" } else { "points" },
        modes_rad_s.len(),
        listed(modes_rad_s)
    )]
    FewerPoints {
        /// Points measured.
        points: usize,
        /// The modes' frequencies \[rad/s\].
        modes_rad_s: Vec<f64>,
    },
    /// The points' gains cannot be inverted.
    #[error("{}", beam_words(source, names, modes_rad_s))]
    Beam {
        /// The error.
        source: EquivalentError,
        /// Names of the points of the arm.
        names: Vec<String>,
        /// The modes' frequencies \[rad/s\].
        modes_rad_s: Vec<f64>,
    },
}

impl EquivalentRefusal {
    /// Whether a wrong sign of the phase may be the reason.
    pub(super) fn may_be_a_turned_phase(&self) -> bool {
        match self {
            Self::Noise { .. }
            | Self::NoModeWithin { .. }
            | Self::Uneven(_)
            | Self::FewerPoints { .. } => true,
            Self::Beam { source, .. } => matches!(source, EquivalentError::TooClose { .. }),
            _ => false,
        }
    }

    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Fit { source, .. } => match source {
                SharedPolesError::NoOutput => "give the response of at least one point",
                SharedPolesError::Grid { .. } => "measure all points at the same frequencies",
                SharedPolesError::TooFew { .. } => {
                    "measure at more frequencies: at least five for each mode"
                }
                SharedPolesError::Frequency { .. } | SharedPolesError::Response { .. } => {
                    "leave out values that are not numbers, and values whose standard error is zero"
                }
                _ => "measure at more frequencies around the resonances",
            },
            Self::Names { .. } => "give each point a name",
            Self::TurnedRound { .. } => {
                "change the sign of the phase, or of the imaginary part: with e^(+jωt) a response that lags has a negative \
                 phase"
            }
            Self::Size { .. } => {
                "check the units: the response of a point is its angle per angle of the motor, about one at low frequencies"
            }
            Self::Deviation { .. } => {
                "correct it; if standard errors are not known, leave them all out: they are then estimated from the residual \
                 of the model"
            }
            Self::NoAngle => {
                "measure angles of points of the beam, or deflections in rad or with a radius: accelerations and signals of \
                 unknown scale do not show how far a point moves. From such signals and the motor, an identification from \
                 logs gives modes and torques"
            }
            Self::Noise { .. } => "drive the motor harder, average longer, and check the sensors",
            Self::NoModeWithin { .. } => {
                "measure over a range that includes the resonances of the beam with the motor clamped"
            }
            Self::Uneven(_) => {
                "a response must be that of a point's angle to the motor's angle, without a delay between the two: check the \
                 channels, their sampling, and the sign and unit of the phase"
            }
            Self::FewerPoints { .. } => {
                "measure as many points as modes, or keep only the lowest modes"
            }
            Self::Beam { .. } => {
                "move one of the two points to a place where this mode has another amplitude or sign; a model with the \
                 dimensions of the beam shows where"
            }
        }
    }
}

fn listed(numbers: &[f64]) -> String {
    numbers.iter().map(|w| format!("{w:.4}")).collect::<Vec<_>>().join(", ")
}

fn name(names: &[String], place: usize) -> &str {
    names.get(place).map_or("?", String::as_str)
}

fn fit_words(error: &SharedPolesError, names: &[String]) -> String {
    match error {
        SharedPolesError::Grid { output, found, expected } => format!(
            "{} has {found} responses for {expected} frequencies: all points must have the same frequencies",
            name(names, *output)
        ),
        SharedPolesError::Response { output, index } => format!(
            "{}, frequency {}: a response needs a finite value, and a standard error above zero",
            name(names, *output),
            index + 1
        ),
        other => other.to_string(),
    }
}

fn uneven_words(part: &PartOutside) -> String {
    let errors =
        part.standard_errors.map_or(String::new(), |n| format!(" ({n:.1} standard errors)"));
    let late = part.delay_s.map_or(String::new(), |late| {
        format!(
            ", like a response that comes {:.3} ms {}",
            1e3 * late.value.abs(),
            side(late.value)
        )
    });
    format!(
        "{} has an imaginary part that no damping explains, {:.0} % of its magnitude{errors}{late}: the response of an \
         arm has only even powers of s",
        part.name,
        100.0 * part.share
    )
}

/// `late` for a positive delay, `early` for a negative one.
pub(super) fn side(delay_s: f64) -> &'static str {
    if delay_s > 0.0 { "late" } else { "early" }
}

fn beam_words(error: &EquivalentError, names: &[String], modes_rad_s: &[f64]) -> String {
    match error {
        EquivalentError::TooClose { first, second, ratio, mode } => format!(
            "{} and {} move almost alike in these modes (the smallest singular value of the gains is {ratio:.1e} of the \
             largest): mode {}{} cannot be separated from the others",
            name(names, *first),
            name(names, *second),
            mode + 1,
            modes_rad_s.get(*mode).map_or(String::new(), |w| format!(" at {w:.4} rad/s"))
        ),
        other => other.to_string(),
    }
}
