//! Quantities whose JSON key contains the unit, such as `viscous_nm_s_per_rad`.
//!
//! The unit depends on the campaign, so the key cannot be the name of a field: a [`WithUnit`] has the key and the
//! value, and is flattened into the table that it belongs to. [`UnitNames`] builds every key.

use std::fmt;
use std::marker::PhantomData;

use lissom_core::identify::Estimate;
use serde::de::{Error as _, IgnoredAny, MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::estimate_entry::EstimateEntry;
use super::unit_names::UnitNames;

/// A quantity whose key contains its unit.
pub trait Quantity {
    /// Description of the quantity.
    const DESCRIPTION: &'static str;
    /// The keys that it may have in a campaign with these units.
    fn keys(names: UnitNames) -> Vec<String>;
}

/// The unit of a quantity.
#[derive(Debug, Clone, Copy)]
enum Unit {
    /// Unit of torque or force, or of the command.
    Torque,
    /// Unit of the command.
    Command,
    /// Torque per unit of command.
    TorqueConstant,
    /// Torque or force per speed.
    Viscous,
    /// Torque or force per angle or position.
    Coupling,
    /// Inertia or mass.
    Inertia,
    /// Angle or position.
    Angle,
    /// Speed.
    Speed,
    /// Torque or force per square root of speed.
    Root,
    /// Unit of a term of the friction law.
    LawTerm,
}

impl Unit {
    /// Keys of a quantity that has this unit and this name.
    fn keys(self, name: &str, names: UnitNames) -> Vec<String> {
        let (torque, command, angle) = (names.torque(), names.command(), names.angle());
        match self {
            Self::Torque if torque == command => vec![format!("{name}_{command}")],
            Self::Torque => vec![format!("{name}_{command}"), format!("{name}_{torque}")],
            Self::Command => vec![format!("{name}_{command}")],
            Self::TorqueConstant => vec![format!("{name}_nm_per_{command}")],
            Self::Viscous => vec![names.viscous_key(name)],
            Self::Coupling => vec![names.coupling_key(name)],
            Self::Inertia => vec![names.inertia_key()],
            Self::Angle => vec![format!("{name}_{angle}")],
            Self::Speed => vec![format!("{name}_{angle}_per_s")],
            Self::Root => vec![names.root_key(name)],
            Self::LawTerm => vec![
                names.viscous_key(name),
                format!("{name}_{torque}"),
                names.root_key(name),
                format!("{name}_{angle}"),
                format!("{name}_s"),
                name.to_owned(),
            ],
        }
    }
}

macro_rules! quantities {
    ($($(#[doc = $text:literal])+ $type:ident = $name:literal in $unit:ident;)+) => {
        $(
            $(#[doc = $text])+
            #[derive(Debug, Clone, Copy, PartialEq, Eq)]
            pub enum $type {}

            impl Quantity for $type {
                const DESCRIPTION: &'static str = concat!($($text),+);
                fn keys(names: UnitNames) -> Vec<String> {
                    Unit::$unit.keys($name, names)
                }
            }
        )+
    };
}

quantities! {
    /// Coulomb friction, mean of both directions, (forward + backward)/2.
    CoulombKey = "coulomb" in Torque;
    /// Coulomb friction while moving forward.
    ForwardKey = "forward" in Torque;
    /// Coulomb friction while moving backward.
    BackwardKey = "backward" in Torque;
    /// (forward - backward)/2: direction-dependent friction or a constant load.
    OffsetKey = "offset" in Torque;
    /// Viscous friction.
    ViscousKey = "viscous" in Viscous;
    /// Viscous friction while moving forward.
    ViscousForwardKey = "viscous_forward" in Viscous;
    /// Viscous friction while moving backward.
    ViscousBackwardKey = "viscous_backward" in Viscous;
    /// Damping by back-EMF, which belongs to the drive and not to friction.
    BackEmfKey = "back_emf" in Viscous;
    /// Inertia, or mass of a linear axis.
    InertiaKey = "inertia" in Inertia;
    /// Torque per angle between motor and beam, h_{n+1} of (15).
    CouplingKey = "coupling" in Coupling;
    /// The coupling of each tip that is a calibrated angle or deflection, in their order; empty without regression.
    CouplingByTipKey = "coupling_by_tip" in Coupling;
    /// The coupling through each mode.
    CouplingByModeKey = "coupling_by_mode" in Coupling;
    /// Amplitude of a term of friction.
    AmplitudeKey = "amplitude" in Torque;
    /// Friction at rest.
    StaticKey = "static" in Torque;
    /// Torque per command.
    TorqueConstantKey = "torque_constant" in TorqueConstant;
    /// Amplitude of the square root of speed.
    RootAmplitudeKey = "amplitude" in Root;
    /// Amplitude of a term of the friction law, in the unit of the term; for a ripple those of cosine and sine.
    LawAmplitudeKey = "amplitude" in LawTerm;
    /// Amplitude of the motor's angle or position.
    MotionKey = "amplitude" in Angle;
    /// Magnitude of a speed; v_s of friction near rest.
    SpeedKey = "speed" in Speed;
    /// Smallest and largest speed.
    SpeedRangeKey = "speed_range" in Speed;
    /// Velocity with its sign.
    VelocityKey = "velocity" in Speed;
    /// Period over the travel, 2*pi/k.
    PeriodKey = "period" in Angle;
    /// Torque on the motor per deflection of a mode.
    StiffnessKey = "stiffness" in Coupling;
    /// Friction per square root of the speed.
    RootKey = "root" in Root;
    /// Amplitude of the cosine over the travel.
    CosineKey = "cosine" in Torque;
    /// Amplitude of the sine over the travel.
    SineKey = "sine" in Torque;
    /// Friction against the motion, positive if it brakes; it includes a constant load.
    FrictionKey = "friction" in Torque;
    /// Coulomb friction from the slowest third of the speeds; null if these are all speeds.
    SlowestKey = "slowest" in Torque;
    /// Standard deviation of the Coulomb friction of one pair around the mean.
    SpreadKey = "spread" in Command;
    /// Mean command.
    MeanCommandKey = "command" in Command;
    /// H of (18): torque on the motor per angle of each point.
    PointTorqueKey = "h" in Coupling;
    /// h_{n+1} of (18): torque on the motor per motor angle.
    MotorTorqueKey = "h_motor" in Coupling;
    /// Root mean square of the logged torque.
    LoggedRmsKey = "logged_rms" in Torque;
}

/// Values of one quantity under keys with their units: none if the table has no such key, two if a torque is also given
/// in the unit of the command.
#[derive(Debug, Clone, PartialEq)]
pub struct WithUnit<Q, T> {
    entries: Vec<(String, T)>,
    quantity: PhantomData<Q>,
}

impl<Q: Quantity, T> WithUnit<Q, T> {
    /// No key at all.
    pub(crate) fn absent() -> Self {
        Self { entries: Vec::new(), quantity: PhantomData }
    }

    /// One value under the key of the last unit; for torques the unit of torque.
    pub(crate) fn new(names: UnitNames, value: T) -> Self {
        let key = Q::keys(names).pop();
        Self { entries: key.map(|key| (key, value)).into_iter().collect(), quantity: PhantomData }
    }

    /// A value that may be absent, under the key of the last unit.
    pub(crate) fn where_some(names: UnitNames, value: Option<T>) -> Self {
        value.map_or_else(Self::absent, |value| Self::new(names, value))
    }

    /// One value under one of the keys of the quantity.
    pub(crate) fn under(key: String, value: T) -> Self {
        Self { entries: vec![(key, value)], quantity: PhantomData }
    }

    /// The value in a campaign with these units; for torques that in the unit of torque.
    pub fn get(&self, names: UnitNames) -> Option<&T> {
        self.keyed(names).map(|(_, value)| value)
    }

    /// The value in a campaign with these units; for torques that in the unit of torque.
    pub(crate) fn keyed(&self, names: UnitNames) -> Option<(&str, &T)> {
        self.under_key(&Q::keys(names).pop()?)
    }

    /// The value of a torque in the unit of the command.
    pub fn in_command(&self, names: UnitNames) -> Option<&T> {
        self.of_command(names).map(|(_, value)| value)
    }

    /// The value of a torque in the unit of the command, and its key.
    pub(crate) fn of_command(&self, names: UnitNames) -> Option<(&str, &T)> {
        self.under_key(Q::keys(names).first()?)
    }

    /// The first of its values, in any unit.
    pub fn any(&self) -> Option<&T> {
        self.entries.first().map(|entry| &entry.1)
    }

    /// Whether its keys are exactly those of a campaign with these units.
    pub(crate) fn has_keys_of(&self, names: UnitNames) -> bool {
        let keys = Q::keys(names);
        keys.len() == self.entries.len() && keys.iter().all(|key| self.under_key(key).is_some())
    }

    fn under_key(&self, key: &str) -> Option<(&str, &T)> {
        let found = self.entries.iter().find(|entry| entry.0 == key);
        found.map(|(key, value)| (key.as_str(), value))
    }

    /// Whether the quantity has this key in some campaign.
    fn has_key(key: &str) -> bool {
        UnitNames::ALL.iter().any(|names| Q::keys(*names).iter().any(|own| own == key))
    }
}

impl<Q: Quantity> WithUnit<Q, Option<EstimateEntry>> {
    /// A torque in the unit of the command and, if the torque constant is known, in the unit of torque.
    pub(crate) fn torque(names: UnitNames, constant: f64, value: Option<Estimate>) -> Self {
        let of_command = value.map(|e| e.scaled(1.0 / constant));
        let values = [of_command, value].map(|e| e.map(EstimateEntry::of));
        Self { entries: Q::keys(names).into_iter().zip(values).collect(), quantity: PhantomData }
    }
}

impl<Q, T: Serialize> Serialize for WithUnit<Q, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.entries.len()))?;
        for (key, value) in &self.entries {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

impl<'de, Q: Quantity, T: Deserialize<'de>> Deserialize<'de> for WithUnit<Q, T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(OwnKeys(PhantomData))
    }
}

/// Reads the keys of a quantity from those of a table.
struct OwnKeys<Q, T>(PhantomData<(Q, T)>);

impl<'de, Q: Quantity, T: Deserialize<'de>> Visitor<'de> for OwnKeys<Q, T> {
    type Value = WithUnit<Q, T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = WithUnit::absent();
        while let Some(key) = map.next_key::<String>()? {
            if WithUnit::<Q, T>::has_key(&key) {
                let value = map.next_value();
                // Errors of a flattened table do not contain the key.
                let value = value.map_err(|e| A::Error::custom(format!("`{key}`: {e}")))?;
                found.entries.push((key, value));
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(found)
    }
}

#[cfg(feature = "schema")]
impl<Q: Quantity, T: schemars::JsonSchema> schemars::JsonSchema for WithUnit<Q, T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        format!("WithUnit_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let mut value = generator.subschema_for::<T>();
        value.insert("description".to_owned(), Q::DESCRIPTION.trim().into());
        schemars::json_schema!({ "type": "object", "patternProperties": { key_pattern::<Q>(): value } })
    }
}

/// The pattern of all keys that a quantity may have.
#[cfg(feature = "schema")]
fn key_pattern<Q: Quantity>() -> String {
    let mut keys: Vec<String> = Vec::new();
    for key in UnitNames::ALL.iter().flat_map(|names| Q::keys(*names)) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    // The common beginning of all keys is written once.
    let first = keys.first().map_or("", String::as_str);
    let mut ends = first.match_indices('_').map(|(at, _)| &first[..=at]);
    let shared = ends.rfind(|start| keys.iter().all(|key| key.starts_with(start)));
    let shared = shared.unwrap_or_default();
    let rests: Vec<&str> = keys.iter().map(|key| &key[shared.len()..]).collect();
    format!("^{shared}({})$", rests.join("|"))
}
