//! The result of an identification, to print, to save and to use.

use std::fmt;

use lissom_core::arm::Arm;
use lissom_core::identify::{
    Estimate, Finding, FoundArm, GeometryCheck, Identified, ModeEstimate, Validation,
    ValidationError, ValidationOptions, geometry_check, validate,
};
use lissom_core::record::{Campaign, Channels};
use lissom_io::{ListedParameter, ParameterList, ResultFile};
use serde::{Serialize, Serializer};

use crate::result_text::ResultText;

/// Result of [`Identify::run`](crate::Identify::run).
///
/// `Display` gives a table with 95 % intervals and the findings; serialised it is `result.json`
/// ([`ResultFile`]), as the command writes it.
#[derive(Debug, Clone)]
pub struct Found {
    channels: Channels,
    identified: Identified,
    geometry: Option<GeometryCheck>,
}

impl Found {
    pub(crate) fn new(campaign: &Campaign, identified: Identified) -> Self {
        Self { channels: campaign.channels.clone(), identified, geometry: None }
    }

    /// Adds a comparison with an arm of known dimensions, if the output-error method has a solution.
    #[must_use]
    pub fn compared_with(mut self, arm: &Arm) -> Self {
        let solution = self.identified.output_error.as_ref().filter(|found| found.stands());
        self.geometry = solution.and_then(|found| geometry_check(arm, found));
        self
    }

    /// Coulomb friction, mean of both directions
    /// \[N·m; N on a linear axis; unit of the command if the torque constant is unknown\]. `None` if it is refused,
    /// with a finding that gives the reason.
    pub fn coulomb(&self) -> Option<Estimate> {
        self.identified.friction.coulomb
    }

    /// Viscous friction \[N·m·s/rad; N·s/m on a linear axis; per unit of command if the torque constant is unknown\].
    pub fn viscous(&self) -> Option<Estimate> {
        self.identified.friction.viscous
    }

    /// Inertia of the motor's side \[kg·m²; kg on a linear axis\].
    pub fn inertia(&self) -> Option<Estimate> {
        self.identified.inertia
    }

    /// Coupling: torque between motor and beam per angle between them \[N·m/rad\].
    pub fn coupling(&self) -> Option<Estimate> {
        self.identified.beam.coupling
    }

    /// Modes of the beam with the motor clamped, ascending in frequency.
    pub fn modes(&self) -> &[ModeEstimate] {
        &self.identified.beam.modes
    }

    /// Findings: what the logs do not determine, what is wrong with them, and what to know about the estimates.
    pub fn findings(&self) -> &[Finding] {
        &self.identified.findings
    }

    /// The complete result: estimates of each method, responses, linear models.
    pub fn identified(&self) -> &Identified {
        &self.identified
    }

    /// The identified arm, which predicts other logs; `None` if the estimates do not make a complete arm.
    pub fn arm(&self) -> Option<&FoundArm> {
        self.identified.arm.as_ref()
    }

    /// Compares the result with a campaign from which it was not identified. `None` if the
    /// estimates do not make a complete arm.
    ///
    /// # Errors
    /// [`ValidationError`] if the arm does not fit the campaign's channels, if it cannot be
    /// simulated, or if nothing moves.
    pub fn validate(
        &self,
        other: &impl AsRef<Campaign>,
    ) -> Result<Option<Validation>, ValidationError> {
        let options = ValidationOptions::default();
        self.arm().map(|arm| validate(arm, other.as_ref(), &options)).transpose()
    }

    /// The parameters as the tables list them: key, name, unit, estimate, and the codes of the warnings that affect each.
    pub fn parameters(&self) -> Vec<ListedParameter> {
        ParameterList::of(&self.file()).parameters
    }

    /// The content of `result.json`.
    pub fn file(&self) -> ResultFile {
        ResultFile::of(&self.channels, &self.identified, self.geometry.as_ref())
    }
}

impl Serialize for Found {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.file().serialize(serializer)
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ResultText(&self.file()).fmt(f)
    }
}
