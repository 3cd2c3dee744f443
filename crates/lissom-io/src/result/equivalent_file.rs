//! The equivalent arm in JSON, in `result.json` and in a file of its own.

use lissom_core::Matrix;
use lissom_core::beam::RootClass;
use lissom_core::identify::{
    Equivalent, EquivalentArm, Estimate, ResponseZero, Spurious, StdSource, StrainlessForm,
};
use serde::{Deserialize, Serialize};

use super::estimate_entry::{EstimateEntry, NumberEntry};
use super::finding_entry::FindingEntry;
use super::unit_names::UnitNames;
use crate::model::{StateSpaceEntry, matrix_rows};

/// Unit of A and B of (17).
const PER_S2: &str = "1/s²";

/// SI units. The suffix of a key is its unit, as in result.schema.json. Rows and columns are the points of the arm, in
/// the order of `points`. An estimate has its standard error and its 95 % interval, from the covariance of the fit to
/// first order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// The arm.
    pub equivalent: EquivalentEntry,
    /// Findings about the data.
    pub findings: Vec<FindingEntry>,
}

/// The lumped arm that behaves as the measured beam does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentEntry {
    /// Names of the points that are in the arm, as many as modes.
    pub points: Vec<String>,
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<EquivalentModeEntry>,
    /// Fitted poles that are not modes: they correct the model at its limits, or follow noise.
    pub spurious_poles: Vec<SpuriousPoleEntry>,
    /// (17) as fitted.
    pub beam: EquivalentBeamEntry,
    /// (18) and (14) as fitted; null without a usable response of the motor.
    pub torque: Option<EquivalentTorqueEntry>,
    /// (17)-(18) for use as an arm; null if a point is not an angle (finding equivalent-gains).
    pub strainless: Option<StrainlessEntry>,
    /// The form for use, from the command to the angles of motor and points, in coordinates of the modes, with their
    /// damping if it is above zero; null without a motor's response, and if a point is not an angle (finding
    /// equivalent-gains).
    pub state_space: Option<StateSpaceEntry>,
    /// Zeros of every measured point, with the modes of the arm.
    pub zeros: Vec<PointZerosEntry>,
    /// Lowest measured frequency.
    pub lowest_rad_s: f64,
    /// Highest measured frequency.
    pub highest_rad_s: f64,
    /// Residual of the responses of the points relative to their standard errors: one if the model is as good as the
    /// data; null if these are unknown.
    pub weighted_rms: Option<f64>,
    /// Residual relative to each response, rms.
    pub relative_residual: f64,
    /// Origin of the standard errors of the responses.
    pub std_source: StdSource,
}

/// A mode of the equivalent arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentModeEntry {
    /// Natural frequency.
    pub natural_frequency_rad_s: EstimateEntry,
    /// Damping ratio of the fit; (17) has none.
    pub damping_ratio: EstimateEntry,
    /// Share of the mode in the angle of each point per motor angle at frequency zero.
    pub static_gains: Vec<EstimateEntry>,
    /// c_k of C_t/theta_m = sum of c_k*s^2/(s^2 + omega_k^2).
    pub coupling: Option<EstimateEntry>,
}

/// A pole that is not a mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SpuriousPoleEntry {
    /// Its natural frequency.
    pub natural_frequency_rad_s: f64,
    /// Its damping ratio.
    pub damping_ratio: f64,
    /// Why it is not a mode.
    pub why: Spurious,
}

/// (17): second derivatives of the angles of the points, from these angles and the motor's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentBeamEntry {
    /// A of (17).
    pub a_per_s2: Vec<Vec<EstimateEntry>>,
    /// B of (17).
    pub b_per_s2: Vec<EstimateEntry>,
}

/// (18) and (14) as fitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentTorqueEntry {
    /// H of (18).
    pub h: Vec<EstimateEntry>,
    /// h_{n+1} of (18), the sum of the modes' couplings.
    pub h_motor: EstimateEntry,
    /// J, including the inertia of the omitted modes.
    pub inertia: EstimateEntry,
    /// V, including back-EMF.
    pub viscous: EstimateEntry,
    /// Delay of the motor after the command; null if its response does not show one.
    pub delay_s: Option<EstimateEntry>,
    /// Residual of the motor's response relative to its standard errors; null if these are unknown.
    pub weighted_rms: Option<f64>,
}

/// (17)-(18) for use as an arm: turning the whole arm bends nothing, A*1 + B = 0 and H*1 + h = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StrainlessEntry {
    /// A of (17).
    pub a_per_s2: Vec<Vec<f64>>,
    /// B of (17).
    pub b_per_s2: Vec<f64>,
    /// H of (18); null without a motor's response.
    pub h: Option<NumberEntry<Vec<f64>>>,
    /// h_{n+1} of (18); null without a motor's response.
    pub h_motor: Option<NumberEntry>,
    /// One minus the sum of the fitted gains of each point.
    pub missing: Vec<f64>,
    /// Whether `missing` is significant for a point. Its last mode then gets all of it; otherwise all its modes share
    /// it by their standard errors.
    pub given_to_last_mode: Vec<bool>,
}

/// Zeros of a point's response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PointZerosEntry {
    /// Name of the point.
    pub point: String,
    /// Its zeros.
    pub zeros: Vec<ResponseZeroEntry>,
}

/// A zero of a response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResponseZeroEntry {
    /// Its class.
    pub class: RootClass,
    /// Real part of the root in the first quadrant.
    pub re_rad_s: f64,
    /// Imaginary part of the root in the first quadrant.
    pub im_rad_s: f64,
    /// Its magnitude.
    pub magnitude_rad_s: EstimateEntry,
    /// Whether it is outside the measured frequencies, so that omitted modes may change it.
    pub outside: bool,
}

