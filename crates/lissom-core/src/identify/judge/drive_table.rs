//! The order of the methods for friction, inertia and coupling.

use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::judge::evidence::{Evidence, Methods};
use crate::identify::judge::thresholds::{BEATEN_FACTOR, BEATEN_SHARE, MODEL_MISFIT};
use crate::identify::methods::friction_law::FrictionLaw;
use crate::identify::methods::regression::{MotorRegression, Terms, coupled_tips};
use crate::identify::responses::rational::MotorFit;

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
/// | friction law | terms beyond Coulomb friction and one viscous coefficient predict better |
/// | regression | Coulomb friction comes out of it |
/// | least squares | there is no regression, or it leaves more of the torque than they do |
/// | frequency response | there is no regression |
/// | third harmonic | pairs of sines at ω0 and 3·ω0 |
/// | constant velocity | stretches at constant velocity |
/// | regression | else: what it gives without Coulomb friction |
pub(super) const DRIVE: [Row; 9] = [
    Row { method: Method::OutputError, solution: by_output_error },
    Row { method: Method::FrequencyResponse, solution: by_response_with_modes },
    Row { method: Method::FrictionLaw, solution: by_friction_law },
    Row { method: Method::Regression, solution: by_regression_with_friction },
    Row { method: Method::LeastSquares, solution: by_least_squares },
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

/// The line where another method's solution is refused: by slip phases, and by all motion. `method` is that method.
pub(super) fn lines(
    evidence: &Evidence<'_>,
    method: Method,
) -> impl Iterator<Item = (Option<Method>, DriveEstimates)> {
    let by_phases = evidence.methods.regression.as_ref();
    let by_phases = by_phases.filter(|_| method != Method::Regression);
    let by_all = evidence.methods.least_squares.as_ref().filter(|fit| fit.describes_torque());
    let by_all = by_all.filter(|_| !evidence.rests_on_constant_velocities());
    let by_phases = by_phases.map(|r| (Some(Method::Regression), r.estimates()));
    by_phases
        .into_iter()
        .chain(by_all.map(|fit| (Some(Method::LeastSquares), fit.estimates.clone())))
}

/// The best solution of slip phases alone: that with a law, or with one viscous coefficient.
pub(crate) fn slip_phase_solution(
    regression: Option<&MotorRegression>,
    law: Option<&FrictionLaw>,
) -> Option<(Method, DriveEstimates)> {
    let regression = regression?;
    if let Some(law) = law.filter(|law| law.chosen.departs()) {
        return Some((Method::FrictionLaw, law.chosen.estimates()));
    }
    Some((Method::Regression, regression.estimates()))
}

/// Terms of the solution of slip phases that a method offers, with their covariance; `None` of other methods.
pub(crate) fn slip_phase_terms<'a>(
    method: Method,
    regression: Option<&'a MotorRegression>,
    law: Option<&'a FrictionLaw>,
) -> Option<&'a Terms> {
    match method {
        Method::Regression => regression.map(|r| &r.terms),
        Method::FrictionLaw => law.map(|law| &law.chosen.joint),
        _ => None,
    }
}

fn by_output_error(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let motion = evidence.methods.friction_law.as_ref().map(|law| &law.motion);
    Some(evidence.replay()?.estimates_at(&evidence.campaign.channels, motion))
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
        let coulomb =
            third.coulomb_command.scaled(evidence.campaign.channels.command.torque_per_unit());
        Some(Friction { coulomb: Some(coulomb), ..Friction::default() })
    });
    of_model(evidence, model, &corrected_for.unwrap_or_default())
}

fn of_model(evidence: &Evidence<'_>, model: &MotorFit, friction: &Friction) -> DriveEstimates {
    let back_emf = evidence.campaign.channels.command.back_emf_viscous;
    let viscous = Estimate { value: model.viscous.value - back_emf, std: model.viscous.std };
    let coupling = (!model.coupling.is_empty()).then(|| model.total_coupling());
    DriveEstimates {
        friction: Friction { viscous: Some(viscous), law: None, ..friction.clone() },
        inertia: Some(model.inertia),
        coupling: coupling.filter(|_| !evidence.campaign.channels.tips.is_empty()),
        coupling_by_tip: Vec::new(),
        gravity: None,
    }
}

fn by_friction_law(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::FrictionLaw)
}

fn by_regression_with_friction(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    of_slip_phases(evidence, Method::Regression)
        .filter(|e| has_friction(&e.friction) && !is_beaten(evidence))
}

/// Where slip phases are too few for the regression, or the regression leaves more than this baseline.
fn by_least_squares(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let fit = evidence.methods.least_squares.as_ref()?;
    // Transitions between constant velocities are short: what they show is not worth more than the velocities.
    let missing = evidence.methods.regression.is_none() && !evidence.rests_on_constant_velocities();
    let needed = missing || is_beaten(evidence);
    let sound = fit.describes_torque()
        && fit.estimates.inertia.is_some_and(is_known)
        && fit.estimates.friction.coulomb.is_some_and(is_known);
    (needed && sound).then(|| fit.estimates.clone())
}

