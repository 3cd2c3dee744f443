//! Checks of single channels: dead, clipped, jumping, sticking.

use crate::identify::prepare::thresholds::{
    CLIPPED_SLOPE, CLIPPED_SLOWED, ENCODER_STEPS, MOVED_STEPS, REST_RANGE, REST_STEPS,
    SLOWING_SHOWN,
};
use crate::record::extent::{extremes, range, step};
use crate::record::spikes::bends;
use crate::record::spikes::thresholds::{SPIKE_SHAPE, SPIKE_SIZE};

/// Samples over which slopes are taken: a quantised signal has none over one.
const REACH: usize = 4;

/// Share of samples at which a channel stands at its largest or smallest value after having run
/// into it at speed: at least three samples on end, entered with a slope of 30 % of the largest, and on the whole with
/// as much speed as just before.
///
/// A signal that turns round or sticks at its extreme comes to it ever more slowly and is not counted, nor is
/// one whose plateau is no longer than its own steps make it.
pub(crate) fn clipped_share(samples: &[f64]) -> f64 {
    let (low, high) = extremes(samples);
    if high <= low {
        return 0.0;
    }
    let near = 1e-9 * (high - low);
    let way = |k: usize, over: usize| (samples[k] - samples[k - over]).abs();
    let at = |x: f64| (x - low).abs() <= near || (x - high).abs() <= near;
    // Most channels come to their extremes for a sample or two.
    if !samples.windows(3).any(|w| w.iter().all(|x| at(*x))) {
        return 0.0;
    }
    let quantum = step(samples);
    let steepest = steepest(samples, quantum);
    let mut clipped = 0;
    // Ways of entry, and those of as many samples before.
    let (mut entry, mut before) = (0.0, 0.0);
    let mut k = REACH;
    while k < samples.len() {
        let mut end = k;
        while end < samples.len() && at(samples[end]) && (samples[end] - samples[k]).abs() <= near {
            end += 1;
        }
        let plateau = end - k;
        let ran_in = way(k, plateau.min(k)) > MOVED_STEPS * quantum;
        let is_long = |over: &usize| way(k, *over) > SLOWING_SHOWN * quantum;
        let over = (REACH..plateau.min(k)).find(is_long).unwrap_or(REACH);
        let is_fast = || way(k, over) > CLIPPED_SLOPE * steepest * over as f64;
        if plateau >= 3 && !at(samples[k - 1]) && ran_in && is_fast() {
            clipped += plateau;
            if k >= 2 * over {
                entry += way(k, over);
                before += way(k - over, over);
            }
        }
        k = end.max(k + 1);
    }
    if entry < CLIPPED_SLOWED * before { 0.0 } else { clipped as f64 / samples.len() as f64 }
}

/// Largest change per sample, over as many samples, four at least, as it takes to come by [`MOVED_STEPS`] steps.
pub(super) fn steepest(samples: &[f64], quantum: f64) -> f64 {
    let mut over = REACH;
    loop {
        let ways = samples.iter().zip(samples.iter().skip(over)).map(|(a, b)| (b - a).abs());
        let most = ways.fold(0.0, f64::max);
        if most > MOVED_STEPS * quantum || 4 * over > samples.len() {
            return most / over as f64;
        }
        over *= 2;
    }
}

/// Samples at which a channel has come to another level at once, and how far: its readings before and after go on
/// alike, as those of a sensor that wraps round or that lost counts.
///
/// Second differences are 1, −1 there, many times what the motion bends elsewhere.
pub(crate) fn jumps(samples: &[f64]) -> Vec<(usize, f64)> {
    let Some((bend, usual)) = bends(samples) else { return Vec::new() };
    let least = (SPIKE_SIZE * usual).max(SPIKE_SIZE * step(samples));
    let around = |k: usize| bend.get(k).map_or(0.0, |b| b.abs());
    let jump = |(k, w): (usize, &[f64])| {
        let size = w[0].abs();
        let level = size > least && (w[1] / w[0] + 1.0).abs() < SPIKE_SHAPE;
        let quiet =
            around(k + 2) < SPIKE_SHAPE * size && (k == 0 || around(k - 1) < SPIKE_SHAPE * size);
        // The first of two second differences is that of the sample one on, whose neighbour jumps.
        (level && quiet).then_some((k + 2, 0.5 * (w[0] - w[1])))
    };
    bend.windows(2).enumerate().filter_map(jump).collect()
}

/// Steps of an encoder are a whole turn over 2^8 to 2^24.
const BITS: std::ops::RangeInclusive<i32> = 8..=24;

