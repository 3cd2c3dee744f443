//! A random campaign: its definition, its logs, and why draws were rejected.

use lissom::record::Run;
use lissom::rig::{Experiment, Rig};
use serde::{Deserialize, Serialize};

use crate::bench::Bench;
use crate::draw::Draw;
use crate::law::Law;
use crate::plan::ideas;
use crate::rejected::{Dropped, Rejected};
use crate::stratum::{COULOMB_SHARE, Kind, Stratum};
use crate::trial::tried;

/// Largest number of draws with one stratum.
const DRAWS_MOST: usize = 50;
/// Largest number of strata for one campaign.
const STRATA_MOST: usize = 50;

/// Everything that a simulator needs to make the logs.
#[derive(Debug, Clone)]
pub struct Definition {
    /// Arm, friction, instruments and controller.
    pub rig: Rig,
    /// The runs.
    pub runs: Vec<PlannedRun>,
}

/// A run of a definition.
#[derive(Debug, Clone)]
pub struct PlannedRun {
    /// Its name.
    pub name: String,
    /// Reference, settling, length.
    pub experiment: Experiment,
    /// Seed of the sensors' noise.
    pub seed: u64,
}

/// Facts about a run that its log does not contain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunFacts {
    /// Share of the record in which the joint stuck \[1\].
    pub stuck_share: f64,
    /// Time before the log \[s\].
    pub waited_s: f64,
    /// Largest current \[A\].
    pub peak_a: f64,
    /// State at the log's first row, `[θ_m, θ̇_m, θ_i.., θ̇_i..]`.
    pub start: Vec<f64>,
}

/// A campaign as it was simulated.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// Its place in the study.
    pub index: usize,
    /// Its drawn properties.
    pub stratum: Stratum,
    /// How its arm differs from lissom's equations.
    pub law: Law,
    /// The definition from which it was simulated.
    pub definition: Definition,
    /// The logs.
    pub logs: lissom::record::Campaign,
    /// Facts about each run that its log does not contain.
    pub facts: Vec<RunFacts>,
    /// Runs that were given up.
    pub dropped: Vec<Dropped>,
    /// Draws that were rejected before this one.
    pub rejected: Vec<Rejected>,
    /// Strata for which all draws failed.
    pub given_up: Vec<Stratum>,
}

impl Campaign {
    /// CF relative to the largest torque of all runs.
    pub fn coulomb_share(&self) -> f64 {
        let motor = &self.definition.rig.arm.motor;
        let peak_a = self.facts.iter().map(|f| f.peak_a).fold(0.0, f64::max);
        sliding(&self.definition.rig) / (motor.torque_constant_nm_per_a() * peak_a)
    }

    /// The largest share of a run in which the joint stuck.
    pub fn stuck_share(&self) -> f64 {
        self.facts.iter().map(|f| f.stuck_share).fold(0.0, f64::max)
    }
}

/// Friction at speed, mean of both directions \[N·m\].
pub(crate) fn sliding(rig: &Rig) -> f64 {
    0.5 * (rig.arm.coulomb.forward() + rig.arm.coulomb.backward())
}

/// Campaign `index` of the study with `seed`; `None` if all 2500 draws were rejected.
pub fn draw_campaign(seed: u64, index: usize, law: Law) -> Option<Campaign> {
    let mut draw = Draw::of(seed, index);
    let (mut rejected, mut given_up) = (Vec::new(), Vec::new());
    while given_up.len() < STRATA_MOST {
        let stratum = Stratum::draw(&mut draw);
        for _ in 0..DRAWS_MOST {
            match drawn(&mut draw, stratum, law, index) {
                Ok(campaign) => return Some(Campaign { rejected, given_up, ..campaign }),
                Err(why) => rejected.push(why),
            }
        }
        given_up.push(stratum);
    }
    None
}

fn drawn(draw: &mut Draw, stratum: Stratum, law: Law, index: usize) -> Result<Campaign, Rejected> {
    let bench = Bench::draw(draw, &stratum, law)?;
    let (mut runs, mut logs, mut facts, mut dropped) = (vec![], vec![], vec![], vec![]);
    for idea in ideas(draw, &bench, stratum.kind) {
        let name = format!("{:02} {}", logs.len() + 1, idea.shape.name());
        let seed = draw.seed();
        match tried(&bench, &idea, &name, seed) {
            Ok((logged, experiment)) => {
                facts.push(RunFacts {
                    stuck_share: logged.stuck_share,
                    waited_s: logged.settled.waited_s,
                    peak_a: peak(&logged.run),
                    start: logged.start,
                });
                logs.push(logged.run);
                runs.push(PlannedRun { name, experiment, seed });
            }
            Err(why) => dropped.push(why),
        }
    }
    if logs.len() < runs_least(stratum.kind) {
        return Err(Rejected::FewRuns(commonest(&dropped)));
    }
    let channels = bench.rig.channels(0..bench.rig.arm.beam().len())?;
    let logs = lissom::record::Campaign::new(channels, logs)
        .map_err(|error| Rejected::Impossible(error.to_string()))?;
    let definition = Definition { rig: bench.rig, runs };
    let campaign = Campaign {
        index,
        stratum,
        law,
        definition,
        logs,
        facts,
        dropped,
        rejected: vec![],
        given_up: vec![],
    };
    let share = campaign.coulomb_share();
    if (COULOMB_SHARE.0..=COULOMB_SHARE.1).contains(&share) {
        Ok(campaign)
    } else {
        Err(Rejected::CoulombShare)
    }
}

/// Smallest number of good runs in a campaign.
fn runs_least(kind: Kind) -> usize {
    match kind {
        Kind::Sines | Kind::Mixed => 4,
        Kind::Multisines | Kind::Chirps => 3,
    }
}

fn commonest(dropped: &[Dropped]) -> Dropped {
    let count = |why: &&Dropped| dropped.iter().filter(|d| d == why).count();
    // A campaign without runs had planned runs, and each of them was dropped for a reason.
    dropped.iter().max_by_key(count).copied().unwrap_or(Dropped::Impossible)
}

/// Largest current of a run \[A\].
pub(crate) fn peak(run: &Run) -> f64 {
    run.command().iter().fold(0.0_f64, |most, i| most.max(i.abs()))
}
