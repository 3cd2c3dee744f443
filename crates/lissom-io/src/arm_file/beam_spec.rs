//! The table `[beam]`.

use lissom_core::beam::{Damping, Payload};
use serde::{Deserialize, Serialize};

use super::material::{MATERIAL_KEYS, Material};
use crate::config::{ConfigError, ConfigPlace, Table, Value};
use crate::units::Dimension;

/// Largest `count` of a span.
const MOST_REPEATED: i64 = 1_000_000;
/// Largest number of spans of a beam.
const MOST_SPANS: usize = 2_000_000;

/// A beam from base to tip.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamSpec {
    /// Spans from base to tip, at least one; a span with a `count` is repeated.
    pub spans: Vec<SpanSpec>,
    /// Distance of the clamp from the motor's axis \[m\].
    pub hub_radius_m: f64,
    /// Rotary inertia of the last mass about itself \[kg·m²\].
    pub tip_inertia_kg_m2: Option<f64>,
    /// The table `payload`.
    pub payload: Option<Payload>,
    /// Damping in addition to the dampers at masses.
    pub damping: Damping,
}

/// A piece of beam and the mass at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpanSpec {
    /// Length \[m\].
    pub length_m: f64,
    /// Mass at its end \[kg\]; may be zero in a distributed beam.
    pub mass_kg: f64,
    /// Mass along it \[kg/m\]; in a distributed beam every span has one, in a lumped one none.
    pub mass_per_length_kg_per_m: Option<f64>,
    /// Flexural rigidity EI \[N·m²\].
    pub flexural_rigidity_n_m2: f64,
    /// Viscous damping on the velocity of its end \[N·s/m\].
    pub damping_n_s_per_m: f64,
}

/// Where the mass of a beam is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum BeamKind {
    /// At points, with massless spans between them.
    Lumped,
    /// Along its length, and at the points for which the file gives masses.
    Distributed,
    /// Unknown: the beam is given by its modes.
    Modal,
}

impl BeamSpec {
    /// Where the mass of the beam is.
    pub fn kind(&self) -> BeamKind {
        match self.spans.first().and_then(|s| s.mass_per_length_kg_per_m) {
            Some(_) => BeamKind::Distributed,
            None => BeamKind::Lumped,
        }
    }

    /// The payload at the tip, with the rotary inertia of the last mass.
    pub fn tip(&self) -> Payload {
        let mut tip = self.payload.unwrap_or_default();
        tip.inertia_kg_m2 += self.tip_inertia_kg_m2.unwrap_or(0.0);
        tip
    }
}

pub(super) fn beam(table: &Table<'_>) -> Result<BeamSpec, ConfigError> {
    table.only(&format!("{MATERIAL_KEYS} hub_radius spans payload damping"))?;
    let common = Material::read(table)?;
    let hub_radius_m = table.not_negative("hub_radius", Dimension::LENGTH)?.unwrap_or(0.0);
    let value = table.need("spans")?;
    let items =
        value.list("a list of spans, as in [{ length = \"7 in\", mass = \"0.121 lb\" }]")?;
    if items.is_empty() {
        return Err(value.kind("a list of at least one span"));
    }
    let read: Vec<Entry<'_>> =
        items.iter().map(|v| Entry::read(v, table, &common)).collect::<Result<_, _>>()?;
    if let Some(early) = read[..read.len() - 1].iter().find_map(|e| e.table.get("inertia")) {
        let problem = " is allowed only in the last entry";
        return Err(early.error(problem, "move it to the last entry, or remove it"));
    }
    let inertia = read[read.len() - 1].table.get("inertia");
    let payload = table.optional("payload", Value::table)?;
    if let Some(both) = payload.as_ref().filter(|p| inertia.is_some() && p.get("inertia").is_some())
    {
        let place = ConfigPlace { key: table.place().key, ..both.place() };
        let clash = table.clash("payload.inertia", "spans[].inertia");
        return Err(ConfigError { place, ..clash });
    }
    Ok(BeamSpec {
        spans: spans(&value, &read, hub_radius_m)?,
        hub_radius_m,
        tip_inertia_kg_m2: inertia.map(|v| v.not_negative(Dimension::INERTIA)).transpose()?,
        payload: payload.map(|p| tip(&p)).transpose()?,
        damping: table.optional("damping", damping)?.unwrap_or(Damping::None),
    })
}

/// One entry of the list of spans.
struct Entry<'a> {
    table: Table<'a>,
    count: usize,
    length_m: f64,
    flexural_rigidity_n_m2: f64,
    mass_per_length_kg_per_m: Option<f64>,
    damping: Option<PointDamping>,
}

impl<'a> Entry<'a> {
    fn read(
        value: &Value<'a>,
        beam: &Table<'a>,
        common: &Material<'a>,
    ) -> Result<Self, ConfigError> {
        let table = value.table()?;
        table.only(&format!("length mass count damping inertia {MATERIAL_KEYS}"))?;
        let material = Material::read(&table)?.or(common);
        let count = table.optional("count", |v| v.whole(1, MOST_REPEATED))?;
        Ok(Self {
            count: count.and_then(|c| usize::try_from(c).ok()).unwrap_or(1),
            length_m: table.need("length")?.positive(Dimension::LENGTH)?,
            flexural_rigidity_n_m2: material.rigidity(beam)?,
            mass_per_length_kg_per_m: material.mass_per_length()?,
            damping: table.optional("damping", PointDamping::read)?,
            table,
        })
    }

