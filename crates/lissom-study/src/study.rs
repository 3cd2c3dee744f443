//! Many campaigns, side by side.

use std::path::Path;
use std::time::{Duration, Instant};

use lissom::identify::{Identified, IdentifyError, Options, identify};
use lissom::record::Run;
use rayon::prelude::*;

use crate::bound::Bound;
use crate::campaign::{Campaign, Rejected, RunFacts, draw_campaign};
use crate::external::{ExternalError, simulated};
use crate::law::Law;
use crate::score::{Score, score};
use crate::statistics::Share;
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
    /// What the true arm leaves of each channel, in its sensor's deviations: see [`Bound::left`].
    pub left: Vec<f64>,
    /// Time of the simulation, repeated runs included.
    pub simulation: Duration,
    /// Time of the identification.
    pub identification: Duration,
}

/// Identifies a campaign as a user would, with no options.
///
/// # Errors
/// [`IdentifyError`] where nothing can be said at all.
pub fn identified(campaign: &Campaign) -> Result<Identified, IdentifyError> {
    identify(&campaign.logs, &Options::default(), |_| {})
}

/// Runs the study on rayon's current threads; `done` is called after each campaign. `None`: a
/// campaign whose draws were all rejected.
pub fn study(study: &Study, done: impl Fn() + Sync) -> Vec<Option<Scored>> {
    (0..study.campaigns)
        .into_par_iter()
        .map(|index| {
            let start = Instant::now();
            let campaign = draw_campaign(study.seed, index, study.law);
            let scored = campaign.map(|c| Scored::of(c, start.elapsed()));
            done();
            scored
        })
        .collect()
}

/// The campaigns of a study by the rig and by another simulator.
#[derive(Debug, Clone)]
pub struct Both {
    /// By the rig.
    pub ours: Vec<Option<Scored>>,
    /// By the other.
    pub theirs: Vec<Option<Scored>>,
    /// Readings in which both are alike, of campaigns whose sensors have steps and no noise.
    pub alike: Share,
}

/// The campaigns of a study as the rig simulates them, and as another simulator did in `folder`.
///
/// # Errors
/// Where its logs cannot be read.
pub fn both(study: &Study, folder: &Path, done: impl Fn() + Sync) -> Result<Both, ExternalError> {
    let one = |index| {
        let start = Instant::now();
        let Some(campaign) = draw_campaign(study.seed, index, study.law) else { return Ok(None) };
        let took = start.elapsed();
        let other = simulated(campaign.clone(), folder)?;
        let without_noise = campaign.stratum.noise_steps.is_none();
        let alike = if without_noise { alike(&campaign, &other) } else { Share { hits: 0, of: 0 } };
        let pair = (Scored::of(campaign, took), Scored::of(other, took));
        done();
        Ok(Some((pair, alike)))
    };
    let pairs: Vec<_> =
        (0..study.campaigns).into_par_iter().map(one).collect::<Result<_, ExternalError>>()?;
    let shares = pairs.iter().flatten().map(|(_, share)| share);
    let alike = shares.fold(Share { hits: 0, of: 0 }, |sum, share| Share {
        hits: sum.hits + share.hits,
        of: sum.of + share.of,
    });
    let (ours, theirs) = pairs.into_iter().map(|p| p.map(|(pair, _)| pair).unzip()).unzip();
    Ok(Both { ours, theirs, alike })
}

/// Readings in which two logs of a campaign are within a thousandth of the finest step.
fn alike(one: &Campaign, other: &Campaign) -> Share {
    let bits = one.stratum.motor_bits.max(one.stratum.tip_bits);
    let near = 1e-3 * std::f64::consts::TAU / f64::from(1_u32 << bits);
    let mut share = Share { hits: 0, of: 0 };
    for (a, b) in one.logs.runs.iter().zip(&other.logs.runs) {
        let channels = |run: &Run| {
            std::iter::once(run.motor().to_vec()).chain(run.tips().to_vec()).collect::<Vec<_>>()
        };
        for (a, b) in channels(a).iter().flatten().zip(channels(b).iter().flatten()) {
            share.hits += usize::from((a - b).abs() < near);
            share.of += 1;
        }
    }
    share
}

impl Scored {
    /// Identifies a campaign whose simulation took so long.
    pub fn of(campaign: Campaign, simulation: Duration) -> Self {
        let start = Instant::now();
        let found = identified(&campaign);
        let identification = start.elapsed();
        let bound = Bound::of(&campaign);
        Self {
            index: campaign.index,
            stratum: campaign.stratum,
            coulomb_share: campaign.coulomb_share(),
            stuck_share: campaign.stuck_share(),
            samples: campaign.logs.runs.iter().map(Run::len).sum(),
            score: found.map(|id| score(&Truth::of(&campaign), &id).with_bound(bound.as_ref())),
            left: bound.map_or_else(Vec::new, |b| b.left),
            runs: campaign.facts,
            dropped: campaign.dropped,
            rejected: campaign.rejected,
            given_up: campaign.given_up,
            simulation,
            identification,
        }
    }
}
