//! Builds a rig from an `arm.toml`: instruments, controller and the arm's scene.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::beam::BeamError;
use lissom_core::rig::{Pd, Rig, RigError, Scene};

use super::arm_error::{absent, load_on_beam};
use super::arm_spec::ArmFile;
use super::beam_spec::BeamKind;
use crate::config::ConfigError;

/// Largest number of simulated masses. More masses add nothing useful, and a run takes hours.
const COORDINATES_MOST: usize = 150;
/// Number of point masses for a beam with mass along it, if the file does not give one.
const MASSES: usize = 10;

impl ArmFile {
    /// Builds the arm with its loop and its scene. Without sensors of the tips, these are as the motor's.
    ///
    /// A beam with mass along it is lumped into the `masses` of `[rig]`, or into ten.
    ///
    /// # Errors
    /// As [`arm`](Self::arm), and if `[rig]` is missing.
    pub fn rig(&self, path: &Path) -> Result<Rig, ConfigError> {
        let spec = self.rig.as_ref().ok_or_else(|| absent(path, "rig"))?;
        let arm = self.simulated_arm(path)?;
        if arm.dynamics().len() > COORDINATES_MOST {
            let source = RigError::Unsupported { what: "more than 150 masses" };
            return Err(ConfigError::of_arm(path, source));
        }
        let failed = |source: RigError| ConfigError::of_arm(path, source);
        let controller = match &spec.controller {
            Some(controller) => controller.clone(),
            // A zero controller for an open drive, which does not use it.
            None => Pd::new(0.0, 0.0).map_err(failed)?.into(),
        };
        let mut rig = Rig::new(arm, spec.instruments.clone(), controller);
        rig.scene = self.scene(path, &rig.arm)?;
        Ok(rig)
    }

    /// Whether `[rig]` has a controller.
    pub fn has_controller(&self) -> bool {
        self.rig.as_ref().is_some_and(|rig| rig.controller.is_some())
    }

    /// Builds the arm with point masses; a beam with mass along it is lumped as in [`rig`](Self::rig).
    ///
    /// # Errors
    /// As [`arm`](Self::arm).
    pub fn simulated_arm(&self, path: &Path) -> Result<Arm, ConfigError> {
        if self.rigid || self.beam_kind(path)? != BeamKind::Distributed {
            return self.arm(path);
        }
        let count = self.rig.as_ref().and_then(|rig| rig.masses).unwrap_or(MASSES);
        let (motor, coulomb) = self.motor(path)?;
        let failed = |source: BeamError| ConfigError::of_arm(path, source);
        let beam = self.distributed_beam(path)?.lumped(count).map_err(failed)?;
        Arm::new(beam, motor, coulomb).map_err(failed)
    }

    fn scene(&self, path: &Path, arm: &Arm) -> Result<Scene, ConfigError> {
        let beam_failed = |source: BeamError| ConfigError::of_arm(path, source);
        let friction = self.drive.as_ref().map(|drive| drive.friction.joint()).unwrap_or_default();
        if self.load.is_some() && !self.rigid {
            return Err(load_on_beam(path));
        }
        let gravity = self.load.map(|load| load.gravity());
        let torque_ripples =
            self.drive.as_ref().map_or_else(Vec::new, |d| d.torque_ripples.clone());
        let joint = Scene { friction, gravity, torque_ripples, ..Scene::default() };
        let Some(tip) = &self.tip else { return Ok(joint) };
        if arm.beam().lumped().is_none() {
            return Err(beam_failed(BeamError::NoTip));
        }
        let mut later = Vec::with_capacity(tip.payloads.len());
        for (at_s, payload) in &tip.payloads {
            let beam = arm.beam().clone().with_payload(*payload).map_err(beam_failed)?;
            later.push((*at_s, Arm::new(beam, arm.motor, arm.coulomb).map_err(beam_failed)?));
        }
        let scene = Scene { tip: tip.world.clone(), later, ..joint };
        scene.check().map_err(|source| ConfigError::of_arm(path, source))?;
        Ok(scene)
    }
}
