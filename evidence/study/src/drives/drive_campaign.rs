//! A random drive, its loop and its logs.

use lissom::arm::Arm;
use lissom::beam::{Beam, BeamError, Damping, LumpedBeam, Span};
use lissom::drive::{Coulomb, DriveError, DryFriction, Falloff, Motor};
use lissom::load::GravityLoad;
use lissom::record::clock::{ClockError, LogRows, Trim, even_parts};
use lissom::record::{Campaign, Hold, RecordError, Run};
use lissom::rig::{
    CurrentReading, CurrentSensor, Delay, FrictionWander, Instruments, JointFriction, LateStamps,
    Logged, Noise, Quantiser, Rig, RigError, Scene, Sensor,
};
use serde::Serialize;

use super::effects::{Cause, DriveStudy, Effects, Input, Lag};
use super::planned_motion::{MotionKind, PlannedMotion, motions};
use crate::draw::Draw;
use crate::position_loop::{Gains, is_stable};

/// Largest number of draws of a campaign.
const DRAWS_MOST: usize = 200;
/// Inertia of all rotating parts \[kg·m²\].
const INERTIA_KG_M2: (f64, f64) = (1e-5, 1.0);
/// Torque constant \[N·m/A\].
const TORQUE_CONSTANT: (f64, f64) = (0.05, 2.0);
/// Peak torque of inertia, of dry and of viscous friction, each over the largest of the three \[1\].
const SHARES: (f64, f64) = (0.1, 1.0);
/// Frequency of the loop over that of the motion.
const LOOP_RATIO: (f64, f64) = (8.0, 30.0);
/// Largest frequency of the loop, in radians per sample of the controller.
const FASTEST: f64 = 0.25;
/// Largest angle that the loop needs to overcome dry friction and load, relative to the travel.
const DEAD_SHARE: f64 = 0.05;
/// Largest torque that one step of the encoder causes, relative to the peak torque.
const CHATTER: f64 = 0.1;
/// Time constants for the filter of the loop's derivative, in 1/ω_c.
const FILTERS: [f64; 4] = [0.0, 0.1, 0.25, 0.5];
/// Smallest travel in steps of the encoder.
const STEPS_LEAST: f64 = 500.0;
/// Largest share of a run in which the joint sticks.
const STUCK_MOST: f64 = 0.6;
/// Smallest number of moves in all runs, unless few strokes are drawn.
const MOVES_LEAST: usize = 16;
/// A part of a log with fewer rows is left out, as in the reader of files.
const LEAST_ROWS: usize = 50;

/// The numbers of a drive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DriveNumbers {
    /// Inertia of all rotating parts, as if they were rigid \[kg·m²\].
    pub inertia_kg_m2: f64,
    /// Viscous friction \[N·m·s/rad\].
    pub viscous_nm_s_per_rad: f64,
    /// Coulomb friction at speed \[N·m\].
    pub coulomb_nm: f64,
    /// \[N·m/A\].
    pub torque_constant_nm_per_a: f64,
    /// Planned peak torque of inertia and friction \[N·m\].
    pub peak_nm: f64,
    /// Planned peak speed \[rad/s\].
    pub peak_speed_rad_s: f64,
    /// Planned peak acceleration \[rad/s²\].
    pub peak_acceleration_rad_s2: f64,
    /// Constant load \[N·m\].
    pub load_nm: f64,
    /// Largest torque of gravity \[N·m\].
    pub gravity_nm: f64,
    /// Bits of the encoder per turn.
    pub encoder_bits: u32,
    /// Time between rows \[s\].
    pub row_s: f64,
    /// Frequency of the position loop \[rad/s\].
    pub loop_rad_s: f64,
    /// Frequency of the unseen mode with the motor clamped \[rad/s\].
    pub mode_rad_s: Option<f64>,
}

/// The true state at a row of a log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TrueRow {
    pub(crate) angle_rad: f64,
    pub(crate) speed_rad_s: f64,
    /// The factor of the dry friction.
    pub(crate) factor: f64,
}

