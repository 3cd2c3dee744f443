//! Ctrl-C: the first one stops a search with the best result so far, the second one stops the program.

use std::sync::OnceLock;
#[cfg(feature = "fleet")]
use std::sync::atomic::{AtomicBool, Ordering};

use lissom::identify::Interrupt;

use super::exit_codes::ExitCode;

static SEARCH: OnceLock<Interrupt> = OnceLock::new();

/// Sets `interrupt` when the user presses Ctrl-C. If the system does not allow a handler, Ctrl-C stops the program as
/// usual.
pub(crate) fn on_ctrl_c(interrupt: &Interrupt) {
    if SEARCH.set(interrupt.clone()).is_err() {
        return;
    }
    let handler = || {
        let Some(search) = SEARCH.get() else { return };
        if search.is_asked() {
            ExitCode::KILLED.exit();
        }
        search.ask();
    };
    let _no_handler = ctrlc::set_handler(handler);
}

/// Set when the user presses Ctrl-C; a second Ctrl-C stops the program.
#[cfg(feature = "fleet")]
pub(crate) fn stopped_by_ctrl_c() -> &'static AtomicBool {
    static STOPPED: AtomicBool = AtomicBool::new(false);
    let handler = || {
        if STOPPED.swap(true, Ordering::Relaxed) {
            ExitCode::KILLED.exit();
        }
    };
    let _no_handler = ctrlc::set_handler(handler);
    &STOPPED
}
