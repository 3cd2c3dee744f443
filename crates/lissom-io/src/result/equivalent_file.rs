//! The equivalent arm in JSON, in `result.json` and by itself.

use lissom_core::Matrix;
use lissom_core::identify::{
    Deviations, Equivalent, EquivalentArm, Estimate, ResponseZero, Spurious, StrainlessForm,
};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use super::estimate_keys::{Estimated, Refusable};
use super::finding_entry::FindingEntry;
use super::unit_keys::{
    CouplingKey, InertiaKey, MotorTorqueKey, PointTorqueKey, ViscousKey, WithUnit,
};
use super::unit_names::UnitNames;
use crate::model::{RootClassName, StateSpaceEntry, matrix_rows};

/// SI units. The suffix of a key is its unit, as in result.schema.json. Rows and columns are the arm's points, in the
/// order of `points`. An estimate carries its standard error and its 95 % interval, from the covariance of the fit to
/// first order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentFile {
    /// Version that wrote the file.
    pub lissom: String,
    /// The arm.
    pub equivalent: EquivalentEntry,
    /// What the data do not allow.
    pub findings: Vec<FindingEntry>,
}

/// The lumped arm that behaves as the beam measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentEntry {
    /// Names of the points that are in the arm, as many as modes.
    pub points: Vec<String>,
    /// Modes with the motor clamped, ascending.
    pub modes: Vec<EquivalentModeEntry>,
    /// Poles fitted that are no modes: they correct the model's edges, or stand for noise.
    pub spurious_poles: Vec<SpuriousPoleEntry>,
    /// (17) as fitted.
    pub beam: EquivalentBeamEntry,
    /// (18) and (14) as fitted; null without a motor's response that holds them.
    pub torque: Option<EquivalentTorqueEntry>,
    /// (17)-(18) for use as an arm; null where a point is no angle (finding equivalent-no-angle).
    pub strainless: Option<StrainlessEntry>,
    /// The form for use, from the command to the motor's angle and those of the points: in the modes' own coordinates,
    /// with their damping where it is above zero; null without a motor's response, and where a point is no angle
    /// (finding equivalent-no-angle).
    pub state_space: Option<StateSpaceEntry>,
    /// Of every point measured, with the modes of the arm.
    pub zeros: Vec<PointZerosEntry>,
    /// Lowest frequency measured.
    pub lowest_rad_s: f64,
    /// Highest frequency measured.
    pub highest_rad_s: f64,
    /// Residual of the points' responses relative to their standard errors: one where the model is as good as the
    /// data; null where these are not known.
    pub weighted_rms: Option<f64>,
    /// Residual relative to each response, rms.
    pub relative_residual: f64,
    /// Where the standard errors of the responses are from.
    pub deviations: DeviationsName,
}

/// A mode of the equivalent arm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EquivalentModeEntry {
    /// Natural frequency.
    pub natural_frequency_rad_s: EstimateEntry,
    /// Damping ratio of the fit; (17) has none.
    pub damping_ratio: EstimateEntry,
    /// The mode's part of each point's angle per motor angle at rest.
    pub static_gains: Vec<EstimateEntry>,
    /// c_k of C_t/theta_m = sum of c_k*s^2/(s^2 + omega_k^2).
    #[serde(flatten)]
    pub coupling: Refusable<CouplingKey>,
}

/// A pole that is no mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SpuriousPoleEntry {
    /// Its natural frequency.
    pub natural_frequency_rad_s: f64,
    /// Its damping ratio.
    pub damping_ratio: f64,
    /// Why it is no mode.
    pub why: SpuriousName,
}

/// Why a pole is no mode.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SpuriousName {
    /// Outside the frequencies measured.
    Outside,
    /// Damped by more than 0.25 or negatively.
    Damped,
    /// No point shows it by four standard errors.
    Unfelt,
}

/// (17): second derivatives of the points' angles from these and the motor's.
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
    #[serde(flatten)]
    pub h: WithUnit<PointTorqueKey, Vec<EstimateEntry>>,
    /// h_{n+1} of (18), the sum of the modes' couplings.
    #[serde(flatten)]
    pub h_motor: Estimated<MotorTorqueKey>,
    /// J, with what the modes left out carry.
    #[serde(flatten)]
    pub inertia: Estimated<InertiaKey>,
    /// V, back-EMF included.
    #[serde(flatten)]
    pub viscous: Estimated<ViscousKey>,
    /// By how much the motor comes later than the command; null where its response does not call for that.
    pub delay_s: Option<EstimateEntry>,
    /// Residual of the motor's response relative to its standard errors; null where these are not known.
    pub weighted_rms: Option<f64>,
}

