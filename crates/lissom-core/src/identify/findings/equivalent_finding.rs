//! An equivalent arm: its points and modes, and inertia, viscous friction and coupling from the motor's response.

use crate::finding::Severity::{Info, Warning};
use crate::finding::result_key::EQUIVALENT;
use crate::finding::{counted, findings};
use crate::identify::equivalent::equivalent_error::EquivalentError;
use crate::identify::equivalent::refusal::EquivalentRefusal;
use crate::identify::estimate::Estimate;
use crate::identify::findings::number_text::{later, milliseconds};
use crate::identify::responses::rational::Spurious;

findings! {
    /// The responses of a campaign make no equivalent arm.
    "equivalent-refused" EquivalentRefused { refusal: EquivalentRefusal }
        Info, [EQUIVALENT],
        format!("there is no equivalent arm: {refusal}"),
        refusal.hint();

    /// A pole of the fit is not a mode of the arm.
    "equivalent-spurious-pole" EquivalentSpuriousPole { omega_rad_s: f64, reason: Spurious }
        Info, [EQUIVALENT],
        format!("a pole at {omega_rad_s:.4} rad/s {}: it is not a mode of the arm", match reason {
            Spurious::Outside => "lies outside the measured frequencies",
            Spurious::Damped => "is damped more than any mode of a beam",
            Spurious::Unfelt => "has gains less than four standard errors from zero at all points",
        }),
        "nothing to do if the pole describes modes beyond the measured frequencies, or noise";

    /// Fewer modes are kept than were found.
    "equivalent-left-out" EquivalentModesLeftOut { kept: usize, found: usize }
        Info, [EQUIVALENT],
        format!("{kept} of {found} modes are kept: the arm is valid below the first mode that is left out"),
        "use the arm below the first mode that is left out, or keep more modes";

    /// There are more points than modes.
    "equivalent-left-out" EquivalentPointsLeftOut { modes: usize, points: Vec<String> }
        Info, [EQUIVALENT],
        {
            let (is, response) = match points.len() {
                1 => ("is", "its response is"),
                _ => ("are", "their responses are"),
            };
            format!("the arm has {} and therefore as many points: {} {is} not in it, but {response} used for the poles",
                counted(*modes, "mode", "modes"), points.join(", "))
        },
        "measure at higher frequencies, so that there are as many modes as points";

    /// A response has an imaginary part that neither damping nor a delay explains.
    "equivalent-imaginary-part" EquivalentImaginaryPart { point: String, share: f64, standard_errors: Option<f64> }
        Warning, [EQUIVALENT],
        format!("the response of {point} has an imaginary part of {:.2} % of its size{} that no damping explains: errors of \
            frequencies and gains may be larger than their intervals", 100.0 * share,
            standard_errors.map_or_else(String::new, |n| format!(" ({n:.1} standard errors)"))),
        "check the phase of the channels: filters, sampling, a delay between them";

    /// The response of a point is delayed relative to the motor (negative: it comes earlier).
    "equivalent-delay" EquivalentDelay { point: String, delay_s: Estimate }
        Warning, [EQUIVALENT],
        format!("the response of {point} comes {} {} than the motor's angle: the delay is removed, and the intervals include its \
            uncertainty", milliseconds(*delay_s), later(delay_s.value)),
        "sample both channels at the same time and with the same filter, or correct the responses by the delay; damping within \
            the beam may look like a small delay";

    /// The motor's response is delayed relative to the command (negative: it comes earlier).
    "equivalent-delay" EquivalentMotorDelay { delay_s: Estimate }
        Warning, [EQUIVALENT],
        format!("the motor's response comes {} {} than the command: the delay is removed, and the intervals include its \
            uncertainty", milliseconds(*delay_s), later(delay_s.value)),
        "sample command and angle at the same time and with the same filter, or correct the response by the delay";

    /// Residues have terms in s, up to this share of their gains.
    "equivalent-terms-in-s" EquivalentTermsInS { largest_share: f64, hidden_delay_s: f64 }
        Info, [EQUIVALENT],
        format!("the residues have terms in s, up to {largest_share:.4} of their gains: the beam has internal damping, or \
            damping with another shape than its modes. These terms may hide a delay of up to {:.4} ms, which the intervals of \
            the gains include", 1e3 * hidden_delay_s),
        "nothing to do: the fit contains these terms; an identification from logs finds an arm with such damping";

    /// The points' responses differ from the model.
    "equivalent-misfit" EquivalentMisfit { rms_standard_errors: f64 }
        Warning, [EQUIVALENT],
        format!("the responses of the points differ from the model by {rms_standard_errors:.1} standard errors (rms): they \
            contain more than the modes of an arm, or the standard errors are too small. The intervals include the difference"),
        "look at the plot: a misfit at one frequency is a disturbance, a misfit everywhere means wrong standard errors";

    /// The motor's response differs from that of the arm.
    "equivalent-misfit" EquivalentMotorMisfit { rms_standard_errors: f64 }
        Warning, [EQUIVALENT],
        format!("the motor's response differs from the model by {rms_standard_errors:.1} standard errors (rms): it contains \
            friction, or modes that are not in the arm. The intervals include the difference"),
        "look at the plot of the motor's response";

    /// The same where standard errors are not known.
    "equivalent-misfit" EquivalentMotorApart { share: f64, share_of_points: f64 }
        Warning, [EQUIVALENT],
        format!("the motor's response differs from the model by {:.1} % (rms), and the points' responses by {:.2} %: it contains \
            friction or modes that are not in the arm, is not an angle per command, or is poorly measured",
            100.0 * share, 100.0 * share_of_points),
        "look at the plot of the motor's response; give standard errors (columns that end in _std) to separate noise from misfit";

    /// Standard errors of the responses are larger than their errors.
    "equivalent-misfit" EquivalentErrorsLarge { rms_standard_errors: f64 }
        Info, [EQUIVALENT],
        format!("the responses differ from the model by only {rms_standard_errors:.2} standard errors (rms): the given standard \
            errors are too large, and the intervals are wider than they need to be"),
        "check the standard errors of the responses";

    /// The gains of a point do not add up to one: it is not an angle.
    "equivalent-gains" EquivalentNoAngle { missing_gain: f64 }
        Warning, [EQUIVALENT],
        format!("the sum of the gains of a point differs from one by {missing_gain:.3}: the point does not turn with a motor \
            that turns slowly. The form for use as an arm and the state space are not given"),
        "check whether an angle has the wrong sign, or another unit than the motor's angle";

    /// The last mode gets the difference between the sum of the gains and one, which changes a gain by up to this share.
    "equivalent-gains" EquivalentCompleted { missing_gain: f64, change_share: f64 }
        Info, [EQUIVALENT],
        format!("the sum of the gains of a point differs from one by {missing_gain:.3}: for use as an arm the last mode gets the \
            difference, so that an arm that turns as one body is not bent. This changes a gain by up to {:.0} %, and the zeros \
            as well", 100.0 * change_share),
        "the last mode's part of the responses has an error of this size; the parts of the other modes do not";

    /// The motor's response contains Coulomb friction.
    "equivalent-motor-friction" EquivalentMotorFriction { standard_errors: f64 }
        Warning, [EQUIVALENT],
        format!("the motor's response contains a torque against the motion that does not grow with speed, like Coulomb friction \
            ({standard_errors:.1} standard errors from zero): errors of viscous friction and inertia may be larger than their \
            intervals"),
        "remove the friction first (an identification from the logs does so), or measure at larger amplitudes";

    /// Parameters of the arm are negative.
    "equivalent-implausible" EquivalentImplausible { parameters: Vec<String> }
        Warning, [EQUIVALENT],
        format!("{} {} negative, which is not possible for an arm", parameters.join(", "),
            if parameters.len() == 1 { "is" } else { "are" }),
        "check the motor's response: its sign, the torque constant, and whether friction has been removed";

    /// Inertia, viscous friction and coupling cannot be identified.
    "equivalent-without-torque" EquivalentWithoutTorque { error: EquivalentError }
        Warning, [EQUIVALENT],
        error.to_string(),
        "give the motor's response at more frequencies";
}
