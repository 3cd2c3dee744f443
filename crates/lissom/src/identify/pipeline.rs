//! The whole way from a campaign to its figures and their verdict.

use std::borrow::Cow;

use thiserror::Error;

use crate::identify::equivalent::{Equivalent, EquivalentData, equivalent};
use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::findings::{
    Channel, ChannelFinding, EquivalentFinding, Finding, FindingKind, RunFinding, Severity,
    result_key as key,
};
use crate::identify::identified::{Identified, ThirdHarmonic};
use crate::identify::judge::{Evidence, Methods, conclude, slip_phase_solution};
use crate::identify::methods::constant_velocity;
use crate::identify::methods::constant_velocity::ConstantVelocity;
use crate::identify::methods::friction_law::{FrictionLaw, friction_law};
use crate::identify::methods::least_squares::least_squares;
use crate::identify::methods::output_error::{OutputError, OutputErrorStart, output_error};
use crate::identify::methods::regression::{
    BeamRegression, MotorRegression, beam_regression, motor_regression,
};
use crate::identify::methods::starting_arms::starting_arms;
use crate::identify::methods::third_harmonic::{PairFigure, mean_figure, pair_figure};
use crate::identify::prepare::channel_check::range;
use crate::identify::prepare::run_analysis::{RunAnalysis, RunKind, analyse};
use crate::identify::responses::bands::{against, general, uncertain};
use crate::identify::responses::friction_waveform::FrictionWaveform;
use crate::identify::responses::linear_models::LinearModels;
use crate::identify::responses::models;
use crate::identify::responses::models::{beam_model, figures_model, motor_and_beam, rigid_model};
use crate::identify::responses::replayed_bands::ReplayedBands;
use crate::identify::responses::response_point::ResponsePoint;
use crate::identify::responses::response_table::{Replayed, response_table, weak_points};
use crate::identify::thresholds::{
    BEAM_RESIDUAL, CONSTANT_VELOCITY_ALONE, MODE_DAMPING_LEAST, REFUSED_TORQUE,
    STEPPED_SINES_LEAST, TRIPLE_FREQUENCY, UNEXPLAINED_TORQUE,
};
use crate::record::{Campaign, Run};
use crate::replay::ModalArm;

/// Harmonics fitted to a periodic run.
const HARMONICS: usize = 9;

/// What a user may ask for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Lengths of the regression's window to take one of \[s\]; chosen from the data when empty.
    pub window_s: Vec<f64>,
    /// Highest harmonic fitted to a periodic run; nine when `None`, and never above the Nyquist
    /// frequency.
    pub harmonics: Option<usize>,
    /// Leaves out the replay of the runs through the arm: the regression's figures stand.
    pub without_output_error: bool,
    /// Most evaluations of the output-error method ([`OutputError::evaluations`]); a number that campaigns rarely reach
    /// when `None`. A result depends on this number and not on how fast the machine is.
    pub most_evaluations: Option<u64>,
}

/// Why a campaign cannot be identified at all.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum IdentifyError {
    /// In every run some channel stands still.
    #[error("every run has a constant channel: {}", counted(constant, *runs))]
    NothingMoves {
        /// Number of runs.
        runs: usize,
        /// Channels that are constant somewhere, and in how many runs.
        constant: Vec<(String, usize)>,
    },
    /// The window asked for is not a positive finite length.
    #[error("a window of {found_s} s is not positive and finite")]
    Window {
        /// The length given \[s\].
        found_s: f64,
    },
}

fn counted(constant: &[(String, usize)], runs: usize) -> String {
    let count = |(name, count): &(String, usize)| format!("{name} in {count} of {runs}");
    constant.iter().map(count).collect::<Vec<_>>().join(", ")
}

/// A stage of the work, for a progress display.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Periods and harmonics of run `.0` (from 0) of `.1`.
    Run(usize, usize),
    /// Regression on slip phases.
    Regression,
    /// The beam's own regression.
    Beam,
    /// The runs replayed through the arm.
    OutputError,
    /// Responses and rational models.
    Responses,
}

