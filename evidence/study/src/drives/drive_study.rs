//! Simulates and identifies many drives in parallel.

use std::time::{Duration, Instant};

use lissom::identify::{Effort, Identified, IdentifyError, Options, identify};
use rayon::prelude::*;

use super::drive_campaign::{DriveCampaign, DriveNumbers};
use super::drive_score::{DriveScore, score_drive};
use super::effects::{Cause, DriveStudy, Effects};
use super::planned_motion::MotionKind;

/// The settings of a study of drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DriveStudyPlan {
    /// The kind of study.
    pub study: DriveStudy,
    /// Campaigns, from index 0 on.
    pub campaigns: usize,
    /// Seed of all draws.
    pub seed: u64,
    /// Identifies without the output-error method.
    pub quick: bool,
}

/// A campaign after its identification, without its logs.
#[derive(Debug, Clone)]
pub struct DriveOutcome {
    /// Its place in the study.
    pub index: usize,
    /// Its cause, in a study of causes.
    pub cause: Option<Cause>,
    /// The effects that the simplest equation does not have.
    pub effects: Effects,
    /// The numbers of the drive.
    pub numbers: DriveNumbers,
    /// The kind of motion of its runs.
    pub motion: MotionKind,
    /// Runs.
    pub runs: usize,
    /// Rows of all runs.
    pub rows: usize,
    /// The largest share of a run in which the joint stuck.
    pub stuck_share: f64,
    /// Reasons of the draws that were rejected before.
    pub rejected: Vec<String>,
    /// Parameters compared with the truth, or the error of the identification.
    pub score: Result<DriveScore, String>,
    /// Time of the simulation, with rejected draws.
    pub simulation: Duration,
    /// Time of the identification.
    pub identification: Duration,
}

/// Identifies a drive's campaign as a user would.
///
/// # Errors
/// [`IdentifyError`] if nothing can be identified.
pub(super) fn identified_drive(
    campaign: &DriveCampaign,
    quick: bool,
) -> Result<Identified, IdentifyError> {
    let effort = if quick { Effort::Quick } else { Effort::Normal };
    identify(&campaign.logs, &Options { effort, ..Options::default() }, |_| {})
}

/// Runs the study on rayon's current threads; `done` is called after each campaign. `None`: all draws were rejected.
pub fn drive_study(plan: &DriveStudyPlan, done: impl Fn() + Sync) -> Vec<Option<DriveOutcome>> {
    let one = |index| {
        let start = Instant::now();
        let campaign = DriveCampaign::draw(plan.study, plan.seed, index);
        let outcome = campaign.map(|c| DriveOutcome::of(&c, start.elapsed(), plan.quick));
        done();
        (index, outcome)
    };
    let mut all: Vec<_> = (0..plan.campaigns).into_par_iter().with_max_len(1).map(one).collect();
    all.sort_by_key(|(index, _)| *index);
    all.into_iter().map(|(_, outcome)| outcome).collect()
}

impl DriveOutcome {
    /// Identifies a campaign; `simulation` is the time of its simulation.
    pub fn of(campaign: &DriveCampaign, simulation: Duration, quick: bool) -> Self {
        let start = Instant::now();
        let found = identified_drive(campaign, quick);
        let identification = start.elapsed();
        Self {
            index: campaign.index,
            cause: campaign.cause(),
            effects: campaign.effects,
            numbers: campaign.numbers,
            motion: campaign.motion,
            runs: campaign.raw.len(),
            rows: campaign.raw.iter().map(|(_, run)| run.len()).sum(),
            stuck_share: campaign.stuck_share.iter().copied().fold(0.0, f64::max),
            rejected: campaign.rejected.clone(),
            score: found.map(|id| score_drive(campaign, &id)).map_err(|error| error.to_string()),
            simulation,
            identification,
        }
    }
}
