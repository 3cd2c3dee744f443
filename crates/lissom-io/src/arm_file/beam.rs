//! The table `[beam]`.

use std::f64::consts::PI;

use crate::config::{ConfigError, Rule, Table, Value};
use crate::units::Dimension;

/// A massless beam with lumped masses.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamSpec {
    /// Spans from base to tip, at least one.
    pub spans: Vec<SpanSpec>,
    /// Rotary inertia of the last mass about itself \[kg·m²\].
    pub tip_inertia_kg_m2: Option<f64>,
}

/// A piece of beam and the mass at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpanSpec {
    /// Length \[m\].
    pub length_m: f64,
    /// Mass at its end \[kg\].
    pub mass_kg: f64,
    /// Flexural rigidity EI \[N·m²\].
    pub flexural_rigidity_n_m2: f64,
    /// Viscous damping on the mass's velocity \[N·s/m\].
    pub damping_n_s_per_m: f64,
}

const RIGIDITY_KEYS: [&str; 3] = ["flexural_rigidity", "young_modulus", "section"];

pub(super) fn beam(table: &Table<'_>) -> Result<BeamSpec, ConfigError> {
    table.only(&["young_modulus", "section", "flexural_rigidity", "spans"])?;
    let common = Stiffness::read(table)?;
    let value = table.need("spans")?;
    let items =
        value.list("a list of spans, as in [{ length = \"7 in\", mass = \"0.121 lb\" }]")?;
    if items.is_empty() {
        return Err(value.kind("a list of at least one span"));
    }
    let mut spans = Vec::with_capacity(items.len());
    let mut tip_inertia_kg_m2 = None;
    // L_i, the distance of mass i from the joint [m].
    let mut distance_m = 0.0;
    for (index, item) in items.iter().enumerate() {
        let span = item.table()?;
        span.only(&[
            "length",
            "mass",
            "damping",
            "inertia",
            "flexural_rigidity",
            "young_modulus",
            "section",
        ])?;
        let length_m = span.need("length")?.positive(Dimension::LENGTH)?;
        distance_m += length_m;
        if let Some(inertia) = span.get("inertia") {
            if index + 1 < items.len() {
                return Err(ConfigError::LastOnly { place: inertia.place() });
            }
            tip_inertia_kg_m2 = Some(inertia.not_negative(Dimension::INERTIA)?);
        }
        let damping = span.get("damping").map(|value| damping(&value, distance_m)).transpose()?;
        spans.push(SpanSpec {
            length_m,
            mass_kg: span.need("mass")?.positive(Dimension::MASS)?,
            flexural_rigidity_n_m2: Stiffness::read(&span)?.or(&common).rigidity(table)?,
            damping_n_s_per_m: damping.unwrap_or(0.0),
        });
    }
    Ok(BeamSpec { spans, tip_inertia_kg_m2 })
}

/// Damping in N·s/m at distance L, from that or from the report's ν \[N·s/rad\]: with
/// F = −ν dθ/dt and θ = y/L it is ν/L (Section 6.2).
fn damping(value: &Value<'_>, distance_m: f64) -> Result<f64, ConfigError> {
    let (index, size) =
        value.quantity_of(&[Dimension::VISCOUS_LINEAR, Dimension::FORCE_PER_RATE])?;
    if size < 0.0 {
        return Err(value.range(Rule::NotNegative));
    }
    Ok(if index == 0 { size } else { size / distance_m })
}

/// What a table says of EI.
#[derive(Debug, Clone, Copy, Default)]
struct Stiffness {
    /// EI \[N·m²\].
    rigidity: Option<f64>,
    /// E \[Pa\].
    modulus: Option<f64>,
    /// I \[m⁴\].
    area_moment: Option<f64>,
}

impl Stiffness {
    fn read(table: &Table<'_>) -> Result<Self, ConfigError> {
        for other in &RIGIDITY_KEYS[1..] {
            table.one_of(&[RIGIDITY_KEYS[0], other])?;
        }
        let positive = |key, dimension| table.get(key).map(|v| v.positive(dimension)).transpose();
        Ok(Self {
            rigidity: positive("flexural_rigidity", Dimension::FLEXURAL_RIGIDITY)?,
            modulus: positive("young_modulus", Dimension::PRESSURE)?,
            area_moment: table.get("section").map(|v| area_moment(&v)).transpose()?,
        })
    }

    /// This span's stiffness, with the beam's where it says nothing.
    fn or(self, common: &Self) -> Self {
        if self.rigidity.is_some() {
            return self;
        }
        let own = self.modulus.is_some() || self.area_moment.is_some();
        Self {
            rigidity: common.rigidity.filter(|_| !own),
            modulus: self.modulus.or(common.modulus),
            area_moment: self.area_moment.or(common.area_moment),
        }
    }

    fn rigidity(self, beam: &Table<'_>) -> Result<f64, ConfigError> {
        match (self.rigidity, self.modulus, self.area_moment) {
            (Some(rigidity), ..) => Ok(rigidity),
            (None, Some(modulus), Some(area_moment)) => Ok(modulus * area_moment),
            (None, Some(_), None) => {
                Err(ConfigError::MissingKey { place: beam.place(), key: "section" })
            }
            (None, None, Some(_)) => {
                Err(ConfigError::MissingKey { place: beam.place(), key: "young_modulus" })
            }
            (None, None, None) => {
                Err(ConfigError::NoneOf { place: beam.place(), keys: RIGIDITY_KEYS[..2].to_vec() })
            }
        }
    }
}

/// Second moment of area: πd⁴/64 of a round section, wt³/12 of a rectangle bent across t.
fn area_moment(value: &Value<'_>) -> Result<f64, ConfigError> {
    let section = value.table()?;
    section.only(&["round", "rectangle"])?;
    match section.one_of(&["round", "rectangle"])? {
        None => {
            let keys = vec!["round", "rectangle"];
            Err(ConfigError::NoneOf { place: section.place(), keys })
        }
        Some((0, diameter)) => Ok(PI * diameter.positive(Dimension::LENGTH)?.powi(4) / 64.0),
        Some((_, sides)) => match &sides.list("a list of width and thickness")?[..] {
            [width, thickness] => {
                let width_m = width.positive(Dimension::LENGTH)?;
                Ok(width_m * thickness.positive(Dimension::LENGTH)?.powi(3) / 12.0)
            }
            _ => Err(sides.kind("a list of width and thickness")),
        },
    }
}
