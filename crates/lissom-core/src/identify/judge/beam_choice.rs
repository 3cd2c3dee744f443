//! Modes of the beam: which method's are taken.

use crate::identify::drive_estimates::BeamEstimates;
use crate::identify::drive_estimates::{DriveEstimates, Method};
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{Finding, rows};
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::MODEL_MISFIT;
use crate::identify::judge::thresholds::TIPS_COMPLETE;
use crate::identify::methods::regression::BeamRegression;
use crate::identify::output_error::OutputError;
use crate::identify::prepare::run_analysis::RunKind;

/// Whether the beam's equations on the measured tips explain their motion.
pub(super) fn complete(r: &BeamRegression) -> bool {
    r.relative_residual.iter().all(|left| *left < TIPS_COMPLETE)
}

impl Chosen {
    /// The whole solution of a method for the drive, with the modes beside it.
    pub(super) fn of(
        evidence: &Evidence<'_>,
        (method, solution): (Option<Method>, DriveEstimates),
    ) -> Self {
        let beam = choose(evidence, &solution);
        Self { method, drive: solution.clone(), solution, beam }
    }
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
/// | regression of the beam | the tips' responses show no more modes than there are tips, or are bands of other motions than sines, or the tips explain all motion |
/// | tips' responses | else |
const MODES: [ModesRow; 3] = [
    ModesRow { modes: by_output_error },
    ModesRow { modes: by_beam_regression },
    ModesRow { modes: by_tip_responses },
];

/// The beam: modes by the table, and the coupling of the drive's solution.
pub(super) fn choose(evidence: &Evidence<'_>, drive: &DriveEstimates) -> BeamEstimates {
    let offered = |row: &ModesRow| (row.modes)(evidence);
    let beam = evidence.methods.beam_regression.as_ref().filter(|_| evidence.replay().is_none());
    let by_motor = beam.and_then(|beam| coupling_by_motor(drive, &beam.shares));
    BeamEstimates {
        modes: MODES.iter().find_map(offered).unwrap_or_default(),
        coupling: by_motor.or(drive.coupling),
        coupling_by_tip: drive.coupling_by_tip.clone(),
    }
}

/// The torque per angle of the motor with the modes held, Σ κ_i·s_i: κ_i is the torque per angle between motor and tip i, which is
/// s_i times that between motor and modes.
fn coupling_by_motor(drive: &DriveEstimates, shares: &[Estimate]) -> Option<Estimate> {
    let by_tip: Vec<Estimate> = drive.coupling_by_tip.iter().copied().collect::<Option<_>>()?;
    let coupling = drive.coupling.filter(|_| by_tip.len() == shares.len())?;
    let both = by_tip.iter().zip(shares);
    let value: f64 = both.clone().map(|(k, s)| k.value * s.value).sum();
    let of_shares: f64 = both.map(|(k, s)| (k.value * s.std).powi(2)).sum();
    let std = (coupling.std * value / coupling.value).hypot(of_shares.sqrt());
    std.is_finite().then_some(Estimate { value, std })
}

fn by_output_error(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    let found = evidence.replay().filter(|oe| !oe.arm.modes.is_empty());
    found.map(OutputError::mode_estimates)
}

fn by_beam_regression(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    let methods = evidence.methods;
    let tips = evidence.campaign.channels.tips.len();
    let shown = methods.beam_model.as_ref().map_or(0, |b| b.modes.len());
    // As many equations as tips: where these explain all motion there are no further modes. Bands of other motions than
    // sines may be of what hardly moved.
    let by_sines = evidence.runs.iter().any(|r| matches!(r.kind, RunKind::Sinusoidal(_)));
    let told = |r: &&BeamRegression| shown <= tips || complete(r) || !by_sines;
    let found = methods.beam_regression.as_ref().filter(told);
    found.map(|r| r.modes.clone())
}

fn by_tip_responses(evidence: &Evidence<'_>) -> Option<Vec<ModeEstimate>> {
    evidence.methods.beam_model.as_ref().map(|b| b.modes.clone())
}

/// What is missing of the beam.
pub(super) fn findings(evidence: &Evidence<'_>, beam: &BeamEstimates) -> Vec<Finding> {
    let mut found: Vec<Finding> =
        beam.modes.iter().enumerate().filter_map(negative_damping).collect();
    let tips = evidence.campaign.channels.tips.len();
    if evidence.replay().is_some_and(|oe| !oe.arm.modes.is_empty()) {
        return found;
    }
    if beam.modes.is_empty() && tips > 0 && !evidence.rests_on_constant_velocities() {
        found.push(Finding::new(rows::ModesNotFound {}));
    }
    let model = evidence.methods.motor_model.as_ref();
    // Noise and varying friction bend the response as well; the regression finds a mode itself.
    if tips == 0
        && evidence.methods.regression.is_none()
        && let Some(model) = model.filter(|m| m.weighted_rms < MODEL_MISFIT)
        && let Some(pole) = model.poles.first()
    {
        let omega_rad_s = pole.omega_rad_s;
        found.push(Finding::new(rows::FlexibleWithoutTip { omega_rad_s }));
    }
    found
}

/// A mode that would gain energy.
fn negative_damping((i, mode): (usize, &ModeEstimate)) -> Option<Finding> {
    let negative = mode.given_damping_ratio().is_none();
    let ratio = mode.damping_ratio;
    negative.then(|| Finding::new(rows::NegativeDamping { mode: i + 1, ratio }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::judge::evidence::Methods;
    use crate::identify::prepare::prepared::Prepared;
    use crate::identify::responses::rational::BeamFit;
    use crate::record::{
        Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase, Tip, TipQuantity,
    };

    fn mode(omega_rad_s: f64) -> ModeEstimate {
        let about = |value: f64| Estimate { value, std: 0.01 * value };
        ModeEstimate { natural_frequency_rad_s: about(omega_rad_s), damping_ratio: about(0.01) }
    }

    /// A sine in steady state, or its beginning alone: a motion of another shape.
    fn campaign(is_sine: bool) -> Campaign {
        let command = Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        };
        let tip = Tip { name: "tip".into(), quantity: TipQuantity::Angle, calibrated: true };
        let channels = Channels { axis: Axis::Rotary, command, tips: vec![tip] };
        let wave = |size: f64| -> Vec<f64> {
            let at = |k: i32| {
                (0.02 * f64::from(k)).sin() * if is_sine { 1.0 } else { 1e-3 * f64::from(k) }
            };
            (0..4000).map(|k| size * at(k)).collect()
        };
        let time = TimeBase::uniform(0.0, 5e-3);
        let run = Run::new("run", time, wave(1.0), wave(-0.5), vec![wave(-0.6)]).unwrap();
        let run = if is_sine { run.with_omega(4.0).unwrap() } else { run };
        Campaign::new(channels, vec![run]).unwrap()
    }

    fn frequencies(methods: &Methods, of_sines: bool) -> Vec<f64> {
        let campaign = campaign(of_sines);
        let prepared = Prepared::of(&campaign);
        let beam = choose(&Evidence::of(&prepared, methods), &DriveEstimates::default());
        beam.modes.iter().map(|m| m.natural_frequency_rad_s.value).collect()
    }

    fn regression(relative_residual: f64) -> BeamRegression {
        BeamRegression {
            window_s: vec![0.1],
            relative_residual: vec![relative_residual],
            shares: vec![Estimate { value: 1.0, std: 0.0 }],
            lags_s: vec![0.0],
            modes: vec![mode(6.0)],
            candidates: Vec::new(),
            stiffness: nalgebra::DMatrix::zeros(1, 1),
        }
    }

    /// One tip: a second mode in its responses to sines takes precedence unless the regression explains all motion.
    #[test]
    fn modes_are_of_the_first_row_that_offers_some() {
        assert!(frequencies(&Methods::default(), true).is_empty());
        let shown = |omegas: &[f64]| {
            let mut fit = BeamFit::of_mode(mode(omegas[0]));
            fit.modes = omegas.iter().map(|w| mode(*w)).collect();
            Some(fit)
        };
        let of_responses = Methods { beam_model: shown(&[5.0, 40.0]), ..Methods::default() };
        assert_eq!(frequencies(&of_responses, true), [5.0, 40.0]);
        let beam_regression = Some(regression(2.0 * TIPS_COMPLETE));
        let both = Methods { beam_regression, ..of_responses };
        assert_eq!(frequencies(&both, true), [5.0, 40.0]);
        // Bands of a motion that is no sine may be of what hardly moved.
        assert_eq!(frequencies(&both, false), [6.0]);
        let complete = Methods { beam_regression: Some(regression(0.5 * TIPS_COMPLETE)), ..both };
        assert_eq!(frequencies(&complete, true), [6.0]);
        let one = Methods {
            beam_model: shown(&[5.0]),
            beam_regression: Some(regression(2.0 * TIPS_COMPLETE)),
            ..Methods::default()
        };
        assert_eq!(frequencies(&one, true), [6.0]);
    }

    #[test]
    fn a_negative_damping_ratio_is_refused() {
        let mut of_mode = mode(5.0);
        of_mode.damping_ratio = Estimate { value: -0.01, std: 0.003 };
        let methods = Methods { beam_model: Some(BeamFit::of_mode(of_mode)), ..Methods::default() };
        let campaign = campaign(true);
        let prepared = Prepared::of(&campaign);
        let evidence = Evidence::of(&prepared, &methods);
        let beam = choose(&evidence, &DriveEstimates::default());
        assert!(beam.modes[0].given_damping_ratio().is_none());
        let found = findings(&evidence, &beam);
        assert!(found.iter().any(Finding::is::<rows::NegativeDamping>), "{found:?}");
    }
}
