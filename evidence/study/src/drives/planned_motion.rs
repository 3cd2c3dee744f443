//! The reference motions of a drive.

use std::f64::consts::{PI, TAU};

use lissom::rig::{Drive, Experiment, Reference, RigError, Settle, Table, TableHold};
use serde::Serialize;

use crate::draw::Draw;

/// Length of a run \[s\].
const RUN_S: (f64, f64) = (10.0, 40.0);
/// Largest number of rows of all runs together.
const ROWS_MOST: f64 = 80_000.0;
/// Frequency about which a run moves \[Hz\].
const PACE_HZ: (f64, f64) = (0.1, 1.5);
/// Largest angle of a motion that turns back often \[rad\].
const TRAVEL_RAD: (f64, f64) = (0.3, 8.0);
/// Speed of a long stroke \[rad/s\].
const STROKE_RAD_S: (f64, f64) = (1.0, 30.0);
/// A move is faster than this share of the peak speed.
const MOVES: f64 = 0.1;
/// Share of the largest accelerations and speeds that the plan ignores.
const BEYOND: f64 = 0.01;

/// The kind of motion of the runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MotionKind {
    /// A sum of several sines.
    Multisine,
    /// From point to point, with rests between.
    PointToPoint,
    /// Few long strokes.
    Strokes,
}

/// The reference of a run.
#[derive(Debug, Clone)]
pub(crate) struct PlannedMotion {
    pub(crate) kind: MotionKind,
    /// Time between two of the points \[s\].
    pub(crate) step_s: f64,
    pub(crate) angle_rad: Vec<f64>,
}

/// The references of a campaign's runs for rows every `row_s`, with points every `step_s`.
pub(crate) fn motions(
    draw: &mut Draw,
    few_strokes: bool,
    row_s: f64,
    step_s: f64,
) -> Vec<PlannedMotion> {
    let kind = match (few_strokes, draw.chance(0.5)) {
        (true, _) => MotionKind::Strokes,
        (false, true) => MotionKind::Multisine,
        (false, false) => MotionKind::PointToPoint,
    };
    // Few strokes are few in all runs together.
    let runs = if few_strokes { draw.whole(1, 2) } else { draw.whole(1, 4) };
    let most_s = ROWS_MOST * row_s / f64::from(runs);
    let scale = match kind {
        MotionKind::Strokes => draw.decade(STROKE_RAD_S.0, STROKE_RAD_S.1),
        _ => draw.decade(TRAVEL_RAD.0, TRAVEL_RAD.1),
    };
    let pace_hz = draw.decade(PACE_HZ.0, PACE_HZ.1);
    let one = |_| {
        let length_s = draw.uniform(RUN_S.0, RUN_S.1).min(most_s);
        let size = scale * draw.uniform(0.5, 1.0);
        let points = (length_s / step_s).floor() as usize + 1;
        let angle_rad = match kind {
            MotionKind::Multisine => multisine(draw, points, step_s, size, pace_hz),
            MotionKind::PointToPoint => point_to_point(draw, points, step_s, size, pace_hz),
            MotionKind::Strokes => strokes(draw, points, step_s, size),
        };
        PlannedMotion { kind, step_s, angle_rad }
    };
    (0..runs).map(one).collect()
}

impl PlannedMotion {
    pub(crate) fn experiment(&self) -> Result<Experiment, RigError> {
        let time_s: Vec<f64> = (0..self.angle_rad.len()).map(|k| k as f64 * self.step_s).collect();
        let record_s = time_s[time_s.len() - 1];
        let table = Table::new(time_s, self.angle_rad.clone(), TableHold::Linear)?;
        let drive = Drive::Angle(Reference::Table(table));
        Ok(Experiment::new(drive, record_s)?.settling(Settle::AtOnce))
    }

    /// Speeds of the reference \[rad/s\].
    fn speeds(&self) -> Vec<f64> {
        self.angle_rad.windows(2).map(|w| (w[1] - w[0]) / self.step_s).collect()
    }

    /// Peak speed \[rad/s\] and peak acceleration \[rad/s²\], a hundredth of the time left out.
    pub(crate) fn peaks(&self) -> [f64; 2] {
        let speeds = self.speeds();
        let accelerations: Vec<f64> =
            speeds.windows(2).map(|w| (w[1] - w[0]).abs() / self.step_s).collect();
        let speeds: Vec<f64> = speeds.iter().map(|v| v.abs()).collect();
        let peak = |values: &[f64]| crate::statistics::quantile(values, 1.0 - BEYOND);
        [&speeds, &accelerations].map(|values| peak(values).unwrap_or(0.0))
    }

