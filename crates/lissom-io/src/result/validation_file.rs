//! How well a result predicts another log, in JSON.

use lissom_core::identify::{
    Cause, ChannelResidual, FoundArm, Horizon, MovedBy, MovedMode, TorquePrediction, TorqueStretch,
    Validation,
};
use lissom_core::record::{Axis, Campaign, Channels, TipQuantity};
use serde::{Deserialize, Serialize};

use super::arm_entry::ArmEntry;
use super::channel_names::DirectionName;
use super::estimate_entry::NumberEntry;
use super::finding_entry::FindingEntry;
use super::unit_names::UnitNames;

/// SI units. The suffix of a key is its unit, as in result.schema.json. Shares are from 0 to 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ValidationFile {
    /// Version of lissom that wrote the file.
    pub lissom: String,
    /// Kind of axis.
    pub axis: Axis,
    /// The arm of the result.
    pub arm: ArmEntry,
    /// Torque (or force) that the estimates predict from the logged motion, compared with the logged one; null if the
    /// tips do not give the coupling torque.
    pub torque: Option<TorqueEntry>,
    /// Motion that the estimates predict from the logged command.
    pub motion: MotionEntry,
    /// Residuals of each channel: measured minus predicted motion, minus the mean of each stretch.
    pub residuals: Vec<ChannelResidualEntry>,
    /// Findings about the estimates.
    pub findings: Vec<FindingEntry>,
}

/// The predicted torque compared with the logged one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TorqueEntry {
    /// |logged - predicted|/|logged|, with root sums of squares over all rows used.
    pub relative_error: f64,
    /// The same for the logs of the result.
    pub relative_error_of_logs_used: Option<f64>,
    /// The error that is expected if the arm is correct: that of the same computation with a simulation of the arm and
    /// its sensors; null if the simulation does not follow the log for the length of a window.
    pub relative_error_expected: Option<f64>,
    /// The same while the motor moves forward.
    pub relative_error_forward: Option<f64>,
    /// The same while the motor moves backward.
    pub relative_error_backward: Option<f64>,
    /// Root mean square of the logged torque.
    pub logged_rms: NumberEntry,
    /// Length of the sin^4 window with which both torques are averaged.
    pub window_s: f64,
    /// Frequency at which the window passes half of the power.
    pub half_power_hz: f64,
    /// Share of the time in which the motor rests or a sensor is at a limit of its range, and which is not used.
    pub rest_share: f64,
    /// The torque of each run.
    pub runs: Vec<TorqueRunEntry>,
    /// Each stretch in which the motor moves in one direction for three windows or longer.
    pub stretches: Vec<StretchEntry>,
    /// Terms that the residual resembles, the one with the largest share first.
    pub residual_terms: Vec<Cause>,
}

/// The torque of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TorqueRunEntry {
    /// Its name.
    pub run: String,
    /// Error relative to the torque of the run.
    pub relative_error: Option<f64>,
}

/// The torque of a stretch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StretchEntry {
    /// Its run.
    pub run: String,
    /// Its start, from the run's first sample.
    pub start_s: f64,
    /// Its end.
    pub end_s: f64,
    /// Direction of motion.
    pub direction: DirectionName,
    /// Root mean square of the residual relative to that of the torque of the whole log.
    pub relative_error: f64,
}

/// Motion predicted from the logged command.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MotionEntry {
    /// Predictions over shorter and shorter times, each from its own initial state.
    pub horizons: Vec<HorizonEntry>,
    /// Index of the horizon of the residuals: the longest one over which all channels fit 90 %, otherwise the shortest.
    pub chosen: Option<usize>,
    /// The mode for which another frequency explains most of the residual; null if a change of 0.3 % or more does not
    /// remove half of the squared residual, or if no tip has a residual above the noise of its sensor.
    pub moved_mode: Option<MovedModeEntry>,
}

/// Motion predicted over times of one length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HorizonEntry {
    /// Length of the horizon.
    pub length_s: f64,
    /// Whether whole runs are predicted.
    pub whole_runs: bool,
    /// Number of predicted stretches.
    pub windows: usize,
    /// How well each channel is predicted.
    pub channels: Vec<ChannelFitEntry>,
}

/// How well a channel is predicted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChannelFitEntry {
    /// motor, or a tip's name.
    pub channel: String,
    /// Its unit.
    pub unit: ChannelUnitName,
    /// Root mean square of measured minus predicted.
    pub residual_rms: f64,
    /// 100*(1 - |y - predicted|/|y - mean of y|).
    pub fit_percent: f64,
}

/// Unit of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ChannelUnitName {
    /// An angle.
    #[serde(rename = "rad")]
    Angle,
    /// A position.
    #[serde(rename = "m")]
    Position,
    /// An angular acceleration.
    #[serde(rename = "rad/s²")]
    AngularAcceleration,
    /// An acceleration.
    #[serde(rename = "m/s²")]
    Acceleration,
    /// Unknown.
    #[serde(rename = "1")]
    Unknown,
}

/// A mode that has another frequency in the log.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MovedModeEntry {
    /// Number of the mode, from 1.
    pub mode: usize,
    /// Cause of the change.
    pub by: MovedBy,
    /// Its frequency in the result.
    pub natural_frequency_rad_s: f64,
    /// Its frequency that fits the log best.
    pub of_log_rad_s: f64,
    /// Squared residual of all channels relative to that of the result's arm.
    pub residual_ratio: f64,
}

