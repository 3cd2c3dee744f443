//! The trait of all kinds of findings: code, severity, affected keys, message and hint.

use std::fmt;

use crate::identify::findings::severity::Severity;

/// Texts and severity of a finding, implemented once for each area; [`Display`](fmt::Display) is the message.
pub(super) trait Describe: fmt::Display {
    /// Stable name, derived from the name of the variant.
    fn code(&self) -> &'static str;
    /// How much it matters.
    fn severity(&self) -> Severity;
    /// Result keys that it affects, without the suffix of their unit.
    fn affects(&self) -> Vec<&'static str>;
    /// What to do about it; empty where there is nothing to do.
    fn hint(&self) -> &'static str;
}
