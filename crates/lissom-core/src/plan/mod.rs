//! Plans a campaign: from rough parameters of an arm, the runs that give the requested precision in the shortest time.
//!
//! Each motion is simulated and made as large as current, travel, bending and sensors allow. The exact derivatives of the
//! replay give its information on each parameter. Then the motions are chosen that reach the requested standard errors
//! in the shortest time.

mod addition;
mod choose;
mod known;
mod loaded_information;
mod note;
mod plan_text;
mod planned_motion;
mod planned_parameter;
mod planner;
mod sizing;
mod table;
pub(crate) mod thresholds;
mod wish;

use nalgebra::DMatrix;
use rayon::prelude::*;
use thiserror::Error;

pub use crate::information::ArmParameter;
use crate::information::growing_information;
use crate::plan::thresholds::{TRANSIENT_MOST_S, TRANSIENT_MOST_SHARE};
use crate::replay::TURN_MOST;
use crate::rig::{Rig, Scene};
pub use addition::{Addition, Bounds, additions};
use choose::choose;
use known::KnownRig;
pub use note::PlanNote;
pub use planned_motion::PlannedMotion;
use planned_motion::{Group, Reach, groups};
pub use planned_parameter::{PlannedParameter, PlannedUnknown};
use planner::Planner;
use sizing::Limits;
pub use sizing::Unfit;
pub use table::{ReferenceTable, reference_table};
pub use wish::{Kinds, Precision, Wishes};

/// Amplitudes of a motion that are tried, as shares of the largest.
const SHARES: [f64; 2] = [1.0, 0.4];
/// Time between two runs, in which the arm returns to its start \[s\].
pub const BETWEEN_S: f64 = 5.0;
/// Largest size of one simulation, samples times states: about a hundred simulations are made, each in a fraction of a
/// second.
const WORK_MOST: f64 = 2e6;

/// Error of [`plan`].
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The modes of the beam cannot be separated.
    #[error(
        "the modes of the beam of {masses} masses cannot be separated, so there is nothing to plan for"
    )]
    Modes {
        /// Masses of the beam.
        masses: usize,
    },
    /// Gravity acts on an arm with a beam.
    #[error(
        "gravity can be planned for a rigid joint only, but this arm has a beam of {masses} masses"
    )]
    GravityOnBeam {
        /// Masses of the beam.
        masses: usize,
    },
    /// A wish is not a positive, finite number.
    #[error("{quantity} is {found}, but must be positive and finite")]
    Wish {
        /// Name of the wish.
        quantity: &'static str,
        /// Its value.
        found: f64,
    },
    /// Simulations would take too long.
    #[error(
        "a run of {record_s:.1} s has {samples:.1e} samples of {states} states: too many to try dozens of such runs"
    )]
    TooMuch {
        /// Time of the run \[s\].
        record_s: f64,
        /// Its samples.
        samples: f64,
        /// States of the arm.
        states: usize,
    },
    /// The arm changes far faster than the sample time.
    #[error(
        "the arm's state changes at up to {rate_per_s:.1e} 1/s, thousands of times within a sample of \
         {sample_time_s} s: a parameter is wrong by orders of magnitude"
    )]
    TooFast {
        /// Bound on the rates of its state matrix \[1/s\].
        rate_per_s: f64,
        /// Time between two samples \[s\].
        sample_time_s: f64,
    },
    /// No motion can be used.
    #[error("none of {tried} motions can be used: {}", reasons.join("; "))]
    NoMotion {
        /// Motions tried.
        tried: usize,
        /// Reasons, each with the number of motions.
        reasons: Vec<String>,
    },
    /// The time is too short for any run.
    #[error("no run fits within {within_s} s; the shortest takes {shortest_s:.1} s")]
    NoTime {
        /// Time allowed \[s\].
        within_s: f64,
        /// Time of the shortest run \[s\].
        shortest_s: f64,
    },
}

