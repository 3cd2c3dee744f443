//! The type of `model.json`: filled from a model, written and read.

use lissom_core::beam::{Mode, Payload, Property, RootClass, TruncatedBeam, Zeros, class};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::beam_model::{Function, Model, PayloadCase};
use super::model_responses::Responses;
use super::state_space_entry::{StateSpaceEntry, matrix_rows};
use crate::arm_file::BeamKind;

/// The model of a beam, and of the arm with its drive. SI units and rad/s; equation numbers are those of the 1989
/// report. A key is null if it does not apply to the model or the model is too large for it; notes then gives the
/// reason. Frequencies, modes and tip_zeros are without damping; transfer functions of point masses, state space and
/// responses are with damping.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModelFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Where the beam's mass is.
    pub kind: BeamKind,
    /// Number of masses, of spans of a distributed beam, or of points of a beam given by its modes.
    pub n: usize,
    /// Length from clamp to tip; null for a beam given by its modes.
    pub length_m: Option<f64>,
    /// Distance from the motor's axis to the clamp; null for a beam given by its modes.
    pub hub_radius_m: Option<f64>,
    /// Point masses from base to tip, without the payload.
    pub mass_kg: Vec<f64>,
    /// Mass along the beam; 0 for a lumped beam.
    pub mass_along_kg: f64,
    /// Distance of each mass, or of the end of each span, from the motor's axis.
    pub position_m: Vec<f64>,
    /// Payload at the tip; null for a beam given by its modes.
    pub payload: Option<Payload>,
    /// Inertia of beam, masses and payload about the motor's axis, as a rigid body.
    pub inertia_kg_m2: f64,
    /// EI*A of (13), N/m, rows.
    pub ei_a: Option<Vec<Vec<f64>>>,
    /// EI*B of (13), N/m.
    pub ei_b: Option<Vec<f64>>,
    /// P of (13), torque at the tip, 1/m^2.
    pub p: Option<Vec<f64>>,
    /// Q of (13), force at the tip, 1/m.
    pub q: Option<Vec<f64>>,
    /// U of (10), rows.
    pub u: Option<Vec<Vec<f64>>>,
    /// H of (15): torque on the motor per angle of each mass, N*m/rad.
    pub h: Option<Vec<f64>>,
    /// h_{n+1} of (15): torque per motor angle, N*m/rad.
    pub h_motor: Option<f64>,
    /// h_{n+2} of (15): torque on the motor per torque at the tip.
    pub h_torque: Option<f64>,
    /// Natural frequencies with the motor clamped, ascending.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Natural frequencies with the rotor free and without friction; null without a drive.
    pub coupled_frequencies_rad_s: Option<Vec<f64>>,
    /// Modes with the motor clamped.
    pub modes: Option<Vec<Mode>>,
    /// Zeros of the tip's response per motor angle, in ascending magnitude.
    pub tip_zeros: Option<Vec<ZeroEntry>>,
    /// Transfer functions.
    pub transfer_functions: Vec<FunctionEntry>,
    /// State space of the arm with its drive, without Coulomb friction.
    pub state_space: Option<StateSpaceEntry>,
    /// A model of the first modes of a distributed beam, in the form (17)-(18).
    pub truncated: Option<TruncatedEntry>,
    /// Responses at the frequencies asked for.
    pub frequency_response: Option<ResponsesEntry>,
    /// The same beam with other loads; the load in the file is first.
    pub payload_study: Option<Vec<PayloadCaseEntry>>,
    /// The properties of Section 3 of the 1989 report, checked.
    pub properties: Option<Vec<PropertyEntry>>,
    /// What is not given, and why.
    pub notes: Vec<String>,
    /// What is not reliable.
    pub warnings: Vec<String>,
}

/// A complex number; a part that is not finite is null.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexEntry {
    /// Real part.
    pub re: Option<f64>,
    /// Imaginary part.
    pub im: Option<f64>,
}

/// Zeros of a response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ZeroEntry {
    /// The square of the zeros in 1/s^2: the zeros are both of its square roots.
    pub s_squared: ComplexEntry,
    /// Their class.
    pub class: RootClass,
}

