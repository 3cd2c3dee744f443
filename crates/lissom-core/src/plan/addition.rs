//! Information that one more run would add for an arm that has been identified from logs.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::planned_motion::{Reach, groups, rounded};
use super::{PlannedMotion, Wishes};
use crate::information::growing_information;
use crate::plan::thresholds::TRAVEL_LEAST;
use crate::record::{Campaign, Channels, Run, TimeBase, TipQuantity};
use crate::replay::{ModalArm, Parameter, SensorNoise, Window};
use crate::rig::Reference;

/// Phase of the fastest mode in one step of the integration \[rad\].
const STEP_RAD: f64 = 0.25;
/// Step of the finite difference for the speed of a reference, as a share of the sample time.
const DIFFERENCE: f64 = 1e-3;

/// Limits of a further run.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// Largest torque \[N·m\].
    pub torque_nm: f64,
    /// Largest angle of the motor from its start \[rad\].
    pub travel_rad: f64,
    /// Largest deflection of each tip from the motor's line \[rad\].
    pub bend_rad: Vec<f64>,
    /// Sample time of command and log \[s\].
    pub sample_time_s: f64,
}

/// A run that can be added, with its information.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Reference motion of the motor.
    pub motion: PlannedMotion,
    /// Amplitude of the reference \[rad\].
    pub amplitude_rad: f64,
    /// Time logged \[s\].
    pub record_s: f64,
    /// Information on the parameters, the window's own unknowns eliminated.
    pub information: DMatrix<f64>,
}

impl Bounds {
    /// Limits from a campaign: the largest travel of its motor; its current limit less the reserve of [`Wishes`], or its
    /// largest command; and the bending of [`Wishes`], or the largest deflection of its tips. `None` without runs.
    pub fn of(campaign: &Campaign) -> Option<Self> {
        let channels = &campaign.channels;
        let wishes = Wishes::default();
        let constant = channels.command.torque_per_command.unwrap_or(1.0);
        let runs = &campaign.runs;
        let largest = |of: &dyn Fn(&Run) -> f64| runs.iter().map(of).fold(0.0, f64::max);
        let used = largest(&|r| r.command().iter().fold(0.0, |m: f64, u| m.max(u.abs())));
        let reserved = channels.command.limit.map_or(0.0, |l| (1.0 - wishes.current_reserve) * l);
        let bend = |tip: usize| match channels.tips[tip].quantity {
            _ if !channels.tips[tip].calibrated => f64::INFINITY,
            TipQuantity::Acceleration => f64::INFINITY,
            TipQuantity::Angle => wishes.bend_rad.max(largest(&|r| {
                let apart = r.tips()[tip].iter().zip(r.motor()).map(|(t, m)| t - m);
                half_range(apart)
            })),
            TipQuantity::Deflection => {
                wishes.bend_rad.max(largest(&|r| half_range(r.tips()[tip].iter().copied())))
            }
        };
        Some(Self {
            torque_nm: constant * used.max(reserved),
            travel_rad: largest(&|r| half_range(r.motor().iter().copied())),
            bend_rad: (0..channels.tips.len()).map(bend).collect(),
            sample_time_s: runs.iter().map(Run::sample_time_s).reduce(f64::min)?,
        })
    }
}

/// Half of the difference between the highest and the lowest value.
fn half_range(values: impl Iterator<Item = f64>) -> f64 {
    let ends = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = values.fold(ends, |(low, high), v| (low.min(v), high.max(v)));
    if high > low { 0.5 * (high - low) } else { 0.0 }
}

/// All motions that a plan would try, each as large as the limits allow, with the information that the replay gives; empty
/// if friction has more terms than Coulomb and viscous friction.
///
/// The motor is assumed to follow its reference exactly, because the controller is not known. The replay gets the torque
/// that this needs, averaged over each sample.
pub fn additions(
    arm: &ModalArm,
    parameters: &[Parameter],
    channels: &Channels,
    noise: &[SensorNoise],
    bounds: &Bounds,
) -> Vec<Addition> {
    let reach = Reach {
        arm,
        torque_nm: bounds.torque_nm,
        load_nm: load_nm(arm),
        travel_rad: bounds.travel_rad,
        command_time_s: bounds.sample_time_s,
    };
    // The torque against such terms is not a part that grows with the amplitude plus a constant part.
    if !arm.dry_terms.is_empty() {
        return Vec::new();
    }
    if !(bounds.travel_rad > 0.0 && bounds.torque_nm > constant_nm(arm)) {
        return Vec::new();
    }
    // The sine at three times the frequency is for the third harmonic only, and one draw of phases is as good as another.
    let first = |group: Vec<PlannedMotion>| group.into_iter().next();
    let motions = groups(&reach, false).into_iter().filter_map(first);
    let once =
        |m: &PlannedMotion| !matches!(m, PlannedMotion::Multisine { phases, .. } if *phases > 1);
    let motions: Vec<PlannedMotion> = motions.filter(once).collect();
    let addition = |motion: &PlannedMotion| {
        let followed = FollowedPlan::of(arm, motion, bounds.sample_time_s)?;
        let amplitude_rad = rounded(followed.largest(arm, bounds));
        let moves = followed.travel * amplitude_rad;
        if !(moves.is_finite() && moves > TRAVEL_LEAST * noise[0].deviation()) {
            return None;
        }
        let (campaign, window) = followed.record(arm, channels, amplitude_rad)?;
        let samples = window.len() as f64;
        let windows = [window];
        let mut found = growing_information(arm, parameters, &campaign, &windows, noise, samples);
        let information = found.pop()?.pop()?;
        Some(Addition { motion: *motion, amplitude_rad, record_s: motion.stretch_s(), information })
    };
    motions.par_iter().filter_map(addition).collect()
}