/// A run of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedRun {
    /// Reference motion of the motor.
    pub motion: PlannedMotion,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time logged \[s\].
    pub record_s: f64,
    /// Waiting time before the log begins, in which the transient decays \[s\].
    pub waited_s: f64,
    /// Largest current expected \[A\].
    pub peak_current_a: f64,
    /// Half of the motor's travel \[rad\].
    pub moved_rad: f64,
    /// Share of the record in which the joint sticks.
    pub stuck_share: f64,
    /// Whether it belongs to a pair of sines at a frequency and three times that frequency.
    pub paired: bool,
    /// Reason for the run: the parameter that would miss its requested precision most without it (without both runs of a
    /// pair), and its relative standard error in this case. `None` if all requested precisions would still be reached.
    pub without: Option<(PlannedParameter, f64)>,
}

impl PlannedRun {
    /// Reason for the run, in words.
    pub fn in_words(&self) -> String {
        let it = if self.paired { "this pair" } else { "it" };
        match self.without {
            None if self.paired => "for the third-harmonic method".to_owned(),
            None => "the requested precision does not depend on this run alone".to_owned(),
            Some((parameter, std)) if std >= 1.0 => {
                format!("without {it}, {} cannot be identified", parameter.name())
            }
            Some((parameter, std)) => {
                format!(
                    "without {it}, the standard error of {} would be {}",
                    parameter.name(),
                    percent(std)
                )
            }
        }
    }
}

/// A share in percent with two digits, such as `0.12 %`.
pub fn percent(share: f64) -> String {
    let size = 100.0 * share;
    let digits = (1.0 - size.abs().log10().floor()).clamp(0.0, 9.0);
    format!("{size:.*} %", digits as usize)
}

/// Expected precision of one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The parameter.
    pub parameter: PlannedParameter,
    /// Its rough value \[SI\].
    pub value: f64,
    /// Expected standard error, relative.
    pub std: f64,
    /// Requested standard error, relative.
    pub wanted: f64,
}

/// A planned campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Its runs.
    pub runs: Vec<PlannedRun>,
    /// Expected precision of each parameter.
    pub expected: Vec<Expected>,
    /// Each unknown of the identification with its value and expected standard error \[SI\], which is infinite if no run
    /// shows the unknown.
    pub parameters: Vec<(PlannedUnknown, f64, f64)>,
    /// Time of all runs, including waiting and the return to the start \[s\].
    pub time_s: f64,
    /// Notes: wishes that are not met, and assumptions.
    pub notes: Vec<PlanNote>,
    /// Longest time that a run waits for its transient to decay \[s\].
    pub longest_wait_s: f64,
}

/// A motion within the limits, with its information.
struct Candidate {
    run: PlannedRun,
    speed_rad_s: f64,
    /// Information after one, two, … stretches.
    information: Vec<DMatrix<f64>>,
}

/// Finds the campaign that gives the requested precision in the shortest time, by simulating a rig with rough parameters.
/// `progress` is called with the number of motions tried and the number of all motions.
///
/// Friction terms beyond Coulomb and viscous friction, torque ripples and the world at the tip (see [`Scene`]) are left out.
/// Gravity of a rigid joint's load is included: motions are simulated with it, and g_s and g_c are two further unknowns.
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
        ("the requested standard error of Coulomb friction", p.coulomb),
        ("the requested standard error of viscous friction", p.viscous),
        ("the requested standard error of inertia", p.inertia),
        ("the requested standard error of coupling", p.coupling),
        ("the requested standard error of the frequencies", p.frequency),
        ("the requested standard error of damping", p.damping),
        ("the requested standard error of gravity", p.gravity),
        ("the time of all runs", wishes.within_s),
        ("the allowed travel", wishes.travel_rad),
        ("the allowed bending", wishes.bend_rad),
        ("the share of the current without the reserve", reserve),
    ] {
        if !(found > 0.0 && found.is_finite()) {
            return Err(PlanError::Wish { quantity, found });
        }
    }
    Ok(())
}

/// The longest wait for which a simulation is still short enough.
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

/// Largest speed, averaged over several samples: over one sample the sensor's steps would dominate.
fn speed_rad_s(run: &crate::record::Run) -> f64 {
    let reach = (run.len() / 50).clamp(1, 10);
    let moved = run.motor().windows(reach + 1).map(|w| (w[reach] - w[0]).abs());
    moved.fold(0.0, f64::max) / (reach as f64 * run.sample_time_s())
}
