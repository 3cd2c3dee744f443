//! The replayed arm on bristles: steps short enough for what they do, and their tangents.

use super::bent::Bent;
use super::lanes::LANES;
use super::motion::{Motion, Mover, Torque};
use super::parameter::Parameter;
use super::tangents::Rubbed;
use crate::friction::{
    Bending, BristleStep, Bristled, Bristles, DAMPING, DEFLECTION, INPUTS, LEVEL, LinearStep, Mode,
    Place, SHARE_PER_STEP, STIFFNESS, VELOCITY,
};

/// Largest phase of the motor's swing on its bristles over a step \[rad\].
const TURN: f64 = 0.2;
/// Largest exponent by which bristles forget over a step what they were bent by, while that counts.
const FORGETS: f64 = 0.3;
/// It counts where they are bent otherwise than in steady motion by this share.
const SETTLED: f64 = 1e-3;
/// Bristles that forget faster than the motor swings on them by this factor only follow.
const FOLLOWS: f64 = 5.0;
/// Share of the level within which friction at the end of a step and the motion there agree.
const AGREE: f64 = 1e-13;
/// Share of the level that bristles carry once the joint counts as slipping.
const HOLDS: f64 = 0.9;

/// How a step's inputs change: the motor's angle and velocity at both ends, the deflection at the beginning,
/// and what the law's own numbers change the levels, σ0 and σ1 by.
#[derive(Debug, Clone, Copy, Default)]
struct Change {
    start: [f64; 2],
    end: [f64; 2],
    z: f64,
    level: [f64; 3],
    stiffness: f64,
    damping: f64,
}

/// What these do to friction at the beginning, to its rise over the step and to the deflection at its end.
#[derive(Debug, Clone, Copy, Default)]
struct Answer {
    from: f64,
    rise: f64,
    z: f64,
}

impl Answer {
    fn numbers(self) -> [f64; 3] {
        [self.from, self.rise, self.z]
    }
}

impl<const D: usize> Mover<D> {
    /// Bent as in steady motion, with derivatives by the parameters and the initial state, which follow these.
    pub(super) fn bent_steadily(&self, x: &[f64; D], unknowns: usize) -> Bent {
        let Some(bristles) = &self.friction.terms.bristles else { return Bent::default() };
        let place = place(x[0], x[1]);
        let z = place.sign * self.friction.level(place) / bristles.stiffness_nm_per_rad;
        let packs = unknowns.div_ceil(LANES);
        let mut by = vec![[0.0; LANES]; packs];
        let mut put = |k: usize, slope: f64| {
            by[k / LANES][k % LANES] = place.sign * slope / bristles.stiffness_nm_per_rad;
        };
        if unknowns > 0 {
            let slopes = self.friction.level_slopes(place);
            slopes.iter().enumerate().for_each(|(i, slope)| put(unknowns - D + i, *slope));
            for (k, own) in &self.columns.friction {
                match own {
                    Some(Parameter::BristleStiffness) => put(*k, -z.abs()),
                    Some(own) => put(*k, self.friction.level_by(*own, place)),
                    None => {}
                }
            }
        }
        Bent { z, by, own: vec![[[0.0; LANES]; 3]; packs] }
    }

    /// Moves on over a prepared piece, in parts as short as the bristles ask for.
    pub(super) fn over_bristles(
        &self,
        motion: &mut Motion<D>,
        bristles: &Bristles,
        piece: usize,
        torque: Torque,
    ) {
        let halvings = self.halvings();
        let all = 1_usize << halvings;
        let share = |parts: usize| parts as f64 / all as f64;
        let mut done = 0;
        while done < all {
            let now = torque.part(share(done), 1.0).from;
            let fits = |h: &usize| {
                let duration_s = self.pieces[piece + h][2].duration_s;
                done % (all >> h) == 0
                    && duration_s <= self.bristles_step_s(motion, bristles, now, duration_s)
            };
            let halved = (0..halvings).find(fits).unwrap_or(halvings);
            let next = done + (all >> halved);
            let part = torque.part(share(done), share(next));
            self.bends(motion, bristles, piece + halved, part);
            done = next;
        }
    }

    /// Longest step within `within_s` over which what bristles do is smooth.
    fn bristles_step_s(
        &self,
        motion: &Motion<D>,
        bristles: &Bristles,
        torque: f64,
        within_s: f64,
    ) -> f64 {
        let at = place(motion.x[0], motion.x[1]);
        let rates = &self.phases.slip[at.direction()];
        let pull: f64 = rates.a[1].iter().zip(&motion.x).map(|(a, x)| a * x).sum();
        let friction = self.bristle_torque(motion);
        let acceleration = (pull + rates.b[1] * (torque - friction)).abs();
        let (level, sigma) = (self.friction.level(at), bristles.stiffness_nm_per_rad);
        let swing = (sigma * rates.b[1]).sqrt();
        let (slow, fast) =
            ((at.speed - acceleration * within_s).max(0.0), at.speed + acceleration * within_s);
        let mut most = f64::INFINITY;
        if sigma * slow / level < FOLLOWS * swing {
            most = TURN / swing;
        }
        if (motion.bristles.z - at.sign * level / sigma).abs() > SETTLED * level / sigma {
            most = most.min(FORGETS * level / (sigma * fast));
        }
        if let Some(near) = self.friction.terms.near_rest.filter(|n| n.acts_at(slow)) {
            most = most.min(SHARE_PER_STEP * near.speed_rad_s / acceleration);
        }
        let turns =
            self.friction.terms.ripples.iter().map(|r| SHARE_PER_STEP / (r.per_rad * fast).abs());
        turns.fold(most, f64::min)
    }