impl EquivalentFile {
    /// The content that `lissom equivalent` writes.
    pub fn of(names: UnitNames, found: &Equivalent) -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            equivalent: EquivalentEntry::of(names, found),
            findings: FindingEntry::list(&found.findings),
        }
    }
}

impl EquivalentEntry {
    /// The entry of an equivalent arm.
    pub fn of(names: UnitNames, found: &Equivalent) -> Self {
        let point = |i: usize| found.names[i].as_str();
        let known = found.std_source != StdSource::FromResidual;
        let arm = found.arm.as_ref();
        let state_space = arm.filter(|_| found.strainless.is_some()).map(|arm| {
            let points: Vec<&str> = found.points.iter().map(|i| point(*i)).collect();
            StateSpaceEntry::of(&arm.state_space(&points, names.angle()))
        });
        let zeros = found.zeros.iter().enumerate().map(|(i, zeros)| PointZerosEntry {
            point: point(i).to_owned(),
            zeros: zeros.iter().map(ResponseZeroEntry::of).collect(),
        });
        let form = found.strainless.as_ref();
        Self {
            points: found.points.iter().map(|i| point(*i).to_owned()).collect(),
            modes: EquivalentModeEntry::list(names, found),
            spurious_poles: SpuriousPoleEntry::list(found),
            beam: EquivalentBeamEntry {
                a_per_s2: estimates(&found.beam.a, &found.beam.a_std),
                b_per_s2: column(found.beam.b.as_slice(), found.beam.b_std.as_slice()),
            },
            torque: arm.map(|arm| EquivalentTorqueEntry::of(names, known, arm)),
            strainless: form.map(|form| StrainlessEntry::of(names, arm.is_some(), form)),
            state_space,
            zeros: zeros.collect(),
            lowest_rad_s: found.fit.range_rad_s.0,
            highest_rad_s: found.fit.range_rad_s.1,
            weighted_rms: known.then_some(found.fit.weighted_rms),
            relative_residual: found.relative_residual,
            std_source: found.std_source,
        }
    }
}

impl EquivalentModeEntry {
    fn list(names: UnitNames, found: &Equivalent) -> Vec<Self> {
        let kept = &found.kept;
        let gain = |k| move |i| EstimateEntry::of(kept.static_gain(i, k), "1");
        let mode = |k: usize| {
            let coupling = found.arm.as_ref().map(|arm| arm.coupling[k]);
            Self {
                natural_frequency_rad_s: EstimateEntry::of(
                    kept.natural_frequency_rad_s(k),
                    "rad/s",
                ),
                damping_ratio: EstimateEntry::of(kept.damping_ratio(k), "1"),
                static_gains: (0..found.points.len()).map(gain(k)).collect(),
                coupling: EstimateEntry::or_null(coupling, names.coupling_unit()),
            }
        };
        (0..found.modes.len()).map(mode).collect()
    }
}

impl SpuriousPoleEntry {
    fn list(found: &Equivalent) -> Vec<Self> {
        let each = found.fit.poles.iter().zip(&found.spurious);
        let spurious = each.filter_map(|(pole, why)| {
            Some(Self {
                natural_frequency_rad_s: pole.omega_rad_s,
                damping_ratio: pole.damping_ratio,
                why: (*why)?,
            })
        });
        spurious.collect()
    }
}

impl EquivalentTorqueEntry {
    fn of(names: UnitNames, std_known: bool, arm: &EquivalentArm) -> Self {
        Self {
            h: EstimateEntry::list(arm.h.iter(), names.coupling_unit()),
            h_motor: EstimateEntry::of(arm.h_motor, names.coupling_unit()),
            inertia: EstimateEntry::of(arm.inertia, names.inertia_unit()),
            viscous: EstimateEntry::of(arm.viscous, names.viscous_unit()),
            delay_s: EstimateEntry::or_null(arm.delay_s, "s"),
            weighted_rms: std_known.then_some(arm.weighted_rms),
        }
    }
}

impl StrainlessEntry {
    fn of(names: UnitNames, torque_known: bool, form: &StrainlessForm) -> Self {
        let unit = || names.coupling_unit();
        Self {
            a_per_s2: matrix_rows(&form.a),
            b_per_s2: form.b.as_slice().to_vec(),
            h: torque_known.then(|| NumberEntry::of(form.h.as_slice().to_vec(), unit())),
            h_motor: torque_known.then(|| NumberEntry::of(form.h_motor, unit())),
            missing: form.missing.as_slice().to_vec(),
            given_to_last_mode: form.given_to_last.clone(),
        }
    }
}

impl ResponseZeroEntry {
    fn of(zero: &ResponseZero) -> Self {
        let s = zero.square.sqrt();
        Self {
            class: zero.class,
            re_rad_s: s.re,
            im_rad_s: s.im,
            magnitude_rad_s: EstimateEntry::of(zero.omega_rad_s, "rad/s"),
            outside: zero.outside,
        }
    }
}

fn estimates(value: &Matrix, std: &Matrix) -> Vec<Vec<EstimateEntry>> {
    let one = |i, j| EstimateEntry::of(Estimate { value: value[(i, j)], std: std[(i, j)] }, PER_S2);
    (0..value.nrows()).map(|i| (0..value.ncols()).map(|j| one(i, j)).collect()).collect()
}

fn column(value: &[f64], std: &[f64]) -> Vec<EstimateEntry> {
    let each = value.iter().zip(std);
    each.map(|(&value, &std)| EstimateEntry::of(Estimate { value, std }, PER_S2)).collect()
}
