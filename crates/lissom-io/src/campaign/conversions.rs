//! Columns of a log in SI.

use std::f64::consts::{PI, TAU};

use super::campaign_signals::{Reading, TimeSource};
use crate::config::MAGNITUDE;
use crate::log::{Log, LogError};

/// Largest magnitude of a sample in SI.
const LARGEST: f64 = MAGNITUDE.1;

/// The times of the samples of a log \[s\]: its stamps, or multiples of the sample time.
pub(super) fn stamps_s(source: &TimeSource, log: &mut Log) -> Vec<f64> {
    match source {
        TimeSource::Stamps(_, unit_s) => {
            let stamps = log.time.take().unwrap_or_default();
            stamps.into_iter().map(|stamp| stamp * unit_s).collect()
        }
        TimeSource::Steps(sample_time_s) => {
            let step_s = sample_time_s * log.factor as f64;
            let samples = log.columns.first().map_or(0, Vec::len);
            (0..samples).map(|k| k as f64 * step_s).collect()
        }
    }
}

/// Refuses samples that are too large.
pub(super) fn channel_in_range(channel: &str, samples: &[f64], file: &str) -> Result<(), LogError> {
    match samples.iter().position(|v| !v.is_finite() || v.abs() > LARGEST) {
        None => Ok(()),
        Some(k) => Err(LogError::OutOfRange {
            file: file.to_owned(),
            channel: channel.to_owned(),
            sample: k + 1,
            largest: LARGEST,
        }),
    }
}

/// A column in SI.
pub(super) fn in_si(mut column: Vec<f64>, reading: &Reading) -> Vec<f64> {
    for value in &mut column {
        *value = *value * reading.gain + reading.offset;
    }
    column
}

/// Angle of the radius from the origin to a point, unwrapped at ±π.
pub(super) fn camera_angle(x: &[f64], y: &[f64], origin: [f64; 2], scale: f64) -> Vec<f64> {
    let mut turns = 0.0;
    let mut last: Option<f64> = None;
    x.iter()
        .zip(y)
        .map(|(x, y)| {
            let angle = (y - origin[1]).atan2(x - origin[0]);
            if let Some(last) = last {
                if angle - last > PI {
                    turns -= TAU;
                } else if angle - last < -PI {
                    turns += TAU;
                }
            }
            last = Some(angle);
            scale * (angle + turns)
        })
        .collect()
}
