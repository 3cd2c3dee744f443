//! Why there is no equivalent arm, and what to do about it.

use thiserror::Error;

use crate::identify::equivalent::equivalent_error::EquivalentError;
use crate::identify::estimate::Estimate;
use crate::identify::responses::rational::SharedPolesError;

/// A response with more than damping in its imaginary part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartOutside {
    /// Name of the point.
    pub name: String,
    /// Imaginary part that no damping explains, as a share of the response, median.
    pub share: f64,
    /// The same in standard errors, rms; `None` where these are not known.
    pub deviations: Option<f64>,
    /// The delay that the response shows, where it explains that part \[s\].
    pub delay_s: Option<Estimate>,
}

/// Why responses make no equivalent arm.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum EquivalentRefusal {
    /// No poles can be fitted.
    #[error("{}", fit_words(source, names))]
    Fit {
        /// Why.
        source: SharedPolesError,
        /// Names of the points.
        names: Vec<String>,
    },
    /// Not a name for each point.
    #[error("{names} names for {points} points")]
    Names {
        /// Names given.
        names: usize,
        /// Points measured.
        points: usize,
    },
    /// A response with the phase's sign turned.
    #[error(
        "{} {} clearly better with the phase's sign turned: as given {} would be of poles that gain energy",
        names.join(", "),
        if names.len() == 1 { "fits" } else { "fit" },
        if names.len() == 1 { "it" } else { "they" }
    )]
    TurnedRound {
        /// Names of the points.
        names: Vec<String>,
    },
    /// Numbers whose products leave doubles.
    #[error("{name} is of size {size:.1e}: that is no response of an arm")]
    Size {
        /// Of which response, or that it is a frequency.
        name: String,
        /// Its size.
        size: f64,
    },
    /// A standard error that does not go with its response.
    #[error(
        "{name}, frequency {} ({omega_rad_s:.6} rad/s): a standard error of {std:.1e} for a response of size {size:.1e}",
        index + 1
    )]
    Deviation {
        /// Name of the point, or `motor`.
        name: String,
        /// Place of the frequency, from 0.
        index: usize,
        /// The frequency \[rad/s\].
        omega_rad_s: f64,
        /// The standard error.
        std: f64,
        /// Of the response.
        size: f64,
    },
    /// No point's angle is known.
    #[error("no tip is an angle, or a deflection that makes one")]
    NoAngle,
    /// Nothing but noise.
    #[error(
        "the responses are all noise: of {poles} poles fitted none has a gain four standard errors from zero, or none \
         describes the responses better than zero does"
    )]
    Noise {
        /// Poles tried.
        poles: usize,
    },
    /// What moves lies outside the frequencies.
    #[error(
        "no mode lies within the frequencies measured, {:.4} to {:.4} rad/s",
        range_rad_s.0,
        range_rad_s.1
    )]
    NoModeWithin {
        /// The lowest and the highest frequency \[rad/s\].
        range_rad_s: (f64, f64),
    },
    /// A response that is not even in s, however it is damped.
    #[error("{}", uneven_words(.0))]
    Uneven(PartOutside),
    /// Each mode needs a point of its own.
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
        /// Why.
        source: EquivalentError,
        /// Names of the points in it.
        names: Vec<String>,
        /// The modes' frequencies \[rad/s\].
        modes_rad_s: Vec<f64>,
    },
}

impl EquivalentRefusal {
    /// Whether a phase's sign may be the reason behind it.
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
                SharedPolesError::NoOutput => "give a response of one point at least",
                SharedPolesError::Grid { .. } => "measure all points at the same frequencies",
                SharedPolesError::TooFew { .. } => {
                    "measure at more frequencies: five for each mode at least"
                }
                SharedPolesError::Frequency { .. } | SharedPolesError::Response { .. } => {
                    "leave out what is no number, and points whose standard error is zero"
                }
                _ => "measure about the resonances, at more frequencies",
            },
            Self::Names { .. } => "give each point a name",
            Self::TurnedRound { .. } => {
                "change the sign of the phase, or of the imaginary part: with e^(+jωt) a response lags at negative \
                 phases"
            }
            Self::Size { .. } => {
                "check the units: points' responses are angle per angle of the motor, about one at rest"
            }
            Self::Deviation { .. } => {
                "correct it; where no standard errors are known leave them all out: they are then estimated from the \
                 residual of the model"
            }
            Self::NoAngle => {
                "measure angles of points of the beam, or deflections in rad or with a radius: accelerations and \
                 unscaled signals do not say how far a point moves. An identification from logs gives modes and torques \
                 from such signals and the motor"
            }
            Self::Noise { .. } => "drive the motor harder, average longer, and check the sensors",
            Self::NoModeWithin { .. } => {
                "measure over the resonances of the beam with the motor clamped"
            }
            Self::Uneven(_) => {
                "responses must be of a point's angle to the motor's angle, without delay between the two: check \
                 the channels, their sampling and the phase's sign and unit"
            }
            Self::FewerPoints { .. } => {
                "measure as many points as modes, or keep the lowest modes only"
            }
            Self::Beam { .. } => {
                "put one of the two where this mode moves it by another size or sign; the dimensions of the beam say where"
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
            "{} has {found} responses for {expected} frequencies: all points must share one grid",
            name(names, *output)
        ),
        SharedPolesError::Response { output, index } => format!(
            "{}, frequency {}: a response needs a finite value and a standard error above zero",
            name(names, *output),
            index + 1
        ),
        other => other.to_string(),
    }
}

fn uneven_words(part: &PartOutside) -> String {
    let deviations =
        part.deviations.map_or(String::new(), |d| format!(" ({d:.1} standard errors)"));
    let late = part.delay_s.map_or(String::new(), |late| {
        format!(", as if it came {:.3} ms {}", 1e3 * late.value.abs(), side(late.value))
    });
    format!(
        "{} has {:.0} % of its size in an imaginary part that no damping explains{deviations}{late}: the response \
         of an arm has even powers of s only",
        part.name,
        100.0 * part.share
    )
}

/// Which way a delay is.
pub(super) fn side(delay_s: f64) -> &'static str {
    if delay_s > 0.0 { "late" } else { "early" }
}

fn beam_words(error: &EquivalentError, names: &[String], modes_rad_s: &[f64]) -> String {
    match error {
        EquivalentError::TooClose { first, second, ratio, mode } => format!(
            "{} and {} move too much alike in these modes (the gains' least singular value is {ratio:.1e} of the \
             largest): mode {}{} is not told apart",
            name(names, *first),
            name(names, *second),
            mode + 1,
            modes_rad_s.get(*mode).map_or(String::new(), |w| format!(" at {w:.4} rad/s"))
        ),
        other => other.to_string(),
    }
}
