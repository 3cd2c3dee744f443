//! Several experiments on one rig.

use rayon::prelude::*;

use super::{Controller, Experiment, Logged, Rig, RigError};
use crate::record::Campaign;

/// Seed of the first run of [`Rig::campaign`]; each further run has the next number.
const FIRST_SEED: u64 = 1;

/// Logs of several experiments with one rig, and what the simulator knows about each.
#[derive(Debug, Clone)]
pub struct VirtualCampaign {
    /// The logs and their channels, as a user would have them.
    pub campaign: Campaign,
    /// Each run with what the simulator knows about it, in the same order.
    pub logged: Vec<Logged>,
}

impl AsRef<Campaign> for VirtualCampaign {
    fn as_ref(&self) -> &Campaign {
        &self.campaign
    }
}

/// An argument of [`Rig::campaign`]: an experiment, or the result of building one.
pub trait PlannedExperiment {
    /// The experiment.
    ///
    /// # Errors
    /// The error of building it.
    fn experiment(self) -> Result<Experiment, RigError>;
}

impl PlannedExperiment for Experiment {
    fn experiment(self) -> Result<Experiment, RigError> {
        Ok(self)
    }
}

impl PlannedExperiment for Result<Experiment, RigError> {
    fn experiment(self) -> Result<Experiment, RigError> {
        self
    }
}

impl Rig {
    /// Runs experiments with the rig's own controller, on all cores.
    ///
    /// Runs are called `run 1`, `run 2` and so on. The noise of each run has its own fixed seed, so that the same
    /// experiments give the same logs to the last bit.
    ///
    /// ```
    /// use lissom::prelude::*;
    /// # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02).build()?;
    /// # let rig = Rig::builder(arm).sample_time_s(3e-3).controller(Pd::new(8.0, 0.25)?).build()?;
    /// let logs = rig.campaign([1.0, 3.0].map(|w| Experiment::sine(w, 0.5, 20.0)))?; // rad/s, rad, s
    /// assert_eq!(logs.campaign.runs.len(), 2);
    /// # Ok::<(), lissom::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`run`](Self::run), for the first experiment that fails; [`RigError::Record`] without experiments.
    pub fn campaign<E: PlannedExperiment>(
        &self,
        experiments: impl IntoIterator<Item = E>,
    ) -> Result<VirtualCampaign, RigError> {
        self.campaign_from_seed(FIRST_SEED, experiments)
    }

    /// As [`campaign`](Self::campaign), the seeds of the noise beginning with `seed`: give another one for logs that are
    /// independent of those of [`campaign`](Self::campaign), as for a validation.
    ///
    /// # Errors
    /// As [`campaign`](Self::campaign).
    pub fn campaign_from_seed<E: PlannedExperiment>(
        &self,
        seed: u64,
        experiments: impl IntoIterator<Item = E>,
    ) -> Result<VirtualCampaign, RigError> {
        let runs: Vec<(String, u64, Experiment)> = numbered(seed, experiments)?;
        let logged: Vec<_> =
            runs.par_iter().map(|(name, seed, e)| self.run(name, e, *seed)).collect();
        self.collected(logged.into_iter().collect::<Result<_, _>>()?)
    }

    /// Runs experiments with a controller of your own, one after another.
    ///
    /// # Errors
    /// Those of [`campaign`](Self::campaign) and [`run_with`](Self::run_with).
    pub fn campaign_with<C: Controller + ?Sized, E: PlannedExperiment>(
        &self,
        controller: &mut C,
        experiments: impl IntoIterator<Item = E>,
    ) -> Result<VirtualCampaign, RigError> {
        let runs: Vec<(String, u64, Experiment)> = numbered(FIRST_SEED, experiments)?;
        let one =
            |(name, seed, e): &(String, u64, Experiment)| self.run_with(controller, name, e, *seed);
        let logged = runs.iter().map(one).collect::<Result<_, _>>()?;
        self.collected(logged)
    }

    fn collected(&self, logged: Vec<Logged>) -> Result<VirtualCampaign, RigError> {
        let channels = self.channels(0..self.arm.beam().len())?;
        let runs = logged.iter().map(|one| one.run.clone()).collect();
        let mut campaign = Campaign::new(channels, runs)?;
        if self.scene.gravity.is_some() {
            campaign = campaign.with_gravity()?;
        }
        Ok(VirtualCampaign { campaign, logged })
    }
}

fn numbered<E: PlannedExperiment>(
    first_seed: u64,
    experiments: impl IntoIterator<Item = E>,
) -> Result<Vec<(String, u64, Experiment)>, RigError> {
    let one = |(number, e): (u64, E)| {
        Ok((format!("run {}", number + 1), first_seed.wrapping_add(number), e.experiment()?))
    };
    (0..).zip(experiments).map(one).collect()
}
