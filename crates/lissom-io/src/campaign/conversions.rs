//! Columns of a log in SI.

use std::f64::consts::{PI, TAU};

use super::campaign_signals::Reading;

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