    /// Friction's torque now.
    pub(super) fn bristle_torque(&self, motion: &Motion<D>) -> f64 {
        self.bending_now(motion).map_or(0.0, |b| b.now()) + self.friction.offset
    }

    /// Its derivatives now by the motor's angle and velocity and by the deflection.
    pub(super) fn bristle_slopes(&self, motion: &Motion<D>) -> ([f64; 2], f64) {
        let Some(bending) = self.bending_now(motion) else { return ([0.0; 2], 0.0) };
        let by = bending.slopes_now();
        let level = self.friction.level_slopes(place(motion.x[0], motion.x[1]));
        let slopes = [by[LEVEL] * level[0], by[VELOCITY] + by[LEVEL] * level[1]];
        (slopes, by[DEFLECTION])
    }

    /// Its derivative now by a parameter of its own, the deflection as it is.
    pub(super) fn bristle_torque_by(&self, p: Parameter, motion: &Motion<D>) -> f64 {
        let Some(bending) = self.bending_now(motion) else { return 0.0 };
        let by = bending.slopes_now();
        match p {
            Parameter::Offset => 1.0,
            Parameter::BristleStiffness => by[STIFFNESS],
            Parameter::BristleDamping => by[DAMPING],
            _ => by[LEVEL] * self.friction.level_by(p, place(motion.x[0], motion.x[1])),
        }
    }

    fn bending_now(&self, motion: &Motion<D>) -> Option<Bending<f64>> {
        self.friction.terms.bristles.as_ref().map(|b| self.bending(motion, b))
    }

    /// A step of no length.
    fn bending(&self, motion: &Motion<D>, bristles: &Bristles) -> Bending<f64> {
        let level = self.friction.level(place(motion.x[0], motion.x[1]));
        Bending {
            velocity: [motion.x[1]; 3],
            z: motion.bristles.z,
            level: [level; 3],
            stiffness: bristles.stiffness_nm_per_rad,
            damping: bristles.damping_nm_s_per_rad,
        }
    }

    /// Over one part.
    fn bends(&self, motion: &mut Motion<D>, bristles: &Bristles, piece: usize, torque: Torque) {
        let direction = place(motion.x[0], motion.x[1]).direction();
        let transition = &self.pieces[piece][direction];
        let own = &transition.own;
        let change = torque.to - torque.from;
        let offset = self.friction.offset;
        let alone = own.apply(&motion.x, torque.from - offset, change);
        let linear = LinearStep {
            duration_s: transition.duration_s,
            start: [motion.x[0], motion.x[1]],
            free: [alone[0] - motion.x[0], alone[1]],
            push: [own.push[0], own.push[1]],
            ramp: [own.ramp[0], own.ramp[1]],
            spring: [0.0; 2],
        };
        let level = |at| self.friction.level(at);
        let step = BristleStep::solve(linear, bristles, motion.bristles.z, AGREE, level);
        let from = step.found.from + step.found.beyond;
        let rise = step.found.to - step.found.from;
        let net = torque.from - offset - from;
        motion.tangents.over(transition, &motion.x, net, change - rise);
        if !motion.tangents.is_empty() {
            self.bend_tangents(motion, &step, (&own.push, &own.ramp), torque);
        }
        motion.x = own.apply(&motion.x, net, change - rise);
        motion.bristles.z = step.found.z;
        motion.rub(offset + from + 0.5 * rise, step.linear.duration_s);
        let carried = (bristles.stiffness_nm_per_rad * motion.bristles.z).abs();
        if carried < HOLDS * step.bending.level[2] {
            motion.stuck_s += step.linear.duration_s;
        }
        motion.mode = if motion.x[1] < 0.0 { Mode::Backward } else { Mode::Forward };
    }

