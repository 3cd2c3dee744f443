//! Material of a beam or a span: stiffness and mass along its length.

use std::f64::consts::PI;

use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// Keys of the material, of a beam and of each span.
pub(super) const MATERIAL_KEYS: &str =
    "flexural_rigidity young_modulus section density mass_per_length";

/// Stiffness and mass along the beam, as given in one table.
#[derive(Debug, Clone, Default)]
pub(super) struct Material<'a> {
    /// EI \[N·m²\].
    rigidity: Option<f64>,
    /// E \[Pa\].
    modulus: Option<f64>,
    section: Option<Section>,
    mass: Option<Mass<'a>>,
}

/// Area and second moment of area.
#[derive(Debug, Clone, Copy)]
struct Section {
    /// A \[m²\].
    area: f64,
    /// I \[m⁴\].
    moment: f64,
}

/// Mass along the beam.
#[derive(Debug, Clone)]
enum Mass<'a> {
    /// ρ \[kg/m³\], and its place in the file.
    Density(f64, Value<'a>),
    /// ρA \[kg/m\].
    PerLength(f64),
}

impl<'a> Material<'a> {
    pub(super) fn read(table: &Table<'a>) -> Result<Self, ConfigError> {
        for other in ["young_modulus", "section"] {
            table.one_of(&["flexural_rigidity", other])?;
        }
        let mass = match table.one_of(&["density", "mass_per_length"])? {
            None => None,
            Some((0, value)) => Some(Mass::Density(value.positive(Dimension::DENSITY)?, value)),
            Some((_, value)) => Some(Mass::PerLength(value.positive(Dimension::LINEAR_DENSITY)?)),
        };
        Ok(Self {
            rigidity: table.positive("flexural_rigidity", Dimension::FLEXURAL_RIGIDITY)?,
            modulus: table.positive("young_modulus", Dimension::PRESSURE)?,
            section: table.optional("section", section)?,
            mass,
        })
    }

    /// The material of this span; keys that it does not have are taken from the beam. A span with its own
    /// `flexural_rigidity` does not use the section of the beam.
    pub(super) fn or(self, common: &Self) -> Self {
        let mass = self.mass.or_else(|| common.mass.clone());
        if self.rigidity.is_some() {
            return Self { mass, ..self };
        }
        let own = self.modulus.is_some() || self.section.is_some();
        Self {
            rigidity: common.rigidity.filter(|_| !own),
            modulus: self.modulus.or(common.modulus),
            section: self.section.or(common.section),
            mass,
        }
    }

    /// EI \[N·m²\].
    pub(super) fn rigidity(&self, beam: &Table<'_>) -> Result<f64, ConfigError> {
        match (self.rigidity, self.modulus, self.section) {
            (Some(rigidity), ..) => Ok(rigidity),
            (None, Some(modulus), Some(section)) => Ok(modulus * section.moment),
            (None, Some(_), None) => Err(beam.lacks("section")),
            (None, None, Some(_)) => Err(beam.lacks("young_modulus")),
            (None, None, None) => Err(beam.none_of(&["flexural_rigidity", "young_modulus"])),
        }
    }

    /// ρA \[kg/m\]; `None` if the file gives no mass along the beam.
    pub(super) fn mass_per_length(&self) -> Result<Option<f64>, ConfigError> {
        match &self.mass {
            None => Ok(None),
            Some(Mass::PerLength(mass)) => Ok(Some(*mass)),
            Some(Mass::Density(density, value)) => match self.section {
                Some(section) => Ok(Some(density * section.area)),
                None => Err(value.error(
                    " needs `section`",
                    "give `section` and `young_modulus`, from which the area follows, or write \
                     `mass_per_length` instead of `density`",
                )),
            },
        }
    }
}

/// Reads a section: A = πd²/4 and I = πd⁴/64 if it is round, A = wt and I = wt³/12 of a rectangle bent across t.
fn section(value: &Value<'_>) -> Result<Section, ConfigError> {
    let table = value.table()?;
    table.only("round rectangle")?;
    match table.one_of(&["round", "rectangle"])? {
        None => Err(table.none_of(&["round", "rectangle"])),
        Some((0, diameter)) => {
            let d = diameter.positive(Dimension::LENGTH)?;
            Ok(Section { area: PI * d.powi(2) / 4.0, moment: PI * d.powi(4) / 64.0 })
        }
        Some((_, sides)) => match &sides.list("a list of width and thickness")?[..] {
            [width, thickness] => {
                let w = width.positive(Dimension::LENGTH)?;
                let t = thickness.positive(Dimension::LENGTH)?;
                Ok(Section { area: w * t, moment: w * t.powi(3) / 12.0 })
            }
            _ => Err(sides.kind("a list of width and thickness")),
        },
    }
}
