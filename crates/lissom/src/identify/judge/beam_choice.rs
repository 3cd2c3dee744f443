//! Modes of the beam: which method's are taken.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::ModeEstimate;
use crate::identify::findings::{BeamFinding, Finding};
use crate::identify::identified::BeamEstimates;
use crate::identify::judge::evidence::Evidence;
use crate::identify::judge::thresholds::MODEL_MISFIT;
use crate::identify::judge::thresholds::TIPS_COMPLETE;
use crate::identify::methods::output_error::OutputError;
use crate::identify::methods::regression::BeamRegression;

/// Whether the beam's equations on the measured tips explain their motion.
pub(super) fn complete(r: &BeamRegression) -> bool {
    r.relative_residual.iter().all(|left| *left < TIPS_COMPLETE)
}

/// A method in the order of trust: the first that offers modes which nothing speaks against is taken.
struct ModesRow {
    /// Its modes, where it has some to offer.
    modes: fn(&Evidence<'_>) -> Option<Vec<ModeEstimate>>,
}

/// Modes of the beam.
///
/// | method | offers modes where |
/// | --- | --- |
/// | output error | its arm describes the runs and has modes |
/// | regression of the beam | the tips' responses show no more modes than there are tips, or the tips explain all motion |
/// | tips' responses | else |
const MODES: [ModesRow; 3] = [
    ModesRow { modes: by_output_error },
    ModesRow { modes: by_beam_regression },
    ModesRow { modes: by_tip_responses },
];

/// The beam: modes by the table, and the coupling of the drive's solution.
pub(super) fn choose(evidence: &Evidence<'_>, drive: &DriveEstimates) -> BeamEstimates {
    let offered = |row: &ModesRow| (row.modes)(evidence);
    BeamEstimates {
        modes: MODES.iter().find_map(offered).unwrap_or_default(),
        coupling: drive.coupling,
        coupling_by_tip: drive.coupling_by_tip.clone(),
    }
}

fn by_output_error(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    let found = evidence.replay().filter(|oe| !oe.arm.modes.is_empty());
    found.map(OutputError::mode_estimates)
}

fn by_beam_regression(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    let methods = evidence.methods;
    let tips = evidence.campaign.channels.tips.len();
    let shown = methods.beam_model.as_ref().map_or(0, |b| b.modes.len());
    // As many equations as tips: where these explain all motion there are no further modes.
    let found = methods.beam_regression.as_ref().filter(|r| shown <= tips || complete(r));
    found.map(|r| r.modes.clone())
}

fn by_tip_responses(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    evidence.methods.beam_model.as_ref().map(|b| b.modes.clone())
}

/// What is missing of the beam.
pub(super) fn findings(evidence: &Evidence<'_>, beam: &BeamEstimates) -> Vec<Finding> {
    let mut found = Vec::new();
    let tips = evidence.campaign.channels.tips.len();
    if evidence.replay().is_some_and(|oe| !oe.arm.modes.is_empty()) {
        return found;
    }
    if beam.modes.is_empty() && tips > 0 && !evidence.rests_on_constant_velocities() {
        found.push(Finding::new(BeamFinding::ModesNotFound));
    }
    let model = evidence.methods.motor_model.as_ref();
    if tips == 0
        && let Some(model) = model.filter(|m| m.weighted_rms < MODEL_MISFIT)
        && let Some(pole) = model.poles.first()
    {
        let omega_rad_s = pole.omega_rad_s;
        found.push(Finding::new(BeamFinding::FlexibleWithoutTip { omega_rad_s }));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::estimate::Estimate;
    use crate::identify::judge::evidence::Methods;
    use crate::identify::prepare::prepared::Prepared;
    use crate::identify::responses::rational::BeamFit;
    use crate::record::{
        Axis, Campaign, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity,
    };

    fn mode(omega_rad_s: f64) -> ModeEstimate {
        let about = |value: f64| Estimate { value, std: 0.01 * value };
        ModeEstimate { natural_frequency_rad_s: about(omega_rad_s), damping_ratio: about(0.01) }
    }

    fn campaign() -> Campaign {
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let tip = Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
        Campaign { channels, runs: Vec::new(), gravity: false, mgl_nm: None }
    }

    fn frequencies(methods: &Methods) -> Vec<f64> {
        let campaign = campaign();
        let prepared = Prepared::of(&campaign);
        let beam = choose(&Evidence::of(&prepared, methods), &DriveEstimates::default());
        beam.modes.iter().map(|m| m.natural_frequency_rad_s.value).collect()
    }

    fn regression(relative_residual: f64) -> BeamRegression {
        BeamRegression {
            window_s: vec![0.1],
            relative_residual: vec![relative_residual],
            modes: vec![mode(6.0)],
            candidates: Vec::new(),
            stiffness: nalgebra::DMatrix::zeros(1, 1),
        }
    }

    /// One tip: a second mode in its responses takes precedence unless the regression explains all motion.
    #[test]
    fn modes_are_of_the_first_row_that_offers_some() {
        assert!(frequencies(&Methods::default()).is_empty());
        let shown = |omegas: &[f64]| {
            let mut fit = BeamFit::of_mode(mode(omegas[0]));
            fit.modes = omegas.iter().map(|w| mode(*w)).collect();
            Some(fit)
        };
        let of_responses = Methods { beam_model: shown(&[5.0, 40.0]), ..Methods::default() };
        assert_eq!(frequencies(&of_responses), [5.0, 40.0]);
        let beam_regression = Some(regression(2.0 * TIPS_COMPLETE));
        let both = Methods { beam_regression, ..of_responses };
        assert_eq!(frequencies(&both), [5.0, 40.0]);
        let complete = Methods { beam_regression: Some(regression(0.5 * TIPS_COMPLETE)), ..both };
        assert_eq!(frequencies(&complete), [6.0]);
        let one = Methods {
            beam_model: shown(&[5.0]),
            beam_regression: Some(regression(2.0 * TIPS_COMPLETE)),
            ..Methods::default()
        };
        assert_eq!(frequencies(&one), [6.0]);
    }
}
