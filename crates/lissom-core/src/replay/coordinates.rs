//! Coordinates of a search: single parameters, or those of a beam with point masses.

use nalgebra::DMatrix;

use super::modal_arm::ModalArm;
use super::parameter::Parameter;
use super::point_masses::{BeamCoordinate, PointMasses};
use super::sums::WindowSums;
use crate::record::Channels;

/// One coordinate that a search changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Coordinate {
    Parameter(Parameter),
    Beam(BeamCoordinate),
}

/// An arm, and its point masses if the beam is modelled by them.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    pub(crate) arm: ModalArm,
    pub(crate) masses: Option<PointMasses>,
}

impl Body {
    /// An arm whose beam has point masses at its tips, if there are as many tips as modes and all tips are
    /// calibrated.
    pub(crate) fn of_masses(channels: &Channels, arm: ModalArm) -> Self {
        let angles = channels.tips.iter().all(|t| t.calibrated);
        let mut body = Self { masses: PointMasses::nearest(&arm).filter(|_| angles), arm };
        if let Some(masses) = &body.masses {
            masses.put_into(&mut body.arm);
        }
        body
    }

    /// Adds dampers at the tips' points, still zero, if there are as many tips as modes.
    pub(crate) fn allow_dampers_at_points(&mut self) {
        let modes = self.arm.modes.len();
        if self.arm.shapes.len() == modes && self.arm.at_points_per_s.is_empty() {
            self.arm.at_points_per_s = vec![0.0; modes];
        }
    }

    /// Adds `change_rad_s` to a mode's frequency.
    pub(crate) fn tune(&mut self, mode: usize, change_rad_s: f64) {
        let own = match self.masses {
            Some(_) => Coordinate::Beam(BeamCoordinate::Frequency(mode)),
            None => Coordinate::Parameter(Parameter::Frequency(mode)),
        };
        self.shift(own, change_rad_s);
    }

    /// Turns two of the modes into each other, if the beam has point masses.
    pub(crate) fn turned(mut self, first: usize, second: usize, angle_rad: f64) -> Self {
        self.shift(Coordinate::Beam(BeamCoordinate::Turn(first, second)), angle_rad);
        self
    }

    /// An arm whose modes are independent of each other.
    pub(crate) fn free(arm: ModalArm) -> Self {
        Self { arm, masses: None }
    }

    /// Coordinates of a search in `parameters`, in their order. The coordinates of point masses take the place of the
    /// first parameter that they replace.
    pub(crate) fn coordinates(&self, parameters: &[Parameter]) -> Vec<Coordinate> {
        let Some(masses) = &self.masses else {
            return parameters.iter().copied().map(Coordinate::Parameter).collect();
        };
        let mut found = Vec::new();
        let mut beam = Some(masses.coordinates());
        for p in parameters {
            if is_of_beam(*p) {
                found.extend(beam.take().into_iter().flatten().map(Coordinate::Beam));
            } else {
                found.push(Coordinate::Parameter(*p));
            }
        }
        found
    }

    /// Value of a coordinate that is positive by nature; `None` of others.
    pub(crate) fn scale(&self, coordinate: Coordinate) -> Option<f64> {
        match coordinate {
            Coordinate::Parameter(p) => p.is_scale().then(|| p.of(&self.arm)),
            Coordinate::Beam(b) => {
                let masses = self.masses.as_ref()?;
                match b {
                    BeamCoordinate::Frequency(j) => Some(masses.omega_rad_s[j]),
                    BeamCoordinate::Inertia(i) => Some(masses.inertia_kg_m2[i]),
                    BeamCoordinate::Turn(..) => None,
                }
            }
        }
    }

    /// Typical size of a coordinate.
    pub(crate) fn size(&self, coordinate: Coordinate) -> f64 {
        match coordinate {
            Coordinate::Parameter(p) => p.size(&self.arm),
            Coordinate::Beam(_) => self.scale(coordinate).unwrap_or(1.0),
        }
    }

    /// Adds `change` to a coordinate.
    pub(crate) fn shift(&mut self, coordinate: Coordinate, change: f64) {
        let b = match coordinate {
            Coordinate::Beam(b) => b,
            Coordinate::Parameter(p) => {
                let value = p.of(&self.arm) + change;
                p.set(&mut self.arm, value);
                return;
            }
        };
        let Some(masses) = &mut self.masses else { return };
        masses.shift(b, change);
        masses.put_into(&mut self.arm);
    }

    /// ∂parameter/∂coordinate; `None` if the coordinates are the parameters.
    pub(crate) fn jacobian(&self, parameters: &[Parameter]) -> Option<DMatrix<f64>> {
        let masses = self.masses.as_ref()?;
        let coordinates = self.coordinates(parameters);
        let mut found = DMatrix::zeros(parameters.len(), coordinates.len());
        for (c, coordinate) in coordinates.iter().enumerate() {
            match coordinate {
                Coordinate::Parameter(p) => {
                    let own = parameters.iter().position(|q| q == p);
                    if let Some(row) = own {
                        found[(row, c)] = 1.0;
                    }
                }
                Coordinate::Beam(b) => {
                    let by = masses.derivative(*b);
                    for (row, p) in parameters.iter().enumerate() {
                        found[(row, c)] = match *p {
                            Parameter::Frequency(j) => by.omega[j],
                            Parameter::Stiffness(j) => by.stiffness[j],
                            Parameter::Shape(i, j) => by.shapes[(i, j)],
                            _ => 0.0,
                        };
                    }
                }
            }
        }
        Some(found)
    }
}

/// Whether point masses determine this parameter.
fn is_of_beam(p: Parameter) -> bool {
    matches!(p, Parameter::Frequency(_) | Parameter::Stiffness(_) | Parameter::Shape(..))
}

/// Converts sums with derivatives by parameters to sums with derivatives by coordinates.
pub(crate) fn in_coordinates(sums: &WindowSums, jacobian: &DMatrix<f64>) -> WindowSums {
    let (shared, fewer) = jacobian.shape();
    let own = sums.gram.ncols() - shared;
    let mut whole = DMatrix::identity(shared + own, fewer + own);
    whole.view_mut((0, 0), (shared, fewer)).copy_from(jacobian);
    whole.view_mut((0, fewer), (shared, own)).fill(0.0);
    whole.view_mut((shared, 0), (own, fewer)).fill(0.0);
    whole.view_mut((shared, fewer), (own, own)).fill_with_identity();
    let turned = |m: &DMatrix<f64>| whole.tr_mul(&(m * &whole));
    WindowSums {
        gram: turned(&sums.gram),
        blocks: sums.blocks.iter().map(turned).collect(),
        ..sums.clone()
    }
}
