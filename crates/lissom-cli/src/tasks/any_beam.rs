//! A beam of any kind with its load.

use std::path::Path;

use lissom::beam::{
    Base, BeamError, BeamResponse, Damping, DistributedBeam, LumpedBeam, ModalBeam, Payload, Piece,
    Zeros,
};
use lissom_io::{ArmFile, BeamKind, ConfigError};
use num_complex::Complex64;

use crate::args::model_args::Load;
use crate::shared::failure::Failure;

/// Largest number of masses for which matrices, transfer functions and the state space are computed. Their cost grows
/// with the square and the cube of the number.
pub(crate) const MOST_DENSE: usize = 200;

/// A beam with point masses, with mass along it, or known by its modes.
#[derive(Debug, Clone)]
pub(crate) enum Beam {
    Lumped(LumpedBeam),
    Distributed(DistributedBeam),
    Modal(ModalBeam),
}

impl Beam {
    pub(crate) fn of(file: &ArmFile, path: &Path) -> Result<Self, ConfigError> {
        match file.beam_kind(path)? {
            BeamKind::Lumped => file.lumped_beam(path).map(Self::Lumped),
            BeamKind::Distributed => file.distributed_beam(path).map(Self::Distributed),
            BeamKind::Modal => file.modal_beam(path).map(Self::Modal),
        }
    }

