//! `model.json` as a type: filled from a model, written and read.

use lissom_core::beam::{Mode, Payload, Property, RootClass, TruncatedBeam, Zeros, class};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::beam_model::{Function, Model, PayloadCase};
use super::model_responses::Responses;
use super::state_space_entry::{StateSpaceEntry, matrix_rows};
use crate::arm_file::BeamKind;

/// A beam, and the arm it makes with its drive. SI units and rad/s; numbers of equations are those of the report. A key
/// is null where the model has no such thing or is too large for it; a sentence in notes then says why. Frequencies,
/// modes and tip_zeros leave damping out; transfer functions of point masses, state space and responses have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModelFile {
    /// Version that wrote the file.
    pub lissom: String,
    /// Where the beam's mass is.
    pub kind: BeamKindName,
    /// Number of masses, of spans of a distributed beam, or of points of one known by its modes.
    pub n: usize,
    /// From clamp to tip; null of a beam known by its modes.
    pub length_m: Option<f64>,
    /// From the motor's axis to the clamp; null of a beam known by its modes.
    pub hub_radius_m: Option<f64>,
    /// Point masses, base to tip, without the payload.
    pub mass_kg: Vec<f64>,
    /// Mass along the beam; 0 for a lumped one.
    pub mass_along_kg: f64,
    /// Distance of each mass, or span's end, from the motor's axis.
    pub position_m: Vec<f64>,
    /// What the tip carries; null of a beam known by its modes.
    pub payload: Option<TipPayloadEntry>,
    /// Beam, masses and payload about the motor's axis as one body.
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
    /// Motor clamped, ascending.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Rotor free, without its friction; null without a drive.
    pub coupled_frequencies_rad_s: Option<Vec<f64>>,
    /// Motor clamped.
    pub modes: Option<Vec<ModeShapeEntry>>,
    /// Zeros of the tip's response to the motor, ascending in size.
    pub tip_zeros: Option<Vec<ZeroEntry>>,
    /// Transfer functions.
    pub transfer_functions: Vec<FunctionEntry>,
    /// The arm with its drive, Coulomb friction left out.
    pub state_space: Option<StateSpaceEntry>,
    /// A distributed beam by its first modes, in the form (17)-(18).
    pub truncated: Option<TruncatedEntry>,
    /// Responses at the frequencies asked for.
    pub frequency_response: Option<ResponsesEntry>,
    /// The same beam with other loads; the file's own load first.
    pub payload_study: Option<Vec<PayloadCaseEntry>>,
    /// The properties of Section 3, measured.
    pub properties: Option<Vec<PropertyEntry>>,
    /// What is left out, and why.
    pub notes: Vec<String>,
    /// What the numbers cannot be trusted for.
    pub warnings: Vec<String>,
}

/// Where a beam's mass is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum BeamKindName {
    /// Point masses.
    Lumped,
    /// Mass along the beam.
    Distributed,
    /// The beam is known by its modes.
    Modal,
}

/// What the tip carries.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TipPayloadEntry {
    /// Its mass.
    pub mass_kg: f64,
    /// About its own centre.
    pub inertia_kg_m2: f64,
    /// Of its centre from the tip, along the beam's tangent, outward.
    pub offset_m: f64,
}

/// A mode with the motor clamped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ModeShapeEntry {
    /// Its frequency.
    pub natural_frequency_rad_s: f64,
    /// Deflection at each position, the largest being 1.
    pub shape: Vec<f64>,
    /// The mode's share in each angle per motor angle: theta_i/theta_m = sum of share/(1 + s^2/omega^2).
    pub share: Vec<f64>,
    /// What the mode adds to the inertia that the motor feels at rest.
    pub inertia_kg_m2: f64,
}

/// A complex number; null where a part is not finite.
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
    /// 1/s^2; the zeros are both roots of it.
    pub s_squared: ComplexEntry,
    /// Their class.
    pub class: RootClassName,
}

/// Class of a root by Section 3; b and c are non-minimum phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RootClassName {
    /// A pair on the imaginary axis.
    A,
    /// A real pair.
    B,
    /// Half a quadruple.
    C,
}

/// A transfer function.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FunctionEntry {
    /// motor (its angle, rad) or current (A).
    pub from: String,
    /// theta_1 ... (rad), motor (rad), coupling_torque (N*m).
    pub to: String,
    /// Numerator, descending powers of s; null where a distributed beam has no polynomial or it leaves the range of a
    /// double.
    pub num: Option<Vec<f64>>,
    /// Denominator.
    pub den: Option<Vec<f64>>,
    /// 1/s; of a distributed beam those below its highest frequency.
    pub zeros: Vec<ComplexEntry>,
    /// 1/s; of a distributed beam the lowest.
    pub poles: Vec<ComplexEntry>,
    /// Product of (s - zero) over product of (s - pole), times this.
    pub gain: Option<f64>,
    /// No zero right of the imaginary axis; null where not all are known and none of those known is.
    pub minimum_phase: Option<bool>,
    /// Roots that were not found; a warning names them.
    pub missing: usize,
}

