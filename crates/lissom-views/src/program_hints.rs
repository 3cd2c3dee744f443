//! What a program adds to the report page about its own commands. The library names none of them.

use lissom::identify::findings::FindingKind;

/// Hints of the program that makes a page.
#[derive(Debug, Clone, Copy)]
pub struct ProgramHints {
    /// The option or command that helps with a finding, in addition to the finding's own hint.
    pub of_finding: fn(&FindingKind) -> Option<&'static str>,
    /// A sentence about how to get the 95 % intervals of the equivalent arm.
    pub equivalent_intervals: Option<&'static str>,
}

impl ProgramHints {
    /// No hint in addition to those of the findings.
    pub const NONE: Self = Self { of_finding: |_| None, equivalent_intervals: None };
}
