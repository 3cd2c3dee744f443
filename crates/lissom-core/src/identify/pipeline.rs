//! The steps from a campaign to its result: prepare, methods, responses, judge.

use thiserror::Error;

use crate::identify::equivalent::{Equivalent, EquivalentData, equivalent};
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::identified::Identified;
use crate::identify::judge::{Evidence, Methods, conclude, slip_phase_solution, slip_phase_terms};
use crate::identify::linear_models::LinearModels;
use crate::identify::methods::constant_velocity;
use crate::identify::methods::friction_law::{
    FrictionLaw, KnownArm, friction_law, predicts_better,
};
use crate::identify::methods::least_squares::least_squares;
use crate::identify::methods::regression::thresholds::FEW_PHASES;
use crate::identify::methods::regression::{
    BeamRegression, MotorRegression, beam_regression, other_hold, with_tips_in_time,
};
use crate::identify::methods::rigid_equation::rigid_equation;
use crate::identify::methods::third_harmonic::{ThirdHarmonic, third_harmonic};
use crate::identify::methods::unlike_runs::regression_of_like_runs;
use crate::identify::options::{Effort, Options};
use crate::identify::output_error::starting_arms::{starting_arms, starts_by_bending, with_law};
use crate::identify::output_error::{OutputError, OutputErrorStart, output_error};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::RunKind;
use crate::identify::replayed_responses::response_step::{ResponseTables, Responses, rigid_model};
use crate::identify::responses::models::{beam_model, estimates_model};
use crate::identify::responses::rational::BeamFit;
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::thresholds::{
    BEAM_RESIDUAL, BEAM_SHARES, CONSTANT_VELOCITY_ALONE, CONSTANT_VELOCITY_FEW, MODE_DAMPING_LEAST,
    PRESENT, REFUSED_TORQUE, UNEXPLAINED_TORQUE,
};
use crate::record::Campaign;
use crate::replay::ModalArm;

/// Error of [`identify`]: the campaign cannot be identified at all.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// Every run has a constant channel.
    #[error("every run has a constant channel: {}", counted(constant, *runs))]
    NothingMoves {
        /// Number of runs.
        runs: usize,
        /// Channels that are constant somewhere, and in how many runs.
        constant: Vec<(String, usize)>,
    },
    /// The length of the window is not positive and finite.
    #[error("the length of the window is {found_s} s, but must be positive and finite")]
    Window {
        /// The length given \[s\].
        found_s: f64,
    },
}

fn counted(constant: &[(String, usize)], runs: usize) -> String {
    let count = |(name, count): &(String, usize)| format!("{name} in {count} of {runs}");
    constant.iter().map(count).collect::<Vec<_>>().join(", ")
}

/// A stage of the identification, to show progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Periods and harmonics of run `.0` (counted from 0) of `.1` runs.
    Run(usize, usize),
    /// Regression in slip phases.
    Regression,
    /// Regression of the beam's equation.
    Beam,
    /// Output-error method.
    OutputError,
    /// Frequency responses and rational models.
    Responses,
}

impl Stage {
    /// Number of stages of an identification of so many runs.
    pub fn count(runs: usize) -> usize {
        runs + 4
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Run(..) => "periods and harmonics",
            Self::Regression => "regression",
            Self::Beam => "beam",
            Self::OutputError => "output-error method",
            Self::Responses => "responses and models",
        }
    }
}

