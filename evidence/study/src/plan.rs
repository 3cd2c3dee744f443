//! Plans the runs that an engineer would try on an arm.

use std::f64::consts::TAU;

use lissom::rig::{Drive, Experiment, Multisine, Reference, RigError, Settle, Sweep};

use crate::bench::Bench;
use crate::draw::Draw;
use crate::stratum::Kind;

/// Lowest frequency of all runs \[rad/s\]: six periods in [`LONGEST_S`].
const LOWEST_RAD_S: f64 = 1.0;
/// Length of a run \[s\].
const SHORTEST_S: f64 = 10.0;
/// See [`SHORTEST_S`].
const LONGEST_S: f64 = 40.0;
/// Number of periods of a sine, if the time allows.
const PERIODS: f64 = 12.0;
/// Smallest relative distance of a sine, and of three times its frequency, from the clamped modes.
const KEEP_OFF: f64 = 0.06;
/// The same for the lines of a multisine.
const NEAR_LINE: f64 = 0.1;
/// Relative distance from a clamped mode at which a slow chirp begins or ends.
const BESIDE: f64 = 0.15;
/// Duration of a chirp across a mode: in a slower one the mode has time to grow \[s\].
const ACROSS_S: (f64, f64) = (10.0, 16.0);
/// Share of the torque that a run may use, after friction is subtracted.
const PLANNED: f64 = 0.85;
/// Largest bending of a beam \[rad\].
const BEND_RAD: f64 = 0.6;
/// Peak of a sum of sines relative to its rms value.
const CREST: f64 = 2.5;
/// Largest number of lines of a multisine.
const LINES: usize = 24;
/// Longest wait for a transient \[s\].
const PATIENCE_S: f64 = 120.0;

/// A run without its amplitude.
#[derive(Debug, Clone)]
pub(crate) enum MotionShape {
    Sine { omega_rad_s: f64, record_s: f64 },
    Multisine { omega_rad_s: f64, lines: Vec<u32>, phases: u64, record_s: f64 },
    Chirp { from_rad_s: f64, to_rad_s: f64, record_s: f64 },
}

/// A run to try.
#[derive(Debug, Clone)]
pub(crate) struct Idea {
    pub(crate) shape: MotionShape,
    /// First amplitude of the reference \[rad\].
    pub(crate) reference_rad: f64,
}

impl MotionShape {
    pub(crate) fn experiment(&self, amplitude: f64) -> Result<Experiment, RigError> {
        let settle = Settle::Detected { tolerance: 1e-4, longest_s: PATIENCE_S };
        match self {
            Self::Sine { omega_rad_s, record_s } => {
                Ok(Experiment::sine(*omega_rad_s, amplitude, *record_s)?.settling(settle))
            }
            Self::Multisine { omega_rad_s, lines, phases, record_s } => {
                let sum = Multisine::new(*omega_rad_s, lines, amplitude, *phases)?;
                let drive = Drive::Angle(Reference::Multisine(sum));
                Ok(Experiment::new(drive, *record_s)?.settling(settle))
            }
            Self::Chirp { from_rad_s, to_rad_s, record_s } => {
                let ends = (*from_rad_s, *to_rad_s);
                let sweep = Reference::chirp(Sweep::Logarithmic, ends, amplitude, *record_s)?;
                Ok(Experiment::new(Drive::Angle(sweep), *record_s)?.settling(Settle::AtOnce))
            }
        }
    }

    pub(crate) fn name(&self) -> String {
        match self {
            Self::Sine { omega_rad_s, .. } => format!("sine {omega_rad_s:.3} rad/s"),
            Self::Multisine { omega_rad_s, lines, .. } => {
                let line = |at: Option<&u32>| at.map_or(0.0, |l| f64::from(*l) * omega_rad_s);
                format!("multisine {:.2}-{:.2} rad/s", line(lines.first()), line(lines.last()))
            }
            Self::Chirp { from_rad_s, to_rad_s, .. } => {
                format!("chirp {from_rad_s:.2}-{to_rad_s:.2} rad/s")
            }
        }
    }
}

