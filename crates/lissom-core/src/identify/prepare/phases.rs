//! Phases in which the motor slips one way.
#![expect(clippy::inline_always, reason = "compiled for wide registers as one: half the time")]

use crate::identify::prepare::thresholds::{REST_SPEED, SURELY_REVERSED};
use crate::identify::prepare::window::Window;
use crate::identify::thresholds::TRAVEL_OVER_NOISE;
use crate::registers::widest;

/// Samples `from..to` in which the motor moves in the direction of `sign`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Phase {
    /// First sample.
    pub(crate) from: usize,
    /// One past the last sample.
    pub(crate) to: usize,
    /// +1 or −1.
    pub(crate) sign: f64,
}

/// Phases of one sign of the smoothed velocity.
///
/// The velocity is the angle's convolution with the derivative of a window of `smooth` samples:
/// long enough that the sensor's steps do not reverse it, short against the phases.
pub(crate) fn slip_phases(motor: &[f64], smooth: usize, sample_time_s: f64) -> Vec<Phase> {
    slips(motor, &Window::new(smooth, sample_time_s), 0.0)
}

/// The same without what reverses within the smoothing: where the velocity over half of it is against the
/// phase's by more than [`SURELY_REVERSED`] of its own deviations, `σ·√Σẇ²` for angles with noise of deviation `noise_rad`.
pub(crate) fn unreversed_phases(
    motor: &[f64],
    smooth: usize,
    sample_time_s: f64,
    noise_rad: f64,
) -> Vec<Phase> {
    let phases = slip_phases(motor, smooth, sample_time_s);
    if smooth < 2 * LEAST_SMOOTH {
        return phases;
    }
    let window = Window::new(smooth / 2, sample_time_s);
    let std = noise_rad * window.first.iter().map(|w| w * w).sum::<f64>().sqrt();
    let within = slips(motor, &window, SURELY_REVERSED * std);
    phases.iter().flat_map(|phase| without_reversals(*phase, &within)).collect()
}

/// Fewest samples over which a velocity is smoothed.
pub(crate) const LEAST_SMOOTH: usize = 4;

/// The parts of a phase that are left by those of the other sign.
fn without_reversals(phase: Phase, found: &[Phase]) -> Vec<Phase> {
    let first = found.partition_point(|other| other.to <= phase.from);
    let mut parts = vec![phase];
    let reaching = found[first..].iter().take_while(|other| other.from < phase.to);
    for other in reaching.filter(|other| other.sign * phase.sign < 0.0) {
        let Some(last) = parts.pop() else { break };
        let (before, after) = (Phase { to: other.from, ..last }, Phase { from: other.to, ..last });
        parts.extend([before, after].into_iter().filter(|part| part.from < part.to));
    }
    parts
}

/// Phases of one sign of velocities of more than `least`, and of more than [`REST_SPEED`].
fn slips(motor: &[f64], window: &Window, least: f64) -> Vec<Phase> {
    phases_of(&velocities(motor, window), window, least)
}

/// The same from the [`velocities`] in a window.
pub(crate) fn phases_of(velocity_at: &[f64], window: &Window, least: f64) -> Vec<Phase> {
    let fastest = velocity_at.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let least = least.max(REST_SPEED * fastest);
    let mut phases: Vec<Phase> = Vec::new();
    for (k, &velocity) in (window.len() / 2..).zip(velocity_at) {
        if velocity.abs() > least {
            extend(&mut phases, k, velocity);
        }
    }
    phases
}

/// `Σẇ·θ`, up to its unit the velocity, in every window that the samples hold.
pub(crate) fn velocities(motor: &[f64], window: &Window) -> Vec<f64> {
    widest(|| side_by_side(motor, window))
}

/// Velocities found side by side.
const LANES: usize = 16;

#[inline(always)]
fn side_by_side(motor: &[f64], window: &Window) -> Vec<f64> {
    let n = window.len();
    let rising = &window.first[..n.div_ceil(2)];
    let mut velocity_at = Vec::with_capacity(motor.len());
    let velocities = motor.len().saturating_sub(n);
    for from in (0..velocities).step_by(LANES) {
        let seen = &motor[from..];
        let lanes = LANES.min(velocities - from);
        let found = if lanes == LANES {
            convolved(rising, n, seen)
        } else {
            let mut padded = seen.to_vec();
            padded.resize(n + LANES, 0.0);
            convolved(rising, n, &padded)
        };
        velocity_at.extend_from_slice(&found[..lanes]);
    }
    velocity_at
}

/// The velocities in the middle of the first windows of `n` sample intervals, by the first half of ẇ.
#[inline(always)]
fn convolved(rising: &[f64], n: usize, motor: &[f64]) -> [f64; LANES] {
    let mut sums = [0.0; LANES];
    for (i, w) in rising.iter().enumerate() {
        // ẇ is odd about the middle, and zero there. A motor at rest has a velocity of exactly zero.
        let (before, after) = (&motor[i..][..LANES], &motor[n - i..][..LANES]);
        for lane in 0..LANES {
            sums[lane] += w * (after[lane] - before[lane]);
        }
    }
    sums
}

/// Adds sample `k` to the last phase, or begins one.
#[inline(always)]
fn extend(phases: &mut Vec<Phase>, k: usize, velocity: f64) {
    let sign = velocity.signum();
    match phases.last_mut() {
        Some(last) if last.to == k && last.sign.total_cmp(&sign).is_eq() => last.to = k + 1,
        _ => phases.push(Phase { from: k, to: k + 1, sign }),
    }
}

