//! Progress of longer work, on standard error, where that is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use lissom::identify::Stage;

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

/// A bar whose time goes on while a step takes long.
pub(crate) fn stages(length: usize) -> ProgressBar {
    let bar = bar(length, "");
    bar.enable_steady_tick(std::time::Duration::from_millis(250));
    bar
}

/// Shows the stage that identification has reached.
pub(crate) fn stage(bar: &ProgressBar, stage: Stage) {
    bar.inc(1);
    bar.set_message(match stage {
        Stage::Run(..) => "periods and harmonics",
        Stage::Regression => "regression",
        Stage::Beam => "beam",
        Stage::OutputError => "replay through the arm",
        Stage::Responses => "responses and models",
    });
}

/// Steps that identification takes for `runs` runs.
pub(crate) fn steps(runs: usize) -> usize {
    runs + 4
}
