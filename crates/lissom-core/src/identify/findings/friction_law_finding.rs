//! Friction with more terms than Coulomb friction plus one viscous constant.

use lissom_text::significant;

use crate::finding::Severity::{Info, Warning};
use crate::finding::findings;
use crate::finding::result_key as key;
use crate::identify::estimate::Estimate;
use crate::identify::findings::units::EstimateUnits;
use crate::identify::methods::friction_law::LawTerm;

/// Digits of a term's size.
const DIGITS: usize = 3;

/// The method that gives a friction law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawSource {
    /// The output-error method.
    OutputError {
        /// Whether it describes the runs from beginning to end; otherwise only over short windows.
        whole_runs: bool,
    },
    /// The regression in slip phases.
    SlipPhases {
        /// Whether the output-error method describes the runs without these terms.
        replayed_without: bool,
        /// How much better the law describes the data, if single terms were tested.
        better: Option<BetterLaw>,
        /// Residual torque with the law relative to the torque, if that is much and not noise \[1\].
        left_over: Option<f64>,
    },
}

/// How much better a law describes the data than Coulomb friction and one viscous constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BetterLaw {
    /// Residual torque with this law relative to that without it.
    pub residual_ratio: f64,
    /// Improvement for slip phases that are left out of the fit, in standard errors, at least.
    pub standard_errors: f64,
}

/// Terms of friction with their amplitudes.
fn in_words(terms: &[(LawTerm, Vec<Estimate>)], units: EstimateUnits) -> String {
    let words = terms.iter().filter_map(|term| term_in_words(term, units));
    words.collect::<Vec<_>>().join(", ")
}

/// A term of friction with its amplitude; `None` for a term that is not friction.
fn term_in_words(
    (term, amplitudes): &(LawTerm, Vec<Estimate>),
    units: EstimateUnits,
) -> Option<String> {
    let (torque, angle) = (units.torque(), units.angle());
    let amplitude = amplitudes.first().map_or(f64::NAN, |e| e.value);
    let size = significant(amplitude.abs(), DIGITS);
    Some(match term {
        LawTerm::ViscousByDirection => {
            format!(
                "viscous friction differs by direction, by ±{size} {} from its mean",
                units.viscous()
            )
        }
        LawTerm::NearRest { speed, .. } => {
            let (way, name) =
                if amplitude > 0.0 { ("higher", " (Stribeck)") } else { ("lower", "") };
            format!(
                "near standstill (below about {} {angle}/s) it is {size} {torque} {way} than Coulomb plus viscous friction{name}",
                significant(*speed, DIGITS)
            )
        }
        LawTerm::Root => {
            let sign = if amplitude < 0.0 { "falls" } else { "grows" };
            format!("it {sign} with the square root of speed, by {size} {torque}/√({angle}/s)")
        }
        LawTerm::WithLoad { .. } => {
            let sign = if amplitude < 0.0 { "falls" } else { "grows" };
            format!("it {sign} with the load of gravity, by {size} times its torque")
        }
        LawTerm::Ripple { per_angle } => {
            let squares = amplitudes.iter().take(2).map(|e| e.value * e.value);
            format!(
                "it changes over the travel by ±{} {torque} with a period of {} {angle}",
                significant(squares.sum::<f64>().sqrt(), DIGITS),
                significant(std::f64::consts::TAU / per_angle, DIGITS + 1)
            )
        }
        LawTerm::TorqueRipple { per_angle } => {
            let squares = amplitudes.iter().take(2).map(|e| e.value * e.value);
            format!(
                "a torque that changes over the travel acts in both directions alike (cogging), ±{} {torque} with a period of {} \
                 {angle}",
                significant(squares.sum::<f64>().sqrt(), DIGITS),
                significant(std::f64::consts::TAU / per_angle, DIGITS + 1)
            )
        }
        LawTerm::CommandLag => return None,
    })
}

/// What a law is worth that slip phases or the output-error method gave, in words.
fn worth(source: LawSource) -> String {
    let (replayed_without, better, left_over) = match source {
        LawSource::OutputError { whole_runs } => {
            let runs = if whole_runs { "from beginning to end" } else { "over short windows only" };
            return format!("With this law the output-error method describes the runs {runs}");
        }
        LawSource::SlipPhases { replayed_without, better, left_over } => {
            (replayed_without, better, left_over)
        }
    };
    let better = better.map_or_else(String::new, |BetterLaw { residual_ratio, standard_errors }| {
        format!(
            "With this law the residual torque is {residual_ratio:.2} times as large, and slip phases left out of the fit are \
             described better by {standard_errors:.0} standard errors or more. "
        )
    });
    match left_over {
        _ if replayed_without => {
            format!("{better}The output-error method describes the runs without these terms")
        }
        None => format!("{better}The estimates come from the fit with this law"),
        Some(share) => format!(
            "{better}The estimates come from the fit with this law. It leaves {:.0} % of the torque unexplained, more than \
             noise: the terms of friction may stand for another effect",
            100.0 * share
        ),
    }
}

/// What to do about a law.
fn hint(terms: &[(LawTerm, Vec<Estimate>)], source: LawSource) -> &'static str {
    let with_load = |(term, _): &(LawTerm, Vec<Estimate>)| {
        matches!(term, LawTerm::WithLoad { .. } | LawTerm::CommandLag)
    };
    match source {
        LawSource::SlipPhases { replayed_without: true, .. } => {
            "nothing to do: the estimates are those of the output-error method"
        }
        LawSource::SlipPhases { left_over: Some(_), .. } => {
            "look for a flexible part, a load or a wrong channel; compare with the line of least squares"
        }
        LawSource::SlipPhases { .. } if terms.iter().all(with_load) => {
            "Coulomb friction is that under the mean load of the log; the law has that without load, to which the factor \
             in the message times the torque of gravity is added"
        }
        LawSource::OutputError { .. } | LawSource::SlipPhases { .. } => {
            "Coulomb and viscous friction are valid at speed, not near standstill: use the friction curve at the speed \
             of interest; runs at other speeds show whether the law is valid there"
        }
    }
}

findings! {
    /// Friction has further terms.
    "friction-law" FrictionLaw { terms: Vec<(LawTerm, Vec<Estimate>)>, source: LawSource, units: EstimateUnits }
        match source {
            // The estimates are those of the law.
            LawSource::SlipPhases { replayed_without: false, left_over: Some(_), .. } => Warning,
            _ => Info,
        },
        [key::COULOMB, key::VISCOUS],
        format!("{}friction is not Coulomb friction plus one viscous constant: {}. {}", match source {
            LawSource::SlipPhases { replayed_without: true, .. } => "according to the slip phases alone, ",
            _ => "",
        }, in_words(terms, *units), worth(*source)),
        hint(terms, *source);
}
