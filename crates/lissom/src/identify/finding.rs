//! What the data could not carry, run by run.

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// The figures named are less certain than their deviation says.
    Warning,
    /// The figures named are not given.
    Refusal,
}

/// One finding.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Stable name of its kind, e.g. `saturation`.
    pub code: &'static str,
    /// How much it matters.
    pub severity: Severity,
    /// Name of the run it is about; `None` for the whole campaign.
    pub run: Option<String>,
    /// Result keys that it affects, without the suffix of their unit, e.g. `friction.viscous`.
    pub affects: Vec<&'static str>,
    /// What was found, with its figure.
    pub message: String,
    /// What to do about it.
    pub hint: &'static str,
}

impl Finding {
    /// A finding about the whole campaign.
    pub(crate) fn new(
        code: &'static str,
        severity: Severity,
        affects: &[&'static str],
        message: String,
        hint: &'static str,
    ) -> Self {
        Self { code, severity, run: None, affects: affects.to_vec(), message, hint }
    }

    /// Whether readings themselves are wrong: other findings may follow from it.
    pub(crate) fn is_about_readings(&self) -> bool {
        let codes =
            ["spike", "reading-jumps", "frozen-channel", "angle-in-degrees", "command-sign"];
        codes.contains(&self.code)
    }

    /// The same, about one run.
    pub(crate) fn of(mut self, run: &str) -> Self {
        self.run = Some(run.to_owned());
        self
    }
}

/// Result keys as findings name them.
pub(crate) mod key {
    pub(crate) const COULOMB: &str = "friction.coulomb";
    pub(crate) const OFFSET: &str = "friction.offset";
    pub(crate) const VISCOUS: &str = "friction.viscous";
    pub(crate) const INERTIA: &str = "drive.inertia";
    pub(crate) const COUPLING: &str = "beam.coupling";
    pub(crate) const MODES: &str = "beam.modes";
    pub(crate) const THIRD: &str = "methods.third_harmonic";
    pub(crate) const CLASSICAL: &str = "methods.constant_velocity";
    pub(crate) const RAW: &str = "frequency_response.motor_raw";
    pub(crate) const CORRECTED: &str = "frequency_response.motor_corrected";
    pub(crate) const EQUIVALENT: &str = "equivalent";
    pub(crate) const TIPS: &str = "frequency_response.tips";
}
