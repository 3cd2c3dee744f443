//! Motion of an arm under torques that are constant over each sample: whole samples in one step, events by search.

use std::cell::{OnceCell, RefCell};

use super::crossing::Wave;
use super::flow::step;
use super::held_arm::{Duration, HeldArm, Modes};
use crate::drive::Coulomb;
use crate::rig::hybrid::events::ROUNDING;
use crate::rig::{Hybrid, Mode, Motion, RigError};

/// Motion of an arm under torques that are constant over each sample.
///
/// Between events, every mode turns by a fixed angle per sample. A bound decides whether there is an event: the
/// monitored quantity (the velocity, or the torque on a sticking joint) departs from the straight line through its end
/// values by at most `|λ|·|ẏ|·t²/8` or `2·|ẏ|/|λ|` in each mode, whichever is less, so that stiff modes do no harm. If
/// the bound allows a zero, the first zero of the sum of modes is searched.
///
/// ```
/// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
/// # use lissom::rig::{HeldArm, HeldMotion, Motion};
/// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
/// # let beam = LumpedBeam::new(&[span]).unwrap();
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
/// let held = HeldArm::new(&arm, &[0.003])?.unwrap();
/// let mut motion = HeldMotion::at_rest(&held);
/// motion.advance(0.029, 0.003)?; // N·m and s: below the friction of 0.03 N·m
/// assert_eq!(motion.state()[0], 0.0);
/// motion.advance(0.031, 0.003)?;
/// assert!(motion.state()[0] > 0.0);
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15), Section 5]`, in the coordinates of the phase's own modes.
#[derive(Debug, Clone)]
pub struct HeldMotion<'a> {
    pub(in crate::rig) held: &'a HeldArm<'a>,
    pub(in crate::rig) mode: Mode,
    pub(in crate::rig) angle: f64,
    /// θ̇_m while slipping, C_t while sticking.
    pub(in crate::rig) watched: f64,
    /// States of the phase's blocks, and room for what is tried.
    pub(in crate::rig) y: Vec<[f64; 2]>,
    pub(in crate::rig) next: Vec<[f64; 2]>,
    pub(in crate::rig) z: Vec<f64>,
    pub(in crate::rig) wave: Wave,
    /// Room for a duration that was not prepared.
    pub(in crate::rig) other: Option<Duration>,
    /// The event engine, for what is left to it.
    pub(in crate::rig) events: Hybrid<'a>,
    /// The state as it was last asked for, with its z behind it; and the room for it until then.
    state: OnceCell<Vec<f64>>,
    room: RefCell<Vec<f64>>,
    pub(in crate::rig) sticks: usize,
    pub(in crate::rig) stuck_s: f64,
    pub(in crate::rig) work: Work,
}

/// Operations that a motion has taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Work {
    /// Number of durations that were passed in one step.
    pub whole: usize,
    /// Number of durations that were searched for events.
    pub searched: usize,
    /// Number of times in searches at which modes were evaluated (exponentials).
    pub evaluations: usize,
    /// Number of durations, or parts of them, that were passed to the event engine.
    pub handed_over: usize,
}

impl<'a> HeldMotion<'a> {
    /// Starts at rest, at angle zero.
    pub fn at_rest(held: &'a HeldArm<'a>) -> Self {
        Self::start(held, vec![0.0; held.arm.state_len()])
    }

    /// Starts in `state`, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    ///
    /// # Errors
    /// [`RigError::State`] if its length differs from that of the arm's state, or if it is not finite.
    pub fn with_state(held: &'a HeldArm<'a>, state: &[f64]) -> Result<Self, RigError> {
        if state.len() != held.arm.state_len() || !state.iter().all(|x| x.is_finite()) {
            return Err(RigError::State { found: state.len(), expected: held.arm.state_len() });
        }
        Ok(Self::start(held, state.to_vec()))
    }

    fn start(held: &'a HeldArm<'a>, state: Vec<f64>) -> Self {
        let len = state.len();
        let events = Hybrid::with_state(held.arm, state);
        let blocks = held.modes.slip.blocks.len();
        let mut motion = Self {
            held,
            mode: events.mode,
            angle: 0.0,
            watched: 0.0,
            y: vec![[0.0; 2]; blocks],
            next: vec![[0.0; 2]; blocks],
            z: vec![0.0; len - 1],
            wave: Wave::with_room(blocks),
            other: Some(held.modes.other_duration()),
            events,
            state: OnceCell::new(),
            room: RefCell::new(vec![0.0; 2 * len - 1]),
            sticks: 0,
            stuck_s: 0.0,
            work: Work::default(),
        };
        motion.take_over(&held.modes);
        motion
    }

    /// Whether the joint sticks, or in which direction it slips.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Number of times that the joint began to stick.
    pub fn sticks(&self) -> usize {
        self.sticks
    }

    /// Operations that the motion has taken so far.
    pub fn work(&self) -> Work {
        Work { evaluations: self.wave.evaluations, ..self.work }
    }

    /// θ_m \[rad\]: equal to `state()[0]`, without computing the other states.
    pub fn motor_angle_rad(&self) -> f64 {
        self.angle
    }

    /// θ̇_m \[rad/s\]: equal to `state()[1]`, without computing the other states.
    pub fn motor_velocity_rad_s(&self) -> f64 {
        if self.mode == Mode::Stick { 0.0 } else { self.watched }
    }

    /// θ_i \[rad\] of coordinate `i`, counted from 0 at the base: equal to `state()[2 + i]`, at a cost that grows with
    /// the number of modes instead of its square. `None` if there is no such coordinate.
    pub fn angle_rad(&self, i: usize) -> Option<f64> {
        let row = self.held.modes.deflections[usize::from(self.mode == Mode::Stick)].get(i)?;
        Some(self.angle + dot(row, &self.y))
    }

    /// The state of the event engine becomes this one's.
    pub(in crate::rig) fn take_over(&mut self, modes: &Modes) {
        self.mode = self.events.mode;
        self.angle = self.events.state[0];
        modes.modal.energy(&self.events.state, &mut self.z);
        self.enter(modes);
        if self.mode != Mode::Stick {
            self.watched = self.events.state[1];
        }
    }

    /// z to the blocks of the phase.
    pub(in crate::rig) fn enter(&mut self, modes: &Modes) {
        if self.mode == Mode::Stick {
            modes.stick.enter(&self.z[1..], &mut self.y[..modes.stick.blocks.len()]);
            self.watched = self.z.iter().zip(&modes.coupling).skip(1).map(|(z, c)| z * c).sum();
        } else {
            modes.slip.enter(&self.z, &mut self.y);
        }
    }

    /// The blocks of the phase to z.
    pub(in crate::rig) fn leave(&mut self, modes: &Modes) {
        if self.mode == Mode::Stick {
            self.z[0] = 0.0;
            modes.stick.leave(&self.y[..modes.stick.blocks.len()], &mut self.z[1..]);
        } else {
            modes.slip.leave(&self.y, &mut self.z);
        }
    }

    /// Tries to pass the whole of `duration` without an event.
    #[inline]
    fn whole(&mut self, duration: &Duration, torque: f64) -> bool {
        let coulomb = self.held.arm.coulomb;
        if self.mode == Mode::Stick {
            let moved = step(&duration.stick, &self.y, 0.0, &mut self.next);
            let most = moved.stray + rounding(coulomb, torque);
            let (low, high) = (self.watched.min(moved.watched), self.watched.max(moved.watched));
            if low - torque + coulomb.forward() > most && torque - high + coulomb.backward() > most
            {
                self.watched = moved.watched;
                self.stuck_s += duration.time_s;
                std::mem::swap(&mut self.y, &mut self.next);
                return true;
            }
            return false;
        }
        let sign = if self.mode == Mode::Forward { 1.0 } else { -1.0 };
        let net = torque - coulomb.slipping(sign);
        let moved = step(&duration.slip, &self.y, net, &mut self.next);
        if (sign * self.watched).min(sign * moved.watched) > moved.stray || frictionless(coulomb) {
            self.angle = (self.angle + moved.sum) + duration.turned * net;
            self.watched = moved.watched;
            std::mem::swap(&mut self.y, &mut self.next);
            return true;
        }
        false
    }

    /// As [`Motion::advance`], for a finite torque.
    #[inline]
    fn move_on(&mut self, torque: f64, duration_s: f64) {
        if let Some(state) = self.state.take() {
            self.room.replace(state);
        }
        let modes = &self.held.modes;
        if frictionless(self.held.arm.coulomb) && self.mode == Mode::Stick {
            self.change(modes, Mode::Forward, 0.0);
        }
        let passed = if let Some(duration) = modes.duration(duration_s) {
            self.whole(duration, torque)
        } else {
            self.whole_of_other(modes, torque, duration_s)
        };
        if passed {
            self.work.whole += 1;
        } else {
            self.search(modes, torque, duration_s);
        }
    }

    #[cold]
    fn whole_of_other(&mut self, modes: &Modes, torque: f64, duration_s: f64) -> bool {
        let Some(mut room) = self.other.take() else { return false };
        if self.mode == Mode::Stick {
            room.set_stick(modes, duration_s);
        } else {
            room.set_slip(modes, duration_s);
        }
        let passed = self.whole(&room, torque);
        self.other = Some(room);
        passed
    }
}

impl Motion for HeldMotion<'_> {
    /// Made when asked for, in a time that grows with the square of the number of modes:
    /// [`motor_angle_rad`](HeldMotion::motor_angle_rad) and [`angle_rad`](HeldMotion::angle_rad)
    /// give single angles sooner.
    fn state(&self) -> &[f64] {
        let modes = &self.held.modes;
        let len = self.held.arm.state_len();
        let made = self.state.get_or_init(|| {
            let mut room = self.room.take();
            let (x, z) = room.split_at_mut(len);
            if self.mode == Mode::Stick {
                modes.stick.leave(&self.y[..modes.stick.blocks.len()], &mut z[1..]);
                z[0] = 0.0;
            } else {
                modes.slip.leave(&self.y, z);
            }
            modes.modal.state(self.angle, z, x);
            x[1] = self.motor_velocity_rad_s();
            room
        });
        &made[..len]
    }

    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        if !torque_nm.is_finite() {
            return Err(RigError::NotFinite { quantity: "motor torque [N·m]", found: torque_nm });
        }
        if duration_s > 0.0 && duration_s.is_finite() {
            self.move_on(torque_nm, duration_s);
            return Ok(());
        }
        if duration_s == 0.0 {
            return Ok(());
        }
        Err(RigError::NotPositive { quantity: "held duration [s]", found: duration_s })
    }

    fn stuck_s(&self) -> f64 {
        self.stuck_s
    }

    fn tolerance(&self) -> Option<f64> {
        None
    }
}

fn dot(row: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    row.iter().zip(y).map(|(r, y)| r[0] * y[0] + r[1] * y[1]).sum()
}

fn frictionless(coulomb: Coulomb) -> bool {
    coulomb.forward() == 0.0 && coulomb.backward() == 0.0
}

/// Torques below this are rounding of those that act \[N·m\]: as the event engine's.
pub(in crate::rig) fn rounding(coulomb: Coulomb, torque: f64) -> f64 {
    ROUNDING * (torque.abs() + coulomb.forward().max(coulomb.backward()))
}