/// Fewest samples over which a run's velocity is smoothed by itself.
pub(crate) const SMOOTHING_LEAST: usize = 8;

/// Samples over which the motor's velocity is smoothed: [`needed_smoothing`], and a few at least.
pub(crate) fn smoothing(motor: &[f64]) -> usize {
    needed_smoothing(motor).max(SMOOTHING_LEAST)
}

/// Samples over which the motor moves by several times its sensor's steps or noise at its usual speed:
/// the velocity over them has a sure sign. No more, so that no reversal is smoothed away.
///
/// Noise is taken from second differences, whose expectation for white noise σ is √6·σ.
pub(crate) fn needed_smoothing(motor: &[f64]) -> usize {
    let rms = |sum: f64, n: usize| (sum / n.max(1) as f64).sqrt();
    let second = motor.windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).powi(2)).sum();
    let noise = rms(second, motor.len() - 2) / 6.0_f64.sqrt();
    let samples = TRAVEL_OVER_NOISE * noise / usual_speed(motor, noise).max(f64::MIN_POSITIVE);
    samples.min(motor.len() as f64) as usize
}

/// Root mean square of the speed \[per sample\], by the stretches that show most of it: over a hundredth of the record steps
/// and noise are small, and a fast motion has turned back; of shorter ones three times what noise makes of them is
/// taken off.
fn usual_speed(motor: &[f64], noise: f64) -> f64 {
    let longest = (motor.len() / 100).max(1);
    let over = |reach: usize| {
        let moved: f64 = motor.windows(reach + 1).map(|w| (w[reach] - w[0]).powi(2)).sum();
        let by_noise = if reach < longest { 6.0 * noise * noise } else { 0.0 };
        (moved / (motor.len() - reach) as f64 - by_noise).max(0.0).sqrt() / reach as f64
    };
    let halved = std::iter::successors(Some(longest), |reach| (*reach > 1).then_some(reach / 2));
    halved.map(over).fold(0.0, f64::max)
}

/// Direction of motion at every sample: +1, −1, or 0 where the smoothed velocity has no sign.
pub(crate) fn slip_sign(motor: &[f64], sample_time_s: f64) -> Vec<f64> {
    let mut sign = vec![0.0; motor.len()];
    for phase in slip_phases(motor, smoothing(motor), sample_time_s) {
        sign[phase.from..phase.to].fill(phase.sign);
    }
    sign
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution as _, StandardNormal};
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::*;

    #[test]
    fn a_quantised_cosine_has_its_half_cycles() {
        let t = 0.003;
        let x: Vec<f64> =
            (0..4000).map(|k| ((2.0 * f64::from(k) * t).cos() / 0.0015).round() * 0.0015).collect();
        let phases = slip_phases(&x, 30, t);
        let long: Vec<_> = phases.iter().filter(|p| p.to - p.from > 100).collect();
        assert_eq!(long.len(), 8);
        for (k, p) in long.iter().enumerate() {
            assert!((p.sign - if k % 2 == 0 { -1.0 } else { 1.0 }).abs() < 1e-9);
            let half_cycle = std::f64::consts::PI / 2.0 / t;
            assert!((p.to as f64 - (k as f64 + 1.0) * half_cycle).abs() < 16.0 || k == 7);
        }
    }

    /// A hundredth of the record is two periods: over these the motor is back where it was.
    #[test]
    fn the_speed_of_a_fast_motion_is_not_that_over_its_periods() {
        let (amplitude, period, step) = (0.05, 50.0, 2e-3);
        let turn = std::f64::consts::TAU / period;
        let angle = |k: u32| amplitude * (turn * f64::from(k)).sin();
        let motor: Vec<f64> = (0..10_000).map(|k| (angle(k) / step).round() * step).collect();
        let speed = amplitude * turn / 2.0_f64.sqrt();
        let found = usual_speed(&motor, step / 12.0_f64.sqrt());
        assert!((found / speed - 1.0).abs() < 0.05, "{found} {speed}");
        // So that no velocity is smoothed over half of a period.
        assert!(needed_smoothing(&motor) < 12, "{}", needed_smoothing(&motor));
    }

    #[test]
    fn a_motor_at_rest_has_none() {
        assert!(slip_phases(&[1.0; 200], 20, 0.01).is_empty());
    }

    /// Back and forth within the smoothing, which only sees the way forward.
    #[test]
    fn a_reversal_within_the_smoothing_is_cut_out() {
        let (t, noise, smooth) = (0.001, 1e-5, 40);
        let mut next = draws();
        let mut at = 0.0;
        let motor: Vec<f64> = (0..2000)
            .map(|k| {
                at += if (1000..1006).contains(&k) { -1e-3 } else { 1e-3 };
                at + noise * next()
            })
            .collect();
        let smoothed = slip_phases(&motor, smooth, t);
        assert_eq!(smoothed.len(), 1, "it is not smoothed away");
        let phases = unreversed_phases(&motor, smooth, t, noise);
        assert_eq!(phases.len(), 2, "{phases:?}");
        assert!(phases[0].to < 1003 && phases[1].from > 1003, "{phases:?}");
        assert!(phases[1].from - phases[0].to < smooth, "{phases:?}");
    }

    /// Numbers of mean 0 and standard error 1.
    fn draws() -> impl FnMut() -> f64 {
        let mut source = Xoshiro256PlusPlus::seed_from_u64(1);
        move || StandardNormal.sample(&mut source)
    }
}