/// A campaign of a drive as it was simulated.
#[derive(Debug, Clone)]
pub struct DriveCampaign {
    /// Its study.
    pub study: DriveStudy,
    /// The study's seed.
    pub seed: u64,
    /// Its place in the study.
    pub index: usize,
    /// The effects that the simplest equation does not have.
    pub effects: Effects,
    /// The numbers of the drive.
    pub numbers: DriveNumbers,
    /// The kind of motion of its runs.
    pub motion: MotionKind,
    /// The logs, as the reader of files returns them.
    pub logs: Campaign,
    /// The logs as they are written to files: time stamps \[s\] and rows.
    pub(crate) raw: Vec<(Vec<f64>, Run)>,
    /// The dry friction without wander.
    pub(crate) dry: DryFriction,
    /// The same without ripple.
    pub(crate) dry_without_ripple: DryFriction,
    /// The true state at each row, run by run.
    pub(crate) truth: Vec<Vec<TrueRow>>,
    /// Share of each run in which the joint stuck.
    pub stuck_share: Vec<f64>,
    /// Reasons of the draws that were rejected before.
    pub rejected: Vec<String>,
}

impl DriveCampaign {
    /// Campaign `index` of a study; `None` if all draws were rejected.
    pub fn draw(study: DriveStudy, seed: u64, index: usize) -> Option<Self> {
        let mut draw = Draw::of(seed, index);
        let effects = Effects::draw(&mut draw, study, index);
        let mut rejected = Vec::new();
        for _ in 0..DRAWS_MOST {
            match drawn(&mut draw, (study, seed, index), effects) {
                Ok(campaign) => return Some(Self { rejected, ..campaign }),
                Err(why) => rejected.push(why.to_string()),
            }
        }
        None
    }

    /// Its cause, in a study of causes.
    pub fn cause(&self) -> Option<Cause> {
        (self.study == DriveStudy::Causes).then(|| Cause::of(self.index))
    }

    /// Gravity of a load that the campaign declares.
    pub fn declares_gravity(&self) -> bool {
        self.effects.gravity.is_some_and(|g| g.declared)
    }
}

