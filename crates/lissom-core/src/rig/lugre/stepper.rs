//! Steps of an arm on bristles, as long as a tolerance allows.

use super::linear_steps::{ArmSteps, HALVINGS, is_velocity};
use crate::arm::Arm;
use crate::drive::LuGre;
use crate::friction::{BristleStep, Bristles, LinearStep, Place};
use crate::load::PositionTorque;

/// Largest share of a motion by which bristles bend while the joint counts as sliding.
const HOLDS: f64 = 0.1;
/// Distance of two halves from the whole step over the error of the halves, 2² − 1: where the motor reverses, the
/// velocity is taken for linear, and gravity for linear in time throughout, both of order 2. Elsewhere the method is of order 4, and the error a fifth of this estimate.
const HALVES: f64 = 3.0;
/// Largest exponent by which bristles forget over a step what they were bent by while they are counted with the arm, as a
/// spring: stiff bristles then limit no step in which they only hold the joint.
const SPRUNG: f64 = 0.3;
/// Errors below this share of the tolerance let the next step be twice as long, which makes them 2⁵ times as large.
const GROWS: f64 = 1.0 / 64.0;
/// Share of the tolerance, in terms of the friction level, within which friction and motion of a step agree.
const AGREES: f64 = 1e-3;
/// The least such share: some times rounding.
const AGREES_LEAST: f64 = 1e-13;
/// Most steps computed for one time: some seconds of processor time.
const STEPS_MOST: usize = 10_000_000;
/// Most halvings of a step that is halved once more for its error.
const MOST: usize = HALVINGS - 1;

/// State of the arm and deflection of its bristles.
#[derive(Debug, Clone)]
pub(super) struct Bristling {
    pub(super) x: Vec<f64>,
    pub(super) z: f64,
}

/// What a time under a held torque leads to.
#[derive(Debug, Clone)]
pub(super) struct FollowedTime {
    pub(super) end: Bristling,
    pub(super) steps: usize,
    /// Time in presliding \[s\].
    pub(super) held_s: f64,
    /// The longest step that the tolerance allowed \[s\].
    pub(super) step_s: f64,
}

/// Where a motion could not be followed: the time passed and the step that was tried \[s\].
pub(super) type Stopped = (f64, f64);

/// An arm, its law and the tolerance of its steps.
#[derive(Debug, Clone)]
pub(super) struct Stepper {
    pub(super) law: LuGre,
    pub(super) tolerance: f64,
    pub(super) load: PositionTorque,
    bristles: Bristles,
    /// The arm alone, and held by its bristles as by a spring.
    alone: ArmSteps,
    sprung: ArmSteps,
    /// What errors are compared with beside the state itself: an angle \[rad\] and a velocity \[rad/s\].
    scale: [f64; 2],
}

impl Stepper {
    pub(super) fn new(arm: &Arm, law: LuGre, tolerance: f64) -> Self {
        let bristles = Bristles {
            stiffness_nm_per_rad: law.stiffness_nm_per_rad(),
            damping_nm_s_per_rad: law.damping_nm_s_per_rad(),
        };
        let bend = law.deflection_most_rad();
        let swing = (bristles.stiffness_nm_per_rad / arm.motor.inertia_kg_m2()).sqrt();
        let scale = [bend, bend * swing];
        let spring = [bristles.stiffness_nm_per_rad, bristles.damping_nm_s_per_rad];
        let (alone, sprung) = (ArmSteps::new(arm, [0.0; 2]), ArmSteps::new(arm, spring));
        Self { law, tolerance, load: PositionTorque::default(), bristles, alone, sprung, scale }
    }

    /// Time in which the motor swings by 1 rad on its bristles \[s\].
    pub(super) fn swing_s(&self) -> f64 {
        self.scale[0] / self.scale[1]
    }

    /// From `start` over `duration_s` under a torque, the first step about `step_s` long.
    ///
    /// Each step is the time halved some number of times and is made twice: whole, and as two halves. These are kept
    /// where both agree; otherwise the first half is the next whole step to be tried.
    pub(super) fn follow(
        &mut self,
        start: &Bristling,
        torque_nm: f64,
        duration_s: f64,
        step_s: f64,
    ) -> Result<FollowedTime, Stopped> {
        self.alone.begin(duration_s);
        self.sprung.begin(duration_s);
        let all = 1_u64 << MOST;
        let seconds = |parts: u64| duration_s * (parts as f64 / all as f64);
        let mut halvings = (duration_s / step_s).log2().ceil().clamp(0.0, MOST as f64) as usize;
        let mut found = FollowedTime { end: start.clone(), steps: 0, held_s: 0.0, step_s: 0.0 };
        let (mut done, mut computed, mut whole) = (0, 0, None);
        while done < all {
            // A step begins at a multiple of its length.
            while done % (all >> halvings) != 0 {
                halvings += 1;
            }
            let (parts, step_s) = (all >> halvings, seconds(all >> halvings));
            let now = &found.end;
            let tried = whole.take().or_else(|| self.step(now, torque_nm, halvings));
            let half = self.step(now, torque_nm, halvings + 1);
            let end = half.as_ref().and_then(|half| self.step(half, torque_nm, halvings + 1));
            computed += 3;
            let error = match (&tried, &end) {
                (Some(tried), Some(end)) => self.error(now, tried, end),
                _ => f64::INFINITY,
            };
            match (half, end) {
                (Some(half), Some(end)) if error <= 1.0 => {
                    let held = [&half, &end].iter().filter(|n| self.holds(n)).count();
                    found.held_s += 0.5 * step_s * held as f64;
                    found.steps += 2;
                    found.end = end;
                    done += parts;
                    let grows = error < GROWS;
                    found.step_s = found.step_s.max(if grows { 2.0 * step_s } else { step_s });
                    halvings = halvings.saturating_sub(usize::from(grows));
                }
                (half, _) if halvings < MOST && computed < STEPS_MOST => {
                    halvings += 1;
                    whole = half;
                }
                _ => return Err((seconds(done), step_s)),
            }
            if computed >= STEPS_MOST && done < all {
                return Err((seconds(done), step_s));
            }
        }
        if self.resolves(&found.end) { Ok(found) } else { Err((duration_s, found.step_s)) }
    }

