//! What an `arm.toml` says.

use lissom_core::beam::KnownMode;

use super::beam_spec::BeamSpec;
use super::drive_spec::DriveSpec;
use super::load_spec::LoadSpec;
use super::rig_spec::RigSpec;
use super::tip_spec::TipSpec;

/// What an `arm.toml` says, in SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArmFile {
    /// The beam, by its spans.
    pub beam: Option<BeamSpec>,
    /// The beam, by its modes, in place of that.
    pub modes: Option<Vec<KnownMode>>,
    /// Whether the joint is rigid: no beam, in place of both.
    pub rigid: bool,
    /// The motor.
    pub drive: Option<DriveSpec>,
    /// An unbalanced load on a rigid joint.
    pub load: Option<LoadSpec>,
    /// The world at the tip.
    pub tip: Option<TipSpec>,
    /// Sampling, limits, sensors and controller.
    pub rig: Option<RigSpec>,
}
