//! Linear models from estimates or from fitted responses.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::FrictionLaw;
use crate::identify::methods::regression::{BeamRegression, MotorRegression, Terms, coupled_tips};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    BeamFit, MotorData, MotorFit, TipData, TipForm, fit_at_once, fit_beam, fit_motor, fit_motor_at,
};
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::responses::response_table::tip_model;
use crate::identify::responses::thresholds::MODEL_EXPLAINED;
use crate::record::{Campaign, Tip};

/// The model that the slip phases' estimates make, where they explain all: a rigid axis without
/// tips and without a mode, or one tip that follows one mode.
pub(crate) fn estimates_model(
    campaign: &Campaign,
    (regression, drive, terms): (&MotorRegression, &DriveEstimates, &Terms),
    law: Option<&FrictionLaw>,
    beam: Option<&BeamRegression>,
) -> Option<(MotorFit, Option<BeamFit>)> {
    let left = law.map_or(regression.relative_residual, |law| law.relative_residual[1]);
    if left >= MODEL_EXPLAINED || regression.mode.is_some() {
        return None;
    }
    let lag = law.and_then(|law| law.lag);
    // Of a law the slope that is there at any speed: its other terms are no part of a linear model.
    let friction = &drive.friction;
    let viscous = friction.law.as_ref().map_or(friction.viscous, |law| law.viscous)?;
    let inertia = drive.inertia?;
    let through = match (campaign.channels.tips.len(), beam) {
        (0, _) => None,
        (1, Some(beam)) if beam.relative_residual[0] < MODEL_EXPLAINED => {
            Some((*beam.modes.first()?, drive.coupling?))
        }
        _ => return None,
    };
    let (mode, coupling) = through.unzip();
    let drive: Vec<Estimate> = [inertia, viscous].into_iter().chain(coupling).collect();
    let correlation = terms.drive_correlation();
    let model = MotorFit::of_estimates(&drive, &correlation, mode, &campaign.channels.command)?;
    let model = match lag {
        // Of a filter the delay that it has at low frequencies.
        Some(lag) => model.with_delay(Estimate { value: lag.time_s, std: lag.std_s }),
        None => model,
    };
    (inertia.value > 0.0).then(|| (model, mode.map(BeamFit::of_mode)))
}

/// The beam's modes from its tips' responses to the motor.
pub(crate) fn beam_model(campaign: &Campaign, responses: &[ResponsePoint]) -> Option<BeamFit> {
    let (omega, data) = tip_data(campaign, responses)?;
    fit_beam(&omega, &data)
}

/// Motor and beam, from what is `known` of them: the motor's by its responses where it is not known yet. Where
/// no tip gives an angle both by poles that both show: slip phases then do not tell the motor's inertia from
/// the beam's, and each response alone knows less.
pub(crate) fn motor_and_beam(
    campaign: &Campaign,
    responses: &[ResponsePoint],
    constant: f64,
    known: (Option<MotorFit>, Option<BeamFit>),
) -> (Option<MotorFit>, Option<BeamFit>) {
    let (motor, beam) = known;
    let at_once = || {
        let beam = beam.as_ref().filter(|_| coupled_tips(campaign).is_empty())?;
        let (omega, data) = tip_data(campaign, responses)?;
        fit_at_once(&omega, &data, beam, &motor_data(responses, constant))
    };
    if let Some(both) = at_once() {
        return (Some(both.motor), Some(both.beam));
    }
    (motor.or_else(|| motor_model(responses, constant, beam.as_ref())), beam)
}

/// Frequencies at which all tips' responses are known, and these.
fn tip_data(campaign: &Campaign, responses: &[ResponsePoint]) -> Option<(Vec<f64>, Vec<TipData>)> {
    let tips = &campaign.channels.tips;
    if tips.is_empty() {
        return None;
    }
    let complete: Vec<&ResponsePoint> =
        responses.iter().filter(|p| p.tips.iter().all(Option::is_some)).collect();
    let omega: Vec<f64> = complete.iter().map(|p| p.omega_rad_s).collect();
    let data: Vec<TipData> = tips
        .iter()
        .enumerate()
        .map(|(i, tip)| {
            let modelled: Vec<_> = complete
                .iter()
                .filter_map(|p| Some(tip_model(tip.quantity, tip.calibrated, p.tips[i]?)))
                .collect();
            let form = modelled.first().map(|m| m.0)?;
            Some(TipData { form, response: modelled.into_iter().map(|m| m.1).collect() })
        })
        .collect::<Option<_>>()?;
    Some((omega, data))
}

/// Motor and coupling from its corrected responses, the beam's modes where they are known.
pub(crate) fn motor_model(
    responses: &[ResponsePoint],
    constant: f64,
    beam: Option<&BeamFit>,
) -> Option<MotorFit> {
    let data = motor_data(responses, constant);
    let Some(beam) = beam else { return fit_motor(&data, None) };
    fit_motor_at(&data, &beam.modal_poles(), beam.modal_covariance().as_ref())
}

/// The motor's corrected responses that nothing speaks against.
pub(crate) fn motor_data(responses: &[ResponsePoint], constant: f64) -> MotorData {
    let sound: Vec<_> = responses
        .iter()
        .filter(|p| !p.flagged)
        .filter_map(|p| Some((p.omega_rad_s, p.motor_corrected?)))
        .collect();
    MotorData {
        omega_rad_s: sound.iter().map(|p| p.0).collect(),
        response: sound.iter().map(|p| p.1).collect(),
        torque_per_command: constant,
    }
}

/// Frequencies, and θ_i/θ_m of every tip at them; `None` where a tip's angle is not known.
pub(crate) fn tip_responses(
    campaign: &Campaign,
    responses: &[ResponsePoint],
) -> Option<(Vec<f64>, Vec<Vec<Response>>)> {
    let tips = &campaign.channels.tips;
    let complete = responses.iter().filter(|p| p.tips.iter().all(Option::is_some));
    let complete: Vec<&ResponsePoint> = complete.collect();
    let of_tip = |(i, tip): (usize, &Tip)| -> Option<Vec<Response>> {
        let angle = |p: &&ResponsePoint| match tip_model(tip.quantity, tip.calibrated, p.tips[i]?) {
            (TipForm::Angle, response) => tip.calibrated.then_some(response),
            (TipForm::SecondDerivative, _) => None,
        };
        complete.iter().map(angle).collect()
    };
    let outputs = tips.iter().enumerate().map(of_tip).collect::<Option<_>>()?;
    Some((complete.iter().map(|p| p.omega_rad_s).collect(), outputs))
}
