//! Simulates and identifies many campaigns in parallel.

use std::path::Path;
use std::time::{Duration, Instant};

use lissom::identify::{Effort, Identified, IdentifyError, Options, identify};
use lissom::record::Run;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::bound::Bound;
use crate::campaign::{Campaign, RunFacts, draw_campaign};
use crate::external::{ExternalError, simulated};
use crate::law::Law;
use crate::rejected::{Dropped, Rejected};
use crate::score::{Score, score};
use crate::statistics::Share;
use crate::stratum::Stratum;
use crate::truth::Truth;

/// The settings of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Study {
    /// Campaigns, from index 0 on.
    pub campaigns: usize,
    /// Seed of all draws.
    pub seed: u64,
    /// Friction law of all campaigns.
    pub law: Law,
    /// Identifies without the output-error method.
    pub quick: bool,
}

/// A campaign after its identification, without its logs.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Scored {
    /// Its place in the study.
    pub index: usize,
    /// Its drawn properties.
    pub stratum: Stratum,
    /// CF relative to the largest torque of the logs.
    pub coulomb_share: f64,
    /// The largest share of a run in which the joint stuck.
    pub stuck_share: f64,
    /// Facts about each run that its log does not contain.
    pub runs: Vec<RunFacts>,
    /// Samples of all runs.
    pub samples: usize,
    /// Runs given up.
    pub dropped: Vec<Dropped>,
    /// Draws rejected before this one.
    pub rejected: Vec<Rejected>,
    /// Strata for which all draws failed.
    pub given_up: Vec<Stratum>,
    /// Estimates compared with the truth, or the error of the identification.
    pub score: Result<Score, String>,
    /// Residual of the true arm for each channel, in standard deviations of its sensor: see [`Bound::left`].
    pub left: Vec<f64>,
    /// Time of the simulation, with repeated runs.
    pub simulation: Duration,
    /// Time of the identification.
    pub identification: Duration,
}

/// Identifies a campaign as a user would, with default options or with `--quick`.
///
/// # Errors
/// [`IdentifyError`] if nothing can be identified.
pub fn identified(campaign: &Campaign, quick: bool) -> Result<Identified, IdentifyError> {
    let effort = if quick { Effort::Quick } else { Effort::Normal };
    let options = Options { effort, ..Options::default() };
    identify(&campaign.logs, &options, |_| {})
}

/// Runs the study on rayon's current threads, except for the campaigns that `known` returns. `done` is
/// called with each new one. `None`: a campaign for which all draws were rejected.
///
/// # Errors
/// An error of `done` ends the study and is returned.
pub fn study<E: Send>(
    study: &Study,
    known: impl Fn(usize) -> Option<Option<Scored>> + Sync,
    done: impl Fn(usize, Option<&Scored>) -> Result<(), E> + Sync,
) -> Result<Vec<Option<Scored>>, E> {
    let one = |index| {
        if let Some(known) = known(index) {
            return Ok(known);
        }
        let start = Instant::now();
        let campaign = draw_campaign(study.seed, index, study.law);
        let scored = campaign.map(|c| Scored::of(c, start.elapsed(), study.quick));
        done(index, scored.as_ref())?;
        Ok(scored)
    };
    // In order, so that a stopped study has its first campaigns.
    let numbered = (0..study.campaigns).par_bridge().map(|index| Ok((index, one(index)?)));
    let mut all = numbered.collect::<Result<Vec<_>, E>>()?;
    all.sort_by_key(|(index, _)| *index);
    Ok(all.into_iter().map(|(_, scored)| scored).collect())
}

/// Campaigns of a study that another simulator made.
#[derive(Debug, Clone)]
pub struct Independent {
    /// Every campaign, identified and compared with the truth.
    pub outcome: Vec<Option<Scored>>,
    /// Share of readings that are the same as those of the rig, for campaigns whose sensors have steps but no noise.
    pub alike: Share,
}

/// Runs the study with the logs that another simulator wrote to `folder`.
///
/// # Errors
/// If they cannot be read.
pub fn independent(
    study: &Study,
    folder: &Path,
    done: impl Fn() + Sync,
) -> Result<Independent, ExternalError> {
    let one = |index| {
        let start = Instant::now();
        let Some(rig) = draw_campaign(study.seed, index, study.law) else { return Ok(None) };
        let took = start.elapsed();
        let other = simulated(rig.clone(), folder)?;
        let noise = rig.stratum.noise_steps.is_some();
        let same = if noise { Share { hits: 0, of: 0 } } else { alike(&rig, &other) };
        let scored = Scored::of(other, took, study.quick);
        done();
        Ok(Some((scored, same)))
    };
    let all: Vec<Option<(Scored, Share)>> =
        (0..study.campaigns).into_par_iter().map(one).collect::<Result<_, ExternalError>>()?;
    let shares = || all.iter().flatten().map(|(_, share)| share);
    let alike = Share { hits: shares().map(|s| s.hits).sum(), of: shares().map(|s| s.of).sum() };
    let outcome = all.into_iter().map(|one| one.map(|(scored, _)| scored)).collect();
    Ok(Independent { outcome, alike })
}

/// Share of readings of two logs of a campaign that differ by less than a thousandth of the finest step.
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
    /// Identifies a campaign; `simulation` is the time of its simulation.
    pub fn of(campaign: Campaign, simulation: Duration, quick: bool) -> Self {
        let start = Instant::now();
        let found = identified(&campaign, quick);
        let identification = start.elapsed();
        let bound = Bound::of(&campaign);
        Self {
            index: campaign.index,
            stratum: campaign.stratum,
            coulomb_share: campaign.coulomb_share(),
            stuck_share: campaign.stuck_share(),
            samples: campaign.logs.runs.iter().map(Run::len).sum(),
            score: found
                .map(|id| score(&Truth::of(&campaign), &id).with_bound(bound.as_ref()))
                .map_err(|error| error.to_string()),
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
