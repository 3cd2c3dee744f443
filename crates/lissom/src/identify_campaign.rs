//! Identification with its options by name.

use std::time::Duration;

use lissom_core::identify::{Effort, IdentifyError, Interrupt, Options, Stage, identify};
use lissom_core::record::Campaign;

use crate::found::Found;

/// An identification in the making: what to identify, and how.
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
    progress: Box<dyn FnMut(Stage) + 'c>,
}

impl<'c> Identify<'c> {
    /// Of a [`Campaign`], of a campaign read from files, or of a virtual one.
    pub fn new(campaign: &'c impl AsRef<Campaign>) -> Self {
        Self {
            campaign: campaign.as_ref(),
            options: Options::default(),
            progress: Box::new(|_| ()),
        }
    }

    /// How far the output-error method goes. [`Effort::Quick`] leaves it out: a fraction of a second.
    pub fn effort(mut self, effort: Effort) -> Self {
        self.options.effort = effort;
        self
    }

    /// Length of the regression's window \[s\], in place of one that is chosen from the data.
    pub fn window_s(mut self, window_s: f64) -> Self {
        self.options.window_s = vec![window_s];
        self
    }

    /// All options at once, in place of those given before.
    pub fn options(mut self, options: Options) -> Self {
        self.options = options;
        self
    }

    /// Takes the best result after this time; it then depends on how fast the machine is.
    pub fn time_limit(self, limit: Duration) -> Self {
        self.interrupt(Interrupt::after(limit))
    }

    /// Takes the best result when another thread asks for it.
    pub fn interrupt(mut self, interrupt: Interrupt) -> Self {
        self.options.interrupt = interrupt;
        self
    }

    /// Calls `progress` at the beginning of each stage.
    pub fn progress(mut self, progress: impl FnMut(Stage) + 'c) -> Self {
        self.progress = Box::new(progress);
        self
    }

    /// Identifies. Whatever the data do not support is refused with a finding, which is no error.
    ///
    /// # Errors
    /// [`IdentifyError`] where no run moves, or an option is no valid number.
    pub fn run(self) -> Result<Found, IdentifyError> {
        let Self { campaign, options, progress } = self;
        let identified = identify(campaign, &options, progress)?;
        Ok(Found::new(campaign, identified))
    }
}