/// Whether the regression's estimates leave more of the torque than ordinary least squares do.
pub(super) fn is_beaten(evidence: &Evidence<'_>) -> bool {
    let Methods { regression, friction_law, least_squares, .. } = evidence.methods;
    let phases = slip_phase_solution(regression.as_ref(), friction_law.as_ref());
    let (Some((method, estimates)), Some(baseline)) = (phases, least_squares) else { return false };
    // A law, and a mode, have terms that this equation has not.
    let same =
        method != Method::FrictionLaw && regression.as_ref().is_none_or(|r| r.mode.is_none());
    let left = same.then(|| baseline.left_by(&estimates)).flatten();
    left.is_some_and(|left| left > BEATEN_FACTOR * baseline.relative_residual + BEATEN_SHARE)
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
    let coulomb =
        third.coulomb_command.scaled(evidence.campaign.channels.command.torque_per_unit());
    let friction = Friction { coulomb: Some(coulomb), ..Friction::default() };
    Some(match &evidence.methods.third_harmonic_model {
        Some(model) => of_model(evidence, model, &friction),
        None => DriveEstimates { friction, ..DriveEstimates::default() },
    })
}

fn by_constant_velocity(evidence: &Evidence<'_>) -> Option<DriveEstimates> {
    let found = evidence.methods.constant_velocity.as_ref()?;
    let estimates = found.estimates();
    (estimates.friction != Friction::default()).then_some(estimates)
}

/// Whether Coulomb friction is known, or with a constant load in the one direction that the motor turns.
fn has_friction(friction: &Friction) -> bool {
    match (friction.coulomb, friction.forward, friction.backward) {
        (Some(coulomb), ..) => is_known(coulomb),
        (None, Some(one), None) | (None, None, Some(one)) => is_known(one),
        _ => false,
    }
}

fn is_positive(e: Estimate) -> bool {
    e.value > 0.0
}