    /// The mass at the end of the span; optional if the beam has mass along its length.
    fn mass_kg(&self) -> Result<f64, ConfigError> {
        match (self.mass_per_length_kg_per_m, self.table.get("mass")) {
            (None, _) => self.table.need("mass")?.positive(Dimension::MASS),
            (Some(_), Some(mass)) => mass.not_negative(Dimension::MASS),
            (Some(_), None) => Ok(0.0),
        }
    }
}

/// All spans, repeated by their `count`.
fn spans(
    list: &Value<'_>,
    entries: &[Entry<'_>],
    hub_radius_m: f64,
) -> Result<Vec<SpanSpec>, ConfigError> {
    let heavy = entries.iter().find(|e| e.mass_per_length_kg_per_m.is_some());
    let massless = entries.iter().find(|e| e.mass_per_length_kg_per_m.is_none());
    if let (Some(heavy), Some(massless)) = (heavy, massless) {
        let other = heavy.table.place().key;
        return Err(massless.table.error(
            format!(" has no mass along its length, but `{other}` has"),
            "give all spans a mass along their length (`mass_per_length`, or `density` with \
             `section`), or none of them",
        ));
    }
    let total: usize = entries.iter().map(|e| e.count).sum();
    if total > MOST_SPANS {
        return Err(list.too_many(total, MOST_SPANS));
    }
    let mut spans = Vec::with_capacity(total);
    // L_i, the distance of mass i from the axis [m].
    let mut distance_m = hub_radius_m;
    for entry in entries {
        let mass_kg = entry.mass_kg()?;
        for _ in 0..entry.count {
            distance_m += entry.length_m;
            spans.push(SpanSpec {
                length_m: entry.length_m,
                mass_kg,
                mass_per_length_kg_per_m: entry.mass_per_length_kg_per_m,
                flexural_rigidity_n_m2: entry.flexural_rigidity_n_m2,
                damping_n_s_per_m: entry.damping.map_or(0.0, |d| d.at(distance_m)),
            });
        }
    }
    Ok(spans)
}

/// Damping of a mass.
#[derive(Debug, Clone, Copy)]
enum PointDamping {
    /// \[N·s/m\].
    PerVelocity(f64),
    /// ν of the 1989 report \[N·s/rad\].
    PerRate(f64),
}

impl PointDamping {
    fn read(value: &Value<'_>) -> Result<Self, ConfigError> {
        let (index, size) =
            value.quantity_of(&[Dimension::VISCOUS_LINEAR, Dimension::FORCE_PER_RATE])?;
        if size < 0.0 {
            return Err(value.range("zero or greater"));
        }
        Ok(if index == 0 { Self::PerVelocity(size) } else { Self::PerRate(size) })
    }

    /// Damping \[N·s/m\] at distance L: with F = −ν dθ/dt and θ = ŷ/L it is ν/L (Section 6.2).
    fn at(self, distance_m: f64) -> f64 {
        match self {
            Self::PerVelocity(size) => size,
            Self::PerRate(size) => size / distance_m,
        }
    }
}

/// The table `payload`.
fn tip(table: &Table<'_>) -> Result<Payload, ConfigError> {
    table.only("mass inertia offset")?;
    payload(table)
}

/// Reads the keys of a payload.
pub(super) fn payload(table: &Table<'_>) -> Result<Payload, ConfigError> {
    let mass = table.not_negative("mass", Dimension::MASS)?;
    let inertia = table.not_negative("inertia", Dimension::INERTIA)?;
    if mass.is_none() && inertia.is_none() {
        return Err(table.none_of(&["mass", "inertia"]));
    }
    let offset = table.any("offset", Dimension::LENGTH)?;
    Ok(Payload {
        mass_kg: mass.unwrap_or(0.0),
        inertia_kg_m2: inertia.unwrap_or(0.0),
        offset_m: offset.unwrap_or(0.0),
    })
}

/// The beam's table `damping`.
fn damping(value: &Value<'_>) -> Result<Damping, ConfigError> {
    let table = value.table()?;
    let keys = ["mass_proportional", "stiffness_proportional", "ratio", "ratios"];
    table.only(&keys.join(" "))?;
    for pair in [[0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] {
        table.one_of(&pair.map(|k| keys[k]))?;
    }
    if let Some(ratio) = table.not_negative("ratio", Dimension::NUMBER)? {
        return Ok(Damping::Modal { ratios: vec![ratio] });
    }
    if let Some(list) = table.get("ratios") {
        let ratios = table.items("ratios", RATIOS, |v| v.not_negative(Dimension::NUMBER))?;
        return if ratios.is_empty() {
            Err(list.kind(RATIOS))
        } else {
            Ok(Damping::Modal { ratios })
        };
    }
    let mass = table.not_negative(keys[0], Dimension::RATE)?;
    let stiffness = table.not_negative(keys[1], Dimension::TIME)?;
    if mass.is_none() && stiffness.is_none() {
        return Err(table.none_of(&keys));
    }
    Ok(Damping::Proportional {
        mass_per_s: mass.unwrap_or(0.0),
        stiffness_s: stiffness.unwrap_or(0.0),
    })
}

const RATIOS: &str = "a list of damping ratios";
