//! What every layer above may use: failures, guards of outputs, progress, numbers as text, what
//! options of the command do about a finding.

pub(crate) mod command_hint;
pub(crate) mod digits;
pub(crate) mod exit_codes;
pub(crate) mod failure;
pub(crate) mod interrupted;
pub(crate) mod output_guard;
pub(crate) mod progress_bar;