    pub(crate) fn kind(&self) -> BeamKind {
        match self {
            Self::Lumped(_) => BeamKind::Lumped,
            Self::Distributed(_) => BeamKind::Distributed,
            Self::Modal(_) => BeamKind::Modal,
        }
    }

    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Modal(beam) => beam.len(),
            _ => self.position_m().len(),
        }
    }

    pub(crate) fn position_m(&self) -> &[f64] {
        match self {
            Self::Lumped(beam) => beam.position_m(),
            Self::Distributed(beam) => beam.position_m(),
            Self::Modal(_) => &[],
        }
    }

    pub(crate) fn mass_kg(&self) -> Vec<f64> {
        match self {
            Self::Lumped(beam) => beam.spans().iter().map(|s| s.mass_kg).collect(),
            Self::Distributed(beam) => beam.pieces().iter().map(|p| p.end_mass_kg).collect(),
            Self::Modal(_) => Vec::new(),
        }
    }

    pub(crate) fn mass_along_kg(&self) -> f64 {
        match self {
            Self::Lumped(_) | Self::Modal(_) => 0.0,
            Self::Distributed(beam) => {
                beam.pieces().iter().map(|p| p.mass_per_length_kg_per_m * p.length_m).sum()
            }
        }
    }

    /// Smallest and largest EI \[N·m²\]; `None` if there are no spans.
    pub(crate) fn rigidity_n_m2(&self) -> Option<(f64, f64)> {
        let range = |(low, high): (f64, f64), ei: f64| (low.min(ei), high.max(ei));
        let start = (f64::INFINITY, 0.0);
        match self {
            Self::Lumped(beam) => {
                Some(beam.spans().iter().map(|s| s.flexural_rigidity_n_m2).fold(start, range))
            }
            Self::Distributed(beam) => {
                Some(beam.pieces().iter().map(|p| p.flexural_rigidity_n_m2).fold(start, range))
            }
            Self::Modal(_) => None,
        }
    }

    pub(crate) fn hub_radius_m(&self) -> f64 {
        match self {
            Self::Lumped(beam) => beam.hub_radius_m(),
            Self::Distributed(beam) => beam.hub_radius_m(),
            Self::Modal(_) => 0.0,
        }
    }

    pub(crate) fn payload(&self) -> Payload {
        match self {
            Self::Lumped(beam) => *beam.payload(),
            Self::Distributed(beam) => *beam.payload(),
            Self::Modal(_) => Payload::default(),
        }
    }

    pub(crate) fn damping(&self) -> &Damping {
        match self {
            Self::Lumped(beam) => beam.damping(),
            Self::Distributed(beam) => beam.damping(),
            // Each mode has its own damping ratio, which is in the table of frequencies.
            Self::Modal(_) => &Damping::None,
        }
    }

    pub(crate) fn is_undamped(&self) -> bool {
        match self {
            Self::Lumped(beam) => beam.is_undamped(),
            Self::Distributed(beam) => {
                *beam.damping() == Damping::None
                    && beam.pieces().iter().all(|p| p.end_damping_n_s_per_m == 0.0)
            }
            Self::Modal(beam) => beam.is_undamped(),
        }
    }

    pub(crate) fn inertia_kg_m2(&self) -> f64 {
        match self {
            Self::Lumped(beam) => beam.inertia_kg_m2(),
            Self::Distributed(beam) => beam.inertia_kg_m2(),
            Self::Modal(beam) => beam.inertia_kg_m2(),
        }
    }

    pub(crate) fn frequencies_rad_s(&self, base: Base, count: usize) -> Vec<f64> {
        match self {
            Self::Lumped(beam) => beam.frequencies_rad_s(base, count),
            Self::Distributed(beam) => beam.frequencies_rad_s(base, count),
            Self::Modal(beam) => beam.frequencies_rad_s(base, count),
        }
    }

    pub(crate) fn response(&self, s: Complex64) -> BeamResponse {
        match self {
            Self::Lumped(beam) => beam.response(s),
            Self::Distributed(beam) => beam.response(s),
            Self::Modal(beam) => beam.response(s),
        }
    }

    /// Zeros of the tip's response: for a distributed beam those below `omega_rad_s`, for many masses the lowest
    /// `count`. `None` for many masses and a payload with rotary inertia or an offset.
    pub(crate) fn tip_zeros(&self, omega_rad_s: f64, count: usize) -> Option<Zeros> {
        match self {
            Self::Lumped(beam) if beam.len() > MOST_DENSE => {
                let zeros = beam.tip_zeros_per_s(count)?;
                Some(Zeros { z: zeros.iter().map(|s| (s * s).into()).collect(), missing: 0 })
            }
            Self::Lumped(beam) => beam.zeros(beam.len() - 1),
            Self::Distributed(beam) => beam.zeros_below(beam.length_m(), omega_rad_s),
            Self::Modal(beam) => beam.zeros(beam.len() - 1),
        }
    }

    /// The load at the tip \[kg\]: the payload's mass if there is one, otherwise the last mass.
    pub(crate) fn load_kg(&self) -> f64 {
        let payload = self.payload();
        if payload.mass_kg > 0.0 { payload.mass_kg } else { self.last_mass_kg() }
    }

    fn last_mass_kg(&self) -> f64 {
        match self {
            Self::Lumped(beam) => beam.spans().last().map_or(0.0, |s| s.mass_kg),
            Self::Distributed(beam) => beam.pieces().last().map_or(0.0, |p| p.end_mass_kg),
            Self::Modal(_) => 0.0,
        }
    }

    /// The same beam with another load. A factor multiplies mass and rotary inertia; a mass replaces the mass only.
    pub(crate) fn with_load(&self, load: Load) -> Result<Self, BeamError> {
        let now = self.load_kg();
        let mass_kg = match load {
            Load::Times(factor) => factor * now,
            Load::Mass(mass_kg) => mass_kg,
        };
        let factor = match load {
            Load::Times(factor) => factor,
            Load::Mass(_) => 1.0,
        };
        let mut payload = self.payload();
        payload.inertia_kg_m2 *= factor;
        // If there is no mass at the tip yet, the load is a payload.
        if payload.mass_kg > 0.0 || now == 0.0 {
            payload.mass_kg = mass_kg;
            return match self {
                Self::Lumped(beam) => beam.clone().with_payload(payload).map(Self::Lumped),
                Self::Distributed(beam) => {
                    beam.clone().with_payload(payload).map(Self::Distributed)
                }
                Self::Modal(_) => Err(BeamError::NoTip),
            };
        }
        match self {
            Self::Lumped(beam) => {
                let mut spans = beam.spans().to_vec();
                spans.iter_mut().last().into_iter().for_each(|s| s.mass_kg = mass_kg);
                LumpedBeam::new(&spans)?
                    .with_hub_radius(beam.hub_radius_m())?
                    .with_payload(payload)?
                    .with_damping(beam.damping().clone())
                    .map(Self::Lumped)
            }
            Self::Distributed(beam) => {
                let mut pieces: Vec<Piece> = beam.pieces().to_vec();
                pieces.iter_mut().last().into_iter().for_each(|p| p.end_mass_kg = mass_kg);
                DistributedBeam::new(&pieces)?
                    .with_hub_radius(beam.hub_radius_m())?
                    .with_payload(payload)?
                    .with_damping(beam.damping().clone())
                    .map(Self::Distributed)
            }
            Self::Modal(_) => Err(BeamError::NoTip),
        }
    }
}

/// The failure for numbers of a beam that cannot be used.
pub(crate) fn beam_failure(arm: &Path, source: BeamError) -> Failure {
    lissom_io::Error::from(ConfigError::of_arm(arm, source)).into()
}
