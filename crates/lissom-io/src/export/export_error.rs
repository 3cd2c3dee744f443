//! Why a model cannot be exported.

use thiserror::Error;

/// Why a model cannot be exported.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The result has no arm.
    #[error(
        "{file}: the result has no arm: no method gives inertia, Coulomb friction and, where tips are measured, the modes together"
    )]
    NoArm {
        /// The result.
        file: String,
    },
    /// The result has a coupling to what is behind the motor, and no modes.
    #[error(
        "{file}: the result has a coupling to the tips and no modes, so its arm predicts torque and no motion"
    )]
    NoModes {
        /// The result.
        file: String,
    },
    /// A description without numbers of the drive, or with a beam that has no such form.
    #[error("{file}: {reason}")]
    Arm {
        /// The description.
        file: String,
        /// What is missing.
        reason: &'static str,
    },
    /// A beam of too many spans for a chain of hinges.
    #[error("{file}: a beam of {found} spans needs more than {hinges} hinges")]
    TooManySpans {
        /// The description.
        file: String,
        /// Spans of the beam.
        found: usize,
        /// Largest number of hinges.
        hinges: usize,
    },
    /// The torque constant is unknown, so nothing is in N·m.
    #[error("{file}: the torque constant is unknown, and {target} needs torques in N·m")]
    NoTorque {
        /// The result.
        file: String,
        /// The target.
        target: &'static str,
    },
    /// The file to merge into cannot be read.
    #[error("{file}: {source}")]
    Read {
        /// The file.
        file: String,
        /// The cause.
        source: std::io::Error,
    },
    /// The file to merge into is no XML.
    #[error("{file}: is not valid XML: {reason}")]
    Xml {
        /// The file.
        file: String,
        /// What is wrong, with line and column.
        reason: String,
    },
    /// There is no such joint.
    #[error("{file}: there is no joint \"{joint}\"; the joints are {}", list(.joints))]
    NoJoint {
        /// The file.
        file: String,
        /// The name.
        joint: String,
        /// The joints of the file.
        joints: Vec<String>,
    },
    /// The joint moves in another way than the axis.
    #[error(
        "{file}: the joint \"{joint}\" is of type \"{kind}\"; the axis of the result needs {allowed}"
    )]
    JointType {
        /// The file.
        file: String,
        /// The name.
        joint: String,
        /// Its type.
        kind: String,
        /// The types that fit.
        allowed: String,
    },
    /// Several joints have that name.
    #[error("{file}: several joints are called \"{joint}\"")]
    Several {
        /// The file.
        file: String,
        /// The name.
        joint: String,
    },
}

fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "not named".to_owned();
    }
    names.iter().map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ")
}

impl ExportError {
    /// What the user can do.
    pub fn hint(&self) -> Option<String> {
        Some(
            match self {
                Self::NoArm { .. } => {
                    "read the findings of the result; where only linear models are given, they are in its `models`"
                }
                Self::NoModes { .. } => {
                    "add a sweep through the beam's resonance, or identify without the tip as a rigid axis"
                }
                Self::Arm { .. } => "give a [drive] and a beam, as the page arm.toml explains",
                Self::TooManySpans { .. } => {
                    "describe the beam with fewer spans: a span with mass along it (`density` or `mass_per_length`) needs no \
                     division"
                }
                Self::NoTorque { .. } => {
                    "give torque_constant in [drive] of the campaign, and identify again"
                }
                Self::Read { .. } => "check the path",
                Self::Xml { .. } => "give the file that the simulator reads",
                Self::NoJoint { .. } | Self::JointType { .. } => {
                    "give the joint of the result's axis with --joint"
                }
                Self::Several { .. } => "give the joint a name of its own",
            }
            .to_owned(),
        )
    }
}