/// Largest torque of gravity and torque ripples.
fn load_nm(arm: &ModalArm) -> f64 {
    arm.position_torque().largest_nm()
}

/// Largest torque that does not grow with the amplitude.
fn constant_nm(arm: &ModalArm) -> f64 {
    arm.coulomb_nm + arm.offset_nm.abs() + load_nm(arm)
}

/// A motor that follows a reference of amplitude one, with the torque that this needs.
struct FollowedPlan {
    sample_time_s: f64,
    /// θ and θ̇ at the first sample.
    start: [f64; 2],
    /// θ at each sample, one more than there are torques.
    angle: Vec<f64>,
    /// Largest |θ|.
    travel: f64,
    /// Torque over each sample that grows with the amplitude.
    linear_nm: Vec<f64>,
    /// Mean direction of motion over each sample.
    direction: Vec<f64>,
    /// Largest |θ_i − θ| of each tip.
    bend: Vec<f64>,
}

impl FollowedPlan {
    fn of(arm: &ModalArm, motion: &PlannedMotion, sample_time_s: f64) -> Option<Self> {
        let reference = motion.reference(1.0).ok()?;
        let samples = (motion.stretch_s() / sample_time_s).floor() as usize;
        let fastest = arm.modes.iter().map(|m| m.omega_rad_s).fold(0.0, f64::max);
        let steps = (fastest * sample_time_s / STEP_RAD).ceil().max(1.0) as usize;
        let motor = Driven { reference, difference_s: DIFFERENCE * sample_time_s };
        let mut beam = PlannedBeam::at(arm, motor.at(0.0));
        let start = motor.at(0.0);
        let mut followed = Self {
            sample_time_s,
            start,
            angle: vec![start[0]],
            travel: 0.0,
            linear_nm: Vec::with_capacity(samples),
            direction: Vec::with_capacity(samples),
            bend: vec![0.0; arm.shapes.len()],
        };
        let mut now = start;
        for k in 0..samples {
            let from_s = k as f64 * sample_time_s;
            let step_s = sample_time_s / steps as f64;
            let mut pull_nm = 0.0;
            for i in 0..steps {
                let before = beam.pull_nm();
                beam.step(&motor, from_s + i as f64 * step_s, step_s);
                pull_nm += 0.5 * (before + beam.pull_nm()) / steps as f64;
            }
            let then = motor.at(from_s + sample_time_s);
            let direction = mean_direction(now[1], then[1]);
            let viscous = arm.viscous_nm_s_per_rad[usize::from(direction < 0.0)];
            followed.linear_nm.push(
                arm.inertia_kg_m2 * (then[1] - now[1]) / sample_time_s
                    + viscous * (then[0] - now[0]) / sample_time_s
                    + pull_nm,
            );
            followed.direction.push(direction);
            followed.angle.push(then[0]);
            followed.travel = followed.travel.max(then[0].abs());
            for (most, shape) in followed.bend.iter_mut().zip(&arm.shapes) {
                *most = most.max(beam.bend(shape).abs());
            }
            now = then;
        }
        Some(followed)
    }

    /// The largest amplitude within the limits.
    fn largest(&self, arm: &ModalArm, bounds: &Bounds) -> f64 {
        let torque = self.linear_nm.iter().fold(0.0, |m: f64, t| m.max(t.abs()));
        let left_nm = bounds.torque_nm - constant_nm(arm);
        let bends = self.bend.iter().zip(&bounds.bend_rad);
        let bend = bends.map(|(one, most)| most / one).fold(f64::INFINITY, f64::min);
        (left_nm / torque).min(bounds.travel_rad / self.travel).min(bend)
    }

