//! A joint on bristles over a step in which everything but friction is linear.

use super::bristles::{Bending, Bristled, Bristles};
use super::place::Place;

/// Most rounds until friction over a step and the motion at its end agree.
const ROUNDS: usize = 60;
/// Rounds after which changes are halved: a reversal within the step is a kink, about which whole changes may alternate.
const WHOLE: usize = 8;

/// What a step does without friction, and what torques on the joint do over it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinearStep {
    pub(crate) duration_s: f64,
    /// Angle and velocity at the beginning \[rad, rad/s\].
    pub(crate) start: [f64; 2],
    /// Change of the angle \[rad\] and velocity at the end \[rad/s\], both without friction.
    pub(crate) free: [f64; 2],
    /// Responses of angle and velocity at the end to a constant torque of one.
    pub(crate) push: [f64; 2],
    /// The same to a torque that grows from zero to one.
    pub(crate) ramp: [f64; 2],
    /// What of the bristles is in these already, as a spring \[N·m/rad\] and a damper \[N·m·s/rad\] that hold the joint
    /// as the bristles do at the beginning; zero where they are not.
    pub(crate) spring: [f64; 2],
}

/// A step with bristles: friction is taken for linear in time, and its mean is that of a parabola.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BristleStep {
    pub(crate) linear: LinearStep,
    /// Beginning, middle and end.
    pub(crate) places: [Place; 3],
    pub(crate) bending: Bending,
    /// Friction and deflection; friction without that of the [`LinearStep`]'s spring.
    pub(crate) found: Bristled,
    /// Whether friction and motion agree.
    pub(crate) agrees: bool,
}

impl BristleStep {
    /// Finds friction over a step from the deflection `z`. `level` is the torque of steady motion at a place, without
    /// its sign. Rounds end when they change friction by less than `agree` times the level and σ1·v.
    ///
    /// Newton's method on two unknowns, friction at the end and the excess of its mean, with the slopes that they
    /// have where the level is constant: as exact as that in presliding, however stiff the bristles are.
    pub(crate) fn solve(
        linear: LinearStep,
        bristles: &Bristles,
        z: f64,
        agree: f64,
        level: impl Fn(Place) -> f64,
    ) -> Self {
        let [angle, velocity] = linear.start;
        let first = Place::of_velocity(angle, velocity, linear.free[0]);
        let bending = Bending {
            velocity: [velocity; 3],
            z,
            level: [level(first); 3],
            stiffness: bristles.stiffness_nm_per_rad,
            damping: bristles.damping_nm_s_per_rad,
        };
        let begins = bending.now() - linear.spring[0] * z - linear.spring[1] * velocity;
        let found = Bristled { from: begins, to: begins, beyond: 0.0, middle_z: z, z };
        let mut step = Self { linear, places: [first; 3], bending, found, agrees: false };
        let (mut to, mut beyond) = (begins, 0.0);
        for round in 0..ROUNDS {
            step.friction_ends_at(to, begins, beyond, &level);
            let off = [step.found.to - to, step.found.beyond - beyond];
            let change = step.newton(off);
            let share = if round < WHOLE { 1.0 } else { 0.5 };
            to += share * change[0];
            beyond += share * change[1];
            let fastest = step.bending.velocity.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let most = agree * (step.bending.level[0] + bristles.damping_nm_s_per_rad * fastest);
            step.agrees = off[0].abs() <= most && off[1].abs() <= most;
            // Anything that is no number ends it, too.
            if step.agrees || !(off[0].is_finite() && off[1].is_finite()) {
                break;
            }
        }
        step
    }

    /// Change of the angle and velocity at the end, where friction rises from `begins + beyond` to `to + beyond`.
    fn end(&self, to: f64, begins: f64, beyond: f64) -> [f64; 2] {
        let (from, rise) = (begins + beyond, to - begins);
        let LinearStep { free, push, ramp, .. } = &self.linear;
        [0, 1].map(|i| free[i] - from * push[i] - rise * ramp[i])
    }

    /// Bends the bristles by the motion under this friction.
    fn friction_ends_at(
        &mut self,
        to: f64,
        begins: f64,
        beyond: f64,
        level: impl Fn(Place) -> f64,
    ) {
        let [angle, velocity] = self.linear.start;
        let h = self.linear.duration_s;
        let [travel, last] = self.end(to, begins, beyond);
        // The velocity halfway is what the distance asks for, a parabola in time.
        let middle = 1.5 * travel / h - 0.25 * (velocity + last);
        let halfway = h / 24.0 * (5.0 * velocity + 8.0 * middle - last);
        self.places = [
            Place::of_velocity(angle, velocity, middle),
            Place::of_velocity(angle + halfway, middle, last),
            Place::of_velocity(angle + travel, last, middle),
        ];
        self.bending.velocity = [velocity, middle, last];
        self.bending.level = self.places.map(level);
        self.found = self.bending.over(h);
        let [stiffness, damping] = self.linear.spring;
        let (z, found) = (self.bending.z, &mut self.found);
        let held = |turned: f64, velocity: f64| stiffness * (z + turned) + damping * velocity;
        let mean = held((4.0 * halfway + travel) / 6.0, travel / h);
        let ends = [held(0.0, velocity), held(travel, last)];
        found.from -= ends[0];
        found.to -= ends[1];
        found.beyond -= mean - 0.5 * (ends[0] + ends[1]);
    }

    /// What to change the two unknowns by where they are off by `off`.
    fn newton(&self, off: [f64; 2]) -> [f64; 2] {
        let (b, h) = (&self.bending, self.linear.duration_s);
        let (stiffness, damping) = (b.stiffness, b.damping);
        // Change of the deflection per travel, 1 − σ0·z·sgn(v)/g, halfway and at the end.
        let bends = |at: usize, z: f64| 1.0 - stiffness * z * self.places[at].sign / b.level[at];
        let (halfway, last) = (bends(1, self.found.middle_z), bends(2, self.found.z));
        let forgets = stiffness * b.velocity[2].abs() / b.level[2];
        let answers = |torque: [f64; 2]| {
            let [angle, velocity] = torque.map(|t| -t);
            let middle = 0.5 * angle - 0.125 * h * velocity;
            let (z, middle_z) = (last * angle, halfway * middle);
            let [held, damped] = self.linear.spring;
            let to = stiffness * z + damping * (last * velocity - forgets * z)
                - held * angle
                - damped * velocity;
            let mean =
                (4.0 * (stiffness * middle_z - held * middle) + stiffness * z - held * angle) / 6.0
                    + (damping * z - damped * angle) / h;
            [to, mean - 0.5 * to]
        };
        let [a, c] = answers(self.linear.ramp);
        let [b, d] = answers(self.linear.push);
        let (a, d) = (1.0 - a, 1.0 - d);
        let (b, c) = (-b, -c);
        let whole = a * d - b * c;
        [(off[0] * d - b * off[1]) / whole, (a * off[1] - c * off[0]) / whole]
    }
}