/// Bits of an encoder whose steps the readings show, a turn being `turn` of their unit.
pub(crate) fn encoder_bits(samples: &[f64], turn: f64) -> Option<i32> {
    // A fast motion's neighbouring readings may all be some steps apart.
    let most = (turn / step(samples)).log2().round().clamp(0.0, 64.0) as i32;
    (most..=most + 3)
        .find(|bits| BITS.contains(bits) && is_on_steps(samples, turn / f64::from(*bits).exp2()))
}

fn is_on_steps(samples: &[f64], quantum: f64) -> bool {
    let off = |x: &f64| {
        let steps = (x - samples[0]) / quantum;
        (steps - steps.round()).powi(2)
    };
    let rms = (samples.iter().map(off).sum::<f64>() / samples.len() as f64).sqrt();
    range(samples) > MOVED_STEPS * quantum && rms < ENCODER_STEPS
}

/// Samples over which a motor rests, at least: within fewer its sensor may show no step.
const REST: usize = 10;

/// Share of a run in which the motor stays for a fiftieth of it within two steps, or within a
/// thousandth of its range.
pub(crate) fn rest_share(motor: &[f64]) -> f64 {
    let block = motor.len().div_ceil(50).max(REST);
    let allowed = (REST_STEPS * step(motor)).max(REST_RANGE * range(motor));
    let still: usize = motor.chunks(block).filter(|c| range(c) <= allowed).map(<[f64]>::len).sum();
    still as f64 / motor.len() as f64
}