    /// Tangents over a step; those of the arm's own matrices and of a steady torque are made already.
    fn bend_tangents(
        &self,
        motion: &mut Motion<D>,
        step: &BristleStep,
        (push, ramp): (&[f64; D], &[f64; D]),
        torque: Torque,
    ) {
        if let Some(k) = self.columns.lag
            && torque.by_lag.iter().any(|b| *b != 0.0)
        {
            motion.tangents.add(k, torque.by_lag[0], push);
            motion.tangents.add(k, torque.by_lag[1] - torque.by_lag[0], ramp);
        }
        let slopes = self.step_slopes(step);
        let one = |change: Change| slopes.answer(step, &change);
        let unit = |at: usize| [0, 1].map(|i| f64::from(u8::from(i == at)));
        let start = |at: usize| one(Change { start: unit(at), ..Change::default() });
        let end = |at: usize| one(Change { end: unit(at), ..Change::default() });
        let by_z = one(Change { z: 1.0, ..Change::default() });
        let to = [start(0), start(1), end(0), end(1), by_z].map(Answer::numbers);
        let Bent { by, own, .. } = &mut motion.bristles;
        own.fill([[0.0; LANES]; 3]);
        for (k, p) in self.columns.friction.iter().filter_map(|(k, own)| Some((*k, (*own)?))) {
            let answer = match p {
                Parameter::Offset => {
                    let end = [0, 1].map(|i| -step.linear.push[i]);
                    let change = one(Change { end, ..Change::default() });
                    Answer { from: change.from + 1.0, ..change }
                }
                Parameter::BristleStiffness => one(Change { stiffness: 1.0, ..Change::default() }),
                Parameter::BristleDamping => one(Change { damping: 1.0, ..Change::default() }),
                _ => {
                    let level = step.places.map(|at| self.friction.level_by(p, at));
                    one(Change { level, ..Change::default() })
                }
            };
            for (lanes, number) in own[k / LANES].iter_mut().zip(answer.numbers()) {
                lanes[k % LANES] = number;
            }
        }
        motion.tangents.rubbed(&Rubbed { to, push, ramp }, own, by);
    }

    fn step_slopes(&self, step: &BristleStep) -> StepSlopes {
        let by = step.bending.slopes(step.linear.duration_s);
        let level = step.places.map(|at| self.friction.level_slopes(at));
        let mut slopes = StepSlopes { by, level, system: [[1.0, 0.0], [0.0, 1.0]] };
        // What friction at the end, and its mean beyond both ends, do to themselves by way of the end.
        for (column, torque) in [step.linear.ramp, step.linear.push].into_iter().enumerate() {
            let end = torque.map(|t| -t);
            let inputs = slopes.inputs(step, &Change { end, ..Change::default() });
            slopes.system[0][column] -= dot(&slopes.by.to, &inputs);
            slopes.system[1][column] -= dot(&slopes.by.beyond, &inputs);
        }
        slopes
    }
}

/// Derivatives of what a step does by its inputs, and the equations for what it does to itself.
struct StepSlopes {
    by: Bristled<[f64; INPUTS]>,
    level: [[f64; 2]; 3],
    system: [[f64; 2]; 2],
}

impl StepSlopes {
    /// Changes of the inputs of a bending.
    fn inputs(&self, step: &BristleStep, change: &Change) -> [f64; INPUTS] {
        let h = step.linear.duration_s;
        let ([angle, velocity], [end_angle, end_velocity]) = (change.start, change.end);
        let middle = 1.5 * (end_angle - angle) / h - 0.25 * (velocity + end_velocity);
        let halfway = angle + h / 24.0 * (5.0 * velocity + 8.0 * middle - end_velocity);
        let places = [[angle, velocity], [halfway, middle], [end_angle, end_velocity]];
        let level = |i: usize| {
            change.level[i] + self.level[i][0] * places[i][0] + self.level[i][1] * places[i][1]
        };
        [
            velocity,
            middle,
            end_velocity,
            change.z,
            level(0),
            level(1),
            level(2),
            change.stiffness,
            change.damping,
        ]
    }

    /// What a change does, the end's being that without a change of friction.
    fn answer(&self, step: &BristleStep, change: &Change) -> Answer {
        let first = dot(&self.by.from, &self.inputs(step, change));
        // Friction that begins otherwise, and ends as it did.
        let end =
            [0, 1].map(|i| change.end[i] - first * (step.linear.push[i] - step.linear.ramp[i]));
        let mut inputs = self.inputs(step, &Change { end, ..*change });
        let right = [dot(&self.by.to, &inputs), dot(&self.by.beyond, &inputs)];
        let [[a, b], [c, d]] = self.system;
        let whole = a * d - b * c;
        let to = (right[0] * d - b * right[1]) / whole;
        let beyond = (a * right[1] - c * right[0]) / whole;
        let end = [0, 1].map(|i| end[i] - to * step.linear.ramp[i] - beyond * step.linear.push[i]);
        inputs = self.inputs(step, &Change { end, ..*change });
        Answer { from: first + beyond, rise: to - first, z: dot(&self.by.z, &inputs) }
    }
}

fn dot(a: &[f64; INPUTS], b: &[f64; INPUTS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn place(angle: f64, velocity: f64) -> Place {
    Place::of_velocity(angle, velocity, 0.0)
}