/// Identifies drive and beam from a campaign.
///
/// Run by run: checks of the channels, steady state and harmonics. Then over all runs: regression
/// on slip phases of motor and beam, third harmonic of every pair of runs at ω0 and 3ω0,
/// responses with friction taken out, rational models, and the verdict, which takes the regression's
/// figures where they stand and those of the third harmonic and its model where they do not.
/// `progress` is called at the beginning of each stage.
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
/// `[Feliu1989, Sections 4 (step 6), 5 and 6.2.2]`, with the regression beside it.
///
/// # Errors
/// [`IdentifyError`] where nothing can be said at all. Everything less is a finding.
pub fn identify(
    campaign: &Campaign,
    options: &Options,
    mut progress: impl FnMut(Stage),
) -> Result<Identified, IdentifyError> {
    possible(options)?;
    let harmonics = options.harmonics.unwrap_or(HARMONICS).max(1);
    let mut findings = Vec::new();
    let mut runs = Vec::with_capacity(campaign.runs.len());
    let dead = dead_everywhere(campaign);
    for index in 0..campaign.runs.len() {
        progress(Stage::Run(index, campaign.runs.len()));
        runs.push(analyse(campaign, index, harmonics, &dead, &mut findings));
    }
    dead_tips(campaign, &dead, &mut findings);
    let constant_velocity = classical(campaign, &runs, &mut findings);
    let kept = kept(&runs);
    let usable = usable(campaign, &kept, &dead);
    if usable.runs.is_empty() && constant_velocity.is_none() {
        let constant = constant_channels(campaign);
        return Err(IdentifyError::NothingMoves { runs: campaign.runs.len(), constant });
    }
    progress(Stage::Regression);
    // Of constant velocities alone it stands where their transitions show the inertia.
    let alone = !runs.iter().any(|r| r.usable && !r.is_constant_velocity());
    let any_regression = motor_regression(&usable, &options.window_s)
        .filter(|r| !alone || constant_velocity.is_none() || stands_alone(r));
    let regression_residual = any_regression.as_ref().map(|r| r.relative_residual);
    let regression = any_regression.clone().filter(|r| r.relative_residual < REFUSED_TORQUE);
    let mut friction_law = regression.as_ref().and_then(|r| friction_law(&usable, r));
    progress(Stage::Beam);
    let any_beam_regression = beam_regression(&usable);

    // Tips' responses to the motor know nothing of friction.
    let square = Replayed::default();
    let shown = response_table(campaign, &runs, None, &square, &findings);
    let mut beam_model = beam_model(campaign, &shown);
    let constant = campaign.channels.command.torque_per_command.unwrap_or(1.0);
    let mut third_harmonic = pairs(&runs, &findings);
    let best = coulomb_command(regression.as_ref(), third_harmonic.as_ref(), constant);
    let replayable = any_regression.filter(|_| !options.without_output_error);
    let output_error = replayable.and_then(|motor| {
        progress(Stage::OutputError);
        // Responses of the motor without friction: as a square wave it is near enough to start with.
        let table = || response_table(campaign, &runs, best, &square, &findings);
        let (beam, tips) = (any_beam_regression.as_ref(), beam_model.as_ref());
        let drive = motor.estimates();
        let plain = starting_arms(&usable, &drive, beam, tips, &shown, table);
        replayed(
            &usable,
            &runs,
            &kept,
            &plain,
            friction_law.as_ref().map(|(law, _)| law),
            options.most_evaluations,
        )
    });

    let beam_regression = any_beam_regression.filter(beam_stands);

    progress(Stage::Responses);
    let table = |c: Option<Estimate>| response_table(campaign, &runs, c, &square, &findings);
    let replay = output_error.as_ref().filter(|o| o.describes_whole_runs());
    if let Some(((law, sums), found)) = friction_law.as_mut().zip(replay) {
        let own = std::mem::take(&mut law.curve);
        law.curve = sums.beside_arm(found).unwrap_or_else(|| sums.beside_law(own, found));
    }
    let replay = replay.map_or_else(Replayed::default, |o| corrected(o, &usable, &runs, &kept));
    let mut responses = response_table(campaign, &runs, best, &replay, &findings);
    let stepped = responses.iter().filter(|p| p.run.is_some()).count() >= STEPPED_SINES_LEAST;
    let law = friction_law.as_ref().map(|(law, _)| law);
    let phases = slip_phase_solution(regression.as_ref(), law).map(|(_, drive)| drive);
    let explained = regression.as_ref().zip(phases.as_ref());
    let figures = figures_model(campaign, explained, beam_regression.as_ref());
    let (mut motor_model, mut contradicted) = (None, None);
    if let Some((motor, beam)) = &figures {
        if replay.bands.is_none() {
            contradicted = against(&mut responses, motor);
        }
        if !stepped {
            // Bands of a sweep or of ordinary moves are poorer than the figures of the regression.
            motor_model = Some(motor.clone());
            beam_model = beam.clone().or(beam_model);
        }
    }
    if let Some(rigid) = output_error.as_ref().and_then(|oe| rigid_model(campaign, oe)) {
        // Responses know less: noise in them looks like a pole and a zero side by side.
        motor_model = Some(rigid);
    }
    let (motor_model, beam_model) =
        motor_and_beam(campaign, &responses, constant, (motor_model, beam_model));
    if let Some(third) = &mut third_harmonic {
        third.motor =
            models::motor_model(&table(Some(third.coulomb_command)), constant, beam_model.as_ref());
    }
    findings.extend(contradicted);
    // After the models: they weigh each band by its deviation.
    findings.extend(uncertain(&mut responses));
    findings.extend(weak_points(&responses, &runs));
    let equivalent = equivalent_arm(campaign, &responses, &mut findings);
    let methods = Methods {
        third_harmonic,
        regression,
        regression_residual,
        least_squares: least_squares(&usable),
        friction_law: friction_law.map(|(law, _)| law),
        constant_velocity,
        beam_regression,
        output_error,
        beam_model,
        motor_model,
    };
    let evidence = Evidence { campaign, used: &usable, runs: &runs, methods: &methods };
    let conclusion = conclude(&evidence, findings);
    let models = LinearModels::of(&evidence);
    Ok(Identified::new(campaign, methods, runs, responses, (models, equivalent), conclusion))
}