/// At most ten runs.
pub(crate) fn ideas(draw: &mut Draw, bench: &Bench, kind: Kind) -> Vec<Idea> {
    let further = bench.modes_rad_s.len() - 1;
    let first = bench.modes_rad_s[0];
    let low = (first * draw.uniform(0.25, 0.45)).max(LOWEST_RAD_S);
    let main = (low, first * draw.uniform(1.7, 2.5));
    let mut ideas = Vec::new();
    match kind {
        Kind::Sines => {
            let pairs = draw.whole(3, 5 - further as u32);
            stepped(draw, bench, low, pairs as usize, &mut ideas);
            for mode in &bench.modes_rad_s[1..] {
                for beside in [0.85, 1.2] {
                    ideas.extend(sine(draw, bench, beside * mode));
                }
            }
        }
        Kind::Multisines => {
            for _ in 0..draw.whole(3, 5) {
                ideas.extend(multisine(draw, bench, main));
            }
            let bands = mode_bands(bench);
            ideas.extend(bands.iter().filter_map(|band| multisine(draw, bench, *band)));
        }
        Kind::Chirps => {
            for _ in 0..draw.whole(3, 5) {
                ideas.push(chirp(draw, bench, main, first));
            }
            ideas.extend(further_chirps(draw, bench));
        }
        Kind::Mixed => {
            stepped(draw, bench, low, 2, &mut ideas);
            for _ in 0..draw.whole(1, 2) {
                ideas.extend(multisine(draw, bench, main));
                ideas.push(chirp(draw, bench, main, first));
            }
            ideas.extend(further_chirps(draw, bench));
        }
    }
    ideas
}

/// A chirp around the second mode and each further one.
fn further_chirps(draw: &mut Draw, bench: &Bench) -> Vec<Idea> {
    let bands = mode_bands(bench).into_iter().zip(&bench.modes_rad_s[1..]);
    bands.map(|(band, mode)| chirp(draw, bench, band, *mode)).collect()
}

/// Bands around the second mode and further ones.
fn mode_bands(bench: &Bench) -> Vec<(f64, f64)> {
    let band = |mode: &f64| (0.75 * mode, (1.3 * mode).min(bench.fastest_rad_s()));
    bench.modes_rad_s[1..].iter().map(band).collect()
}

/// Pairs of sines at ω0 and 3ω0, with ω0 spread around the first mode.
fn stepped(draw: &mut Draw, bench: &Bench, low: f64, pairs: usize, ideas: &mut Vec<Idea>) {
    let high = (1.3 * bench.modes_rad_s[0]).min(bench.fastest_rad_s() / 3.0);
    for pair in 0..pairs {
        let at = |draw: &mut Draw| {
            let share = (pair as f64 + draw.uniform(0.1, 0.9)) / pairs as f64;
            low * (high / low).powf(share)
        };
        // If no draw is far enough from the modes, the last one is used.
        let mut omega = at(draw);
        for _ in 0..20 {
            if is_clear(bench, omega, KEEP_OFF) && is_clear(bench, 3.0 * omega, KEEP_OFF) {
                break;
            }
            omega = at(draw);
        }
        ideas.extend(sine(draw, bench, omega));
        ideas.extend(sine(draw, bench, 3.0 * omega));
    }
}

/// Whether a frequency has a relative distance of more than `share` from every clamped mode.
fn is_clear(bench: &Bench, omega_rad_s: f64, share: f64) -> bool {
    bench.modes_rad_s.iter().all(|mode| (omega_rad_s / mode - 1.0).abs() > share)
}