    /// Number of stretches in one direction.
    pub(crate) fn moves(&self) -> usize {
        let least = MOVES * self.peaks()[0];
        let way = |v: &f64| (v.abs() > least).then_some(*v > 0.0);
        let ways: Vec<Option<bool>> = self.speeds().iter().map(way).collect();
        1 + ways.windows(2).filter(|w| w[0] != w[1] && w[1].is_some()).count()
    }

    /// From the lowest to the highest angle \[rad\].
    pub(crate) fn travel_rad(&self) -> f64 {
        let ends =
            self.angle_rad.iter().fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(*a), h.max(*a)));
        ends.1 - ends.0
    }
}

/// Sines of random frequencies about `pace_hz`, which grow from zero within a period.
fn multisine(draw: &mut Draw, points: usize, step_s: f64, size: f64, pace_hz: f64) -> Vec<f64> {
    let count = draw.whole(3, 6);
    let lines: Vec<[f64; 3]> = (0..count)
        .map(|_| {
            let omega = TAU * pace_hz * draw.decade(0.4, 2.5);
            [omega, draw.uniform(0.3, 1.0) / omega.powf(0.7), draw.uniform(0.0, TAU)]
        })
        .collect();
    let at = |t: f64| -> f64 {
        let grows = 0.5 - 0.5 * (PI * (t * pace_hz).min(1.0)).cos();
        grows * lines.iter().map(|[w, a, p]| a * ((w * t + p).sin() - p.sin())).sum::<f64>()
    };
    let raw: Vec<f64> = (0..points).map(|k| at(k as f64 * step_s)).collect();
    let most = raw.iter().fold(f64::MIN_POSITIVE, |m, a| m.max(a.abs()));
    raw.into_iter().map(|a| size * a / most).collect()
}

/// Moves of least jerk between random points, with rests.
fn point_to_point(
    draw: &mut Draw,
    points: usize,
    step_s: f64,
    size: f64,
    pace_hz: f64,
) -> Vec<f64> {
    let mut angle = vec![0.0];
    while angle.len() < points {
        let from = angle[angle.len() - 1];
        // Far enough from the present point.
        let to = loop {
            let to = draw.uniform(-size, size);
            if (to - from).abs() > 0.3 * size {
                break to;
            }
        };
        let move_s = draw.uniform(0.3, 1.0) / pace_hz;
        let rest_s = draw.uniform(0.02, 0.2) / pace_hz;
        let steps = (move_s / step_s).ceil().max(4.0);
        for k in 1..=steps as usize {
            angle.push(from + (to - from) * least_jerk(k as f64 / steps));
        }
        let rests = (rest_s / step_s) as usize;
        angle.extend(std::iter::repeat_n(to, rests));
    }
    angle.truncate(points);
    angle
}

/// From 0 to 1 as x goes from 0 to 1.
fn least_jerk(x: f64) -> f64 {
    x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
}

/// Two to four strokes to and fro, at a speed that changes slowly.
fn strokes(draw: &mut Draw, points: usize, step_s: f64, speed: f64) -> Vec<f64> {
    let count = draw.whole(2, 4) as usize;
    let length = (points / count).max(8);
    let waves = draw.uniform(1.0, 4.0);
    let depth = draw.uniform(0.2, 0.7);
    let mut angle = vec![0.0];
    let mut now = 0.0;
    for k in 0..points - 1 {
        let (stroke, at) = ((k / length).min(count), (k % length) as f64 / length as f64);
        // Speeds up and down within a tenth of the stroke.
        let ends = (at.min(1.0 - at) / 0.1).min(1.0);
        let shape = least_jerk(ends) * (1.0 - depth * (0.5 - 0.5 * (TAU * waves * at).cos()));
        let sign = if stroke.is_multiple_of(2) { 1.0 } else { -1.0 };
        now += sign * speed * shape * step_s * f64::from(u8::from(stroke < count));
        angle.push(now);
    }
    angle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_begin_at_zero_and_go_on_smoothly() {
        for index in 0..40 {
            let mut draw = Draw::of(11, index);
            for motion in motions(&mut draw, index % 4 == 0, 1e-3, 0.5e-3) {
                let [speed, acceleration] = motion.peaks();
                assert!(motion.angle_rad[0] == 0.0 && speed > 0.0 && acceleration > 0.0);
                let most = motion.speeds().iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                assert!(most < 3.0 * speed, "{index} {:?} {most} {speed}", motion.kind);
                assert!(motion.experiment().is_ok());
            }
        }
    }
}