/// Whether an estimate is larger than its standard error.
fn is_known(e: Estimate) -> bool {
    e.value > e.std
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::identify::estimate::Estimate;
    use crate::identify::estimate::ModeEstimate;
    use crate::identify::methods::constant_velocity::constant_velocity;
    use crate::identify::methods::least_squares::least_squares;
    use crate::identify::methods::regression::motor_regression;
    use crate::identify::methods::third_harmonic::ThirdHarmonic;
    use crate::identify::options::Options;
    use crate::identify::prepare::prepared::Prepared;
    use crate::record::{
        Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
    };

    const TORQUE_PER_COMMAND: f64 = 2.0;
    const BACK_EMF: f64 = 0.01;

    fn about(value: f64) -> Estimate {
        Estimate { value, std: 0.01 * value }
    }

    /// A sine of 20 s, and friction of 0.3 N·m with 0.05 N·m·s/rad.
    fn campaign(tips: Vec<Tip>) -> Campaign {
        let wave = |of: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (0..10_000).map(|k| of(2e-3 * f64::from(k))).collect()
        };
        let angle = |t: f64| (3.0 * t).sin();
        let torque = |t: f64| {
            let v = 3.0 * (3.0 * t).cos();
            (-0.18 * (3.0 * t).sin() + 0.05 * v + 0.3 * v.signum()) / TORQUE_PER_COMMAND
        };
        let logged = tips.iter().map(|_| wave(&angle)).collect();
        let time = TimeBase::uniform(0.0, 2e-3);
        let run = Run::new("sine", time, wave(&torque), wave(&angle), logged).unwrap();
        Campaign::new(Channels { axis: Axis::Rotary, command: command(), tips }, vec![run]).unwrap()
    }

    fn command() -> Command {
        Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(TORQUE_PER_COMMAND),
            back_emf_viscous: BACK_EMF,
            limit: None,
        }
    }

    fn nothing() -> Methods {
        Methods {
            missing: Vec::new(),
            third_harmonic: None,
            third_harmonic_model: None,
            regression: None,
            regression_residual: None,
            least_squares: None,
            friction_law: None,
            constant_velocity: None,
            beam_regression: None,
            output_error: None,
            beam_model: None,
            motor_model: None,
        }
    }

    fn chosen(campaign: &Campaign, methods: &Methods) -> (Option<Method>, DriveEstimates) {
        choose(&Evidence { campaign, used: campaign, tip_lags_s: &[], runs: &[], methods })
    }

    fn third_harmonic() -> ThirdHarmonic {
        ThirdHarmonic {
            pairs: Vec::new(),
            coulomb_command: about(0.15),
            spread_command: 0.0,
            used: Vec::new(),
        }
    }

    /// Rigid, or with one mode through which a beam is coupled.
    fn model(flexible: bool) -> MotorFit {
        let natural_frequency_rad_s = about(9.0);
        let mode = ModeEstimate { natural_frequency_rad_s, damping_ratio: about(0.01) };
        let drive = [about(0.02), about(0.05), about(0.4)];
        let (mode, drive) = if flexible { (Some(mode), &drive[..]) } else { (None, &drive[..2]) };
        MotorFit::of_estimates(drive, &DMatrix::identity(3, 3), mode, &command()).unwrap()
    }

    #[test]
    fn nothing_gives_nothing() {
        assert_eq!(chosen(&campaign(vec![]), &nothing()), (None, DriveEstimates::default()));
    }

    #[test]
    fn constant_velocities_come_last() {
        let campaign = campaign(vec![]);
        let mut found = constant_velocity(&Prepared::of(&campaign));
        found.viscous = Some(about(0.07));
        let mut methods = Methods { constant_velocity: Some(found), ..nothing() };
        let (method, estimates) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::ConstantVelocity));
        assert_eq!((estimates.friction.viscous, estimates.inertia), (Some(about(0.07)), None));
        methods.third_harmonic = Some(third_harmonic());
        assert_eq!(chosen(&campaign, &methods).0, Some(Method::ThirdHarmonic));
    }

    /// Coulomb friction alone, and with the model that it corrects the response for.
    #[test]
    fn the_third_harmonic_gives_its_own_model_whole() {
        let campaign = campaign(vec![]);
        let mut methods = Methods { third_harmonic: Some(third_harmonic()), ..nothing() };
        let (method, alone) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::ThirdHarmonic));
        assert_eq!(alone.friction.coulomb, Some(about(0.15).scaled(TORQUE_PER_COMMAND)));
        assert_eq!((alone.inertia, alone.friction.viscous), (None, None));
        methods.third_harmonic_model = Some(model(false));
        let (_, with) = chosen(&campaign, &methods);
        assert_eq!(with.inertia, Some(about(0.02)));
    }

    /// The response is corrected for the third harmonic's friction, and back-EMF is no friction.
    #[test]
    fn without_a_regression_the_response_gives_all() {
        let campaign = campaign(vec![]);
        let methods = Methods {
            third_harmonic: Some(third_harmonic()),
            motor_model: Some(model(false)),
            ..nothing()
        };
        let (method, estimates) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::FrequencyResponse));
        assert_eq!(estimates.inertia, Some(about(0.02)));
        assert!((estimates.friction.viscous.unwrap().value - 0.05).abs() < 1e-12);
        assert_eq!(estimates.friction.coulomb, Some(about(0.15).scaled(TORQUE_PER_COMMAND)));
    }

    #[test]
    fn least_squares_stand_in_for_a_regression_that_is_missing() {
        let campaign = campaign(vec![]);
        let methods = Methods {
            least_squares: least_squares(&Prepared::of(&campaign), None),
            motor_model: Some(model(false)),
            ..nothing()
        };
        let (method, estimates) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::LeastSquares));
        assert_eq!(estimates, methods.least_squares.unwrap().estimates);
    }

    #[test]
    fn a_regression_comes_before_its_baseline() {
        let campaign = campaign(vec![]);
        let methods = Methods {
            regression: motor_regression(&Prepared::of(&campaign), &Options::default()),
            least_squares: least_squares(&Prepared::of(&campaign), None),
            motor_model: Some(model(false)),
            ..nothing()
        };
        let (method, estimates) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::Regression));
        assert_eq!(estimates, methods.regression.unwrap().estimates());
    }

    /// A regression that leaves far more of the torque than least squares do is not taken.
    #[test]
    fn a_regression_that_is_beaten_is_not_taken() {
        let campaign = campaign(vec![]);
        let mut regression =
            motor_regression(&Prepared::of(&campaign), &Options::default()).unwrap();
        regression.inertia = regression.inertia.map(|e| e.scaled(3.0));
        let methods = Methods {
            regression: Some(regression),
            least_squares: least_squares(&Prepared::of(&campaign), None),
            ..nothing()
        };
        assert_eq!(chosen(&campaign, &methods).0, Some(Method::LeastSquares));
    }

    /// Slip phases count a beam's inertia as the motor's where no tip shows an angle.
    #[test]
    fn a_response_with_modes_comes_before_slip_phases_without_angles() {
        let tip =
            Tip { name: "tip".to_owned(), quantity: TipQuantity::Acceleration, calibrated: false };
        let campaign = campaign(vec![tip]);
        let methods = Methods {
            regression: motor_regression(&Prepared::of(&campaign), &Options::default()),
            motor_model: Some(model(true)),
            ..nothing()
        };
        let (method, estimates) = chosen(&campaign, &methods);
        assert_eq!(method, Some(Method::FrequencyResponse));
        assert_eq!((estimates.inertia, estimates.coupling), (Some(about(0.02)), Some(about(0.4))));
        let by_phases = methods.regression.as_ref().unwrap();
        assert_eq!(estimates.friction.coulomb, by_phases.coulomb);
    }
}
