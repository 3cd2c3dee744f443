//! The runs worth making: from rough numbers of an arm, the campaign that gives the wanted precision in
//! the least time.
//!
//! Motions are made as large as current, travel, bending and sensors allow by simulating them; what
//! each of them says of every figure comes from the replay's exact derivatives; of all, those are
//! chosen that reach the wanted deviations soonest.

mod addition;
mod choose;
mod known;
mod loaded_information;
mod note;
mod plan_text;
mod planned_figure;
mod planned_motion;
mod planner;
mod sizing;
mod table;
pub(crate) mod thresholds;
mod wish;

use nalgebra::DMatrix;
use rayon::prelude::*;
use thiserror::Error;

pub use crate::information::Figure;
use crate::information::growing_information;
use crate::plan::thresholds::{TRANSIENT_MOST_S, TRANSIENT_MOST_SHARE};
use crate::replay::TURN_MOST;
use crate::rig::{Rig, Scene};
pub use addition::{Addition, Bounds, additions};
use choose::choose;
use known::KnownRig;
pub use note::PlanNote;
pub use planned_figure::{PlannedFigure, PlannedUnknown};
pub use planned_motion::PlannedMotion;
use planned_motion::{Group, Reach, groups};
use planner::Planner;
use sizing::Limits;
pub use sizing::Unfit;
pub use table::{ReferenceTable, reference_table};
pub use wish::{Kinds, Precision, Wishes};

/// Sizes of a motion, as shares of the largest.
const SHARES: [f64; 2] = [1.0, 0.4];
/// Time from one run to the next: the arm goes back to its start \[s\].
pub const BETWEEN_S: f64 = 5.0;
/// Most numbers that one simulation goes through, samples times states: a fraction of a second, as there
/// are some hundred.
const WORK_MOST: f64 = 2e6;

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The beam has no modes that can be told apart.
    #[error("the beam of {masses} masses has no distinct modes to plan for")]
    Modes {
        /// Its masses.
        masses: usize,
    },
    /// Gravity on an arm with a beam.
    #[error("gravity is planned for a rigid joint, and this arm has a beam of {masses} masses")]
    GravityOnBeam {
        /// Its masses.
        masses: usize,
    },
    /// A wish that makes no sense.
    #[error("{quantity} = {found} is not positive and finite")]
    Wish {
        /// Which.
        quantity: &'static str,
        /// What was found.
        found: f64,
    },
    /// Simulations would take too long.
    #[error(
        "a run of {record_s:.1} s has {samples:.1e} samples of {states} states: too many to try \
         dozens of them"
    )]
    TooMuch {
        /// Time of the run \[s\].
        record_s: f64,
        /// Its samples.
        samples: f64,
        /// States of the arm.
        states: usize,
    },
    /// The arm is far faster than its sampling.
    #[error(
        "the arm's state changes at up to {rate_per_s:.1e} 1/s, thousands of times within a sample of \
         {sample_time_s} s: some number is off by orders of magnitude"
    )]
    TooFast {
        /// Bound on the rates of its state matrix \[1/s\].
        rate_per_s: f64,
        /// Time between two samples \[s\].
        sample_time_s: f64,
    },
    /// No motion is of any use.
    #[error("none of {tried} motions is of use: {}", reasons.join("; "))]
    NoMotion {
        /// Motions tried.
        tried: usize,
        /// How many failed for what.
        reasons: Vec<String>,
    },
    /// The time is too short for any run.
    #[error("no run fits within {within_s} s; the shortest takes {shortest_s:.1} s")]
    NoTime {
        /// The time given \[s\].
        within_s: f64,
        /// What is needed at least \[s\].
        shortest_s: f64,
    },
}

/// A run that is worth making.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// What the motor is asked to do.
    pub motion: PlannedMotion,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time logged \[s\].
    pub record_s: f64,
    /// Time before, in which the transient goes \[s\].
    pub waited_s: f64,
    /// Largest current expected \[A\].
    pub peak_current_a: f64,
    /// Half of the motor's way \[rad\].
    pub moved_rad: f64,
    /// Part of the record in which the joint sticks.
    pub stuck_share: f64,
    /// Whether it is made for a pair: a sine or its triple.
    pub paired: bool,
    /// Why it is there: the figure that would be furthest from what is wanted of it without it (without
    /// both of a pair), and its relative deviation then. `None` where all wishes would come true.
    pub without: Option<(PlannedFigure, f64)>,
}