/// The residual of a channel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ChannelResidualEntry {
    /// motor, or a tip's name.
    pub channel: String,
    /// Its unit.
    pub unit: ChannelUnitName,
    /// Its tests.
    #[serde(flatten)]
    pub tests: ChannelResidual,
    /// Lags of the residual behind the command, in samples.
    pub lags: Vec<isize>,
    /// Share of these lags outside the band.
    pub outside_share: f64,
}

impl ValidationFile {
    /// The content that `lissom validate` writes.
    pub fn of(campaign: &Campaign, found: &FoundArm, v: &Validation) -> Self {
        let channels = &campaign.channels;
        let names = UnitNames::new(channels);
        let residual = |(c, r)| ChannelResidualEntry::of(channels, c, r);
        Self {
            lissom: env!("CARGO_PKG_VERSION").to_owned(),
            axis: channels.axis,
            arm: ArmEntry::of(channels, names, found),
            torque: v.torque.as_ref().map(|t| TorqueEntry::of(campaign, names, found, t)),
            motion: MotionEntry {
                horizons: v.horizons.iter().map(|h| HorizonEntry::of(channels, h)).collect(),
                chosen: if v.horizons.is_empty() { None } else { Some(v.chosen) },
                moved_mode: v.moved_mode.as_ref().map(MovedModeEntry::of),
            },
            residuals: v.residuals.iter().enumerate().map(residual).collect(),
            findings: FindingEntry::list(&v.findings),
        }
    }
}

impl TorqueEntry {
    fn of(campaign: &Campaign, names: UnitNames, found: &FoundArm, t: &TorquePrediction) -> Self {
        let name = |run: usize| campaign.runs[run].name().to_owned();
        let stretch = |s: &TorqueStretch| StretchEntry {
            run: name(s.run),
            start_s: s.start_s,
            end_s: s.end_s,
            direction: DirectionName::of(s.forward),
            relative_error: s.relative_error,
        };
        let runs = t
            .runs
            .iter()
            .map(|r| TorqueRunEntry { run: name(r.run), relative_error: r.relative_error });
        Self {
            relative_error: t.relative_error,
            relative_error_of_logs_used: found.torque_used.map(|t| t.relative_error),
            relative_error_expected: t.expected_error,
            relative_error_forward: t.by_direction[0],
            relative_error_backward: t.by_direction[1],
            logged_rms: NumberEntry::of(t.logged_nm, names.torque_unit()),
            window_s: t.window_s,
            half_power_hz: t.half_power_hz,
            rest_share: t.rest_share,
            runs: runs.collect(),
            stretches: t.stretches.iter().map(stretch).collect(),
            residual_terms: t.causes.clone(),
        }
    }
}

impl MovedModeEntry {
    fn of(m: &MovedMode) -> Self {
        Self {
            mode: m.mode + 1,
            by: m.by,
            natural_frequency_rad_s: m.omega_rad_s,
            of_log_rad_s: m.of_log_rad_s,
            residual_ratio: m.residual_ratio,
        }
    }
}

impl HorizonEntry {
    fn of(channels: &Channels, h: &Horizon) -> Self {
        let fits = h.channels.iter().enumerate().map(|(c, f)| ChannelFitEntry {
            channel: channel_name_unit(channels, c).0.to_owned(),
            unit: ChannelUnitName::of(channels, c),
            residual_rms: f.residual_rms,
            fit_percent: f.fit_percent,
        });
        Self {
            length_s: h.length_s,
            whole_runs: h.whole_runs,
            windows: h.windows,
            channels: fits.collect(),
        }
    }
}

impl ChannelResidualEntry {
    fn of(channels: &Channels, channel: usize, r: &ChannelResidual) -> Self {
        Self {
            channel: channel_name_unit(channels, channel).0.to_owned(),
            unit: ChannelUnitName::of(channels, channel),
            tests: r.clone(),
            lags: r.lags(),
            outside_share: r.outside(),
        }
    }
}

impl ChannelUnitName {
    fn of(channels: &Channels, channel: usize) -> Self {
        let (angle, acceleration) = match channels.axis {
            Axis::Rotary => (Self::Angle, Self::AngularAcceleration),
            Axis::Linear => (Self::Position, Self::Acceleration),
        };
        let Some(tip) = channel.checked_sub(1).map(|i| &channels.tips[i]) else { return angle };
        match (tip.calibrated, tip.quantity) {
            (false, _) => Self::Unknown,
            (true, TipQuantity::Acceleration) => acceleration,
            (true, _) => angle,
        }
    }

    /// The unit in words.
    fn text(self) -> &'static str {
        match self {
            Self::Angle => "rad",
            Self::Position => "m",
            Self::AngularAcceleration => "rad/s²",
            Self::Acceleration => "m/s²",
            Self::Unknown => "1",
        }
    }
}

/// Name and unit of a channel; channel 0 is the motor, then tips follow.
pub fn channel_name_unit(channels: &Channels, channel: usize) -> (&str, &'static str) {
    let tip = channel.checked_sub(1).map(|i| &channels.tips[i]);
    let name = tip.map_or("motor", |tip| &tip.name);
    (name, ChannelUnitName::of(channels, channel).text())
}
