//! Offsets at which two signals look alike, by cross-correlation.

use num_complex::Complex64;
use rustfft::FftPlanner;

use super::even_signal::EvenSignal;
use super::regressors::Follows;

/// Distance of the points of a difference \[s\]: slower than noise, faster than most motions.
const DIFFERENCE_S: f64 = 0.03;
/// Offsets that are tried at most.
const MOST: usize = 16;
/// Smallest correlation of a motion with itself, later, if it repeats.
const REPEATS_LEAST: f64 = 0.5;

/// Offsets \[s\], best first: the stamp of the other log minus that of the reference.
pub(super) fn offsets(reference: &EvenSignal, other: &EvenSignal, follows: Follows) -> Vec<f64> {
    let step_s = other.step_s;
    let count = ((reference.end_s() - reference.start_s) / step_s) as usize;
    let motion: Vec<f64> =
        (0..count).map(|k| reference.at(reference.start_s + k as f64 * step_s)).collect();
    let n = ((DIFFERENCE_S / step_s).round() as usize).max(1);
    let alike = match follows {
        Follows::Angle => {
            correlations(&[first_difference(&motion, n)], &first_difference(&other.values, n), true)
        }
        Follows::Acceleration => {
            correlations(&[second_difference(&motion, n)], &inner(&other.values, n), false)
        }
        Follows::Torque => {
            let speed = first_difference(&motion, n);
            let usual = rms(&speed);
            let friction = speed.iter().map(|v| (v / (0.03 * usual)).tanh()).collect();
            let acceleration = second_difference(&motion, n);
            correlations(&[acceleration, friction], &inner(&other.values, n), false)
        }
    };
    let shift_s = other.start_s - reference.start_s;
    let mut peaks: Vec<(f64, f64)> = alike
        .iter()
        .enumerate()
        .filter(|(k, value)| {
            let before = alike[(k + alike.len() - 1) % alike.len()];
            **value > before && **value >= alike[(k + 1) % alike.len()]
        })
        .map(|(k, value)| {
            let lag = if k < other.values.len() { k as f64 } else { k as f64 - alike.len() as f64 };
            (*value, shift_s + lag * step_s)
        })
        .collect();
    peaks.sort_by(|a, b| b.0.total_cmp(&a.0));
    peaks.truncate(MOST);
    peaks.into_iter().map(|(_, offset_s)| offset_s).collect()
}

/// Time after which the motion repeats, or repeats in the other direction if the signal's sign is unknown \[s\]; `None` if
/// it does not.
pub(super) fn period_s(reference: &EvenSignal, follows: Follows) -> Option<f64> {
    let motion = first_difference(&reference.values, 1);
    let signed = follows == Follows::Angle;
    let alike = correlations(std::slice::from_ref(&motion), &motion, signed);
    let half = &alike[..motion.len().min(alike.len() / 2)];
    // Beyond the peak at 0.
    let first = half.windows(2).position(|pair| pair[1] > pair[0])?;
    let peak = (first..half.len()).max_by(|a, b| half[*a].total_cmp(&half[*b]))?;
    (half[peak].sqrt() > REPEATS_LEAST).then_some(peak as f64 * reference.step_s)
}

/// Share of the squares of `other` that the motions explain, for each lag of `other` in steps, circular; both ends are
/// padded with zeros. If `signed`, motions against each other explain nothing.
fn correlations(motions: &[Vec<f64>], other: &[f64], signed: bool) -> Vec<f64> {
    let length = motions.iter().map(Vec::len).max().unwrap_or(0) + other.len();
    let n = length.next_power_of_two();
    let mut planner = FftPlanner::new();
    let forward = planner.plan_fft_forward(n);
    let backward = planner.plan_fft_inverse(n);
    let spectrum = |x: &[f64]| {
        let mean = x.iter().sum::<f64>() / x.len().max(1) as f64;
        let mut z: Vec<Complex64> = x.iter().map(|v| Complex64::from(v - mean)).collect();
        z.resize(n, Complex64::default());
        forward.process(&mut z);
        z
    };
    let y = spectrum(other);
    let power = rms(other).powi(2) * other.len() as f64;
    let mut explained = vec![0.0; n];
    // Each motion without what it shares with those before.
    let mut before: Vec<Vec<f64>> = Vec::new();
    for motion in motions {
        let mut own = motion.clone();
        for known in &before {
            let share = dot(&own, known) / dot(known, known).max(f64::MIN_POSITIVE);
            own.iter_mut().zip(known).for_each(|(o, k)| *o -= share * k);
        }
        let x = spectrum(&own);
        let mut z: Vec<Complex64> = y.iter().zip(&x).map(|(y, x)| y * x.conj()).collect();
        backward.process(&mut z);
        let scale = 1.0 / (n as f64 * n as f64 * dot(&own, &own) * power).max(f64::MIN_POSITIVE);
        for (sum, z) in explained.iter_mut().zip(&z) {
            // A point of the arm does not move against the motor in all.
            let against = signed && z.re < 0.0;
            *sum += if against { 0.0 } else { z.re * z.re * scale };
        }
        before.push(own);
    }
    explained
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn rms(x: &[f64]) -> f64 {
    let mean = x.iter().sum::<f64>() / x.len().max(1) as f64;
    (x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / x.len().max(1) as f64).sqrt()
}

fn first_difference(x: &[f64], n: usize) -> Vec<f64> {
    x.windows(2 * n + 1).map(|w| w[2 * n] - w[0]).collect()
}

fn second_difference(x: &[f64], n: usize) -> Vec<f64> {
    x.windows(2 * n + 1).map(|w| w[2 * n] - 2.0 * w[n] + w[0]).collect()
}

/// The points at the centres of the differences.
fn inner(x: &[f64], n: usize) -> Vec<f64> {
    x.get(n..x.len().saturating_sub(n)).unwrap_or_default().to_vec()
}
