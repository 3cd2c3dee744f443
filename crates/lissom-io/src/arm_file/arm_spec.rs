//! The contents of an `arm.toml`.

use lissom_core::beam::KnownMode;

use super::beam_spec::BeamSpec;
use super::drive_spec::DriveSpec;
use super::load_spec::LoadSpec;
use super::rig_spec::RigSpec;
use super::tip_spec::TipSpec;

/// The contents of an `arm.toml`, in SI units.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArmFile {
    /// The beam, given by its spans.
    pub beam: Option<BeamSpec>,
    /// The beam, given by its modes instead.
    pub modes: Option<Vec<KnownMode>>,
    /// Whether the joint is rigid, so that there is no beam.
    pub rigid: bool,
    /// The motor.
    pub drive: Option<DriveSpec>,
    /// An unbalanced load on a rigid joint.
    pub load: Option<LoadSpec>,
    /// What acts on the tip.
    pub tip: Option<TipSpec>,
    /// Sampling, limits, sensors and controller.
    pub rig: Option<RigSpec>,
}
