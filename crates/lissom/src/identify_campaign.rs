//! Builder of an identification: its options are set one by one, by name.

use std::time::Duration;

use lissom_core::identify::{Effort, IdentifyError, Interrupt, Options, Stage, identify};
use lissom_core::record::Campaign;
use lissom_io::CampaignFile;

use crate::found::Found;

/// Builder of an identification: the campaign, and the options of [`identify`](fn@crate::identify::identify).
///
/// ```
/// use lissom::prelude::*;
/// # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02).build()?;
/// # let rig = Rig::builder(arm).sample_time_s(3e-3).controller(Pd::new(8.0, 0.25)?).build()?;
/// # let logs = rig.campaign([1.0, 3.0].map(|w| Experiment::sine(w, 0.5, 20.0)))?;
/// let found = Identify::new(&logs).effort(Effort::Quick).run()?;
/// assert!(found.inertia().is_some());
/// # Ok::<(), lissom::Error>(())
/// ```
#[must_use = "nothing is identified before `run`"]
pub struct Identify<'c> {
    campaign: &'c Campaign,
    options: Options,
    limit: Option<Duration>,
    progress: Box<dyn FnMut(Stage) + 'c>,
}

impl<'c> Identify<'c> {
    /// Starts the identification of a [`Campaign`] or of a simulated one.
    pub fn new(campaign: &'c impl AsRef<Campaign>) -> Self {
        Self {
            campaign: campaign.as_ref(),
            options: Options::default(),
            limit: None,
            progress: Box::new(|_| ()),
        }
    }

    /// Starts the identification of a campaign that was read from files, with the options of its table `[analysis]`.
    pub fn of_file(file: &'c CampaignFile) -> Self {
        Self::new(&file.campaign).options(file.options())
    }

    /// Sets the effort of the output-error method. [`Effort::Quick`] leaves that method out
    /// and takes a fraction of a second.
    pub fn effort(mut self, effort: Effort) -> Self {
        self.options.effort = effort;
        self
    }

    /// Sets the length of the regression's window \[s\]; otherwise a length is chosen from the data.
    pub fn window_s(mut self, window_s: f64) -> Self {
        self.options.window_s = vec![window_s];
        self
    }

    /// Sets all options at once, in place of those set before.
    pub fn options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// Limits the time: the search then ends with its best result so far, which depends on the speed of the machine.
    pub fn time_limit(mut self, limit: Duration) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Ends the search with its best result so far when another thread requests it.
    pub fn interrupt(mut self, interrupt: Interrupt) -> Self {
        self.options.interrupt = interrupt;
        self
    }

    /// Sets a function that is called at the beginning of each stage.
    pub fn progress(mut self, progress: impl FnMut(Stage) + 'c) -> Self {
        self.progress = Box::new(progress);
        self
    }

    /// Identifies the campaign. What the data do not support is refused with a finding; this is not an error.
    ///
    /// # Errors
    /// [`IdentifyError`] if no run moves, or if an option is not valid.
    pub fn run(self) -> Result<Found, IdentifyError> {
        let Self { campaign, mut options, limit, progress } = self;
        if let Some(limit) = limit {
            options.interrupt = options.interrupt.or_after(limit);
        }
        let identified = identify(campaign, &options, progress)?;
        Ok(Found::new(campaign, identified))
    }
}
