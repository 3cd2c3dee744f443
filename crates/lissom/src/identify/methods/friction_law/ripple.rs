//! Where friction may change over the angle: the periods that stand out of what a law leaves.

use std::f64::consts::TAU;

use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::Sampled;
use crate::identify::methods::regression::Term;

/// Longest period looked at, as a share of the travel, and points per one more period in it.
const LEAST_PERIODS: f64 = 1.0;
const PER_PERIOD: f64 = 4.0;
/// Periods are looked at down to this many windows' travel at the usual speed.
const SHORTEST: f64 = 2.0;
/// Most frequencies looked at, and rows.
const MOST: usize = 400;
const ROWS: usize = 6000;

/// The spatial frequency, in radians per unit of angle, at which friction's residual over the angle is
/// largest; `None` where the travel is too short.
pub(super) fn strongest(
    sampled: &Sampled<'_>,
    columns: &[Column],
    terms: &[Term],
    value: &[f64],
) -> Option<f64> {
    let mut left: Vec<(f64, f64)> = Vec::new();
    let mut speed = 0.0;
    sampled.rows(columns, &[], |place, row| {
        let explained: f64 =
            terms.iter().zip(value).map(|(t, v)| t.factor(place.sign) * row[t.column()] * v).sum();
        left.push((place.angle, place.sign * (row[row.len() - 1] - explained)));
        speed += place.speed;
    });
    speed /= left.len() as f64;
    let travel = travel(left.iter().map(|p| p.0));
    let most = travel / (SHORTEST * speed * sampled.window_s);
    let step = TAU / travel / PER_PERIOD;
    let count = ((most - LEAST_PERIODS) * PER_PERIOD) as usize;
    if !(travel > 0.0 && most.is_finite()) || count == 0 {
        return None;
    }
    let thinned: Vec<_> = left.iter().step_by((left.len() / ROWS).max(1)).collect();
    let power = |k: f64| {
        let (mut cosine, mut sine) = (0.0, 0.0);
        for (angle, residual) in &thinned {
            let (s, c) = (k * angle).sin_cos();
            cosine += residual * c;
            sine += residual * s;
        }
        cosine.hypot(sine)
    };
    let first = LEAST_PERIODS * PER_PERIOD;
    let frequencies = (0..count.min(MOST)).map(|i| (first + i as f64) * step);
    frequencies.map(|k| (k, power(k))).max_by(|a, b| a.1.total_cmp(&b.1)).map(|p| p.0)
}

/// How far apart the frequencies are that [`strongest`] looks at.
pub(super) fn step(sampled: &Sampled<'_>) -> f64 {
    TAU / travel(sampled.places().iter().map(|place| place.angle)) / PER_PERIOD
}

fn travel(angles: impl Iterator<Item = f64>) -> f64 {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = angles.fold(ends, |(low, high), x| (low.min(x), high.max(x)));
    high - low
}
