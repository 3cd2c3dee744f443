//! Periods of the residual over the angle that stand out: candidates for ripples.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use crate::registers::widest;
use std::f64::consts::TAU;

use crate::identify::methods::friction_law::rows::Sampled;

/// A ripple repeats at least so often over the travel, and periods are looked at in so many steps for one more period.
const LEAST_PERIODS: f64 = 2.0;
const PER_PERIOD: f64 = 4.0;
/// Periods are looked at down to so many windows' travel at a slow speed, the tenth percentile.
const SHORTEST: f64 = 2.0;
const SLOW: f64 = 0.1;
/// Most frequencies looked at, and rows.
const MOST: usize = 400;
const ROWS: usize = 6000;

/// The spatial frequency, in radians per unit of angle, at which what windows leave stands out most among those `wanted`;
/// with the sign of the motion if it is `friction`. `None` where the travel is too short.
pub(super) fn strongest(
    sampled: &Sampled<'_>,
    residual: &[f64],
    friction: bool,
    wanted: impl Fn(usize) -> bool,
) -> Option<f64> {
    let [low, high] = sampled.travel();
    let travel = high - low;
    let most = travel / (SHORTEST * sampled.speed(SLOW)? * sampled.window_s);
    let step = step(sampled);
    let count = (((most - LEAST_PERIODS) * PER_PERIOD) as usize).min(MOST);
    if !(travel > 0.0 && most.is_finite()) || count == 0 {
        return None;
    }
    let used = sampled.places().iter().zip(residual).enumerate().filter(|(i, _)| wanted(*i));
    let left = used.map(|(_, (place, residual))| {
        (place.angle, residual * if friction { place.sign } else { 1.0 })
    });
    let left: Vec<(f64, f64)> = left.collect();
    let thinned: Vec<_> = left.iter().copied().step_by((left.len() / ROWS).max(1)).collect();
    let first = least(sampled);
    let powers = widest(|| powers(&thinned, first, step, count));
    let (best, _) = powers.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    // Between the steps, by a parabola through the largest and its neighbours.
    let at = |i: usize| powers.get(i).copied().unwrap_or(0.0);
    let (before, here, after) = (best.checked_sub(1).map_or(0.0, at), at(best), at(best + 1));
    let bend = before - 2.0 * here + after;
    let between = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    Some(first + (best as f64 + between.clamp(-0.5, 0.5)) * step)
}

/// How far apart the frequencies are that [`strongest`] looks at.
pub(super) fn step(sampled: &Sampled<'_>) -> f64 {
    let [low, high] = sampled.travel();
    TAU / (high - low).max(f64::MIN_POSITIVE) / PER_PERIOD
}

/// The lowest frequency that [`strongest`] looks at.
pub(super) fn least(sampled: &Sampled<'_>) -> f64 {
    LEAST_PERIODS * PER_PERIOD * step(sampled)
}

/// Rows whose waves turn side by side.
const LANES: usize = 16;

/// |Σ residual·e^{jkθ}| of angles and residuals at `count` frequencies k from `first` on, `step` apart.
#[inline(always)]
fn powers(left: &[(f64, f64)], first: f64, step: f64, count: usize) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; count];
    for rows in left.chunks(LANES) {
        let [mut re, mut im, mut cos, mut sin] = [[0.0; LANES]; 4];
        for (lane, (angle, residual)) in rows.iter().enumerate() {
            let (s, c) = (first * angle).sin_cos();
            (re[lane], im[lane]) = (residual * c, residual * s);
            (sin[lane], cos[lane]) = (step * angle).sin_cos();
        }
        for [cosine, sine] in &mut sums {
            *cosine += re.iter().sum::<f64>();
            *sine += im.iter().sum::<f64>();
            for lane in 0..LANES {
                let (a, b) = (re[lane], im[lane]);
                re[lane] = a * cos[lane] - b * sin[lane];
                im[lane] = a * sin[lane] + b * cos[lane];
            }
        }
    }
    sums.into_iter().map(|[cosine, sine]| cosine.hypot(sine)).collect()
}