/// A distributed beam by its first modes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TruncatedEntry {
    /// Points whose angles are its outputs.
    pub points_m: Vec<f64>,
    /// Its frequencies.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// A-hat of (17), 1/s^2.
    pub a: Vec<Vec<f64>>,
    /// B-hat of (17), 1/s^2.
    pub b: Vec<f64>,
    /// H-hat of (18), N*m/rad.
    pub h: Vec<f64>,
    /// h-hat of (18), N*m/rad.
    pub h_motor: f64,
    /// Inertia of the modes left out, to be added to the motor's.
    pub residual_inertia_kg_m2: f64,
}

/// Responses at the frequencies asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResponsesEntry {
    /// Frequencies.
    pub omega_rad_s: Vec<f64>,
    /// What each list of tips is: theta_1 ...
    pub to: Vec<String>,
    /// Angle per motor angle, one list a mass.
    pub tips: Vec<Vec<ComplexEntry>>,
    /// Coupling torque per motor angle.
    pub coupling_nm_per_rad: Vec<ComplexEntry>,
    /// Motor angle per current, Coulomb friction left out.
    pub motor_rad_per_a: Option<Vec<ComplexEntry>>,
}

/// The beam with another load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PayloadCaseEntry {
    /// The payload's mass where there is one, else the last mass.
    pub tip_mass_kg: f64,
    /// Rotary inertia of the payload; a factor multiplies it, a mass leaves it.
    pub payload_inertia_kg_m2: f64,
    /// Load relative to that of the file.
    pub factor: Option<f64>,
    /// Motor clamped.
    pub natural_frequencies_rad_s: Vec<f64>,
    /// Of the tip's response.
    pub zeros: Vec<ZeroEntry>,
    /// Largest relative change of s^2 from the file's own; null where their numbers differ.
    pub zero_shift: Option<f64>,
}

/// A property that Section 3 claims.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PropertyEntry {
    /// Short name.
    pub name: String,
    /// What the report claims.
    pub statement: String,
    /// What was measured.
    pub measured: f64,
    /// It holds up to here.
    pub bound: f64,
    /// Whether it holds.
    pub holds: bool,
    /// How it was measured.
    pub note: String,
}

impl ModelFile {
    /// What `lissom model` writes.
    pub fn of(model: &Model) -> Self {
        let m = model.matrices.as_ref();
        let dimensions = model.kind != BeamKind::Modal;
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            kind: match model.kind {
                BeamKind::Lumped => BeamKindName::Lumped,
                BeamKind::Distributed => BeamKindName::Distributed,
                BeamKind::Modal => BeamKindName::Modal,
            },
            n: model.len(),
            length_m: dimensions.then(|| model.length_m()),
            hub_radius_m: dimensions.then_some(model.hub_radius_m),
            mass_kg: model.mass_kg.clone(),
            mass_along_kg: model.mass_along_kg,
            position_m: model.position_m.clone(),
            payload: dimensions.then(|| TipPayloadEntry::of(&model.payload)),
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
            modes: each(model.modes.as_deref(), ModeShapeEntry::of),
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

/// The entries of a list, where there is one.
fn each<T, E>(list: Option<&[T]>, entry: impl Fn(&T) -> E) -> Option<Vec<E>> {
    list.map(|list| list.iter().map(entry).collect())
}

impl TipPayloadEntry {
    fn of(payload: &Payload) -> Self {
        Self {
            mass_kg: payload.mass_kg,
            inertia_kg_m2: payload.inertia_kg_m2,
            offset_m: payload.offset_m,
        }
    }
}

impl ModeShapeEntry {
    fn of(m: &Mode) -> Self {
        Self {
            natural_frequency_rad_s: m.natural_frequency_rad_s,
            shape: m.shape.clone(),
            share: m.share.clone(),
            inertia_kg_m2: m.inertia_kg_m2,
        }
    }
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
        let each = |z: &Complex64| Self {
            s_squared: ComplexEntry::of(*z),
            class: RootClassName::of(class(*z)),
        };
        found.z.iter().map(each).collect()
    }
}

impl RootClassName {
    /// The name of a class.
    pub fn of(class: RootClass) -> Self {
        match class {
            RootClass::Imaginary => Self::A,
            RootClass::Real => Self::B,
            RootClass::Quadruple => Self::C,
        }
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
            // With zeros not looked for, only one that is found can tell.
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
