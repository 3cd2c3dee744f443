//! One sample in one step: the motion of an arm under a constant torque, if no event falls into it.

use crate::arm::Arm;
use crate::drive::Coulomb;
use crate::friction::Mode;
use crate::rig::Hybrid;

/// Largest (bound on the state's rate × part of a sample) over which events are ruled out at once.
const REACH: f64 = 1.0;

/// Motion of an arm over one sample time, as matrices.
///
/// Between events the state after a sample is `Φ·x + γ·T_net`, slipping or sticking, exact to rounding. The end values
/// of the sample decide whether there is an event: except for a remainder of at most `T⁴/384·max|v⁗|`, the velocity (or
/// the torque on a sticking joint) is the cubic through the values and slopes at both ends, and the fourth derivative
/// is bounded by the rates of the arm and its state. A cubic lies within its Bézier points. If these are not farther
/// from zero than the remainder, the sample is left to [`Hybrid::advance`], which finds the event.
///
/// One step serves any number of [`Hybrid`]s of the same arm.
#[derive(Debug, Clone)]
pub struct HeldStep {
    sample_time_s: f64,
    /// Parts that a sample is cut into.
    parts: usize,
    part_s: f64,
    len: usize,
    /// Φ by rows while the motor slips.
    slip: Vec<f64>,
    /// γ: the state after a part from rest, per torque \[1/(N·m)\].
    push: Vec<f64>,
    /// Φ by rows while it sticks.
    stick: Vec<f64>,
    /// ρ of [`Size`] \[1/s\].
    rho: f64,
    /// What the velocity changes by at most per size of ẋ \[s\], and what its cubic leaves out.
    velocity_change_s: f64,
    velocity_rest_s: f64,
    /// What the stuck coupling torque changes by at most per size of x \[N·m·s/rad\], and what its
    /// cubic leaves out.
    torque_change: f64,
    torque_rest: f64,
}

impl HeldStep {
    /// Builds the step for an arm whose torque is constant over `sample_time_s`.
    pub fn new(arm: &Arm, sample_time_s: f64) -> Self {
        let len = arm.state_len();
        // The size of a state, max(ρ·|q_i − θ_m|, |θ̇_m|, |q̇_i|), grows at no more than 2ρ times
        // itself and |T_net|/J.
        let rho = arm.rate_bound();
        let parts = (2.0 * rho * sample_time_s / REACH).ceil().max(1.0) as usize;
        let part_s = sample_time_s / parts as f64;
        let mut free = arm.clone();
        free.coulomb = Coulomb::NONE;
        let slipped = |start: Vec<f64>, torque: f64| {
            let mut motion = Hybrid::with_state(&free, start);
            motion.advance(torque, part_s);
            motion.state().to_vec()
        };
        let (mut slip, mut stick) = (vec![0.0; len * len], vec![0.0; len * len]);
        for column in 0..len {
            let mut unit = vec![0.0; len];
            unit[column] = 1.0;
            let mut stuck = Hybrid::with_state(&free, unit.clone());
            stuck.advance_stuck(part_s);
            for (row, (s, h)) in slipped(unit, 0.0).iter().zip(stuck.state()).enumerate() {
                slip[row * len + column] = *s;
                stick[row * len + column] = *h;
            }
        }
        // Where ẋ has size one, x changes by T·e^{rate·T} at most, and a cubic leaves out
        // T⁴/384·rate³·e^{rate·T}.
        let turn = 2.0 * rho * part_s;
        let change = part_s * turn.exp();
        let rest = change * turn.powi(3) / 384.0;
        let dynamics = arm.dynamics();
        let by_rate = dynamics.coupling_rate.as_ref().map_or(0.0, |g| g.abs().sum());
        let torque = dynamics.coupling.abs().sum() + 2.0 * rho * by_rate;
        Self {
            sample_time_s,
            parts,
            part_s,
            len,
            slip,
            push: slipped(vec![0.0; len], 1.0),
            stick,
            rho,
            velocity_change_s: change,
            velocity_rest_s: rest,
            torque_change: change * torque,
            torque_rest: rest * torque,
        }
    }

    /// The sample time \[s\].
    pub fn sample_time_s(&self) -> f64 {
        self.sample_time_s
    }

    fn size(&self, x: &[f64]) -> f64 {
        let k = (self.len - 2) / 2;
        let bent = x[2..2 + k].iter().fold(0.0, |m: f64, q| m.max((q - x[0]).abs()));
        x[2 + k..].iter().fold((self.rho * bent).max(x[1].abs()), |m, v| m.max(v.abs()))
    }
}