/// Whether the beam's regression leaves little, and all its modes fade.
fn beam_stands(b: &BeamRegression) -> bool {
    let damped = |m: &ModeEstimate| m.damping_ratio.value > MODE_DAMPING_LEAST;
    b.relative_residual.iter().all(|r| *r < BEAM_RESIDUAL) && b.modes.iter().all(damped)
}

fn possible(options: &Options) -> Result<(), IdentifyError> {
    match options.window_s.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
        Some(&found_s) => Err(IdentifyError::Window { found_s }),
        None => Ok(()),
    }
}

/// Responses without friction of the runs that were replayed, the `kept` ones of `runs`.
fn corrected<'a>(
    found: &'a OutputError,
    usable: &'a Campaign,
    runs: &[RunAnalysis],
    kept: &[usize],
) -> Replayed<'a> {
    let place = |run: usize| kept.iter().position(|&k| k == run);
    let sinusoidal = |(index, run): (usize, &RunAnalysis)| {
        let RunKind::Sinusoidal(steady) = &run.kind else { return None };
        let run = place(index)?;
        FrictionWaveform { found, campaign: usable, run, steady }.response()
    };
    let general: Vec<usize> = general(runs).into_iter().filter_map(place).collect();
    Replayed {
        sinusoidal: runs.iter().enumerate().map(sinusoidal).collect(),
        bands: ReplayedBands::new(found, usable, &general),
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

/// The equivalent arm of more than one point, or why there is none.
fn equivalent_arm(
    campaign: &Campaign,
    responses: &[ResponsePoint],
    findings: &mut Vec<Finding>,
) -> Option<Equivalent> {
    let data = EquivalentData::of_campaign(campaign, responses).ok()?;
    if data.names.len() < 2 {
        return None;
    }
    match equivalent(&data, None) {
        Ok(found) => Some(found),
        Err(refusal) => {
            findings.push(Finding::new(EquivalentFinding::EquivalentRefused { refusal }));
            None
        }
    }
}

/// Channels that are constant in some runs, and in how many.
fn constant_channels(campaign: &Campaign) -> Vec<(String, usize)> {
    let count = |channel: &dyn Fn(&Run) -> &[f64]| {
        campaign.runs.iter().filter(|run| range(channel(run)) <= 0.0).count()
    };
    let mut constant = vec![
        ("motor".to_owned(), count(&Run::motor)),
        ("command".to_owned(), count(&Run::command)),
    ];
    constant.extend(campaign.channels.tips.iter().enumerate().map(|(i, tip)| {
        (format!("tip \"{}\"", tip.name), count(&|run: &Run| run.tips()[i].as_slice()))
    }));
    constant.retain(|(_, runs)| *runs > 0);
    constant
}

/// Which tips are constant in every run.
fn dead_everywhere(campaign: &Campaign) -> Vec<bool> {
    let dead = |i: usize| campaign.runs.iter().all(|run| range(&run.tips()[i]) <= 0.0);
    (0..campaign.channels.tips.len()).map(dead).collect()
}

/// Says which tips are dead in every run.
fn dead_tips(campaign: &Campaign, dead: &[bool], findings: &mut Vec<Finding>) {
    for (tip, _) in campaign.channels.tips.iter().zip(dead).filter(|(_, dead)| **dead) {
        let channel = Channel::Tip(tip.name.clone());
        findings.push(Finding::new(ChannelFinding::DeadChannel { channel, value: None, unit: "" }));
    }
}

/// The figures of steady velocities, where a line goes through some or a run was made for them.
fn classical(
    campaign: &Campaign,
    runs: &[RunAnalysis],
    findings: &mut Vec<Finding>,
) -> Option<ConstantVelocity> {
    let points: Vec<_> = runs.iter().flat_map(|r| r.steady.iter().copied()).collect();
    let found = ConstantVelocity::of_points(&campaign.channels, points);
    let meant = runs.iter().any(RunAnalysis::is_constant_velocity);
    findings.extend(constant_velocity::findings(campaign, &found, meant));
    (meant || found.lines().next().is_some()).then_some(found)
}

/// Whether a regression on nothing but constant velocities gives all of the motor's figures.
fn stands_alone(r: &MotorRegression) -> bool {
    let known = |e: Option<Estimate>| e.is_some_and(|e| e.std < CONSTANT_VELOCITY_ALONE * e.value);
    known(r.inertia)
        && known(r.coulomb)
        && known(r.viscous)
        && r.relative_residual < UNEXPLAINED_TORQUE
}

/// What the regressions may use: no run with a dead channel, no tip that is dead in all, and runs of
/// constant velocities only where there are no others: they lie outside the speeds that a drive works
/// at, and one viscous constant need not hold there.
/// Logs are long: they are copied only where something falls out.
fn usable<'a>(campaign: &'a Campaign, kept: &[usize], dead: &[bool]) -> Cow<'a, Campaign> {
    if kept.len() == campaign.runs.len() && !dead.iter().any(|d| *d) {
        return Cow::Borrowed(campaign);
    }
    let mut channels = campaign.channels.clone();
    for (tip, dead) in channels.tips.iter_mut().zip(dead) {
        tip.calibrated &= !dead;
    }
    let runs = kept.iter().map(|&i| campaign.runs[i].clone()).collect();
    Cow::Owned(Campaign { channels, runs })
}

