//! The steps from a campaign to its result: prepare, methods, responses, output error, judge.

use thiserror::Error;

use crate::identify::equivalent::{Equivalent, EquivalentData, equivalent};
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{EstimateUnits, Finding, rows};
use crate::identify::identified::Identified;
use crate::identify::judge::{Evidence, Methods, conclude, slip_phase_solution, slip_phase_terms};
use crate::identify::linear_models::LinearModels;
use crate::identify::methods::constant_velocity;
use crate::identify::methods::friction_law::{
    AngleLag, CurveSums, FrictionLaw, KnownArm, MissingTerm, friction_law, predicts_better,
};
use crate::identify::methods::least_squares::{LeastSquares, least_squares};
use crate::identify::methods::regression::thresholds::FEW_PHASES;
use crate::identify::methods::regression::{
    BeamRegression, MotorRegression, beam_regression, other_hold, with_tips_in_time,
};
use crate::identify::methods::rigid_equation::{RigidEquation, rigid_equation};
use crate::identify::methods::third_harmonic::{ThirdHarmonic, third_harmonic};
use crate::identify::methods::unlike_runs::regression_of_like_runs;
use crate::identify::options::{Effort, Options};
use crate::identify::output_error::starting_arms::{starting_arms, starts_by_bending, with_law};
use crate::identify::output_error::{OutputError, OutputErrorStart, output_error};
use crate::identify::prepare::prepared::Prepared;
use crate::identify::prepare::run_analysis::RunKind;
use crate::identify::replayed_responses::response_step::{ResponseTables, Responses, rigid_model};
use crate::identify::responses::models::{beam_model, estimates_model};
use crate::identify::responses::rational::{BeamFit, MotorFit};
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
    let (prepared, line_of_phases, late_tips) =
        line_of_slip_phases(prepared, options, constant_velocity.is_some());
    progress(Stage::Beam);
    // Each loops over the runs on all threads, and leaves some of them idle between its loops.
    let (phases, (beam_equation, third_harmonic)) = rayon::join(
        || line_of_phases.map(|line| SlipPhases::new(&prepared, line)),
        || (beam_regression(&prepared), third_harmonic(&prepared)),
    );
    let explaining = phases.as_ref().filter(|phases| phases.explain());
    let hold = explaining.and_then(|p| assumed_hold(prepared.used(), options, &p.regression));
    // What is found on slip phases is of commands that are as late as the angle.
    let lag = phases.as_ref().and_then(SlipPhases::lag);
    let late = lag.map(|lag| prepared.using(lag.late(prepared.used())));
    let in_time = late.as_ref().unwrap_or(&prepared);
    let line = least_squares(in_time, explaining.map(|p| p.regression.window_s));

    let coulomb_command = coulomb_command(campaign, explaining, third_harmonic.as_ref());
    let tables = ResponseTables { prepared: &prepared, coulomb_command };
    let shown = tables.without_friction_known();
    let tips_model = beam_model(campaign, &shown);
    let start = phases.as_ref().filter(|_| options.effort != Effort::Quick);
    let output_error = start.and_then(|phases| {
        progress(Stage::OutputError);
        let (beam, tips) = (beam_equation.as_ref(), tips_model.as_ref());
        Simulation { tables, in_time, phases, beam, tips, shown: &shown }.found(options)
    });

    progress(Stage::Responses);
    let regression_residual = phases.as_ref().map(|p| p.regression.relative_residual);
    let missing = phases.as_ref().map_or_else(Vec::new, SlipPhases::missing);
    let drive = DriveEquation::of(&prepared, options, phases, line, output_error.as_ref());
    let replay = output_error.as_ref().filter(|o| o.describes_whole_runs());
    let curve_of_arm = replay.map(|found| found as &dyn KnownArm);
    let friction_law = drive.law.map(|(law, sums)| law.beside(&sums, curve_of_arm));
    let beam_regression = beam_equation.filter(is_sound_beam);
    let by_regression = model_of_estimates(
        campaign,
        drive.regression.as_ref(),
        friction_law.as_ref(),
        beam_regression.as_ref(),
    );
    let rigid = output_error.as_ref().and_then(|found| rigid_model(campaign, found));
    let Responses { points, motor_model, beam_model, findings: response_findings } =
        tables.with_models(replay, tips_model, by_regression, rigid);
    let third_harmonic_model = third_harmonic
        .as_ref()
        .and_then(|third| tables.model_with(third.coulomb_command, beam_model.as_ref()));
    let (equivalent, refused) = equivalent_arm(campaign, &points);
    let methods = Methods {
        third_harmonic,
        third_harmonic_model,
        regression: drive.regression,
        regression_residual,
        missing,
        least_squares: drive.line,
        friction_law,
        constant_velocity,
        beam_regression,
        output_error,
        beam_model,
        motor_model,
    };
    let evidence = Evidence::of(&prepared, &methods);
    let findings = [
        prepared.findings().to_vec(),
        steady_findings,
        response_findings,
        refused,
        drive.without_coupling.into_iter().chain(hold).collect(),
        late_tips,
    ];
    let conclusion = conclude(&evidence, findings.concat());
    let models = LinearModels::of(&evidence);
    let runs = prepared.into_runs();
    Ok(Identified::new(campaign, methods, runs, points, (models, equivalent), conclusion))
}