/// Share of a sinusoidal cycle that the motor dwells at its extremes, beyond what a sinusoid of
/// the same amplitude does: an estimate of the sticking share, to about one per cent of the
/// cycle for a sensor of 12 bits.
pub(crate) fn dwell_share(motor: &[f64], omega_rad_s: f64, sample_time_s: f64) -> f64 {
    let period = std::f64::consts::TAU / (omega_rad_s * sample_time_s);
    let quantum = step(motor);
    let (mut share, mut cycles) = (0.0, 0.0);
    let mut from = 0.0;
    while from + period <= motor.len() as f64 + 0.5 {
        let end = ((from + period).round() as usize).min(motor.len());
        let cycle = &motor[from.round() as usize..end];
        let (low, high) = extremes(cycle);
        let amplitude = 0.5 * (high - low);
        if amplitude > 0.0 && cycle.len() > 8 {
            let margin = quantum.max(0.003 * amplitude);
            let near =
                cycle.iter().filter(|x| **x >= high - margin || **x <= low + margin).count() as f64;
            // Readings are rounded: within half a step more of the true extreme.
            let depth = (margin + 0.5 * quantum).min(amplitude);
            let expected = 2.0 / std::f64::consts::PI * (1.0 - depth / amplitude).acos();
            share += near / cycle.len() as f64 - expected;
            cycles += 1.0;
        }
        from += period;
    }
    if cycles > 0.0 { (share / cycles).max(0.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::spikes::spikes;

    fn sine(limit: f64) -> Vec<f64> {
        (0..4000).map(|k| (0.02 * f64::from(k)).sin().clamp(-limit, limit)).collect()
    }

    #[test]
    fn a_sensor_that_wraps_jumps_and_a_stroke_does_not() {
        let turning = |k: usize| 0.01 * k as f64 + 0.2 * (0.02 * k as f64).sin();
        let turn = std::f64::consts::TAU;
        let wrapped: Vec<f64> = (0..2000).map(|k| turning(k) % turn).collect();
        let found = jumps(&wrapped);
        assert_eq!(found.len(), 3);
        for (at, by) in found {
            assert!(turning(at - 1) % turn > turning(at) % turn && (by + turn).abs() < 1e-3);
        }
        assert!(jumps(&stops(20.0, 3)).is_empty() && jumps(&sine(0.8)).is_empty());
        let mut spiked = sine(2.0);
        spiked[700] += 0.3;
        assert!(jumps(&spiked).is_empty());
        // A camera's readings, each held for 50 samples.
        let held: Vec<f64> = (0..4000).map(|k| (0.02 * f64::from(k / 50 * 50)).sin()).collect();
        assert!(jumps(&held).is_empty() && spikes(&held).is_empty());
    }

    #[test]
    fn an_encoder_read_in_degrees_is_told() {
        let turn = std::f64::consts::TAU;
        let read = |bits: i32, turn: f64| -> Vec<f64> {
            let quantum = turn / f64::from(bits).exp2();
            sine(2.0).iter().map(|v| (0.1 * turn * v / quantum).round() * quantum).collect()
        };
        for bits in [10, 12, 16, 20] {
            // As a log of six decimals has it.
            let degrees: Vec<f64> =
                read(bits, 360.0).iter().map(|x| (x * 1e6).round() / 1e6).collect();
            assert_eq!(encoder_bits(&degrees, 360.0), Some(bits));
            assert_eq!(encoder_bits(&read(bits, turn), 360.0), None);
        }
        assert_eq!(encoder_bits(&sine(2.0), 360.0), None);
        assert_eq!(encoder_bits(&[1.0; 40], 360.0), None);
    }

    #[test]
    fn a_clipped_sine_is_told_from_a_whole_one() {
        assert!(clipped_share(&sine(2.0)) < 1e-9);
        let share = clipped_share(&sine(0.8));
        // Above 0.8 for 1 − 2/π·asin(0.8) = 41 % of the cycle.
        assert!((share - 0.41).abs() < 0.02, "{share}");
    }

    #[test]
    fn a_slow_motion_in_steps_is_clipped_where_it_runs_into_its_end() {
        let x = |limit: f64| -> Vec<f64> {
            let at = |k: i32| (6.28e-4 * f64::from(k)).sin().clamp(-limit, limit);
            (0..60_000).map(|k| (325.0 * at(k)).round()).collect()
        };
        assert!(clipped_share(&x(2.0)) < 1e-9);
        // It stands for 7 % of the time, and comes there at a tenth of its speed.
        assert!(clipped_share(&x(0.9945)) < 1e-9);
        assert!((clipped_share(&x(0.8)) - 0.41).abs() < 0.02);
    }

    /// Friction stops a motor that turns at `speed` steps a sample within `samples`, at the same angle each time.
    fn stops(speed: f64, samples: usize) -> Vec<f64> {
        let coasting = |k: usize| k.min(100) as f64;
        let stopping = |k: usize| {
            let t = k.saturating_sub(100).min(samples) as f64;
            t - 0.5 * t * t / samples as f64
        };
        let stroke: Vec<f64> =
            (0..300).map(|k| (speed * (coasting(k) + stopping(k))).round()).collect();
        let back: Vec<f64> = stroke.iter().map(|x| stroke[299] - x).collect();
        [stroke, back].concat().repeat(3)
    }

    #[test]
    fn a_motor_that_sticks_at_its_extremes_is_not_clipped() {
        for samples in [3, 5, 8, 20] {
            for speed in [4.0, 7.0, 20.0, 1e4] {
                let share = clipped_share(&stops(speed, samples));
                assert!(share < 1e-9, "{samples} {speed}: {share}");
            }
        }
        // Stopped at once it stood for two thirds of the time.
        let share = clipped_share(&stops(20.0, 1));
        assert!((share - 2.0 / 3.0).abs() < 0.01, "{share}");
    }

    #[test]
    fn clipping_is_told_at_any_sampling_and_through_noise() {
        for (per_cycle, limits) in [(60.0, [0.7, 0.8]), (300.0, [0.3, 0.93]), (3000.0, [0.3, 0.8])]
        {
            for limit in limits {
                let x = (0..6000).map(|k| {
                    let noise = 1e-4 * (f64::from(k) * 12.9898).sin();
                    let phase = std::f64::consts::TAU / per_cycle * f64::from(k) + 0.1;
                    (phase.sin() + noise).clamp(-limit, limit)
                });
                let share = clipped_share(&x.collect::<Vec<_>>());
                let asked = 1.0 - 2.0 / std::f64::consts::PI * limit.asin();
                assert!((share / asked - 1.0).abs() < 0.15, "{per_cycle} {limit}: {share} {asked}");
            }
        }
    }

    #[test]
    fn a_quantised_sine_is_not_clipped_and_does_not_dwell() {
        let x: Vec<f64> = sine(2.0).iter().map(|v| (v / 0.003).round() * 0.003).collect();
        assert!(clipped_share(&x) < 1e-9);
        assert!(dwell_share(&x, 2.0, 0.01) < 0.012);
        assert!((step(&x) - 0.003).abs() < 1e-12);
    }

    #[test]
    fn rest_is_told_from_motion() {
        let mut x = sine(2.0);
        assert!(rest_share(&x) < 1e-9);
        x.extend(vec![0.3; 4000]);
        assert!((rest_share(&x) - 0.5).abs() < 0.03);
    }

    #[test]
    fn a_dwell_is_measured() {
        // A cosine that stands for 5 % of the cycle at each extreme.
        let period = 2000;
        let x: Vec<f64> = (0..5 * period)
            .map(|k| {
                let phase = f64::from(k % period) / f64::from(period);
                let (half, sign) = if phase < 0.5 { (phase, 1.0) } else { (phase - 0.5, -1.0) };
                let moving = ((half - 0.05) / 0.45).max(0.0);
                sign * (std::f64::consts::PI * moving).cos()
            })
            .collect();
        let omega = std::f64::consts::TAU / (f64::from(period) * 0.001);
        let share = dwell_share(&x, omega, 0.001);
        assert!((share - 0.1).abs() < 0.01, "{share}");
    }
}