/// Runs that the regressions and the output error may use.
fn kept(runs: &[RunAnalysis]) -> Vec<usize> {
    let others = runs.iter().any(|r| r.usable && !r.is_constant_velocity());
    let kept = |a: &RunAnalysis| a.usable && !(others && a.is_constant_velocity());
    (0..runs.len()).filter(|&i| kept(&runs[i])).collect()
}

/// The output-error method on the usable runs, the `kept` ones of `runs`, from the arms `plain`. Friction terms that
/// `law` tried are tried there too, where the residual calls for another law.
fn replayed(
    usable: &Campaign,
    runs: &[RunAnalysis],
    kept: &[usize],
    plain: &[ModalArm],
    law: Option<&FrictionLaw>,
    most_evaluations: Option<u64>,
) -> Option<OutputError> {
    let omega = |&i: &usize| match &runs[i].kind {
        RunKind::Sinusoidal(s) => Some(s.omega_rad_s),
        RunKind::ConstantVelocity | RunKind::General => None,
    };
    let omega_rad_s: Vec<Option<f64>> = kept.iter().map(omega).collect();
    let arms = plain.to_vec();
    let law = law.map_or(Vec::new(), FrictionLaw::tried);
    let first_window_s = None;
    let start = OutputErrorStart { arms, omega_rad_s, first_window_s, most_evaluations, law };
    output_error(usable, &start)
}