    /// The run in the form that the replay needs: only its command and, with gravity, its angle are used.
    fn record(
        &self,
        arm: &ModalArm,
        channels: &Channels,
        amplitude: f64,
    ) -> Option<(Campaign, Window)> {
        let constant = channels.command.torque_per_command.unwrap_or(1.0);
        let motor: Vec<f64> = self.angle.iter().map(|angle| amplitude * angle).collect();
        let position = arm.position_torque();
        let load = |angle: f64| position.torque_nm(angle);
        let torque = |((linear, direction), w): ((&f64, &f64), &[f64])| {
            let load = 0.5 * (load(w[0]) + load(w[1]));
            (amplitude * linear + arm.coulomb_nm * direction + arm.offset_nm + load) / constant
        };
        let torques = self.linear_nm.iter().zip(&self.direction).zip(motor.windows(2));
        let command: Vec<f64> = torques.map(torque).collect();
        let samples = command.len();
        let time = TimeBase::uniform(0.0, self.sample_time_s);
        let tips = vec![vec![0.0; samples]; channels.tips.len()];
        let run = Run::new("", time, command, motor[..samples].to_vec(), tips).ok()?;
        let start = std::iter::repeat_n(self.start, 1 + arm.modes.len());
        let window = Window {
            run: 0,
            samples: 0..=samples - 1,
            start: start.flatten().map(|v| amplitude * v).collect(),
            zeros: vec![0.0; channels.tips.len()],
        };
        Some((Campaign::new(channels.clone(), vec![run]).ok()?, window))
    }
}

/// Mean of sgn θ̇ over a sample in which the speed goes from one value to the other.
fn mean_direction(from: f64, to: f64) -> f64 {
    let sum = from.abs() + to.abs();
    if sum > 0.0 { (from + to) / sum } else { 0.0 }
}

/// A motor whose angle is a reference.
struct Driven {
    reference: Reference,
    difference_s: f64,
}

impl Driven {
    /// θ and θ̇.
    fn at(&self, time_s: f64) -> [f64; 2] {
        let h = self.difference_s;
        let rate =
            (self.reference.value(time_s + h) - self.reference.value(time_s - h)) / (2.0 * h);
        [self.reference.value(time_s), rate]
    }
}

/// The modes of the beam on a motor that follows a reference.
struct PlannedBeam<'a> {
    arm: &'a ModalArm,
    points: Option<DMatrix<f64>>,
    motor: [f64; 2],
    angles: DVector<f64>,
    rates: DVector<f64>,
}

impl<'a> PlannedBeam<'a> {
    /// Undeflected.
    fn at(arm: &'a ModalArm, motor: [f64; 2]) -> Self {
        let n = arm.modes.len();
        let all = |value| DVector::from_element(n, value);
        Self {
            arm,
            points: arm.points_in_modes(),
            motor,
            angles: all(motor[0]),
            rates: all(motor[1]),
        }
    }

    /// Torque against the motor: `Σ k_j·(θ − ψ_j) + (k_j·d_j/ω_j²)·(θ̇ − ψ̇_j)`.
    fn pull_nm(&self) -> f64 {
        let [angle, rate] = self.motor;
        let one = |(j, m): (usize, &crate::replay::Oscillator)| {
            let damping = m.within_per_s / m.omega_rad_s.powi(2);
            m.stiffness_nm_per_rad * (angle - self.angles[j] + damping * (rate - self.rates[j]))
        };
        self.arm.modes.iter().enumerate().map(one).sum()
    }

    /// θ_i − θ of a tip.
    fn bend(&self, shape: &[f64]) -> f64 {
        shape.iter().zip(&self.angles).map(|(r, psi)| r * (psi - self.motor[0])).sum()
    }

    fn accelerations(
        &self,
        motor: [f64; 2],
        angles: &DVector<f64>,
        rates: &DVector<f64>,
    ) -> DVector<f64> {
        let own = DVector::from_fn(angles.len(), |j, _| {
            let m = &self.arm.modes[j];
            m.omega_rad_s.powi(2) * (motor[0] - angles[j]) + m.within_per_s * (motor[1] - rates[j])
                - m.grounded_per_s * rates[j]
        });
        match &self.points {
            Some(points) => own - points * rates,
            None => own,
        }
    }

    /// A step of the classical Runge-Kutta method.
    fn step(&mut self, motor: &Driven, time_s: f64, h: f64) {
        let (middle, end) = (motor.at(time_s + 0.5 * h), motor.at(time_s + h));
        let (x, v) = (&self.angles, &self.rates);
        let a1 = self.accelerations(self.motor, x, v);
        let v2 = v + &a1 * (0.5 * h);
        let a2 = self.accelerations(middle, &(x + v * (0.5 * h)), &v2);
        let v3 = v + &a2 * (0.5 * h);
        let a3 = self.accelerations(middle, &(x + &v2 * (0.5 * h)), &v3);
        let v4 = v + &a3 * h;
        let a4 = self.accelerations(end, &(x + &v3 * h), &v4);
        self.angles = x + (v + (v2 + v3) * 2.0 + v4) * (h / 6.0);
        self.rates = v + (a1 + (a2 + a3) * 2.0 + a4) * (h / 6.0);
        self.motor = end;
    }
}
