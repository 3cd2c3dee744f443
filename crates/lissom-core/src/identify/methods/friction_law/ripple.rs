//! Finds periods of the residual over the angle that stand out: candidates for ripple.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one")]

use std::f64::consts::TAU;

use crate::identify::methods::friction_law::rows::Sampled;

/// Longest period looked at, as a share of the travel, and points per one more period in it.
const LEAST_PERIODS: f64 = 1.0;
const PER_PERIOD: f64 = 4.0;
/// Periods are looked at down to this many windows' travel at the usual speed.
const SHORTEST: f64 = 2.0;
/// Most frequencies looked at, and rows.
const MOST: usize = 400;
const ROWS: usize = 6000;

/// The spatial frequency, in radians per unit of angle, at which friction's residual over the angle is
/// largest, of windows whose rows leave `residual`; `None` where the travel is too short.
pub(super) fn strongest(sampled: &Sampled<'_>, residual: &[f64]) -> Option<f64> {
    let mut left: Vec<(f64, f64)> = Vec::with_capacity(residual.len());
    let mut speed = 0.0;
    for (place, residual) in sampled.places().iter().zip(residual) {
        left.push((place.angle, place.sign * residual));
        speed += place.speed;
    }
    speed /= left.len() as f64;
    let travel = travel(left.iter().map(|p| p.0));
    let most = travel / (SHORTEST * speed * sampled.window_s);
    let step = TAU / travel / PER_PERIOD;
    let count = ((most - LEAST_PERIODS) * PER_PERIOD) as usize;
    if !(travel > 0.0 && most.is_finite()) || count == 0 {
        return None;
    }
    let thinned: Vec<_> = left.iter().copied().step_by((left.len() / ROWS).max(1)).collect();
    let first = LEAST_PERIODS * PER_PERIOD;
    let frequencies = (0..count.min(MOST)).map(|i| (first + i as f64) * step);
    let count = count.min(MOST);
    let powers =
        pulp::Arch::new().dispatch(Powers { left: &thinned, first: first * step, step, count });
    frequencies.zip(powers).max_by(|a, b| a.1.total_cmp(&b.1)).map(|p| p.0)
}

/// |Σ residual·e^{jkθ}| at `count` frequencies k from `first` on, `step` apart.
struct Powers<'a> {
    /// Angles and residuals.
    left: &'a [(f64, f64)],
    first: f64,
    step: f64,
    count: usize,
}

/// Rows whose waves turn side by side.
const LANES: usize = 16;

impl pulp::WithSimd for Powers<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Vec<f64> {
        let Self { left, first, step, count } = self;
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
