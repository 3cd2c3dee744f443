//! How much a finding matters.

use strum::IntoStaticStr;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// The affected estimates are less certain than their standard errors say.
    Warning,
    /// The affected estimates are not given.
    Refusal,
}

impl Severity {
    /// Name in texts and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
