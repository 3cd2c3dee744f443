//! Progress bars on standard error, if it is a terminal.

use std::thread;
use std::time::Duration;

#[cfg(feature = "fleet")]
use indicatif::HumanDuration;
use indicatif::{ProgressBar, ProgressStyle};
use lissom::identify::{Interrupt, Options, Stage};

/// A bar of `length` steps.
pub(crate) fn bar(length: usize, what: &'static str) -> ProgressBar {
    let bar = ProgressBar::new(length as u64);
    let style = ProgressStyle::with_template("{msg:24} [{bar:36}] {pos}/{len} {elapsed}");
    if let Ok(style) = style {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(what);
    bar
}

/// A bar whose clock runs during long steps.
pub(crate) fn stages(length: usize) -> ProgressBar {
    let bar = bar(length, "");
    bar.enable_steady_tick(Duration::from_millis(250));
    bar
}

/// Does `work` of unknown length, with a clock meanwhile.
pub(crate) fn during<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    let spinner = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        spinner.set_style(style);
    }
    spinner.set_message(what);
    spinner.enable_steady_tick(Duration::from_millis(100));
    let done = work();
    spinner.finish_and_clear();
    done
}

/// Progress of an identification: its stages, then the evaluations of the search.
pub(crate) struct Stages {
    bar: ProgressBar,
    interrupt: Interrupt,
    most: u64,
}

impl Stages {
    /// A bar of `length` stages.
    pub(crate) fn new(length: usize, options: &Options) -> Self {
        let bar = stages(length);
        let (interrupt, most) = (options.interrupt.clone(), options.effort.most_evaluations());
        Self { bar, interrupt, most }
    }

    /// Shows the stage that identification has reached.
    pub(crate) fn stage(&self, stage: Stage) {
        self.bar.inc(1);
        self.bar.set_message(stage.name());
        if stage == Stage::OutputError {
            self.show_evaluations();
        }
    }

    /// Changes the bar to evaluations of the search. The search may end before it has used all of them.
    fn show_evaluations(&self) {
        let style = ProgressStyle::with_template(
            "{msg} [{bar:36}] at most {eta} left (Ctrl-C: stop with the best result so far)",
        );
        if let Ok(style) = style {
            self.bar.set_style(style.progress_chars("=> "));
        }
        self.bar.reset();
        self.bar.set_length(self.most);
        self.bar.set_position(0);
        let (bar, interrupt) = (self.bar.clone(), self.interrupt.clone());
        thread::spawn(move || {
            while !bar.is_finished() {
                bar.set_position(interrupt.evaluations());
                thread::sleep(Duration::from_millis(100));
            }
        });
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Progress of a fleet.
#[cfg(feature = "fleet")]
pub(crate) struct FleetBar {
    bar: ProgressBar,
}

#[cfg(feature = "fleet")]
impl FleetBar {
    /// A bar of so many logs.
    pub(crate) fn new(logs: usize) -> Self {
        let bar = ProgressBar::new(logs as u64);
        let style = ProgressStyle::with_template("[{bar:36}] {pos}/{len} logs{msg}");
        if let Ok(style) = style {
            bar.set_style(style.progress_chars("=> "));
        }
        Self { bar }
    }

    /// Shows how far the run is.
    pub(crate) fn show(&self, progress: &lissom_fleet::Progress) {
        self.bar.set_position((progress.before + progress.done) as u64);
        let failed = match progress.failed {
            0 => String::new(),
            failed => format!(", {failed} failed"),
        };
        let left = progress.left_time().map(HumanDuration);
        let left = left.map_or_else(String::new, |left| format!(", about {left} left"));
        self.bar.set_message(format!("{failed}{left} (Ctrl-C: stop, and go on later)"));
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