/// Identifies drive and beam from a campaign.
///
/// Runs are prepared once: channels are checked, noise is measured, harmonics of sinusoidal runs are computed. Each
/// method computes its own complete estimates from the prepared runs: regression in slip phases, friction law, third
/// harmonic, constant velocity, least squares, and output error. Frequency responses are corrected for friction, and
/// rational models are fitted to them. Then a table chooses one method, whose complete solution gives friction, inertia
/// and coupling, and refuses what the data do not support. `progress` is called at the beginning of each stage.
///
/// ```
/// # use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
/// # let (t, w) = (0.002, 3.0);
/// # let wave = |f: &dyn Fn(f64) -> f64| (0..10_000).map(|k| f(t * f64::from(k))).collect::<Vec<f64>>();
/// # let motor = wave(&|s| (w * s).sin());
/// # let torque = wave(&|s| -0.02 * w * w * (w * s).sin() + 0.05 * w * (w * s).cos() + 0.3 * (w * s).cos().signum());
/// # let command = Command { quantity: CommandQuantity::Current, hold: Hold::Measured, torque_per_command: Some(1.0), back_emf_viscous: 0.0, limit: None };
/// # let run = Run::new("sine", TimeBase::uniform(0.0, t), torque, motor, vec![]).unwrap();
/// # let campaign = Campaign::new(Channels { axis: Axis::Rotary, command, tips: vec![] }, vec![run]).unwrap();
/// use lissom::identify::{Options, identify}; // of a sine with J = 0.02, V = 0.05, CF = 0.3
/// let found = identify(&campaign, &Options::default(), |_stage| ())?;
/// assert!((found.friction.coulomb.unwrap().value - 0.3).abs() < 1e-3);
/// # Ok::<(), lissom::identify::IdentifyError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Sections 4 (step 6), 5 and 6.2.2]` for the third harmonic, the corrected responses and their models.
///
/// # Errors
/// [`IdentifyError`] if no run moves, or if an option is not valid. Everything else is reported by findings.
#[expect(clippy::too_many_lines, reason = "the order of the methods, in one place")]
pub fn identify(
    campaign: &Campaign,
    options: &Options,
    mut progress: impl FnMut(Stage),
) -> Result<Identified, IdentifyError> {
    possible(options)?;
    let runs = campaign.runs.len();
    let prepared = Prepared::new(campaign, options, |run| progress(Stage::Run(run, runs)));
    let (constant_velocity, steady_findings) = constant_velocity::where_meant(&prepared);
    if prepared.used().runs.is_empty() && constant_velocity.is_none() {
        return Err(IdentifyError::NothingMoves { runs, constant: prepared.constant_channels() });
    }
    progress(Stage::Regression);
    // From constant velocities alone it is accepted if their transitions show the inertia.
    let doubted = prepared.has_only_constant_velocities() && constant_velocity.is_some();
    let (prepared, line_of_runs) = regression_of_like_runs(prepared, options);
    let any_regression = line_of_runs.filter(|r| !doubted || is_sound_alone(r));
    let (prepared, mut any_regression, late_tips) =
        with_tips_in_time(prepared, any_regression, options);
    progress(Stage::Beam);
    // Each loops over the runs on all threads, and leaves some of them idle between its loops.
    let (mut model, beside) = rayon::join(
        || any_regression.as_ref().and_then(|r| friction_law(&prepared, r)),
        || (beam_regression(&prepared), third_harmonic(&prepared)),
    );
    if let Some(rigid) = &any_regression
        && let Some(flexible) = &rigid.with_mode
    {
        let with_mode = friction_law(&prepared, flexible);
        let [law, with] = [&model, &with_mode].map(|model| model.as_ref().map(|(law, _)| law));
        if predicts_better((flexible, with), (&prepared, rigid, law)) {
            let (left_out, beside_others) = (rigid.left_out.clone(), rigid.beside_others.clone());
            let flexible = (**flexible).clone();
            any_regression = Some(MotorRegression { left_out, beside_others, ..flexible });
            model = with_mode;
        }
    }
    let sound = any_regression.as_ref().filter(|r| r.relative_residual < REFUSED_TORQUE);
    let hold = sound.and_then(|r| assumed_hold(prepared.used(), options, r));
    let possible = model.as_ref().map_or_else(Vec::new, |(model, _)| model.possible.clone());
    let missing = model.as_ref().map_or_else(Vec::new, |(model, _)| model.missing.clone());
    let regression_residual = any_regression.as_ref().map(|r| r.relative_residual);
    let lag = model.as_ref().and_then(|(model, _)| model.lag);
    let regression = any_regression.clone().filter(|r| r.relative_residual < REFUSED_TORQUE);
    let law = model.filter(|_| regression.is_some());
    // What is found on slip phases is of commands that are as late as the angle.
    let late = lag.map(|lag| prepared.using(lag.late(prepared.used())));
    let in_time = late.as_ref().unwrap_or(&prepared);
    let window_s = regression.as_ref().map(|r| r.window_s);
    let line = least_squares(in_time, window_s);
    let (any_beam_regression, third_harmonic) = beside;

    let constant = campaign.channels.command.torque_per_unit();
    let best = coulomb_command(regression.as_ref(), third_harmonic.as_ref(), constant);
    let tables = ResponseTables { prepared: &prepared, coulomb_command: best };
    let shown = tables.without_friction_known();
    let tips_model = beam_model(campaign, &shown);
    let replayed = any_regression.filter(|_| options.effort != Effort::Quick);
    let output_error = replayed.and_then(|motor| {
        progress(Stage::OutputError);
        let corrected = || tables.with_square_wave(best);
        let (beam, tips) = (any_beam_regression.as_ref(), tips_model.as_ref());
        let law = law.as_ref().map(|(law, _)| law);
        let drive = law.map_or_else(|| motor.estimates(), |law| law.chosen.estimates());
        // A replay knows a delay of the command, which it finds best itself, but no filter and no late goal.
        let delay = lag.filter(|lag| lag.is_delay_of(campaign));
        let replayed = if delay.is_some() { &prepared } else { in_time };
        let lag_s = delay.map_or(0.0, |lag| lag.time_s);
        let known = (&drive, &motor, lag_s);
        let mut arms = starts_by_bending(replayed, options);
        arms.extend(starting_arms(replayed.used(), known, beam, tips, &shown, corrected));
        let arms = with_law(law, arms, replayed.used());
        let shown_rad_s = tips.map_or(Vec::new(), BeamFit::frequencies_rad_s);
        let start = OutputErrorStart { shown_rad_s, ..start_of(replayed, options, arms, law) };
        let found = output_error(replayed, &start)?;
        let (campaign, noise) = (replayed.used(), replayed.noise());
        let unused =
            law.and_then(|law| law.unused.with_arm(campaign, noise, law.window_s, &found.arm));
        Some((found, unused))
    });
    let lawful = law.as_ref().is_some_and(|(law, _)| law.chosen.departs());
    let doubted = !missing.is_empty() && !lawful;
    let line_holds = !lawful && missing.is_empty();
    let varies = line_holds && regression.as_ref().is_some_and(|r| r.varies_by().is_some());
    let by_law = law.as_ref().map(|(law, _)| law);
    let output_error = output_error
        .map(|(oe, unused)| oe.beside_regression(doubted, varies).beside_law(unused, by_law));
    let stands = output_error.as_ref().is_some_and(OutputError::stands);
    let rigid = regression.as_ref().filter(|_| !stands);
    let rigid = rigid.and_then(|r| rigid_equation(&prepared, options, r, by_law));
    let (without_coupling, regression, law, line) = match rigid {
        None => {
            let regression = regression.map(|r| MotorRegression { possible, ..r });
            (None, regression, law, line)
        }
        Some(rigid) => (Some(rigid.finding), Some(rigid.regression), rigid.law, rigid.line),
    };

    progress(Stage::Responses);
    let replay = output_error.as_ref().filter(|o| o.describes_whole_runs());
    let friction_law =
        law.map(|(law, sums)| law.beside(&sums, replay.map(|found| found as &dyn KnownArm)));
    let beam_regression = any_beam_regression.filter(is_sound_beam);
    let phases = slip_phase_solution(regression.as_ref(), friction_law.as_ref());
    let explained = phases.as_ref().zip(regression.as_ref()).and_then(|((method, drive), r)| {
        Some((r, drive, slip_phase_terms(*method, Some(r), friction_law.as_ref())?))
    });
    let by_regression =
        estimates_model(campaign, explained, friction_law.as_ref(), beam_regression.as_ref());
    let rigid = output_error.as_ref().and_then(|oe| rigid_model(campaign, oe));
    let Responses { points, motor_model, beam_model, findings: response_findings } =
        tables.with_models(replay, tips_model, by_regression, rigid);
    let third = third_harmonic.as_ref();
    let third_harmonic_model =
        third.and_then(|t| tables.model_with(t.coulomb_command, beam_model.as_ref()));
    let (equivalent, refused) = equivalent_arm(campaign, &points);
    let methods = Methods {
        third_harmonic,
        third_harmonic_model,
        regression,
        regression_residual,
        missing,
        least_squares: line,
        friction_law,
        constant_velocity,
        beam_regression,
        output_error,
        beam_model,
        motor_model,
    };
    let evidence = Evidence::of(&prepared, &methods);
    let findings =
        [prepared.findings().to_vec(), steady_findings, response_findings, refused].concat();
    let findings = findings.into_iter().chain(without_coupling).chain(hold);
    let findings = findings.chain(late_tips).collect();
    let conclusion = conclude(&evidence, findings);
    let models = LinearModels::of(&evidence);
    let runs = prepared.into_runs();
    Ok(Identified::new(campaign, methods, runs, points, (models, equivalent), conclusion))
}