impl PlannedRun {
    /// Why it is there.
    pub fn in_words(&self) -> String {
        let it = if self.paired { "this pair" } else { "it" };
        match self.without {
            None if self.paired => "for the third-harmonic method".to_owned(),
            None => "no wish needs it alone".to_owned(),
            Some((figure, std)) if std >= 1.0 => {
                format!("without {it} {} is not found", figure.name())
            }
            Some((figure, std)) => {
                format!("without {it} {} is known to {} only", figure.name(), percent(std))
            }
        }
    }
}

/// A share with two digits, such as `0.12 %`.
pub fn percent(share: f64) -> String {
    let size = 100.0 * share;
    let digits = (1.0 - size.abs().log10().floor()).clamp(0.0, 9.0);
    format!("{size:.*} %", digits as usize)
}

/// What a plan gives of one figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The figure.
    pub figure: PlannedFigure,
    /// Its value as far as it is known \[SI\].
    pub value: f64,
    /// Standard deviation expected, relative.
    pub std: f64,
    /// What was wanted.
    pub wanted: f64,
}

/// A campaign worth making.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Its runs.
    pub runs: Vec<PlannedRun>,
    /// What it gives.
    pub expected: Vec<Expected>,
    /// Every parameter that an identification has to find, its value and standard deviation \[SI\]; an
    /// infinite one where no run shows it.
    pub parameters: Vec<(PlannedUnknown, f64, f64)>,
    /// Time of all runs, with waiting and the way back to the start \[s\].
    pub time_s: f64,
    /// What a user should know.
    pub notes: Vec<PlanNote>,
    /// Longest that a run waits for its transient \[s\].
    pub longest_wait_s: f64,
}

/// A motion that fits, and what it says.
struct Candidate {
    run: PlannedRun,
    speed_rad_s: f64,
    /// After one, two, … stretches.
    information: Vec<DMatrix<f64>>,
}

/// The campaign that gives the wanted precision in the least time, by simulations of a rig whose numbers
/// may be rough. `progress` is called with the motions tried and all of them.
///
/// The joint has Coulomb friction alone and the tip is free, whatever the rig's [`Scene`]. Gravity of a rigid joint's
/// load is counted: motions are simulated with it, and g_s and g_c are two unknowns more.
///
/// # Errors
/// [`PlanError`].
pub fn plan(
    rig: &Rig,
    wishes: &Wishes,
    progress: impl Fn(usize, usize) + Sync,
) -> Result<Plan, PlanError> {
    check(wishes)?;
    let gravity = rig.scene.gravity;
    let masses = rig.arm.beam().len();
    if gravity.is_some() && masses > 0 {
        return Err(PlanError::GravityOnBeam { masses });
    }
    let plain = Rig { scene: Scene { gravity, ..Scene::default() }, ..rig.clone() };
    let (rate_per_s, sample_time_s) = (rig.arm.rate_bound(), rig.instruments.sample_time_s);
    let turn = rate_per_s * sample_time_s;
    if turn > TURN_MOST || turn.is_nan() {
        return Err(PlanError::TooFast { rate_per_s, sample_time_s });
    }
    let known = KnownRig::of(&plain)?;
    let reach = Reach {
        arm: &known.arm,
        torque_nm: rig.arm.motor.torque_constant_nm_per_a() * rig.instruments.amplifier.most_a(),
        load_nm: gravity.map_or(0.0, |load| load.amplitude_nm()),
        travel_rad: wishes.travel_rad,
        command_time_s: rig.instruments.control_time_s(),
    };
    let all = groups(&reach, wishes.kinds == Kinds::Sines);
    let longest_s = longest_wait_s(&plain, wishes, &all)?;
    let limits = Limits::of(&plain, wishes, longest_s);
    let tried: Vec<(&Group, f64)> =
        all.iter().flat_map(|group| SHARES.map(|share| (group, share))).collect();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let found: Vec<Result<Vec<Candidate>, Unfit>> = tried
        .par_iter()
        .map(|(group, share)| {
            let found = group.iter().map(|m| candidate(&plain, &known, &limits, m, *share));
            let found = found.collect();
            progress(1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed), tried.len());
            found
        })
        .collect();
    let planner = Planner::new(&known, &plain, wishes, &found)?;
    let chosen = choose(&planner.choices, &planner.goal);
    let mut notes = note::of_rig(rig, &known);
    notes.extend(note::of_unfit(&found));
    Ok(planner.plan(&chosen, notes, longest_s))
}