/// A transfer function.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FunctionEntry {
    /// Input: motor (its angle, rad) or current (A).
    pub from: String,
    /// Output: theta_1 ... (rad), motor (rad), or coupling_torque (N*m).
    pub to: String,
    /// Numerator, descending powers of s; null if a distributed beam has no polynomial or a coefficient exceeds the
    /// range of a double.
    pub num: Option<Vec<f64>>,
    /// Denominator, descending powers of s.
    pub den: Option<Vec<f64>>,
    /// Zeros in 1/s; for a distributed beam those below its highest frequency.
    pub zeros: Vec<ComplexEntry>,
    /// Poles in 1/s; for a distributed beam the lowest.
    pub poles: Vec<ComplexEntry>,
    /// Gain: factor of the product of (s - zero) divided by the product of (s - pole).
    pub gain: Option<f64>,
    /// Whether no zero is right of the imaginary axis; null if some zeros are unknown and no known zero is there.
    pub minimum_phase: Option<bool>,
    /// Number of roots that were not found; a warning reports them.
    pub missing: usize,
}

/// A model of the first modes of a distributed beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TruncatedEntry {
    /// Distances from the axis of the points whose angles are its outputs.
    pub points_m: Vec<f64>,
    /// Its natural frequencies.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// A-hat of (17), 1/s^2.
    pub a: Vec<Vec<f64>>,
    /// B-hat of (17), 1/s^2.
    pub b: Vec<f64>,
    /// H-hat of (18), N*m/rad.
    pub h: Vec<f64>,
    /// h-hat of (18), N*m/rad.
    pub h_motor: f64,
    /// Inertia of the omitted modes, to be added to that of the motor.
    pub residual_inertia_kg_m2: f64,
}

/// Responses at the frequencies asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResponsesEntry {
    /// Frequencies.
    pub omega_rad_s: Vec<f64>,
    /// Output of each list in tips: theta_1 ...
    pub to: Vec<String>,
    /// Angle per motor angle, one list for each mass.
    pub tips: Vec<Vec<ComplexEntry>>,
    /// Coupling torque per motor angle.
    pub coupling_nm_per_rad: Vec<ComplexEntry>,
    /// Motor angle per current, without Coulomb friction.
    pub motor_rad_per_a: Option<Vec<ComplexEntry>>,
}

/// The beam with another load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PayloadCaseEntry {
    /// The load: the payload's mass if there is one, otherwise the last mass.
    pub tip_mass_kg: f64,
    /// Rotary inertia of the payload; a load given as a factor multiplies it, one given as a mass does not change it.
    pub payload_inertia_kg_m2: f64,
    /// Load relative to the load in the file.
    pub factor: Option<f64>,
    /// Natural frequencies with the motor clamped.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Zeros of the tip's response.
    pub zeros: Vec<ZeroEntry>,
    /// Largest relative change of s^2 from the zeros with the load in the file; null if the numbers of zeros differ.
    pub zero_shift: Option<f64>,
}

/// A property claimed in Section 3 of the 1989 report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PropertyEntry {
    /// Short name of the property.
    pub name: String,
    /// What the 1989 report claims.
    pub statement: String,
    /// The number that was computed.
    pub measured: f64,
    /// The largest number for which the property holds.
    pub bound: f64,
    /// Whether the property holds.
    pub holds: bool,
    /// How the number was computed.
    pub note: String,
}

impl ModelFile {
    /// The content that `lissom model` writes.
    pub fn of(model: &Model) -> Self {
        let m = model.matrices.as_ref();
        let dimensions = model.kind != BeamKind::Modal;
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            kind: model.kind,
            n: model.len(),
            length_m: dimensions.then(|| model.length_m()),
            hub_radius_m: dimensions.then_some(model.hub_radius_m),
            mass_kg: model.mass_kg.clone(),
            mass_along_kg: model.mass_along_kg,
            position_m: model.position_m.clone(),
            payload: dimensions.then_some(model.payload),
            inertia_kg_m2: model.inertia_kg_m2,
            ei_a: m.map(|m| matrix_rows(&m.ei_a)),
            ei_b: m.map(|m| m.ei_b.as_slice().to_vec()),
            p: m.map(|m| m.p.as_slice().to_vec()),
            q: m.map(|m| m.q.as_slice().to_vec()),
            u: m.map(|m| matrix_rows(&m.u)),
            h: m.map(|m| m.h.as_slice().to_vec()),
            h_motor: m.map(|m| m.h_motor),
            h_torque: m.map(|m| m.h_torque),
            natural_frequencies_rad_s: model.natural_frequencies_rad_s.clone(),
            coupled_frequencies_rad_s: model.coupled_frequencies_rad_s.clone(),
            modes: model.modes.clone(),
            tip_zeros: model.tip_zeros.as_ref().map(ZeroEntry::list),
            transfer_functions: model.functions.iter().map(FunctionEntry::of).collect(),
            state_space: model.state_space.as_ref().map(StateSpaceEntry::of),
            truncated: model.truncated.as_ref().map(TruncatedEntry::of),
            frequency_response: model.response.as_ref().map(ResponsesEntry::of),
            payload_study: each(model.payload_study.as_deref(), PayloadCaseEntry::of),
            properties: each(model.properties.as_deref(), PropertyEntry::of),
            notes: model.notes.clone(),
            warnings: model.warnings.clone(),
        }
    }
}