/// What an assumed hold of the command changes.
fn assumed_hold(
    campaign: &Campaign,
    options: &Options,
    found: &MotorRegression,
) -> Option<Finding> {
    let other = campaign.hold_assumed.then(|| other_hold(campaign, options, found))??;
    let units = EstimateUnits::new(&campaign.channels);
    Some(Finding::new(rows::HoldAssumed { other, units }))
}

/// Whether the beam's regression has a small residual, all its modes are damped, and the tips show about all of their motion.
fn is_sound_beam(b: &BeamRegression) -> bool {
    let damped = |m: &ModeEstimate| {
        m.damping_ratio.value > MODE_DAMPING_LEAST - PRESENT * m.damping_ratio.std
    };
    let whole = |share: &Estimate| (1.0 / BEAM_SHARES..BEAM_SHARES).contains(&share.value);
    let explains = b.relative_residual.iter().all(|r| *r < BEAM_RESIDUAL);
    explains && b.modes.iter().all(damped) && b.shares.iter().all(whole)
}

fn possible(options: &Options) -> Result<(), IdentifyError> {
    match options.window_s.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
        Some(&found_s) => Err(IdentifyError::Window { found_s }),
        None => Ok(()),
    }
}

/// Coulomb friction in the command's unit, by the best method that needs no replay.
fn coulomb_command(
    regression: Option<&MotorRegression>,
    third_harmonic: Option<&ThirdHarmonic>,
    constant: f64,
) -> Option<Estimate> {
    let from_regression = regression.and_then(|r| r.coulomb).map(|c| c.scaled(1.0 / constant));
    from_regression.filter(|c| c.value > 0.0).or(third_harmonic.map(|t| t.coulomb_command))
}

