//! Frequency responses and linear models, in JSON.

use lissom_core::identify::{
    Identified, LinearModels, ModelSource, Response, ResponsePoint, TipModel,
};
use lissom_core::lti::{CoefficientCovariance, TransferFunction};
use lissom_core::record::{Channels, Tip, TipQuantity};
use serde::{Deserialize, Serialize};

use super::estimate_entry::EstimateEntry;
use crate::model::StateSpaceEntry;

/// Complex values as parallel lists; null for a point without a value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SeriesEntry {
    /// Real parts.
    pub re: Vec<Option<f64>>,
    /// Imaginary parts.
    pub im: Vec<Option<f64>>,
    /// Standard errors of the complex values, sqrt(E|G^ - G|^2).
    pub std: Vec<Option<f64>>,
}

impl SeriesEntry {
    fn of(points: &[ResponsePoint], get: impl Fn(&ResponsePoint) -> Option<Response>) -> Self {
        let list = |part: fn(&Response) -> f64| -> Vec<Option<f64>> {
            points.iter().map(|p| get(p).map(|r| part(&r))).collect()
        };
        Self { re: list(|r| r.value.re), im: list(|r| r.value.im), std: list(|r| r.std) }
    }
}

/// Frequency responses, one point for each frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FrequencyResponseEntry {
    /// Frequencies.
    pub omega_rad_s: Vec<f64>,
    /// Name of the sinusoidal run; null for a band of broadband motion.
    pub run: Vec<Option<String>>,
    /// Whether a finding affects the corrected point.
    pub flagged: Vec<bool>,
    /// Whether no finding affects the corrected point, the waveform of friction is known from the output-error method,
    /// and the 95 % interval is within 5 % of the point.
    pub vouched_for: Vec<bool>,
    /// Motor angle (or position) per command as measured.
    pub motor_raw: SeriesEntry,
    /// The same with friction removed; null if friction is unknown.
    pub motor_corrected: SeriesEntry,
    /// Response of each tip per motor angle, in the quantity of the tip.
    pub tips: Vec<TipResponseEntry>,
}

/// Response of a tip per motor angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TipResponseEntry {
    /// Its values.
    #[serde(flatten)]
    pub series: SeriesEntry,
    /// Name of the tip.
    pub name: String,
    /// What it measures.
    pub quantity: TipQuantity,
}

impl FrequencyResponseEntry {
    /// The responses of a result.
    pub(crate) fn of(channels: &Channels, id: &Identified) -> Self {
        let points = &id.responses;
        let tip = |(i, tip): (usize, &Tip)| TipResponseEntry {
            series: SeriesEntry::of(points, |p| p.tips.get(i).copied().flatten()),
            name: tip.name.clone(),
            quantity: tip.quantity,
        };
        let run = |p: &ResponsePoint| p.run.map(|r| id.runs[r].name.clone());
        Self {
            omega_rad_s: points.iter().map(|p| p.omega_rad_s).collect(),
            run: points.iter().map(run).collect(),
            flagged: points.iter().map(|p| p.flagged).collect(),
            vouched_for: points.iter().map(ResponsePoint::is_vouched_for).collect(),
            motor_raw: SeriesEntry::of(points, |p| Some(p.motor_raw)),
            motor_corrected: SeriesEntry::of(points, |p| p.motor_corrected),
            tips: channels.tips.iter().enumerate().map(tip).collect(),
        }
    }
}

/// Linear models of drive and beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinearModelEntries {
    /// Origin of the models.
    pub from: ModelSource,
    /// Motor angle per command, without friction and without `motor_delay_s`.
    pub motor: Option<TransferFunction>,
    /// Time by which the command acts later than it is logged; null if the data show no delay.
    pub motor_delay_s: Option<EstimateEntry>,
    /// Covariance matrix of `motor` and `motor_delay_s`, see `covariance` of a tip.
    pub motor_covariance: Option<Vec<Vec<f64>>>,
    /// Tip per motor angle: the angle for a calibrated deflection, the acceleration for an acceleration, the deflection
    /// for a deflection of unknown scale.
    pub tips: Vec<TipModelEntry>,
    /// State space from the command to the motor and each tip that is an angle.
    pub state_space: Option<StateSpaceEntry>,
}

/// Response of a tip per motor angle as a transfer function.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TipModelEntry {
    /// Name of the tip.
    pub name: String,
    /// Numerator, descending powers of s.
    pub num: Vec<f64>,
    /// Denominator, descending powers of s.
    pub den: Vec<f64>,
    /// Time by which the tip is read later than the motor, which is not part of `num` and `den`; null if it was not
    /// searched for.
    pub delay_s: Option<f64>,
    /// Covariance matrix of the coefficients of `num`, then of `den`, then of `delay_s`; null without a covariance of the
    /// whole model.
    pub covariance: Option<Vec<Vec<f64>>>,
}

/// Rows of the covariance of a model; `None` if a number is not finite.
fn covariance_rows(covariance: Option<&CoefficientCovariance>) -> Option<Vec<Vec<f64>>> {
    let rows = covariance?.rows();
    rows.iter().flatten().all(|v| v.is_finite()).then_some(rows)
}

impl LinearModelEntries {
    /// The models of a result.
    pub(crate) fn of(channels: &Channels, models: &LinearModels) -> Self {
        let tip = |(tip, model): (&Tip, &TipModel)| TipModelEntry {
            name: tip.name.clone(),
            num: model.function.num.clone(),
            den: model.function.den.clone(),
            delay_s: model.delay_s,
            covariance: covariance_rows(model.covariance.as_ref()),
        };
        Self {
            from: models.source,
            motor: models.motor.clone(),
            motor_delay_s: EstimateEntry::or_null(models.motor_delay, "s"),
            motor_covariance: covariance_rows(models.motor_covariance.as_ref()),
            tips: channels.tips.iter().zip(&models.tips).map(tip).collect(),
            state_space: models.state_space.as_ref().map(StateSpaceEntry::of),
        }
    }
}