fn check(wishes: &Wishes) -> Result<(), PlanError> {
    let p = wishes.precision;
    let reserve = 1.0 - wishes.current_reserve;
    for (quantity, found) in [
        ("the wanted deviation of Coulomb friction", p.coulomb),
        ("the wanted deviation of viscous friction", p.viscous),
        ("the wanted deviation of the inertia", p.inertia),
        ("the wanted deviation of the coupling", p.coupling),
        ("the wanted deviation of the frequencies", p.frequency),
        ("the wanted deviation of damping", p.damping),
        ("the wanted deviation of gravity", p.gravity),
        ("the time of all runs", wishes.within_s),
        ("the travel", wishes.travel_rad),
        ("the bending", wishes.bend_rad),
        ("the current not in reserve", reserve),
    ] {
        if !(found > 0.0 && found.is_finite()) {
            return Err(PlanError::Wish { quantity, found });
        }
    }
    Ok(())
}

/// The longest wait that keeps a simulation short enough.
fn longest_wait_s(rig: &Rig, wishes: &Wishes, all: &[Group]) -> Result<f64, PlanError> {
    let record = |m: &PlannedMotion| m.stretch_s() * m.stretches() as f64;
    let record_s = all.iter().flatten().map(record).fold(0.0, f64::max);
    let states = rig.arm.state_len();
    let most_s = WORK_MOST / states as f64 * rig.instruments.sample_time_s;
    if record_s > 0.5 * most_s {
        let samples = record_s / rig.instruments.sample_time_s;
        return Err(PlanError::TooMuch { record_s, samples, states });
    }
    Ok(TRANSIENT_MOST_S.min(TRANSIENT_MOST_SHARE * wishes.within_s).min(most_s - record_s))
}

fn candidate(
    rig: &Rig,
    known: &KnownRig<'_>,
    limits: &Limits,
    motion: &PlannedMotion,
    share: f64,
) -> Result<Candidate, Unfit> {
    let stretch_s = motion.stretch_s();
    let record_s = stretch_s * motion.stretches() as f64;
    let mut found = limits.largest(rig, motion, record_s)?;
    if share < 1.0 {
        found = limits.of_size(rig, motion, share * found.amplitude_rad, record_s)?;
    }
    let (campaign, window) = known.record(rig, &found.logged).ok_or(Unfit::Impossible)?;
    let samples = stretch_s / rig.instruments.log_time_s();
    let mut information = if let Some(joint) = known.loaded() {
        joint.growing(motion, &campaign.runs[0], samples)
    } else {
        let (arm, free, windows) = (&known.arm, &known.parameters, [window]);
        let mut growing =
            growing_information(arm, free, &campaign, &windows, &known.noise, samples);
        growing.pop().ok_or(Unfit::Impossible)?
    };
    // The record's last sample may begin one more.
    information.truncate(motion.stretches());
    Ok(Candidate {
        run: PlannedRun {
            motion: *motion,
            amplitude_rad: found.amplitude_rad,
            record_s,
            waited_s: found.logged.settled.waited_s,
            peak_current_a: found.peak_a,
            moved_rad: found.moved_rad,
            stuck_share: found.logged.stuck_share,
            paired: false,
            without: None,
        },
        speed_rad_s: speed_rad_s(&found.logged.run),
        information,
    })
}

/// Largest speed over some samples: over one, the sensor's steps would be the fastest.
fn speed_rad_s(run: &crate::record::Run) -> f64 {
    let reach = (run.len() / 50).clamp(1, 10);
    let moved = run.motor().windows(reach + 1).map(|w| (w[reach] - w[0]).abs());
    moved.fold(0.0, f64::max) / (reach as f64 * run.sample_time_s())
}