/// The regression in slip phases of the runs that are alike, with tips that are read in time, and what was found on the way.
fn line_of_slip_phases<'a>(
    prepared: Prepared<'a>,
    options: &Options,
    has_constant_velocities: bool,
) -> (Prepared<'a>, Option<MotorRegression>, Vec<Finding>) {
    // From constant velocities alone it is accepted if their transitions show the inertia.
    let doubted = prepared.has_only_constant_velocities() && has_constant_velocities;
    let (prepared, regression) = regression_of_like_runs(prepared, options);
    let accepted = regression.filter(|r| !doubted || is_sound_alone(r));
    with_tips_in_time(prepared, accepted, options)
}

/// What slip phases show: the regression, and the model of the torque that predicts best.
struct SlipPhases {
    regression: MotorRegression,
    model: Option<(FrictionLaw, CurveSums)>,
}

impl SlipPhases {
    /// With the hidden mode of the regression, if it has one and predicts better with it.
    fn new(prepared: &Prepared<'_>, line: MotorRegression) -> Self {
        let rigid = friction_law(prepared, &line);
        let Some(flexible) = line.with_mode.clone() else {
            return Self { regression: line, model: rigid };
        };
        let with_mode = friction_law(prepared, &flexible);
        let [law, with] = [&rigid, &with_mode].map(|model| model.as_ref().map(|(law, _)| law));
        if predicts_better((&flexible, with), (prepared, &line, law)) {
            let MotorRegression { left_out, beside_others, .. } = line;
            let regression = MotorRegression { left_out, beside_others, ..*flexible };
            return Self { regression, model: with_mode };
        }
        Self { regression: line, model: rigid }
    }

    /// Whether the regression explains enough of the torque for its estimates to be used.
    fn explain(&self) -> bool {
        self.regression.relative_residual < REFUSED_TORQUE
    }

    /// The friction law, if the regression can be used.
    fn law(&self) -> Option<&FrictionLaw> {
        self.model.as_ref().filter(|_| self.explain()).map(|(law, _)| law)
    }

    fn lag(&self) -> Option<AngleLag> {
        self.model.as_ref().and_then(|(law, _)| law.lag)
    }

    /// What the logs show and the model does not contain, whether or not it can be used.
    fn missing(&self) -> Vec<MissingTerm> {
        self.model.as_ref().map_or_else(Vec::new, |(law, _)| law.missing.clone())
    }
}

/// What the output-error method starts from.
struct Simulation<'a> {
    tables: ResponseTables<'a>,
    /// The runs with commands as late as the angle.
    in_time: &'a Prepared<'a>,
    phases: &'a SlipPhases,
    beam: Option<&'a BeamRegression>,
    tips: Option<&'a BeamFit>,
    shown: &'a [ResponsePoint],
}

