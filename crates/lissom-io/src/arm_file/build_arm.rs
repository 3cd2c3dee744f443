//! Builds an arm from an `arm.toml`.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::beam::{Beam, DistributedBeam, LumpedBeam, ModalBeam, Piece, Span};
use lissom_core::drive::{Coulomb, Motor};

use super::arm_error::{ArmError, absent};
use super::arm_spec::ArmFile;
use super::beam_spec::{BeamKind, BeamSpec, SpanSpec};

impl ArmFile {
    /// Builds the arm that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError`] if `[beam]` or `[drive]` is missing or its numbers cannot be used.
    pub fn arm(&self, path: &Path) -> Result<Arm, ArmError> {
        let beam: Beam = if self.rigid {
            Beam::Rigid
        } else if self.beam_kind(path)? == BeamKind::Modal {
            self.modal_beam(path)?.into()
        } else {
            self.lumped_beam(path)?.into()
        };
        let (motor, coulomb) = self.motor(path)?.ok_or_else(|| absent(path, "drive"))?;
        Arm::new(beam, motor, coulomb)
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// Builds the drive, if the file describes one; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError::Drive`] if its numbers cannot be used.
    pub fn motor(&self, path: &Path) -> Result<Option<(Motor, Coulomb)>, ArmError> {
        let Some(d) = &self.drive else { return Ok(None) };
        let failed = |source| ArmError::Drive { file: path.to_owned(), source };
        let motor = Motor::new(d.inertia_kg_m2, d.viscous_nm_s_per_rad, d.torque_constant_nm_per_a);
        let coulomb = Coulomb::by_direction(d.coulomb_forward_nm, d.coulomb_backward_nm);
        Ok(Some((motor.map_err(failed)?, coulomb.map_err(failed)?)))
    }

    /// Tells how the table `[beam]` describes the beam; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError::MissingTable`] if the table is missing, [`ArmError::Rigid`] if the joint is rigid.
    pub fn beam_kind(&self, path: &Path) -> Result<BeamKind, ArmError> {
        if self.rigid {
            return Err(ArmError::Rigid { file: path.to_owned() });
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
    /// [`ArmError::MissingTable`] if `[beam]` is missing, [`ArmError::Modal`] if it has modes.
    pub fn beam(&self, path: &Path) -> Result<&BeamSpec, ArmError> {
        match self.beam_kind(path)? {
            BeamKind::Modal => Err(ArmError::Modal { file: path.to_owned() }),
            _ => self.beam.as_ref().ok_or_else(|| absent(path, "beam")),
        }
    }

    /// Builds the beam that is given by its modes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError`] if `[beam]` has no modes or their numbers cannot be used.
    pub fn modal_beam(&self, path: &Path) -> Result<ModalBeam, ArmError> {
        let modes = self.modes.clone().ok_or_else(|| absent(path, "beam"))?;
        ModalBeam::new(modes).map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// Builds the beam with point masses that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError`] if `[beam]` is missing, has modes or mass along its length, or its numbers cannot be used.
    pub fn lumped_beam(&self, path: &Path) -> Result<LumpedBeam, ArmError> {
        let beam = self.beam(path)?;
        if beam.kind() == BeamKind::Distributed {
            return Err(ArmError::Distributed { file: path.to_owned() });
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
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }

    /// Builds the beam with mass along it that the file describes; `path` is the file's name in errors.
    ///
    /// # Errors
    /// [`ArmError`] if `[beam]` is missing, has only point masses, or its numbers cannot be used.
    pub fn distributed_beam(&self, path: &Path) -> Result<DistributedBeam, ArmError> {
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
        let pieces = pieces.ok_or_else(|| ArmError::Lumped { file: path.to_owned() })?;
        DistributedBeam::new(&pieces)
            .and_then(|b| b.with_hub_radius(beam.hub_radius_m))
            .and_then(|b| b.with_payload(beam.tip()))
            .and_then(|b| b.with_damping(beam.damping.clone()))
            .map_err(|source| ArmError::Beam { file: path.to_owned(), source })
    }
}
