//! How often intervals contain the truth of logs with a weak further term, which the logs hardly show: a lag, a ripple, viscous
//! friction by direction, or friction near rest. `cargo run --release -p lissom-study --example weak_terms -- FIRST LAST` takes
//! the seeds FIRST to LAST of each kind.
//!
//! A rigid joint follows a prescribed motion; the measured current is its torque with noise. The term has 0.5 to 6 times the
//! standard error that ordinary least squares give it. Nothing of lissom makes the logs.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "an example prints its table")]

use std::f64::consts::TAU;

use lissom::identify::{Effort, Estimate, Options, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, TimeBase};
use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution as _, Normal, Uniform};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng as _;
use rayon::prelude::*;

const KINDS: [&str; 5] = ["none", "lag", "ripple", "by direction", "near rest"];
const DURATION_S: f64 = 35.0;
const COUNTS: f64 = 1_048_576.0;

/// Random numbers of one log.
struct Draw(Xoshiro256PlusPlus);

impl Draw {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        Uniform::new(low, high).map_or(low, |d| d.sample(&mut self.0))
    }

    /// About a value, within a factor.
    fn about(&mut self, value: f64, factor: f64) -> f64 {
        value * factor.powf(self.between(-1.0, 1.0))
    }

    fn noise(&mut self) -> f64 {
        Normal::new(0.0, 1.0).map_or(0.0, |d| d.sample(&mut self.0))
    }
}

/// A sum of sines, or a sweep.
enum Motion {
    Sines(Vec<[f64; 3]>),
    Sweep { from_hz: f64, to_hz: f64, amplitude_rad: f64 },
}

impl Motion {
    fn drawn(draw: &mut Draw, fastest: f64) -> Self {
        let motion = if draw.between(0.0, 1.0) < 0.5 {
            let w = draw.about(1.3, 1.3);
            let parts = [(1.0, 1.0), (2.0, 0.3), (3.0, 0.25), (5.0, 0.12)];
            Self::Sines(
                parts.map(|(k, a)| [draw.about(a, 1.5), k * w, draw.between(0.0, TAU)]).to_vec(),
            )
        } else {
            let (from_hz, to_hz) = (draw.about(0.1, 1.4), draw.about(1.6, 1.3));
            Self::Sweep { from_hz, to_hz, amplitude_rad: 1.0 }
        };
        let samples = (0..20_000).map(|k| motion.at(f64::from(k) * DURATION_S / 20_000.0)[1].abs());
        let scale = fastest / samples.fold(0.0, f64::max);
        match motion {
            Self::Sines(parts) => {
                Self::Sines(parts.iter().map(|[a, w, p]| [a * scale, *w, *p]).collect())
            }
            Self::Sweep { from_hz, to_hz, .. } => {
                Self::Sweep { from_hz, to_hz, amplitude_rad: scale }
            }
        }
    }

    /// Angle, speed and acceleration.
    fn at(&self, t: f64) -> [f64; 3] {
        match self {
            Self::Sines(parts) => parts.iter().fold([0.0; 3], |[q, v, a], [size, w, phase]| {
                let (sin, cos) = (w * t + phase).sin_cos();
                [q + size * sin, v + size * w * cos, a - size * w * w * sin]
            }),
            Self::Sweep { from_hz, to_hz, amplitude_rad } => {
                let rate = TAU * (to_hz - from_hz) / DURATION_S;
                let w = TAU * from_hz + rate * t;
                let (sin, cos) = (TAU * from_hz * t + 0.5 * rate * t * t).sin_cos();
                [sin, w * cos, rate * cos - w * w * sin].map(|x| amplitude_rad * x)
            }
        }
    }
}