impl Simulation<'_> {
    /// The arm that describes the runs best, held to what slip phases show.
    fn found(&self, options: &Options) -> Option<OutputError> {
        let Self { tables, phases, shown, .. } = self;
        let (law, prepared) = (phases.law(), tables.prepared);
        let drive = law.map_or_else(|| phases.regression.estimates(), |law| law.chosen.estimates());
        // A replay knows a delay of the command, which it finds best itself, but no filter and no late goal.
        let delay = phases.lag().filter(|lag| lag.is_delay_of(prepared.campaign()));
        let runs = if delay.is_some() { prepared } else { self.in_time };
        let known = (&drive, &phases.regression, delay.map_or(0.0, |lag| lag.time_s));
        let corrected = || tables.with_square_wave(tables.coulomb_command);
        let mut arms = starts_by_bending(runs, options);
        arms.extend(starting_arms(runs.used(), known, self.beam, self.tips, shown, corrected));
        let arms = with_law(law, arms, runs.used());
        let shown_rad_s = self.tips.map_or(Vec::new(), BeamFit::frequencies_rad_s);
        let start = OutputErrorStart { shown_rad_s, ..start_of(runs, options, arms, law) };
        let found = output_error(runs, &start)?;
        let (used, noise) = (runs.used(), runs.noise());
        let unused = law.and_then(|l| l.unused.with_arm(used, noise, l.window_s, &found.arm));
        let lawful = law.is_some_and(|law| law.chosen.departs());
        let lacks_term = !lawful && !phases.missing().is_empty();
        let varies =
            !lawful && !lacks_term && phases.explain() && phases.regression.varies_by().is_some();
        Some(found.beside_regression(lacks_term, varies).beside_law(unused, law))
    }
}

/// The motor's equation that the result may take: with the coupling to the beam, or without it where that is hardly known.
#[derive(Default)]
struct DriveEquation {
    regression: Option<MotorRegression>,
    law: Option<(FrictionLaw, CurveSums)>,
    line: Option<LeastSquares>,
    /// Why it has no coupling.
    without_coupling: Option<Finding>,
}

impl DriveEquation {
    fn of(
        prepared: &Prepared<'_>,
        options: &Options,
        phases: Option<SlipPhases>,
        line: Option<LeastSquares>,
        output_error: Option<&OutputError>,
    ) -> Self {
        let Some(phases) = phases.filter(SlipPhases::explain) else {
            return Self { line, ..Self::default() };
        };
        let stands = output_error.is_some_and(OutputError::stands);
        let rigid = || rigid_equation(prepared, options, &phases.regression, phases.law());
        if let Some(rigid) = (!stands).then(rigid).flatten() {
            let RigidEquation { regression, law, line, finding } = rigid;
            let regression = Some(regression);
            return Self { regression, law, line, without_coupling: Some(finding) };
        }
        let possible = phases.model.as_ref().map_or_else(Vec::new, |(law, _)| law.possible.clone());
        let regression = Some(MotorRegression { possible, ..phases.regression });
        Self { regression, law: phases.model, line, without_coupling: None }
    }
}

/// Models of motor and beam by the estimates of slip phases, where these explain all.
fn model_of_estimates(
    campaign: &Campaign,
    regression: Option<&MotorRegression>,
    law: Option<&FrictionLaw>,
    beam: Option<&BeamRegression>,
) -> Option<(MotorFit, Option<BeamFit>)> {
    let (method, drive) = slip_phase_solution(regression, law)?;
    let terms = slip_phase_terms(method, regression, law)?;
    estimates_model(campaign, (regression?, &drive, terms), law, beam)
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
    campaign: &Campaign,
    explaining: Option<&SlipPhases>,
    third_harmonic: Option<&ThirdHarmonic>,
) -> Option<Estimate> {
    let per_torque = 1.0 / campaign.channels.command.torque_per_unit();
    let of_phases = explaining.and_then(|p| p.regression.coulomb).map(|c| c.scaled(per_torque));
    of_phases.filter(|c| c.value > 0.0).or(third_harmonic.map(|t| t.coulomb_command))
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
