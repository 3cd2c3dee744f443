//! What a program adds to the report page about its own commands. The library names none of them.

/// Hints of the program that makes a page.
#[derive(Debug, Clone)]
pub struct ProgramHints {
    /// For each finding, in their order, the option or command that helps, in addition to the finding's own hint.
    pub of_findings: Vec<Option<&'static str>>,
    /// A sentence about how to get the 95 % intervals of the equivalent arm.
    pub equivalent_intervals: Option<&'static str>,
}

impl ProgramHints {
    /// No hint in addition to those of the findings.
    pub const NONE: Self = Self { of_findings: Vec::new(), equivalent_intervals: None };

    /// The hint of the finding with this index.
    pub(crate) fn of(&self, finding: usize) -> Option<&'static str> {
        self.of_findings.get(finding).copied().flatten()
    }
}