/// A sine with as many whole periods as fit. Its amplitude is 0.5 to 1 times the largest that torque,
/// travel and beam allow.
fn sine(draw: &mut Draw, bench: &Bench, omega_rad_s: f64) -> Option<Idea> {
    if omega_rad_s > bench.fastest_rad_s() {
        return None;
    }
    let period = TAU / omega_rad_s;
    let time = (PERIODS * period).clamp(SHORTEST_S, LONGEST_S);
    let record_s = (time / period).floor() * period;
    let torque_nm = PLANNED * (bench.peak_nm - bench.coulomb_nm);
    let amplitude = (torque_nm / bench.impedance(omega_rad_s).norm())
        .min(bench.most_rad)
        .min(BEND_RAD / bench.bend(omega_rad_s));
    let smaller = (amplitude * draw.uniform(0.5, 1.0)).max(bench.least_rad());
    let reference_rad = bench.reference_rad(omega_rad_s, smaller.min(amplitude));
    Some(Idea { shape: MotionShape::Sine { omega_rad_s, record_s }, reference_rad })
}

/// Three periods of a multisine with odd lines between two frequencies, evenly spread on a logarithmic
/// scale. No line is near a clamped mode, where a small line bends the beam far.
fn multisine(draw: &mut Draw, bench: &Bench, (low, high): (f64, f64)) -> Option<Idea> {
    let period_s = draw.uniform(5.0, LONGEST_S / 3.0);
    let omega_rad_s = TAU / period_s;
    let ratio = (high / low).powf(1.0 / (LINES - 1) as f64);
    let odd = |omega: f64| 2 * ((0.5 * (omega / omega_rad_s - 1.0)).round().max(0.0) as u32) + 1;
    let mut lines: Vec<u32> = (0..LINES).map(|k| odd(low * ratio.powf(k as f64))).collect();
    lines.dedup();
    lines.retain(|line| is_clear(bench, f64::from(*line) * omega_rad_s, NEAR_LINE));
    let unit = Multisine::new(omega_rad_s, &lines, 1.0, 0).ok()?.line_amplitude();
    let power: f64 = lines
        .iter()
        .map(|line| (unit * bench.torque_per_reference(f64::from(*line) * omega_rad_s)).powi(2))
        .sum();
    let per_reference = CREST * (0.5 * power).sqrt();
    let reference_rad = planned(draw, bench, per_reference);
    let record_s = 3.0 * period_s;
    let shape = MotionShape::Multisine { omega_rad_s, lines, phases: draw.seed(), record_s };
    Some(Idea { shape, reference_rad })
}

/// A sweep between two frequencies, mostly upwards: quickly across the mode between them, or slowly
/// below or above it.
fn chirp(draw: &mut Draw, bench: &Bench, (low, high): (f64, f64), mode: f64) -> Idea {
    let (below, above) = ((1.0 - BESIDE) * mode, (1.0 + BESIDE) * mode);
    let slow = (0.5 * LONGEST_S, LONGEST_S);
    let (low, high, time) = match draw.whole(0, 3) {
        0 if below > 1.5 * low => (low, below, slow),
        1 if high > 1.2 * above => (above, high, slow),
        _ => (low, high, ACROSS_S),
    };
    let steps = 200;
    let per_reference = (0..=steps)
        .map(|k| low * (high / low).powf(f64::from(k) / f64::from(steps)))
        .filter(|omega| is_clear(bench, *omega, NEAR_LINE))
        .fold(0.0_f64, |most, omega| most.max(bench.torque_per_reference(omega)));
    let reference_rad = planned(draw, bench, per_reference);
    let record_s = draw.uniform(time.0, time.1);
    let (from_rad_s, to_rad_s) = if draw.chance(0.75) { (low, high) } else { (high, low) };
    Idea { shape: MotionShape::Chirp { from_rad_s, to_rad_s, record_s }, reference_rad }
}

fn planned(draw: &mut Draw, bench: &Bench, per_reference: f64) -> f64 {
    let torque_nm = PLANNED * (bench.peak_nm - bench.coulomb_nm);
    (torque_nm / per_reference).min(bench.most_rad) * draw.uniform(0.6, 1.0)
}
