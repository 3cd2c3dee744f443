//! Friction that is not Coulomb friction plus one viscous constant.

use std::fmt;

use strum::{IntoStaticStr, VariantNames};

use crate::identify::estimate::Estimate;
use crate::identify::findings::describe::Describe;
use crate::identify::findings::number_text::significant;
use crate::identify::findings::result_key as key;
use crate::identify::findings::severity::Severity;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::LawTerm;

/// Digits of a term's size.
const DIGITS: usize = 3;

/// Where a law of friction is from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawSource {
    /// The output-error method.
    OutputError {
        /// Whether it describes the runs from beginning to end, or parts of them.
        whole_runs: bool,
        /// Whether every term is less than a thousandth of Coulomb and viscous friction.
        negligible: bool,
    },
    /// The slip phases.
    SlipPhases {
        /// Whether the output-error method describes the runs without this law.
        replayed_without: bool,
        /// How much better it describes the data, where single terms were tested.
        better: Option<BetterLaw>,
    },
}

/// How much better a law describes the data than Coulomb friction and one viscous constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BetterLaw {
    /// Residual torque with this law relative to that without.
    pub residual_ratio: f64,
    /// Standard errors by which phases left out of the fit are described better, at least.
    pub standard_errors: f64,
}

/// Friction that is not Coulomb friction plus one viscous constant.
#[derive(Debug, Clone, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[non_exhaustive]
pub enum FrictionLawFinding {
    /// Friction has further terms.
    FrictionLaw {
        /// The terms with their amplitudes.
        terms: Vec<(LawTerm, Vec<Estimate>)>,
        /// Where the law is from.
        source: LawSource,
        /// Units of the amplitudes.
        units: EstimateUnits,
    },
}

/// Terms of friction with their amplitudes.
fn in_words(terms: &[(LawTerm, Vec<Estimate>)], units: EstimateUnits) -> String {
    let words = terms.iter().filter_map(|term| term_in_words(term, units));
    words.collect::<Vec<_>>().join(", ")
}

/// A term of friction with its amplitude; `None` of a term that is not friction.
fn term_in_words(
    (term, amplitudes): &(LawTerm, Vec<Estimate>),
    units: EstimateUnits,
) -> Option<String> {
    let (torque, angle) = (units.torque(), units.angle());
    let amplitude = amplitudes.first().map_or(f64::NAN, |e| e.value);
    let size = significant(amplitude.abs(), DIGITS);
    Some(match term {
        LawTerm::ViscousByDirection => {
            format!("viscous friction differs by ±{size} {} by direction", units.viscous())
        }
        LawTerm::AfterTravel { travel } => format!(
            "it grows over some travel after a reversal (bristles, presliding; the first {} {angle} of every slip phase \
             are not used)",
            significant(*travel, DIGITS)
        ),
        LawTerm::NearRest { speed, .. } => {
            let (way, name) =
                if amplitude > 0.0 { ("higher", " (Stribeck)") } else { ("lower", "") };
            format!(
                "near zero speed (below about {} {angle}/s) it is {size} {torque} {way}{name}",
                significant(*speed, DIGITS)
            )
        }
        LawTerm::Root => {
            let sign = if amplitude < 0.0 { "falls" } else { "grows" };
            format!("it {sign} with the root of speed, by {size} {torque}/√({angle}/s)")
        }
        LawTerm::WithLoad { .. } => {
            let sign = if amplitude < 0.0 { "falls" } else { "grows" };
            format!("it {sign} with the load of gravity, by {size} of it")
        }
        LawTerm::Ripple { per_angle } => {
            let squares = amplitudes.iter().take(2).map(|e| e.value * e.value);
            format!(
                "it changes over the travel by ±{} {torque} with a period of {} {angle}",
                significant(squares.sum::<f64>().sqrt(), DIGITS),
                significant(std::f64::consts::TAU / per_angle, DIGITS + 1)
            )
        }
        LawTerm::CommandLag => return None,
    })
}

impl fmt::Display for FrictionLawFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::FrictionLaw { terms, source, units } = self;
        if matches!(source, LawSource::SlipPhases { replayed_without: true, .. }) {
            f.write_str("in the slip phases alone, ")?;
        }
        write!(
            f,
            "friction is not Coulomb friction plus one viscous constant: {}. ",
            in_words(terms, *units)
        )?;
        match *source {
            LawSource::OutputError { whole_runs, .. } => write!(
                f,
                "With this law the output-error method describes {}",
                if whole_runs {
                    "the runs from beginning to end"
                } else {
                    "the runs over short windows only"
                }
            ),
            LawSource::SlipPhases { replayed_without, better } => {
                if let Some(BetterLaw { residual_ratio, standard_errors }) = better {
                    write!(
                        f,
                        "With this law the residual torque drops to {:.0} %, and slip phases left out of the fit are \
                         described better by {standard_errors:.0} standard errors or more. ",
                        100.0 * residual_ratio
                    )?;
                }
                f.write_str(if replayed_without {
                    "The output-error method describes the runs without it"
                } else {
                    "The estimates are those of this law"
                })
            }
        }
    }
}

impl FrictionLawFinding {
    fn grows_with_load_alone(&self) -> bool {
        let Self::FrictionLaw { terms, .. } = self;
        let alone = |(term, _): &(LawTerm, Vec<Estimate>)| {
            matches!(term, LawTerm::WithLoad { .. } | LawTerm::CommandLag)
        };
        terms.iter().all(alone)
    }

    fn grows_after_reversals(&self) -> bool {
        let Self::FrictionLaw { terms, source, .. } = self;
        matches!(source, LawSource::SlipPhases { replayed_without: false, .. })
            && terms.iter().any(|(term, _)| matches!(term, LawTerm::AfterTravel { .. }))
    }
}

impl Describe for FrictionLawFinding {
    fn code(&self) -> &'static str {
        self.into()
    }

    fn severity(&self) -> Severity {
        // The estimates are those of the law. Bristles are none: what they do to inertia is not in it.
        if self.grows_after_reversals() { Severity::Warning } else { Severity::Info }
    }

    fn affects(&self) -> Vec<&'static str> {
        if self.grows_after_reversals() {
            return vec![key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING];
        }
        vec![key::COULOMB, key::VISCOUS]
    }

    fn hint(&self) -> &'static str {
        let Self::FrictionLaw { source, .. } = self;
        match source {
            LawSource::OutputError { negligible: true, .. } => {
                "nothing to do: all of it is less than a thousandth of Coulomb and viscous friction"
            }
            LawSource::SlipPhases { replayed_without: true, .. } => {
                "nothing to do: the estimates are those of the output-error method"
            }
            LawSource::SlipPhases { .. } if self.grows_after_reversals() => {
                "Coulomb and viscous friction hold at speed, not near zero speed; inertia and coupling have an error \
                 because bristles lag where friction changes with speed: use longer and faster moves to reduce it"
            }
            LawSource::SlipPhases { .. } if self.grows_with_load_alone() => {
                "Coulomb friction is that without the load of gravity: add μ times its torque"
            }
            LawSource::OutputError { .. } | LawSource::SlipPhases { .. } => {
                "Coulomb and viscous friction hold at speed, not near zero speed: use the friction curve at the speed of \
                 interest; runs at other speeds show whether the law holds there"
            }
        }
    }
}