/// (17)-(18) for use as an arm: turning as one body strains nothing, A*1 + B = 0 and H*1 + h = 0.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StrainlessEntry {
    /// A of (17).
    pub a_per_s2: Vec<Vec<f64>>,
    /// B of (17).
    pub b_per_s2: Vec<f64>,
    /// H of (18); null without a motor's response.
    #[serde(flatten)]
    pub h: WithUnit<PointTorqueKey, Option<Vec<f64>>>,
    /// h_{n+1} of (18); null without a motor's response.
    #[serde(flatten)]
    pub h_motor: WithUnit<MotorTorqueKey, Option<f64>>,
    /// What each point's gains, as fitted, lack of one.
    pub missing: Vec<f64>,
    /// Whether the data say that a point lacks it: its last mode is then given all of it, otherwise all its modes by
    /// their standard errors.
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
    pub class: RootClassName,
    /// Real part of the root in the first quadrant.
    pub re_rad_s: f64,
    /// Imaginary part of the root in the first quadrant.
    pub im_rad_s: f64,
    /// Its magnitude.
    pub magnitude_rad_s: EstimateEntry,
    /// Beyond the frequencies measured: modes left out may move it anywhere.
    pub outside: bool,
}

/// Where standard errors of responses are from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DeviationsName {
    /// They are measured.
    Measured,
    /// Measured, but no less than 0.2 % of the response (campaigns).
    Floored,
    /// Not known, and taken from the residual.
    FromResidual,
}

impl EquivalentFile {
    /// What `lissom equivalent` writes.
    pub fn of(names: UnitNames, found: &Equivalent) -> Self {
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            equivalent: EquivalentEntry::of(names, found),
            findings: FindingEntry::list(&found.findings),
        }
    }
}

impl EquivalentEntry {
    /// The arm alone.
    pub fn of(names: UnitNames, found: &Equivalent) -> Self {
        let point = |i: usize| found.names[i].as_str();
        let known = found.deviations != Deviations::FromResidual;
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
            deviations: match found.deviations {
                Deviations::Measured => DeviationsName::Measured,
                Deviations::Floored => DeviationsName::Floored,
                Deviations::FromResidual => DeviationsName::FromResidual,
            },
        }
    }
}

impl EquivalentModeEntry {
    fn list(names: UnitNames, found: &Equivalent) -> Vec<Self> {
        let kept = &found.kept;
        let gain = |k| move |i| EstimateEntry::of(kept.static_gain(i, k));
        let mode = |k: usize| {
            let coupling = found.arm.as_ref().map(|arm| arm.coupling[k]);
            Self {
                natural_frequency_rad_s: EstimateEntry::of(kept.natural_frequency_rad_s(k)),
                damping_ratio: EstimateEntry::of(kept.damping_ratio(k)),
                static_gains: (0..found.points.len()).map(gain(k)).collect(),
                coupling: WithUnit::new(names, EstimateEntry::or_null(coupling)),
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
                why: match (*why)? {
                    Spurious::Outside => SpuriousName::Outside,
                    Spurious::Damped => SpuriousName::Damped,
                    Spurious::Unfelt => SpuriousName::Unfelt,
                },
            })
        });
        spurious.collect()
    }
}

impl EquivalentTorqueEntry {
    fn of(names: UnitNames, deviations_known: bool, arm: &EquivalentArm) -> Self {
        Self {
            h: WithUnit::new(names, EstimateEntry::list(arm.h.iter())),
            h_motor: WithUnit::new(names, EstimateEntry::of(arm.h_motor)),
            inertia: WithUnit::new(names, EstimateEntry::of(arm.inertia)),
            viscous: WithUnit::new(names, EstimateEntry::of(arm.viscous)),
            delay_s: EstimateEntry::or_null(arm.delay_s),
            weighted_rms: deviations_known.then_some(arm.weighted_rms),
        }
    }
}

impl StrainlessEntry {
    fn of(names: UnitNames, torque_known: bool, form: &StrainlessForm) -> Self {
        let h = torque_known.then(|| form.h.as_slice().to_vec());
        Self {
            a_per_s2: matrix_rows(&form.a),
            b_per_s2: form.b.as_slice().to_vec(),
            h: WithUnit::new(names, h),
            h_motor: WithUnit::new(names, torque_known.then_some(form.h_motor)),
            missing: form.missing.as_slice().to_vec(),
            given_to_last_mode: form.given_to_last.clone(),
        }
    }
}

impl ResponseZeroEntry {
    fn of(zero: &ResponseZero) -> Self {
        let s = zero.square.sqrt();
        Self {
            class: RootClassName::of(zero.class),
            re_rad_s: s.re,
            im_rad_s: s.im,
            magnitude_rad_s: EstimateEntry::of(zero.omega_rad_s),
            outside: zero.outside,
        }
    }
}

fn estimates(value: &Matrix, std: &Matrix) -> Vec<Vec<EstimateEntry>> {
    let one = |i, j| EstimateEntry::of(Estimate { value: value[(i, j)], std: std[(i, j)] });
    (0..value.nrows()).map(|i| (0..value.ncols()).map(|j| one(i, j)).collect()).collect()
}

fn column(value: &[f64], std: &[f64]) -> Vec<EstimateEntry> {
    let each = value.iter().zip(std);
    each.map(|(&value, &std)| EstimateEntry::of(Estimate { value, std })).collect()
}