    /// One step; `None` where friction and motion do not come to agree.
    fn step(&mut self, now: &Bristling, torque_nm: f64, halvings: usize) -> Option<Bristling> {
        let (motor, len) = (now.x[0], now.x.len());
        let Bristles { stiffness_nm_per_rad: stiffness, damping_nm_s_per_rad: damping } =
            self.bristles;
        let mut step = self.sprung.step(halvings)?;
        let level = self.law.level_nm(Place::of_velocity(0.0, now.x[1], 0.0));
        let mut spring = [stiffness, damping];
        if stiffness * now.x[1].abs() * step.duration_s > SPRUNG * level {
            step = self.alone.step(halvings)?;
            spring = [0.0; 2];
        }
        // Counted from the motor's angle: short steps change it by less than its rounding.
        let mut from = now.x.clone();
        (0..len).filter(|i| !is_velocity(*i, len)).for_each(|i| from[i] -= motor);
        let mut x = vec![0.0; len];
        let (load, growth) = over(&self.load, now, step.duration_s);
        step.apply(&from, torque_nm - load - spring[0] * now.z, &mut x);
        x.iter_mut().zip(&step.ramp).for_each(|(x, ramp)| *x -= growth * ramp);
        let linear = LinearStep {
            duration_s: step.duration_s,
            start: [motor, now.x[1]],
            free: [x[0], x[1]],
            push: [step.push[0], step.push[1]],
            ramp: [step.ramp[0], step.ramp[1]],
            spring,
        };
        let agree = (AGREES * self.tolerance).max(AGREES_LEAST);
        let law = &self.law;
        let level = |at| law.level_nm(at);
        let solved = BristleStep::solve(linear, &self.bristles, now.z, agree, level);
        if !solved.agrees {
            return None;
        }
        let friction = &solved.found;
        let (begins, rise) = (friction.from + friction.beyond, friction.to - friction.from);
        for (i, x) in x.iter_mut().enumerate() {
            *x -= begins * step.push[i] + rise * step.ramp[i];
            if !is_velocity(i, len) {
                *x += motor;
            }
        }
        Some(Bristling { x, z: friction.z })
    }

    /// Error of two halves by their distance from the whole, over the tolerance: the largest of the state's numbers.
    fn error(&self, now: &Bristling, whole: &Bristling, halves: &Bristling) -> f64 {
        let len = now.x.len();
        let [angle, velocity] = self.scale;
        let share = |a: f64, b: f64, before: f64, scale: f64| {
            (a - b).abs() / (HALVES * self.tolerance * (before.abs().max(b.abs()) + scale))
        };
        let bent = share(whole.z, halves.z, now.z, angle);
        let states = whole.x.iter().zip(&halves.x).zip(&now.x).enumerate();
        states.fold(bent, |most, (i, ((a, b), before))| {
            let error = share(*a, *b, *before, if is_velocity(i, len) { velocity } else { angle });
            // What is no number is no small error.
            if error <= most { most } else { error }
        })
    }

    /// Whether bristles bend by enough of the motion to count as holding the joint.
    fn holds(&self, now: &Bristling) -> bool {
        let v = now.x[1];
        self.law.bristle_rate(v, now.z).abs() >= HOLDS * v.abs()
    }

    /// Whether the state is finite, and its angles so small that doubles tell apart what the bristles bend by.
    fn resolves(&self, now: &Bristling) -> bool {
        let len = now.x.len();
        let mut states = now.x.iter().enumerate();
        let small = |i, x: f64| is_velocity(i, len) || x.abs() * f64::EPSILON < self.scale[0];
        now.z.is_finite() && states.all(|(i, x)| x.is_finite() && small(i, *x))
    }
}

/// What torques of position take of the motor at the beginning of a step, and what it grows by to the angle that the motor's
/// velocity leads to \[N·m\].
fn over(load: &PositionTorque, now: &Bristling, duration_s: f64) -> (f64, f64) {
    let begins = load.torque_nm(now.x[0]);
    (begins, load.torque_nm(now.x[0] + now.x[1] * duration_s) - begins)
}