/// Errors of Coulomb friction, viscous friction and inertia of one log, in the standard errors given.
fn errors(kind: usize, seed: u64) -> Option<[f64; 3]> {
    let mut draw = Draw(Xoshiro256PlusPlus::seed_from_u64(seed * 10 + kind as u64));
    let (mut coulomb, mut viscous, inertia) =
        (draw.about(0.3, 3.0), draw.about(0.06, 3.0), draw.about(0.012, 3.0));
    let sample_time_s = draw.about(0.004, 1.6);
    let fastest = draw.about(4.0, 1.5);
    let motion = Motion::drawn(&mut draw, fastest);
    let noise = coulomb * draw.about(0.05, 2.0);
    let n = (DURATION_S / sample_time_s) as usize;
    let at: Vec<[f64; 3]> = (0..n).map(|k| motion.at(k as f64 * sample_time_s)).collect();
    let torque = |[_, v, a]: [f64; 3]| inertia * a + coulomb * v.signum() + viscous * v;
    let [low, high] =
        at.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x[0]), h.max(x[0])]);
    let period = (high - low) * draw.between(0.04, 0.2);
    let near_rad_s = fastest * draw.between(0.08, 0.3);
    let phase = draw.between(0.0, TAU);
    let shape = |k: usize, [q, v, _]: [f64; 3]| match kind {
        1 => {
            let (before, after) = (at[k.saturating_sub(1)], at[(k + 1).min(n - 1)]);
            let turns = before[1].signum() * after[1].signum() < 0.0;
            if turns { 0.0 } else { (torque(before) - torque(after)) / (2.0 * sample_time_s) }
        }
        2 => v.signum() * (TAU * q / period + phase).sin(),
        3 => v.abs(),
        _ => v.signum() * (-v.abs() / near_rad_s).exp(),
    };
    let rows: Vec<f64> = (0..n)
        .flat_map(|k| [at[k][2], at[k][1], at[k][1].signum(), 1.0, shape(k, at[k])])
        .collect();
    let rows = DMatrix::from_row_slice(n, 5, &rows);
    let covariance = (rows.transpose() * &rows).try_inverse()? * noise * noise;
    let amplitude =
        if kind == 0 { 0.0 } else { draw.between(0.5, 6.0) * covariance[(4, 4)].sqrt() };
    let logged = |k: usize| match kind {
        1 => torque(motion.at(k as f64 * sample_time_s - amplitude)),
        _ => torque(at[k]) + amplitude * shape(k, at[k]),
    };
    let mut command: Vec<f64> = (0..n).map(logged).collect();
    for u in &mut command {
        *u += noise * draw.noise();
    }
    if kind == 4 {
        // The line nearest to friction at the speeds of the log.
        let speeds: Vec<f64> = at.iter().map(|x| x[1].abs()).collect();
        let line = DMatrix::from_fn(n, 2, |k, i| if i == 0 { 1.0 } else { speeds[k] });
        let further = DVector::from_fn(n, |k, _| amplitude * (-speeds[k] / near_rad_s).exp());
        let change = (line.transpose() * &line).try_inverse()? * line.transpose() * further;
        (coulomb, viscous) = (coulomb + change[0], viscous + change[1]);
    }
    let angle = at.iter().map(|x| (x[0] * COUNTS / TAU).round() * TAU / COUNTS).collect();
    let channels = Channels {
        axis: Axis::Rotary,
        command: Command {
            quantity: CommandQuantity::Current,
            hold: Hold::Measured,
            torque_per_command: Some(1.0),
            back_emf_viscous: 0.0,
            limit: None,
        },
        tips: Vec::new(),
    };
    let run =
        Run::new("log", TimeBase::uniform(0.0, sample_time_s), command, angle, Vec::new()).ok()?;
    let options = Options { effort: Effort::Quick, ..Options::default() };
    let found = identify(&Campaign::new(channels, vec![run]).ok()?, &options, |_| ()).ok()?;
    let off = |e: Option<Estimate>, truth: f64| e.map_or(f64::NAN, |e| (e.value - truth) / e.std);
    let friction = found.friction;
    Some([
        off(friction.coulomb, coulomb),
        off(friction.viscous, viscous),
        off(found.inertia, inertia),
    ])
}

fn main() {
    let seeds: Vec<u64> = std::env::args().skip(1).filter_map(|text| text.parse().ok()).collect();
    let [first, last] = seeds[..] else {
        eprintln!("usage: weak_terms FIRST LAST");
        return;
    };
    println!("{:<13} logs  Coulomb  viscous  inertia   rms of errors in standard errors", "term");
    for (kind, name) in KINDS.iter().enumerate() {
        let found: Vec<[f64; 3]> =
            (first..=last).into_par_iter().filter_map(|seed| errors(kind, seed)).collect();
        let n = found.len() as f64;
        let within =
            |i: usize| 100.0 * found.iter().filter(|z| z[i].abs() < 1.96).count() as f64 / n;
        let rms = |i: usize| (found.iter().map(|z| z[i] * z[i]).sum::<f64>() / n).sqrt();
        let [c, v, j] = [0, 1, 2].map(within);
        let [rc, rv, rj] = [0, 1, 2].map(rms);
        println!(
            "{name:<13} {n:>4}  {c:>5.1} %  {v:>5.1} %  {j:>5.1} %   {rc:.2}  {rv:.2}  {rj:.2}"
        );
    }
}
