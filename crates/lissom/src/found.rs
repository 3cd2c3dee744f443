//! A result of identification, to print, to keep and to use.

use std::fmt;

use lissom_core::identify::{
    Estimate, Finding, FoundArm, Identified, ModeEstimate, Validation, ValidationError,
    ValidationOptions, validate,
};
use lissom_core::record::{Campaign, Channels};
use lissom_io::{ParameterList, ResultFile};
use serde::{Serialize, Serializer};

use crate::parameter_text;

/// What [`Identify::run`](crate::Identify::run) found.
///
/// `Display` gives a table with 95 % intervals and the findings; serialised it is `result.json`
/// ([`ResultFile`]), as the command writes it.
#[derive(Debug, Clone)]
pub struct Found {
    channels: Channels,
    identified: Identified,
}

impl Found {
    pub(crate) fn new(campaign: &Campaign, identified: Identified) -> Self {
        Self { channels: campaign.channels.clone(), identified }
    }

    /// Coulomb friction, the mean of both directions \[N·m; N of a linear axis; unit of the command where the torque
    /// constant is not known\]; `None` where a finding refuses it.
    pub fn coulomb(&self) -> Option<Estimate> {
        self.identified.friction.coulomb
    }

    /// Viscous friction \[N·m·s/rad, or as [`coulomb`](Self::coulomb)\].
    pub fn viscous(&self) -> Option<Estimate> {
        self.identified.friction.viscous
    }

    /// Inertia of the motor's side \[kg·m²; kg of a linear axis\].
    pub fn inertia(&self) -> Option<Estimate> {
        self.identified.inertia
    }

    /// Torque per angle between motor and beam \[N·m/rad\].
    pub fn coupling(&self) -> Option<Estimate> {
        self.identified.beam.coupling
    }

    /// Modes of the beam with the motor clamped, ascending.
    pub fn modes(&self) -> &[ModeEstimate] {
        &self.identified.beam.modes
    }

    /// What the data do not allow, and what to know about the estimates.
    pub fn findings(&self) -> &[Finding] {
        &self.identified.findings
    }

    /// Everything: the results of each method, responses, linear models.
    pub fn identified(&self) -> &Identified {
        &self.identified
    }

    /// The arm to predict other logs with; `None` where the estimates make no whole arm.
    pub fn arm(&self) -> Option<&FoundArm> {
        self.identified.arm.as_ref()
    }

    /// Predicts a campaign that this result is not from; `None` where the estimates make no whole arm.
    ///
    /// # Errors
    /// [`ValidationError`] where the arm does not belong to the campaign's channels or nothing moves.
    pub fn validate(
        &self,
        other: &impl AsRef<Campaign>,
    ) -> Result<Option<Validation>, ValidationError> {
        let options = ValidationOptions::default();
        self.arm().map(|arm| validate(arm, other.as_ref(), &options)).transpose()
    }

    /// What the command writes as `result.json`.
    pub fn file(&self) -> ResultFile {
        ResultFile::of(&self.channels, &self.identified, None)
    }
}

impl Serialize for Found {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.file().serialize(serializer)
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = ParameterList::of(&self.file()).ok_or(fmt::Error)?;
        parameter_text::table(f, &list)?;
        if let Some(separability) = &self.identified.separability {
            for words in separability.words(self.channels.axis) {
                write!(f, "\n{words}")?;
            }
        }
        for finding in self.findings() {
            write!(f, "\n{} [{}]: {finding}", finding.severity().name(), finding.code())?;
        }
        Ok(())
    }
}
