//! Many experiments at a time that differ only in their noise.

#![expect(
    clippy::inline_always,
    reason = "a loop over samples, compiled for vectors chosen at run time"
)]

use std::f64::consts::PI;

use nalgebra::{Matrix5, Vector5};
use num_complex::Complex64;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rayon::prelude::*;

use super::held::flow::step;
use super::held::held_arm::{Duration, Modes, Way};
use super::held::lane::{LANES, Lane, Lanes};
use super::sampled_loop::{LEAST_RAD, RUN_AWAY};
use super::{HeldArm, HeldMotion, Motion, Pd, RigError, Sines};
use crate::arm::Arm;
use crate::friction::Mode;
use crate::spectrum::hold_factor;

/// Samples for which noise and reference are made at a time.
const BLOCK: usize = 64;
/// Mean, and two of each harmonic: 1 and 3.
const BASIS: usize = 5;

/// Experiments with one arm in one control loop, each with its own sensor noise inside the loop.
///
/// ```
/// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
/// # use lissom::rig::{Batch, Pd};
/// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.05 };
/// # let beam = LumpedBeam::new(&[span]).unwrap();
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
/// let batch = Batch {
///     arm: &arm, controller: Pd::new(8.0, 0.2)?, limit_a: 4.0, sample_time_s: 0.003, noise_rad: 1e-4,
///     omega_rad_s: 3.0, amplitude_rad: 0.5, settle_s: 6.0, record_s: 6.0,
/// };
/// let runs = batch.run(0..20)?;
/// let mean = runs.iter().map(|run| run.coulomb_a).sum::<f64>() / 20.0;
/// assert!((mean / (0.03 / 0.25) - 1.0).abs() < 0.1); // sticking lowers it by a few percent
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Sections 5.1, 5.2 and 6.1]`
#[derive(Debug, Clone, Copy)]
pub struct Batch<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// The controller. Its derivative must not be filtered.
    pub controller: Pd,
    /// Largest magnitude of the current \[A\].
    pub limit_a: f64,
    /// Sample time T \[s\].
    pub sample_time_s: f64,
    /// Standard deviation of the noise of the motor's sensor \[rad\]; normal, independent from sample to sample.
    pub noise_rad: f64,
    /// Frequency ω0 of the reference \[rad/s\].
    pub omega_rad_s: f64,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time before the record begins \[s\].
    pub settle_s: f64,
    /// Time that is recorded \[s\]; it is cut to whole periods if it is at least one period.
    pub record_s: f64,
}

/// Result of one experiment of a [`Batch`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoisyRun {
    /// Seed of its noise.
    pub seed: u64,
    /// Phasors of the command at ω0 and 3ω0, zero-order hold included \[A\].
    pub current_a: [Complex64; 2],
    /// Phasors of the measured angle at ω0 and 3ω0 \[rad\].
    pub motor_rad: [Complex64; 2],
    /// Coulomb friction CF/K from the third harmonic (27) \[A\]; the linear part of the arm is known.
    pub coulomb_a: f64,
    /// Number of times that the joint began to stick.
    pub sticks: usize,
    /// Total time for which the joint stuck \[s\].
    pub stuck_s: f64,
}

/// What all experiments share.
struct Plan<'a> {
    batch: &'a Batch<'a>,
    settle: usize,
    samples: usize,
    /// From sums over the record to coefficients.
    normal: Matrix5<f64>,
    /// The motor's linear response at 3ω0 \[rad/A\].
    linear: Complex64,
    waves: [Sines; 2],
}

impl Batch<'_> {
    /// Runs one experiment for each seed, on all threads of rayon, and computes the phasors of command and angle at ω0
    /// and 3ω0 and the Coulomb friction that follows from them.
    ///
    /// `c = Re{(i_3 − θ_m3/G(3ω0))/(j·4/(3π)·e^{j3φ})}` \[A\], with the phase φ of θ_m at ω0 \[rad\] and the motor's
    /// response without friction G \[rad/A\]. The results of a seed are the same to the last bit for any other seeds,
    /// any number of threads and any vector registers.
    ///
    /// # Source
    /// `[Feliu1989, eq. (27)]` with the phase of `docs/src/reference/errata.md`.
    ///
    /// # Errors
    /// [`RigError::NotPositive`] or [`RigError::NotFinite`] for times, frequencies, gains or noise that
    /// are not; [`RigError::Unsupported`] for a controller with a filtered derivative;
    /// [`RigError::Unstable`] if a loop is unstable.
    pub fn run(&self, seeds: std::ops::Range<u64>) -> Result<Vec<NoisyRun>, RigError> {
        let plan = Plan::new(self)?;
        let held = HeldArm::new(self.arm, &[self.sample_time_s])?;
        let seeds: Vec<u64> = seeds.collect();
        let groups: Result<Vec<Vec<NoisyRun>>, RigError> = seeds
            .par_chunks(LANES)
            .map(|seeds| match &held.way {
                Way::Modes(modes) => Group::new(&plan, &held, seeds).run(modes),
                Way::Matrices(_) => seeds.iter().map(|seed| plan.alone(&held, *seed)).collect(),
            })
            .collect();
        Ok(groups?.into_iter().flatten().collect())
    }
}

impl<'a> Plan<'a> {
    fn new(batch: &'a Batch<'a>) -> Result<Self, RigError> {
        if batch.controller.filter_s().is_some() {
            return Err(RigError::Unsupported { what: "a filtered derivative in a batch" });
        }
        let positive = [
            ("sample_time_s", batch.sample_time_s),
            ("omega_rad_s", batch.omega_rad_s),
            ("amplitude_rad", batch.amplitude_rad),
            ("record_s", batch.record_s),
            ("limit_a", batch.limit_a),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(RigError::NotPositive { quantity, found });
            }
        }
        let finite = [
            ("noise_rad", batch.noise_rad),
            ("settle_s", batch.settle_s),
            ("proportional_a_per_rad", batch.controller.proportional_a_per_rad()),
            ("derivative_a_s_per_rad", batch.controller.derivative_a_s_per_rad()),
        ];
        for (quantity, found) in finite {
            if !found.is_finite() {
                return Err(RigError::NotFinite { quantity, found });
            }
        }
        let t = batch.sample_time_s;
        let settle = (batch.settle_s.max(0.0) / t).round() as usize;
        // Whole periods, as near as samples come to them.
        let period_s = std::f64::consts::TAU / batch.omega_rad_s;
        let periods = (batch.record_s / period_s).floor();
        let record_s = if periods >= 1.0 { periods * period_s } else { batch.record_s };
        let record = (record_s / t).round().max(8.0) as usize;
        let waves = [1.0, 3.0].map(|k| Sines::new(k * batch.omega_rad_s * t));
        let mut sums = Matrix5::zeros();
        let mut tables = [[0.0; BLOCK]; 4];
        for from in (settle..settle + record).step_by(BLOCK) {
            let count = BLOCK.min(settle + record - from);
            fill(&waves, from, &mut tables);
            for k in 0..count {
                let row = Vector5::from(basis(&tables, k));
                sums += row * row.transpose();
            }
        }
        let normal = sums.try_inverse().ok_or(RigError::NotPositive {
            quantity: "samples in a period",
            found: period_s / t,
        })?;
        let linear = batch.arm.motor_response(3.0 * batch.omega_rad_s);
        Ok(Self { batch, settle, samples: settle + record, normal, linear, waves })
    }

    /// One experiment by itself.
    fn alone(&self, held: &HeldArm<'_>, seed: u64) -> Result<NoisyRun, RigError> {
        let batch = self.batch;
        let mut motion = HeldMotion::at_rest(held);
        let mut noise = Noise::new(seed, batch.noise_rad);
        let mut sums = [[0.0; BASIS]; 2];
        let (mut tables, mut before) = ([[0.0; BLOCK]; 4], None);
        for k in 0..self.samples {
            if k % BLOCK == 0 {
                fill(&self.waves, k, &mut tables);
            }
            let read = motion.motor_angle_rad() + noise.next();
            let error = batch.amplitude_rad * tables[0][k % BLOCK] - read;
            let before = before.replace(error).unwrap_or(error);
            let rate = (error - before) * batch.controller.derivative_a_s_per_rad();
            let demand =
                batch.controller.proportional_a_per_rad() * error + rate / batch.sample_time_s;
            let current = demand.max(-batch.limit_a).min(batch.limit_a);
            if k >= self.settle {
                let row = basis(&tables, k % BLOCK);
                for (sums, x) in sums.iter_mut().zip([current, read]) {
                    sums.iter_mut().zip(row).for_each(|(sum, b)| *sum += x * b);
                }
            }
            motion.advance(
                batch.arm.motor.torque_constant_nm_per_a() * current,
                batch.sample_time_s,
            )?;
            if (k + 1) % BLOCK == 0 {
                self.check(motion.motor_angle_rad(), k + 1)?;
            }
        }
        Ok(self.estimates(seed, sums, &motion))
    }

    fn check(&self, angle_rad: f64, samples: usize) -> Result<(), RigError> {
        let bound_rad = RUN_AWAY * self.batch.amplitude_rad.max(LEAST_RAD);
        if angle_rad.abs() <= bound_rad {
            return Ok(());
        }
        let time_s = samples as f64 * self.batch.sample_time_s;
        Err(RigError::Unstable { angle_rad, bound_rad, time_s, state: vec![angle_rad] })
    }

    fn estimates(&self, seed: u64, sums: [[f64; BASIS]; 2], motion: &HeldMotion<'_>) -> NoisyRun {
        let omega = self.batch.omega_rad_s;
        let [current, motor] = sums.map(|sums| {
            let x = self.normal * Vector5::from(sums);
            // Re{X·e^{jφ}} = Re X·cos φ − Im X·sin φ.
            [Complex64::new(x[2], -x[1]), Complex64::new(x[4], -x[3])]
        });
        let hold = [1.0, 3.0].map(|k| hold_factor(k * omega, self.batch.sample_time_s));
        let current = [current[0] * hold[0], current[1] * hold[1]];
        let turn = Complex64::from_polar(4.0 / (3.0 * PI), 3.0 * motor[0].arg()) * Complex64::I;
        NoisyRun {
            seed,
            current_a: current,
            motor_rad: motor,
            coulomb_a: ((current[1] - motor[1] / self.linear) / turn).re,
            sticks: motion.sticks(),
            stuck_s: motion.stuck_s(),
        }
    }
}

/// Sines and cosines of both harmonics from sample `from` on.
fn fill(waves: &[Sines; 2], from: usize, tables: &mut [[f64; BLOCK]; 4]) {
    let [s1, c1, s3, c3] = tables;
    waves[0].fill(from, s1, c1);
    waves[1].fill(from, s3, c3);
}

fn basis(tables: &[[f64; BLOCK]; 4], k: usize) -> [f64; BASIS] {
    [1.0, tables[0][k], tables[1][k], tables[2][k], tables[3][k]]
}

/// A sensor's noise.
struct Noise {
    source: Xoshiro256PlusPlus,
    size: f64,
}

impl Noise {
    fn new(seed: u64, size: f64) -> Self {
        Self { source: Xoshiro256PlusPlus::seed_from_u64(seed), size }
    }
    fn next(&mut self) -> f64 {
        let unit: f64 = StandardNormal.sample(&mut self.source);
        unit * self.size
    }
}

/// Experiments side by side. Those that slip move together; those that stick, and those in which
/// something may happen within a sample, move one by one.
struct Group<'a> {
    plan: &'a Plan<'a>,
    seeds: &'a [u64],
    noises: Vec<Noise>,
    motions: Vec<HeldMotion<'a>>,
    /// Of those that slip: states, and room for what is tried.
    y: Vec<[Lanes; 2]>,
    next: Vec<[Lanes; 2]>,
    angle: Lanes,
    velocity: Lanes,
    /// Direction; zero for those that stick.
    sign: Lanes,
    friction: Lanes,
    before: Lanes,
    /// Over the record, by channel: current, angle read.
    sums: [[Lanes; BASIS]; 2],
}

/// Some samples of a group, for whatever vectors the machine has: they change no result, as nothing
/// is contracted or reordered.
struct BatchBlock<'a, 'b> {
    group: &'b mut Group<'a>,
    modes: &'b Modes,
    duration: &'b Duration,
    from: usize,
    noise: &'b [Lanes],
    tables: &'b [[f64; BLOCK]; 4],
}

impl pulp::WithSimd for BatchBlock<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.group.block(self.modes, self.duration, self.from, self.noise, self.tables);
    }
}

impl<'a> Group<'a> {
    fn new(plan: &'a Plan<'a>, held: &'a HeldArm<'a>, seeds: &'a [u64]) -> Self {
        // Empty lanes repeat the first experiment.
        let lanes = || (0..LANES).map(|lane| *seeds.get(lane).unwrap_or(&seeds[0]));
        let motions: Vec<_> = lanes().map(|_| HeldMotion::at_rest(held)).collect();
        let zero = Lanes::splat(0.0);
        let blocks = motions[0].blocks();
        Self {
            plan,
            seeds,
            noises: lanes().map(|seed| Noise::new(seed, plan.batch.noise_rad)).collect(),
            motions,
            y: vec![[zero; 2]; blocks],
            next: vec![[zero; 2]; blocks],
            angle: zero,
            velocity: zero,
            sign: zero,
            friction: zero,
            before: zero,
            sums: [[zero; BASIS]; 2],
        }
    }

    fn run(mut self, modes: &Modes) -> Result<Vec<NoisyRun>, RigError> {
        let Some(duration) = modes.duration(self.plan.batch.sample_time_s) else {
            return Ok(Vec::new());
        };
        let arch = pulp::Arch::new();
        let mut noise = [Lanes::splat(0.0); BLOCK];
        let mut tables = [[0.0; BLOCK]; 4];
        for from in (0..self.plan.samples).step_by(BLOCK) {
            let count = BLOCK.min(self.plan.samples - from);
            for (lane, source) in self.noises.iter_mut().enumerate() {
                noise[..count].iter_mut().for_each(|n| n.0[lane] = source.next());
            }
            fill(&self.plan.waves, from, &mut tables);
            let noise = &noise[..count];
            arch.dispatch(BatchBlock {
                group: &mut self,
                modes,
                duration,
                from,
                noise,
                tables: &tables,
            });
            for angle in self.angle.0 {
                self.plan.check(angle, from + count)?;
            }
        }
        let one = |lane: usize| self.sums.map(|sums| sums.map(|sum| sum.0[lane]));
        let lanes = self.seeds.iter().zip(&self.motions).enumerate();
        Ok(lanes.map(|(i, (seed, m))| self.plan.estimates(*seed, one(i), m)).collect())
    }

    /// The loop over some samples.
    #[inline(always)]
    fn block(
        &mut self,
        modes: &Modes,
        duration: &Duration,
        from: usize,
        noise: &[Lanes],
        tables: &[[f64; BLOCK]; 4],
    ) {
        let Batch { arm, controller, sample_time_s, amplitude_rad, .. } = *self.plan.batch;
        let period = Lanes::splat(sample_time_s);
        let limit = self.plan.batch.limit_a;
        let (proportional, derivative) =
            (controller.proportional_a_per_rad(), controller.derivative_a_s_per_rad());
        for (k, noise) in noise.iter().enumerate() {
            let read = self.angle + *noise;
            let error = Lanes::splat(amplitude_rad * tables[0][k]) - read;
            if from + k == 0 {
                self.before = error;
            }
            // As `Pd`.
            let rate = ((error - self.before) * derivative).map2(period, |a, t| a / t);
            let demand = error * proportional + rate;
            let current = demand.map2(demand, |a, _| a.max(-limit).min(limit));
            self.before = error;
            if from + k >= self.plan.settle {
                let row = basis(tables, k);
                for (sums, x) in self.sums.iter_mut().zip([current, read]) {
                    for (sum, b) in sums.iter_mut().zip(row) {
                        *sum = *sum + x * b;
                    }
                }
            }
            let torque = current * arm.motor.torque_constant_nm_per_a();
            self.sample(modes, duration, torque);
        }
    }

    #[inline(always)]
    fn sample(&mut self, modes: &Modes, duration: &Duration, torque: Lanes) {
        let net = torque - self.friction;
        let moved = step(&duration.slip, &self.y, net, &mut self.next);
        let (start, end) = (self.sign * self.velocity, self.sign * moved.watched);
        let least = start.map2(end, f64::min);
        let clear = least - moved.stray;
        let slowest = clear.0.iter().fold(f64::INFINITY, |m: f64, v| m.min(*v));
        if slowest > 0.0 {
            self.angle = (self.angle + moved.sum) + net * duration.turned;
            self.velocity = moved.watched;
            std::mem::swap(&mut self.y, &mut self.next);
            return;
        }
        let angle = (self.angle + moved.sum) + net * duration.turned;
        for lane in 0..LANES {
            if least.0[lane] > moved.stray.0[lane] {
                self.angle.0[lane] = angle.0[lane];
                self.velocity.0[lane] = moved.watched.0[lane];
                for (y, next) in self.y.iter_mut().zip(&self.next) {
                    y[0].0[lane] = next[0].0[lane];
                    y[1].0[lane] = next[1].0[lane];
                }
            } else {
                self.one(modes, duration, lane, torque.0[lane]);
            }
        }
    }

    /// One experiment moves by itself.
    #[inline(never)]
    fn one(&mut self, modes: &Modes, duration: &Duration, lane: usize, torque: f64) {
        let motion = &mut self.motions[lane];
        let stuck = self.sign.0[lane] == 0.0;
        if !stuck {
            motion.put(self.angle.0[lane], self.velocity.0[lane], self.sign.0[lane]);
            for (mine, y) in motion.y.iter_mut().zip(&self.y) {
                *mine = [y[0].0[lane], y[1].0[lane]];
            }
        }
        motion.sample(modes, duration, torque, stuck);
        let mode = motion.mode();
        self.angle.0[lane] = motion.motor_angle_rad();
        if mode == Mode::Stick {
            self.sign.0[lane] = 0.0;
            if !stuck {
                // Nothing moves in a lane that sticks.
                self.y.iter_mut().for_each(|y| (y[0].0[lane], y[1].0[lane]) = (0.0, 0.0));
                self.velocity.0[lane] = 0.0;
                self.friction.0[lane] = torque;
            }
            return;
        }
        let sign = if mode == Mode::Forward { 1.0 } else { -1.0 };
        self.sign.0[lane] = sign;
        self.friction.0[lane] = self.plan.batch.arm.coulomb.slipping(sign);
        self.velocity.0[lane] = motion.motor_velocity_rad_s();
        for (y, mine) in self.y.iter_mut().zip(&motion.y) {
            (y[0].0[lane], y[1].0[lane]) = (mine[0], mine[1]);
        }
    }
}