/// Whether a function with these values and slopes at both ends of `part_s` stays above `rest`, the
/// most that it departs from their cubic: the least of the Bézier points bounds that.
fn stays_above(rest: f64, part_s: f64, [from, to]: [(f64, f64); 2]) -> bool {
    let third = part_s / 3.0;
    from.0.min(to.0).min(from.0 + third * from.1).min(to.0 - third * to.1) > rest
}

/// `out = M·x`, M by rows. One mass and two have their own loops, which the compiler unrolls.
fn times(rows: &[f64], x: &[f64], out: &mut [f64]) {
    match x.len() {
        4 => times_of::<4>(rows, x, out),
        6 => times_of::<6>(rows, x, out),
        _ => {
            for (row, out) in rows.chunks_exact(x.len()).zip(out) {
                *out = row.iter().zip(x).map(|(m, x)| m * x).sum();
            }
        }
    }
}

fn times_of<const N: usize>(rows: &[f64], x: &[f64], out: &mut [f64]) {
    let (Some(x), Some(out)) = (x.first_chunk::<N>(), out.first_chunk_mut::<N>()) else { return };
    for (row, out) in rows.as_chunks::<N>().0.iter().zip(out) {
        *out = row.iter().zip(x).map(|(m, x)| m * x).sum();
    }
}

impl Hybrid<'_> {
    /// Advances by one sample under a constant motor torque \[N·m\]. The result is that of [`advance`](Self::advance),
    /// many times faster if there is no event.
    ///
    /// `step` must have been built for this arm.
    pub fn advance_held(&mut self, step: &HeldStep, torque_nm: f64) {
        for _ in 0..step.parts {
            let quiet = match self.mode {
                Mode::Stick => self.stays_stuck(step, torque_nm),
                Mode::Forward => self.keeps_slipping(step, torque_nm, 1.0),
                Mode::Backward => self.keeps_slipping(step, torque_nm, -1.0),
            };
            if quiet {
                // What was tried becomes the state.
                std::mem::swap(&mut self.state, &mut self.terms[0]);
            } else {
                self.advance(torque_nm, step.part_s);
            }
        }
    }

    /// Tries a part of a sample without leaving the stick.
    fn stays_stuck(&mut self, step: &HeldStep, torque: f64) -> bool {
        let (arm, coulomb) = (self.arm, self.arm.coulomb);
        let (size, rounding) = (step.size(&self.state), self.rounding(torque));
        let (next, scratch) = self.terms.split_at_mut(1);
        times(&step.stick, &self.state, &mut next[0]);
        let net = arm.coupling_torque(&self.state) - torque;
        if (coulomb.forward() + net).min(coulomb.backward() - net)
            > step.torque_change * size + rounding
        {
            self.stuck_s += step.part_s;
            return true;
        }
        let rest = step.torque_rest * size + rounding;
        let mut end = |x: &[f64]| {
            arm.derivative_sticking(x, &mut scratch[0]);
            // It is linear in the state.
            (arm.coupling_torque(x), arm.coupling_torque(&scratch[0]))
        };
        let ends = [end(&self.state), end(&next[0])];
        let room = |sign: f64, limit: f64| {
            ends.map(|(c, rate)| (limit + sign * (c - torque), sign * rate))
        };
        let quiet = stays_above(rest, step.part_s, room(1.0, coulomb.forward()))
            && stays_above(rest, step.part_s, room(-1.0, coulomb.backward()));
        if quiet {
            self.stuck_s += step.part_s;
        }
        quiet
    }

    /// Tries a part of a sample without a reversal.
    fn keeps_slipping(&mut self, step: &HeldStep, torque: f64, sign: f64) -> bool {
        let inertia = self.arm.motor.inertia_kg_m2();
        let net = torque - self.arm.coulomb.slipping(sign);
        let next = &mut self.terms[0];
        times(&step.slip, &self.state, next);
        for (x, push) in next.iter_mut().zip(&step.push) {
            *x += push * net;
        }
        if self.arm.coulomb.forward() == 0.0 && self.arm.coulomb.backward() == 0.0 {
            return true;
        }
        let rate = 2.0 * step.rho * step.size(&self.state) + net.abs() / inertia;
        if sign * self.state[1] > step.velocity_change_s * rate {
            return true;
        }
        let ends = [&self.state, &*next].map(|x| {
            let drag = self.arm.motor.viscous_nm_s_per_rad() * x[1] + self.arm.coupling_torque(x);
            (sign * x[1], sign * (net - drag) / inertia)
        });
        stays_above(step.velocity_rest_s * rate, step.part_s, ends)
    }
}
