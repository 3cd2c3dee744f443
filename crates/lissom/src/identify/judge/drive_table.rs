//! The order of the methods for friction, inertia and coupling.

use super::evidence::{Evidence, Methods};
use crate::identify::Estimate;
use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::friction_estimates::Friction;
use crate::identify::friction_law::FrictionLaw;
use crate::identify::rational::MotorFit;
use crate::identify::regression::{MotorRegression, coupled_tips};

/// Weighted residual of the motor's rational model from which on its estimates are not taken \[standard errors, rms\].
///
/// Convention: three times what its own standard errors explain.
pub(super) const MODEL_MISFIT: f64 = 3.0;

/// A method in the order of trust: the first that offers a solution which nothing speaks against is taken, whole.
pub(super) struct Row {
    pub(super) method: Method,
    /// Its whole solution, where it has one to offer.
    pub(super) solution: fn(&Evidence<'_>) -> Option<DriveEstimates>,
}

/// Friction, inertia and coupling.
///
/// | method | offers a solution where |
/// | --- | --- |
/// | output error | its arm describes the runs to a few times the sensors' noise |
/// | frequency response | no tip shows an angle and the response has modes: slip phases count the beam's inertia as the motor's |
/// | friction law | the logs reject Coulomb friction with one viscous coefficient |
/// | regression by direction | viscous friction differs by direction, and no law was found |
/// | regression | Coulomb friction comes out of it |
/// | frequency response | there is no regression |
/// | third harmonic | pairs of sines at ω0 and 3·ω0 |
/// | constant velocity | stretches at constant velocity |
/// | regression | else: what it gives without Coulomb friction |
pub(super) const DRIVE: [Row; 9] = [
    Row { method: Method::OutputError, solution: by_output_error },
    Row { method: Method::FrequencyResponse, solution: by_response_with_modes },
    Row { method: Method::FrictionLaw, solution: by_friction_law },
    Row { method: Method::RegressionByDirection, solution: by_direction },
    Row { method: Method::Regression, solution: by_regression_with_friction },
    Row { method: Method::FrequencyResponse, solution: by_response },
    Row { method: Method::ThirdHarmonic, solution: by_third_harmonic },
    Row { method: Method::ConstantVelocity, solution: by_constant_velocity },
    Row { method: Method::Regression, solution: by_regression },
];

/// The first whole solution of the table.
pub(super) fn choose(evidence: &Evidence<'_>) -> (Option<Method>, DriveEstimates) {
    let offered = |row: &Row| Some((Some(row.method), (row.solution)(evidence)?));
    DRIVE.iter().find_map(offered).unwrap_or_default()
}

/// The best solution of slip phases alone: law, by direction, one viscous coefficient.
pub(crate) fn slip_phase_solution(
    regression: Option<&MotorRegression>,
    law: Option<&FrictionLaw>,
) -> Option<(Method, DriveEstimates)> {
    let regression = regression?;
    if let Some(law) = law.filter(|law| law.chosen.departs()) {
        return Some((Method::FrictionLaw, law.chosen.estimates()));
    }
    if let Some(split) = &regression.viscous_by_direction {
        return Some((Method::RegressionByDirection, split.estimates.clone()));
    }
    Some((Method::Regression, regression.estimates()))
}

fn by_output_error(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    Some(evidence.replay()?.estimates(&evidence.campaign.channels))
}

fn by_response_with_modes(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let model = evidence.methods.motor_model.as_ref()?;
    let coupled = coupled_tips(evidence.campaign).is_empty()
        && !model.coupling.is_empty()
        && model.poles_given
        && model.weighted_rms < MODEL_MISFIT;
    coupled.then(|| of_response(evidence, model))
}

fn by_response(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let Methods { regression: None, motor_model: Some(model), .. } = evidence.methods else {
        return None;
    };
    Some(of_response(evidence, model))
}

/// A rational model with the friction that its response was corrected for.
fn of_response(evidence: &Evidence<'_>, model: &MotorFit) -> DriveEstimates {
    let methods = evidence.methods;
    let by_phases = methods.regression.as_ref().filter(|r| r.coulomb.is_some_and(is_positive));
    let corrected_for = by_phases.map(|r| r.estimates().friction).or_else(|| {
        let third = methods.third_harmonic.as_ref()?;
        let coulomb = third.coulomb_command.scaled(evidence.torque_per_command());
        Some(Friction { coulomb: Some(coulomb), ..Friction::default() })
    });
    of_model(evidence, model, corrected_for.unwrap_or_default())
}

fn of_model(evidence: &Evidence<'_>, model: &MotorFit, friction: Friction) -> DriveEstimates {
    let back_emf = evidence.campaign.channels.command.back_emf_viscous;
    let viscous = Estimate { value: model.viscous.value - back_emf, std: model.viscous.std };
    let coupling = (!model.coupling.is_empty()).then(|| Estimate {
        value: model.coupling.iter().map(|e| e.value).sum(),
        std: model.coupling.iter().map(|e| e.std * e.std).sum::<f64>().sqrt(),
    });
    DriveEstimates {
        friction: Friction { viscous: Some(viscous), viscous_by_direction: None, ..friction },
        inertia: Some(model.inertia),
        coupling: coupling.filter(|_| !evidence.campaign.channels.tips.is_empty()),
        coupling_by_tip: Vec::new(),
    }
}

fn by_friction_law(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::FrictionLaw)
}

fn by_direction(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::RegressionByDirection)
}

fn by_regression_with_friction(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::Regression)
        .filter(|e| e.friction.coulomb.is_some_and(is_known))
}

fn by_regression(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::Regression)
}

fn of_slip_phases(evidence: &Evidence<'_>, method: Method) -> Option<DriveEstimates> {
    let Methods { regression, friction_law, .. } = evidence.methods;
    let (found, estimates) = slip_phase_solution(regression.as_ref(), friction_law.as_ref())?;
    (found == method).then_some(estimates)
}

fn by_third_harmonic(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let third = evidence.methods.third_harmonic.as_ref()?;
    let coulomb = third.coulomb_command.scaled(evidence.torque_per_command());
    let friction = Friction { coulomb: Some(coulomb), ..Friction::default() };
    Some(match &third.motor {
        Some(model) => of_model(evidence, model, friction),
        None => DriveEstimates { friction, ..DriveEstimates::default() },
    })
}

fn by_constant_velocity(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let found = evidence.methods.constant_velocity.as_ref()?;
    let estimates = found.estimates();
    (estimates.friction != Friction::default()).then_some(estimates)
}

fn is_positive(e: Estimate) -> bool {
    e.value > 0.0
}

/// Whether an estimate is larger than its standard error.
fn is_known(e: Estimate) -> bool {
    e.value > e.std
}
