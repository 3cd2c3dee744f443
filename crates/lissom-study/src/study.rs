//! Many campaigns, side by side.

use std::time::{Duration, Instant};

use lissom::identify::{Identified, IdentifyError, Options, identify};
use rayon::prelude::*;

use crate::campaign::{Campaign, Rejected, RunFacts, draw_campaign};
use crate::law::Law;
use crate::score::{Score, score};
use crate::stratum::Stratum;
use crate::trial::Dropped;
use crate::truth::Truth;

/// What a study is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Study {
    /// Campaigns, from index 0 on.
    pub campaigns: usize,
    /// Seed of all draws.
    pub seed: u64,
    /// Truth of all campaigns.
    pub law: Law,
    /// Leaves the output error out.
    pub quick: bool,
}

/// A campaign that has been identified; its logs are gone.
#[derive(Debug, Clone)]
pub struct Scored {
    /// Its place in the study.
    pub index: usize,
    /// What was asked of it.
    pub stratum: Stratum,
    /// CF over the largest torque reached.
    pub coulomb_share: f64,
    /// The largest share of a run in which the joint stuck.
    pub stuck_share: f64,
    /// What the rig knows of each run.
    pub runs: Vec<RunFacts>,
    /// Samples of all runs.
    pub samples: usize,
    /// Runs given up.
    pub dropped: Vec<Dropped>,
    /// Draws rejected before this one.
    pub rejected: Vec<Rejected>,
    /// Strata that all draws failed for.
    pub given_up: Vec<Stratum>,
    /// Figures against truth, or why nothing was identified at all.
    pub score: Result<Score, IdentifyError>,
    /// Time of the simulation, repeated runs included.
    pub simulation: Duration,
    /// Time of the identification.
    pub identification: Duration,
}

/// Identifies a campaign as a user would, with no options but perhaps `--quick`.
///
/// # Errors
/// [`IdentifyError`] where nothing can be said at all.
pub fn identified(campaign: &Campaign, quick: bool) -> Result<Identified, IdentifyError> {
    let options = Options { without_output_error: quick, ..Options::default() };
    identify(&campaign.logs, &options, |_| {})
}

/// Runs the study on rayon's current threads; `done` is called after each campaign. `None`: a
/// campaign whose draws were all rejected.
pub fn study(study: &Study, done: impl Fn() + Sync) -> Vec<Option<Scored>> {
    (0..study.campaigns)
        .into_par_iter()
        .map(|index| {
            let scored = one(study, index);
            done();
            scored
        })
        .collect()
}

fn one(study: &Study, index: usize) -> Option<Scored> {
    let start = Instant::now();
    let campaign = draw_campaign(study.seed, index, study.law)?;
    let simulation = start.elapsed();
    let start = Instant::now();
    let found = identified(&campaign, study.quick);
    let identification = start.elapsed();
    Some(Scored {
        index,
        stratum: campaign.stratum,
        coulomb_share: campaign.coulomb_share(),
        stuck_share: campaign.stuck_share(),
        samples: campaign.logs.runs.iter().map(lissom::record::Run::len).sum(),
        score: found.map(|id| score(&Truth::of(&campaign), &id)),
        runs: campaign.facts,
        dropped: campaign.dropped,
        rejected: campaign.rejected,
        given_up: campaign.given_up,
        simulation,
        identification,
    })
}