/// Whether a regression of nothing but constant velocities gives all parameters of the drive, from transitions enough.
fn is_sound_alone(r: &MotorRegression) -> bool {
    let known = |e: Option<Estimate>| e.is_some_and(|e| e.std < CONSTANT_VELOCITY_ALONE * e.value);
    let surely = |e: Estimate| e.std < CONSTANT_VELOCITY_FEW * e.value;
    (r.phases >= FEW_PHASES || r.inertia.is_some_and(surely))
        && known(r.inertia)
        && (known(r.coulomb) || known(r.forward) || known(r.backward))
        && known(r.viscous)
        && r.relative_residual < UNEXPLAINED_TORQUE
}

/// The equivalent arm of more than one point, or why there is none.
fn equivalent_arm(
    campaign: &Campaign,
    responses: &[ResponsePoint],
) -> (Option<Equivalent>, Vec<Finding>) {
    let data = EquivalentData::of_campaign(campaign, responses).ok();
    match data.filter(|data| data.names.len() > 1).map(|data| equivalent(&data, None)) {
        None => (None, Vec::new()),
        Some(Ok(found)) => (Some(found), Vec::new()),
        Some(Err(refusal)) => (None, vec![Finding::new(rows::EquivalentRefused { refusal })]),
    }
}

/// Where the output-error method begins: `arms` to start from.
fn start_of(
    prepared: &Prepared<'_>,
    options: &Options,
    arms: Vec<ModalArm>,
    law: Option<&FrictionLaw>,
) -> OutputErrorStart {
    let omega = |&i: &usize| match &prepared.runs()[i].kind {
        RunKind::Sinusoidal(s) => Some(s.omega_rad_s),
        RunKind::ConstantVelocity | RunKind::General => None,
    };
    OutputErrorStart {
        arms,
        omega_rad_s: prepared.kept().iter().map(omega).collect(),
        first_window_s: None,
        most_evaluations: options.evaluations(),
        interrupt: options.interrupt.clone(),
        shown_rad_s: Vec::new(),
        further_terms: law.map(FrictionLaw::further_terms).unwrap_or_default(),
    }
}
