//! Builds an arm from an `arm.toml`.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::beam::{Beam, DistributedBeam, LumpedBeam, ModalBeam, Piece, Span};
use lissom_core::drive::{Coulomb, Motor};

use super::arm_error::absent;
use super::arm_spec::ArmFile;
use super::beam_spec::{BeamKind, BeamSpec, SpanSpec};
use crate::config::ConfigError;

impl ArmFile {
    /// Builds the arm that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[beam]` or `[drive]` is missing or its numbers cannot be used.
    pub fn arm(&self, path: &Path) -> Result<Arm, ConfigError> {
        let beam: Beam = if self.rigid {
            Beam::Rigid
        } else if self.beam_kind(path)? == BeamKind::Modal {
            self.modal_beam(path)?.into()
        } else {
            self.lumped_beam(path)?.into()
        };
        let (motor, coulomb) = self.motor(path)?;
        Arm::new(beam, motor, coulomb).map_err(|source| ConfigError::of_arm(path, source))
    }

    /// The motor and its Coulomb friction; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[drive]` is missing.
    pub(crate) fn motor(&self, path: &Path) -> Result<(Motor, Coulomb), ConfigError> {
        let drive = self.drive.as_ref().ok_or_else(|| absent(path, "drive"))?;
        Ok((drive.motor, drive.coulomb))
    }

    /// Tells how the table `[beam]` describes the beam; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if the table is missing, if the joint is rigid.
    pub fn beam_kind(&self, path: &Path) -> Result<BeamKind, ConfigError> {
        if self.rigid {
            return Err(ConfigError::of_file(
                path,
                "the joint is rigid; here it must have a beam",
                "give `spans` or `modes` instead of `rigid` in [beam]",
            ));
        }
        match (&self.modes, &self.beam) {
            (Some(_), _) => Ok(BeamKind::Modal),
            (None, Some(beam)) => Ok(beam.kind()),
            (None, None) => Err(absent(path, "beam")),
        }
    }

    /// The beam, given by its spans; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[beam]` is missing or it has modes.
    pub fn beam(&self, path: &Path) -> Result<&BeamSpec, ConfigError> {
        match self.beam_kind(path)? {
            BeamKind::Modal => Err(ConfigError::of_file(
                path,
                "the beam is given by its modes; here it must have spans",
                "give `spans` instead of `modes` in [beam]",
            )),
            _ => self.beam.as_ref().ok_or_else(|| absent(path, "beam")),
        }
    }

    /// Builds the beam that is given by its modes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[beam]` has no modes or their numbers cannot be used.
    pub fn modal_beam(&self, path: &Path) -> Result<ModalBeam, ConfigError> {
        let modes = self.modes.clone().ok_or_else(|| absent(path, "beam"))?;
        ModalBeam::new(modes).map_err(|source| ConfigError::of_arm(path, source))
    }

    /// Builds the beam with point masses that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[beam]` is missing, has modes or mass along its length, or its numbers cannot be used.
    pub fn lumped_beam(&self, path: &Path) -> Result<LumpedBeam, ConfigError> {
        let beam = self.beam(path)?;
        if beam.kind() == BeamKind::Distributed {
            return Err(ConfigError::of_file(
                path,
                "the beam has mass along its length; here it must have point masses",
                "give each span a `mass` instead of `density` or `mass_per_length`; with more spans \
                 the point masses come closer to a beam with mass along it",
            ));
        }
        let spans: Vec<Span> = beam
            .spans
            .iter()
            .map(|s| Span {
                length_m: s.length_m,
                flexural_rigidity_n_m2: s.flexural_rigidity_n_m2,
                mass_kg: s.mass_kg,
                damping_n_s_per_m: s.damping_n_s_per_m,
            })
            .collect();
        LumpedBeam::new(&spans)
            .and_then(|b| b.with_hub_radius(beam.hub_radius_m))
            .and_then(|b| b.with_payload(beam.tip()))
            .and_then(|b| b.with_damping(beam.damping.clone()))
            .map_err(|source| ConfigError::of_arm(path, source))
    }

    /// Builds the beam with mass along it that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ConfigError`] if `[beam]` is missing, has only point masses, or its numbers cannot be used.
    pub fn distributed_beam(&self, path: &Path) -> Result<DistributedBeam, ConfigError> {
        let beam = self.beam(path)?;
        let piece = |s: &SpanSpec| {
            Some(Piece {
                length_m: s.length_m,
                flexural_rigidity_n_m2: s.flexural_rigidity_n_m2,
                mass_per_length_kg_per_m: s.mass_per_length_kg_per_m?,
                end_mass_kg: s.mass_kg,
                end_damping_n_s_per_m: s.damping_n_s_per_m,
            })
        };
        let pieces: Option<Vec<Piece>> = beam.spans.iter().map(piece).collect();
        let pieces = pieces.ok_or_else(|| {
            let problem = "the beam has point masses; here it must have mass along its length";
            let hint = "add `mass_per_length`, or `density` and `section`, to [beam]";
            ConfigError::of_file(path, problem, hint)
        })?;
        DistributedBeam::new(&pieces)
            .and_then(|b| b.with_hub_radius(beam.hub_radius_m))
            .and_then(|b| b.with_payload(beam.tip()))
            .and_then(|b| b.with_damping(beam.damping.clone()))
            .map_err(|source| ConfigError::of_arm(path, source))
    }
}