/// The reason why a draw was rejected.
#[derive(Debug, thiserror::Error)]
enum Unfit {
    #[error("no position loop is suitable")]
    NoLoop,
    #[error("the travel is less than {STEPS_LEAST} steps of the encoder")]
    Coarse,
    #[error("fewer than {MOVES_LEAST} moves")]
    FewMoves,
    #[error("the joint sticks")]
    Sticks,
    #[error(transparent)]
    Rig(#[from] RigError),
    #[error(transparent)]
    Beam(#[from] BeamError),
    #[error(transparent)]
    Drive(#[from] DriveError),
    #[error(transparent)]
    Record(#[from] RecordError),
    #[error(transparent)]
    Clock(#[from] ClockError),
}

fn drawn(
    draw: &mut Draw,
    (study, seed, index): (DriveStudy, u64, usize),
    effects: Effects,
) -> Result<DriveCampaign, Unfit> {
    let row_s = 0.25e-3 * f64::from(draw.whole(2, 16));
    // The reference has a point at every sample of the controller. With fewer points the current would have a ripple
    // that is synchronous with the rows.
    let step_s = row_s / samples_per_row(&effects) as f64;
    let planned = motions(draw, effects.few_strokes, row_s, step_s);
    let moves: usize = planned.iter().map(PlannedMotion::moves).sum();
    if !effects.few_strokes && moves < MOVES_LEAST {
        return Err(Unfit::FewMoves);
    }
    let made = Made::draw(draw, &effects, &planned, row_s)?;
    let (mut raw, mut truth, mut stuck_share, mut runs) = (vec![], vec![], vec![], vec![]);
    let channels = channels(&made.rig, &effects)?;
    for (k, motion) in planned.iter().enumerate() {
        let name = format!("run {}", k + 1);
        let mut rows = Vec::new();
        let logged = made.rig.run_watched(
            &mut made.rig.controller.clone(),
            &name,
            &motion.experiment()?,
            draw.seed(),
            &mut |row| {
                rows.push(TrueRow {
                    angle_rad: row.state[0],
                    speed_rad_s: row.state[1],
                    factor: row.friction_factor,
                });
            },
        )?;
        if logged.stuck_share > STUCK_MOST {
            return Err(Unfit::Sticks);
        }
        stuck_share.push(logged.stuck_share);
        truth.push(rows);
        let (stamps, run) = without_tips(logged)?;
        runs.extend(read(&stamps, &run, channels.command.hold, effects.late_stamps.is_some())?);
        raw.push((stamps, run));
    }
    let logs = Campaign::new(channels, runs)?;
    let declared = effects.gravity.is_some_and(|g| g.declared);
    let logs = if declared { logs.with_gravity()? } else { logs };
    let Made { numbers, dry, dry_without_ripple, .. } = made;
    let motion = planned[0].kind;
    let rejected = Vec::new();
    Ok(DriveCampaign {
        study,
        seed,
        index,
        effects,
        numbers,
        motion,
        logs,
        raw,
        dry,
        dry_without_ripple,
        truth,
        stuck_share,
        rejected,
    })
}

/// The channels as the campaign file declares them; a wrong hold is a mistake of the user.
fn channels(rig: &Rig, effects: &Effects) -> Result<lissom::record::Channels, RigError> {
    let mut channels = rig.channels(0..0)?;
    match effects.lag {
        Some(Lag::MeasuredAsHeld) => channels.command.hold = Hold::Sampled,
        Some(Lag::HeldAsMeasured) => channels.command.hold = Hold::Measured,
        _ => {}
    }
    Ok(channels)
}

/// The time stamps of a log and its run, without the mass that no channel measures.
fn without_tips(logged: Logged) -> Result<(Vec<f64>, Run), RecordError> {
    let Logged { run, stamps_s, .. } = logged;
    let time = run.time();
    let even = |k| time.start_s + k as f64 * time.sample_time_s;
    let stamps = stamps_s.unwrap_or_else(|| (0..run.len()).map(even).collect());
    let (command, motor) = (run.command().to_vec(), run.motor().to_vec());
    let run = Run::new(run.name(), time, command, motor, vec![])?;
    Ok((stamps, run))
}

/// The runs that the reader of files makes of a log.
fn read(stamps: &[f64], run: &Run, hold: Hold, late: bool) -> Result<Vec<Run>, Unfit> {
    if !late {
        return Ok(vec![run.clone()]);
    }
    let rows = LogRows {
        stamps_s: stamps.to_vec(),
        sample_time_s: None,
        stamp_step_s: 0.0,
        command: run.command().to_vec(),
        hold,
        motor: run.motor().to_vec(),
        tips: vec![],
    };
    let parts = even_parts(rows, &Trim::default(), LEAST_ROWS)?.parts;
    let count = parts.len();
    let named = |k: usize| match count {
        1 => run.name().to_owned(),
        _ => format!("{} [{}/{count}]", run.name(), k + 1),
    };
    let of = |(k, part): (usize, lissom::record::clock::EvenPart)| {
        let run = Run::new(named(k), part.time, part.command, part.motor, part.tips)?;
        Ok(part.notes.into_iter().fold(run, Run::with_note))
    };
    parts.into_iter().enumerate().map(of).collect()
}

/// A drive in its loop.
struct Made {
    rig: Rig,
    numbers: DriveNumbers,
    dry: DryFriction,
    dry_without_ripple: DryFriction,
}

impl Made {
    fn draw(
        draw: &mut Draw,
        effects: &Effects,
        planned: &[PlannedMotion],
        row_s: f64,
    ) -> Result<Self, Unfit> {
        let most = |of: &dyn Fn(&PlannedMotion) -> f64| planned.iter().map(of).fold(0.0, f64::max);
        let (speed, acceleration) = (most(&|m| m.peaks()[0]), most(&|m| m.peaks()[1]));
        let travel = planned.iter().map(PlannedMotion::travel_rad).fold(f64::MAX, f64::min);
        let encoder_bits = draw.whole(12, 20);
        let encoder = Quantiser::encoder(1 << encoder_bits)?;
        if travel < STEPS_LEAST * encoder.step() {
            return Err(Unfit::Coarse);
        }
        let inertia = draw.decade(INERTIA_KG_M2.0, INERTIA_KG_M2.1);
        let constant = draw.decade(TORQUE_CONSTANT.0, TORQUE_CONSTANT.1);
        let [turn, dry, viscous] = [(); 3].map(|()| draw.decade(SHARES.0, SHARES.1));
        let inertia_nm = inertia * acceleration;
        let coulomb_nm = inertia_nm * dry / turn;
        let viscous = inertia_nm * viscous / turn / speed;
        let peak_nm = inertia_nm + coulomb_nm + viscous * speed;
        let load_nm = effects.constant_load.map_or(0.0, |share| share * coulomb_nm);
        let gravity_nm = effects.gravity.map_or(0.0, |g| g.share * peak_nm);
        let coulomb = Coulomb::symmetric(coulomb_nm)?;
        let dry = friction(effects, coulomb, speed)?;
        let plain = Effects { ripple: None, ..*effects };
        let dry_without_ripple = friction(&plain, coulomb, speed)?;
        let (arm, mode_rad_s) =
            arm(effects, (inertia, viscous, constant), coulomb, (acceleration, speed))?;

        let instruments = instruments(effects, encoder, row_s, peak_nm / constant)?;
        let held_nm = coulomb_nm.max(dry.at(0.0, 0.0).forward()) + load_nm.abs() + gravity_nm;
        let needs = Needs {
            inertia,
            motion_rad_s: acceleration / speed,
            least_rad_s: (held_nm / (DEAD_SHARE * travel * inertia)).sqrt(),
            encoder_rad: encoder.step(),
            peak_nm: peak_nm + gravity_nm + load_nm.abs(),
            delay_s: instruments.delay.map_or(0.0, |d| d.delay_s()),
            sample_s: instruments.sample_time_s,
        };
        let (gains, loop_rad_s) = needs.gains(draw, &arm).ok_or(Unfit::NoLoop)?;
        let mut rig = Rig::new(arm, instruments, gains.pd()?.into());
        rig.scene = scene(effects, &dry, load_nm, gravity_nm)?;
        let numbers = DriveNumbers {
            inertia_kg_m2: inertia,
            viscous_nm_s_per_rad: viscous,
            coulomb_nm,
            torque_constant_nm_per_a: constant,
            peak_nm,
            peak_speed_rad_s: speed,
            peak_acceleration_rad_s2: acceleration,
            load_nm,
            gravity_nm,
            encoder_bits,
            row_s,
            loop_rad_s,
            mode_rad_s,
        };
        Ok(Self { rig, numbers, dry, dry_without_ripple })
    }
}

fn friction(
    effects: &Effects,
    coulomb: Coulomb,
    speed_rad_s: f64,
) -> Result<DryFriction, DriveError> {
    let mut dry = DryFriction::from(coulomb);
    if let Some(near) = effects.near_rest {
        let rest = Coulomb::symmetric(near.rest_share * coulomb.forward())?;
        dry = dry.with_rest(rest, near.speed_share * speed_rad_s, Falloff::Exponential)?;
    }
    if let Some(ripple) = effects.ripple {
        dry = dry.with_ripple(ripple.share, ripple.per_turn, ripple.phase_rad)?;
    }
    Ok(dry)
}

/// The joint; with an unseen mode the inertia is divided between motor and mass.
fn arm(
    effects: &Effects,
    (inertia, viscous, constant): (f64, f64, f64),
    coulomb: Coulomb,
    (acceleration, speed): (f64, f64),
) -> Result<(Arm, Option<f64>), Unfit> {
    let Some(mode) = effects.unseen_mode else {
        let motor = Motor::new(inertia, viscous, constant)?;
        return Ok((Arm::new(Beam::Rigid, motor, coulomb)?, None));
    };
    let omega = mode.frequency_ratio * acceleration / speed;
    let of_motor = inertia / (1.0 + mode.inertia_ratio);
    let (length_m, of_mass) = (0.3, inertia - of_motor);
    let mass_kg = of_mass / (length_m * length_m);
    // One mass at the end of a massless span: ω² = 3·EI/(m·l³).
    let span = Span {
        length_m,
        flexural_rigidity_n_m2: omega * omega * mass_kg * length_m.powi(3) / 3.0,
        mass_kg,
        damping_n_s_per_m: 0.0,
    };
    // The damping is within the beam: dampers against the frame would be viscous friction of the joint.
    let damping = Damping::Modal { ratios: vec![mode.damping_ratio] };
    let beam = LumpedBeam::new(&[span])?.with_damping(damping)?;
    let motor = Motor::new(of_motor, viscous, constant)?;
    Ok((Arm::new(beam, motor, coulomb)?, Some(omega)))
}

fn samples_per_row(effects: &Effects) -> usize {
    match effects.input {
        Input::Held => 1,
        Input::Measured { samples_per_row, .. } => samples_per_row,
    }
}

fn instruments(
    effects: &Effects,
    encoder: Quantiser,
    row_s: f64,
    peak_a: f64,
) -> Result<Instruments, RigError> {
    let per_row = samples_per_row(effects);
    let mut instruments = Instruments::ideal(row_s / per_row as f64)?;
    instruments.motor = Sensor::from(encoder);
    instruments.log_every = per_row;
    if let Input::Measured { noise_share, .. } = effects.input {
        let noise = (noise_share > 0.0).then(|| Noise::new(noise_share * peak_a)).transpose()?;
        let reading = match effects.lag {
            Some(Lag::MeanBefore) => CurrentReading::MeanBefore,
            _ => CurrentReading::Centred,
        };
        let sensor = Sensor { noise, quantiser: None };
        instruments.current = Some(CurrentSensor { sensor, reading });
    }
    if let Some(Lag::Delay { rows }) = effects.lag {
        instruments.delay = Some(Delay::new(rows * row_s)?);
    }
    if let Some(share) = effects.late_stamps {
        instruments.stamps = Some(LateStamps::new(share * row_s)?);
    }
    Ok(instruments)
}

fn scene(
    effects: &Effects,
    dry: &DryFriction,
    load_nm: f64,
    gravity_nm: f64,
) -> Result<Scene, RigError> {
    let wander = effects.wander.map(|w| FrictionWander::new(w.relative_std, w.correlation_time_s));
    let gravity = effects.gravity.map(|g| GravityLoad::of_amplitude(gravity_nm, g.phase_rad));
    Ok(Scene {
        friction: JointFriction::Dry(dry.clone()),
        wander: wander.transpose()?,
        gravity,
        load_nm,
        ..Scene::default()
    })
}

/// The requirements on a position loop.
struct Needs {
    inertia: f64,
    motion_rad_s: f64,
    /// The smallest frequency with which the loop overcomes friction and load.
    least_rad_s: f64,
    encoder_rad: f64,
    peak_nm: f64,
    delay_s: f64,
    sample_s: f64,
}

impl Needs {
    /// Gains and frequency of the loop; `None` if none is suitable.
    fn gains(&self, draw: &mut Draw, arm: &Arm) -> Option<(Gains, f64)> {
        let zeta = draw.uniform(0.6, 1.0);
        let ratio = draw.decade(LOOP_RATIO.0, LOOP_RATIO.1);
        let most = FASTEST / (self.sample_s + self.delay_s);
        let slowest = self.least_rad_s.max(LOOP_RATIO.0 * self.motion_rad_s);
        let mut omega = (ratio * self.motion_rad_s).max(self.least_rad_s).min(most);
        let constant = arm.motor.torque_constant_nm_per_a();
        while omega >= slowest {
            for filter_s in FILTERS.map(|f| f / omega) {
                let proportional = self.inertia * omega * omega / constant;
                let derivative = 2.0 * zeta * self.inertia * omega / constant;
                let gains = Gains { proportional, derivative, filter_s };
                let rate = derivative / (self.sample_s + filter_s);
                let jump_nm = constant * self.encoder_rad * (proportional + rate);
                if jump_nm < CHATTER * self.peak_nm && is_stable(arm, &gains, self.sample_s) {
                    return Some((gains, omega));
                }
            }
            omega *= 0.8;
        }
        None
    }
}