/// The entries of a list, if there is one.
fn each<T, E>(list: Option<&[T]>, entry: impl Fn(&T) -> E) -> Option<Vec<E>> {
    list.map(|list| list.iter().map(entry).collect())
}

impl ComplexEntry {
    fn of(value: Complex64) -> Self {
        let finite = |part: f64| Some(part).filter(|p| p.is_finite());
        Self { re: finite(value.re), im: finite(value.im) }
    }

    fn list(values: &[Complex64]) -> Vec<Self> {
        values.iter().copied().map(Self::of).collect()
    }
}

impl ZeroEntry {
    fn list(found: &Zeros) -> Vec<Self> {
        let each = |z: &Complex64| Self { s_squared: ComplexEntry::of(*z), class: class(*z) };
        found.z.iter().map(each).collect()
    }
}

impl FunctionEntry {
    fn of(f: &Function) -> Self {
        let polynomials = if f.lowest { None } else { f.roots.transfer_function() };
        let (num, den) = polynomials.map(|g| (g.num, g.den)).unzip();
        Self {
            from: f.from.to_owned(),
            to: f.to.clone(),
            num,
            den,
            zeros: ComplexEntry::list(&f.roots.zeros),
            poles: ComplexEntry::list(&f.roots.poles),
            gain: Some(f.roots.gain).filter(|_| !f.lowest),
            // If some zeros were not searched for, only a zero that is found right of the axis decides.
            minimum_phase: Some(f.roots.minimum_phase()).filter(|m| !(f.lowest && *m)),
            missing: f.roots.missing,
        }
    }
}

impl TruncatedEntry {
    fn of(t: &TruncatedBeam) -> Self {
        Self {
            points_m: t.points_m.clone(),
            natural_frequencies_rad_s: t.natural_frequencies_rad_s.clone(),
            a: matrix_rows(&t.a),
            b: t.b.as_slice().to_vec(),
            h: t.h.as_slice().to_vec(),
            h_motor: t.h_motor,
            residual_inertia_kg_m2: t.residual_inertia_kg_m2,
        }
    }
}

impl ResponsesEntry {
    fn of(r: &Responses) -> Self {
        Self {
            omega_rad_s: r.omega_rad_s.clone(),
            to: r.masses.iter().map(|i| format!("theta_{}", i + 1)).collect(),
            tips: r.tips.iter().map(|tip| ComplexEntry::list(tip)).collect(),
            coupling_nm_per_rad: ComplexEntry::list(&r.coupling),
            motor_rad_per_a: r.motor.as_ref().map(|motor| ComplexEntry::list(motor)),
        }
    }
}

impl PayloadCaseEntry {
    fn of(case: &PayloadCase) -> Self {
        Self {
            tip_mass_kg: case.tip_mass_kg,
            payload_inertia_kg_m2: case.inertia_kg_m2,
            factor: case.factor,
            natural_frequencies_rad_s: case.natural_frequencies_rad_s.clone(),
            zeros: ZeroEntry::list(&case.zeros),
            zero_shift: case.zero_shift,
        }
    }
}

impl PropertyEntry {
    fn of(p: &Property) -> Self {
        Self {
            name: p.name.to_owned(),
            statement: p.statement.to_owned(),
            measured: p.measured,
            bound: p.bound,
            holds: p.holds,
            note: p.note.clone(),
        }
    }
}