/// Every pair of runs at ω0 and 3ω0; each run meets the triple nearest to it in amplitude.
fn pairs(runs: &[RunAnalysis], findings: &[Finding]) -> Option<ThirdHarmonic> {
    let phasors: Vec<_> = runs
        .iter()
        .map(|r| match &r.kind {
            RunKind::Sinusoidal(s) => s.phasors(),
            RunKind::ConstantVelocity | RunKind::General => None,
        })
        .collect();
    // Sticking lowers every pair's figure, and counts in the mean's deviation.
    let flagged = |i: usize| {
        findings.iter().any(|f| {
            f.run.as_deref() == Some(&runs[i].name)
                && f.severity() >= Severity::Warning
                && !matches!(f.kind, FindingKind::Run(RunFinding::Sticking { .. }))
                && f.affects().contains(&key::THIRD_HARMONIC)
        })
    };
    let mut pairs = Vec::new();
    for (i, low) in phasors.iter().enumerate() {
        let Some(low) = low else { continue };
        let amplitude = low.motor_1.value.norm();
        let triple = phasors
            .iter()
            .enumerate()
            .filter_map(|(k, p)| Some((k, (*p)?)))
            .filter(|(_, p)| {
                (p.omega_rad_s / (3.0 * low.omega_rad_s) - 1.0).abs() < TRIPLE_FREQUENCY
            })
            .min_by(|(_, a), (_, b)| {
                let far = |p: f64| (p / amplitude).ln().abs();
                far(a.motor_1.value.norm()).total_cmp(&far(b.motor_1.value.norm()))
            });
        if let Some((k, triple)) = triple {
            pairs.extend(pair_figure(i, k, low, &triple));
        }
    }
    let clean: Vec<bool> =
        pairs.iter().map(|p| !flagged(p.run) && !flagged(p.triple_run)).collect();
    let used = if clean.iter().any(|c| *c) { clean } else { vec![true; pairs.len()] };
    let chosen: Vec<PairFigure> =
        pairs.iter().zip(&used).filter(|(_, u)| **u).map(|(p, _)| *p).collect();
    let stuck = |i: usize| runs[i].stuck_share.unwrap_or(0.0);
    let (coulomb_command, spread_command) = mean_figure(&chosen, |p| stuck(p.run))?;
    Some(ThirdHarmonic { pairs, coulomb_command, spread_command, used, motor: None })
}
