//! What every layer above may use: failures, guards of outputs, progress, numbers as text.

pub(crate) mod digits;
pub(crate) mod exit_codes;
pub(crate) mod failure;
pub(crate) mod output_guard;
pub(crate) mod progress_bar;
