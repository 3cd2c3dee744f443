//! Modules that all other layers may use: errors, checks of output files, progress bars, and the options
//! that help with a finding.

pub(crate) mod command_hint;
pub(crate) mod exit_codes;
pub(crate) mod failure;
pub(crate) mod interrupted;
pub(crate) mod output_guard;
pub(crate) mod progress_bar;
pub(crate) mod shell_word;
