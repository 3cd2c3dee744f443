//! Notes of a plan in JSON.

use lissom_core::plan::PlanNote;
use serde::{Deserialize, Serialize};

/// A note of a plan: something that its user should know.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlanNoteEntry {
    /// What the note is about; the page about planning in the book lists all codes.
    pub code: PlanNoteName,
    /// How much it matters.
    pub severity: NoteSeverityName,
    /// The note in words, with numbers.
    pub message: String,
}

/// What a note of a plan is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PlanNoteName {
    /// A wanted precision that cannot be reached within the allowed time.
    Unreached,
    /// Modes that the plan treats as rigid, because they are too fast for the log or too light.
    ModesLeftOut,
    /// A sensor has neither steps nor noise; an error of 1e-6 rad is assumed.
    IdealSensor,
    /// The noise of the measured current is not in the plan: errors may be many times the expected standard errors.
    CurrentNoise,
    /// No sine fits together with a sine at three times its frequency, which the third-harmonic method needs.
    NoPair,
    /// Only steady sines on a damped beam: errors may be many times the expected standard errors.
    SinesAlone,
    /// Motions that were tried and dropped.
    MotionsOfNoUse,
    /// The arm has friction or a load at the tip that the plan does not include.
    SceneLeftOut,
    /// Expected standard errors of a load with gravity are those of the regression, and may be off by a factor of up to
    /// four.
    GravityByRegression,
    /// A note without a code of its own.
    Other,
}

/// How much a note of a plan matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum NoteSeverityName {
    /// A wanted precision is not reached, or the expected precision may not be reached.
    Warning,
    /// Worth knowing.
    Info,
}

impl PlanNoteEntry {
    pub(super) fn of(note: &PlanNote) -> Self {
        let warning = note.is_warning();
        Self {
            code: PlanNoteName::of(note),
            severity: if warning { NoteSeverityName::Warning } else { NoteSeverityName::Info },
            message: note.to_string(),
        }
    }
}

impl PlanNoteName {
    fn of(note: &PlanNote) -> Self {
        match note {
            PlanNote::Unreached { .. } => Self::Unreached,
            PlanNote::LeftOut { .. } => Self::ModesLeftOut,
            PlanNote::IdealSensor => Self::IdealSensor,
            PlanNote::CurrentNoise => Self::CurrentNoise,
            PlanNote::NoPair => Self::NoPair,
            PlanNote::SinesAlone => Self::SinesAlone,
            PlanNote::Unfit { .. } => Self::MotionsOfNoUse,
            PlanNote::SceneLeftOut => Self::SceneLeftOut,
            PlanNote::GravityByRegression => Self::GravityByRegression,
            _ => Self::Other,
        }
    }
}

#[cfg(test)]
mod tests {
    use lissom_core::plan::{ArmParameter, Expected, PlannedParameter, Unfit};

    use super::*;

    #[test]
    fn codes_are_those_of_the_library() {
        let parameter = PlannedParameter::Arm(ArmParameter::Inertia);
        let expected = Expected { parameter, value: 1.0, std: 0.1, wanted: 0.01 };
        let notes = [
            PlanNote::Unreached { expected, within_s: 60.0, needed_s: 600.0, torque_share: None },
            PlanNote::LeftOut { omega_rad_s: vec![100.0] },
            PlanNote::IdealSensor,
            PlanNote::CurrentNoise,
            PlanNote::NoPair,
            PlanNote::SinesAlone,
            PlanNote::Unfit { reason: Unfit::Impossible, motions: 3 },
            PlanNote::SceneLeftOut,
            PlanNote::GravityByRegression,
        ];
        for note in notes {
            let code = serde_json::to_value(PlanNoteName::of(&note)).unwrap();
            assert_eq!(code, note.code());
        }
    }
}
