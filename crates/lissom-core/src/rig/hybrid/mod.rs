//! Exact motion of an arm with dry friction: stick, slip, and the events between them.

pub(super) mod events;
mod series;
mod slip;

use crate::lti::first_root::ORDER_MOST;

use super::error::not_negative;
use super::{Motion, RigError, Signal, TipWorld};
use crate::arm::Arm;
use crate::drive::DryFriction;
use crate::friction::{FrictionSeries, Mode, PhaseSeries};
use crate::load::{GravityLoad, PositionTorque, TorqueRipple};

/// Largest (rate bound × step) for which a Taylor series of order [`ORDER_MOST`] is exact to
/// rounding: 0.5²⁴/24! is 1e-31.
const STEP_RATE: f64 = 0.5;
/// Events at one instant after which the joint is taken to chatter and is held for a moment.
const EVENTS_AT_ONCE: usize = 50;

/// The motor's torque over time.
#[derive(Debug, Clone, Copy)]
enum Torque<'s> {
    /// Constant \[N·m\].
    Held(f64),
    /// Over the motion's own time \[N·m\].
    Over(&'s Signal),
}

/// Motion of an arm, exact to rounding.
///
/// Between events the arm is linear. Its state is a Taylor series in time, whose terms follow from each other by the
/// state matrix and are summed until they vanish. The velocity is then a polynomial, and its first root is the event.
/// Nothing is smoothed, and there is no tolerance except rounding.
///
/// Friction that changes with speed or position ([`DryFriction`]), gravity ([`GravityLoad`]) and torque ripple
/// ([`TorqueRipple`]) make the series nonlinear. Its terms still follow from each other; steps are so short that the last of 24 terms is below 1e-15 of
/// the state. [`Motion::tolerance`] gives this value.
///
/// ```
/// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}, rig::Hybrid};
/// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
/// # let beam = LumpedBeam::new(&[span]).unwrap();
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
/// let mut hybrid = Hybrid::at_rest(&arm);
/// hybrid.advance(0.029, 1.0); // N·m and s: below the friction of 0.03 N·m
/// assert_eq!(hybrid.state()[0], 0.0);
/// hybrid.advance(0.031, 1.0);
/// assert!(hybrid.state()[0] > 0.0);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15), Section 5]`.
///
/// # Differences from the source
/// The source does not define θ̇_m = 0. Here the joint sticks while the drive torque minus the coupling torque is
/// between −backward and forward.
#[derive(Debug, Clone)]
pub struct Hybrid<'a> {
    pub(in crate::rig) arm: &'a Arm,
    friction: DryFriction,
    /// Friction as it was given, where it has been scaled.
    unscaled: Option<Box<DryFriction>>,
    gravity: Option<GravityLoad>,
    torque_ripples: Vec<TorqueRipple>,
    /// Both together.
    position_torque: PositionTorque,
    world: Option<TipWorld>,
    /// Arms that come later, and when \[s\]; the next one last.
    changes: Vec<(f64, &'a Arm)>,
    pub(in crate::rig) state: Vec<f64>,
    time_s: f64,
    pub(in crate::rig) mode: Mode,
    /// What a rubbing tip does.
    tip_mode: Mode,
    /// Which walls the tip touches.
    touching: Vec<bool>,
    step_most_s: f64,
    /// Σ|h_i| \[N·m/rad\].
    coupling_size: f64,
    /// Taylor coefficients of the state; the first also serves as a state that is tried.
    pub(in crate::rig) terms: Vec<Vec<f64>>,
    series: Coefficients,
    sticks: usize,
    events: usize,
    pub(in crate::rig) stuck_s: f64,
}

/// Taylor coefficients of what acts on the arm.
#[derive(Debug, Clone)]
struct Coefficients {
    /// Motor torque less the part of C_t that the tip's torque makes \[N·m\].
    torque: [f64; ORDER_MOST + 1],
    /// What the drive would have to overcome to turn a stuck joint \[N·m\].
    held: [f64; ORDER_MOST + 1],
    /// F(t) and T(t) at the tip \[N, N·m\].
    tip_force: [f64; ORDER_MOST + 1],
    tip_torque: [f64; ORDER_MOST + 1],
    /// What pushes a stuck tip \[N\].
    tip_held: [f64; ORDER_MOST + 1],
    angle: [f64; ORDER_MOST + 1],
    velocity: [f64; ORDER_MOST + 1],
    friction: FrictionSeries,
    /// Of each wave of the torque of position.
    phases: Vec<PhaseSeries>,
}

impl Default for Coefficients {
    fn default() -> Self {
        let zero = [0.0; ORDER_MOST + 1];
        Self {
            torque: zero,
            held: zero,
            tip_force: zero,
            tip_torque: zero,
            tip_held: zero,
            angle: zero,
            velocity: zero,
            friction: FrictionSeries::default(),
            phases: Vec::new(),
        }
    }
}

impl<'a> Hybrid<'a> {
    /// Relative error of a step where friction bends or a torque of position acts: the series' last terms are below it.
    pub(in crate::rig) const BENT: f64 = 1e-15;

    /// Starts at rest, at angle zero.
    pub fn at_rest(arm: &'a Arm) -> Self {
        Self::with_state(arm, vec![0.0; arm.state_len()])
    }

    /// Starts in `state`, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\]; missing values count as
    /// zero, further values are ignored.
    pub fn with_state(arm: &'a Arm, mut state: Vec<f64>) -> Self {
        let len = arm.state_len();
        state.resize(len, 0.0);
        let mode = Mode::of(state[1]);
        let mut made = Self {
            arm,
            friction: arm.coulomb.into(),
            unscaled: None,
            gravity: None,
            torque_ripples: Vec::new(),
            position_torque: PositionTorque::default(),
            world: None,
            changes: Vec::new(),
            state,
            time_s: 0.0,
            mode,
            tip_mode: Mode::Stick,
            touching: Vec::new(),
            step_most_s: 0.0,
            coupling_size: arm.dynamics().coupling.abs().sum(),
            terms: vec![vec![0.0; len]; ORDER_MOST + 1],
            series: Coefficients::default(),
            sticks: 0,
            events: 0,
            stuck_s: 0.0,
        };
        made.step_most_s = STEP_RATE / made.rate_bound();
        made
    }

    /// Returns this motion with another dry friction in place of the arm's.
    #[must_use]
    pub fn with_friction(mut self, friction: DryFriction) -> Self {
        self.friction = friction;
        self.unscaled = None;
        self
    }

    /// Returns this motion with gravity of an unbalanced load on the motor, a function of the motor's angle.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::Beam, drive::{Coulomb, Motor}, load::GravityLoad, rig::Hybrid};
    /// let motor = Motor::new(0.02, 0.1, 1.0).unwrap(); // kg·m², N·m·s/rad, N·m/A
    /// let arm = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
    /// let load = GravityLoad::of_amplitude(2.0, 0.0); // hangs at θ = 0
    /// let mut hybrid = Hybrid::with_state(&arm, vec![1.0]).with_gravity(load);
    /// hybrid.advance(1.0, 10.0); // half of the largest torque holds it at 30°
    /// assert!((hybrid.state()[0] - 30.0_f64.to_radians()).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn with_gravity(mut self, load: GravityLoad) -> Self {
        self.gravity = Some(load);
        self.with_position_torque()
    }

    /// Returns this motion with torque ripples (cogging) on the motor, functions of the motor's angle.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::Beam, drive::{Coulomb, Motor}, load::TorqueRipple, rig::Hybrid};
    /// let motor = Motor::new(0.02, 0.1, 1.0).unwrap(); // kg·m², N·m·s/rad, N·m/A
    /// let arm = Arm::new(Beam::Rigid, motor, Coulomb::symmetric(0.0).unwrap()).unwrap();
    /// let cogging = TorqueRipple { per_rad: 6.0, cosine_nm: 0.0, sine_nm: 0.05 }; // rests at θ = 0
    /// let mut hybrid = Hybrid::with_state(&arm, vec![0.3]).with_torque_ripples(&[cogging]);
    /// hybrid.advance(0.0, 20.0);
    /// assert!(hybrid.state()[0].abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn with_torque_ripples(mut self, ripples: &[TorqueRipple]) -> Self {
        self.torque_ripples = ripples.to_vec();
        self.with_position_torque()
    }

    fn with_position_torque(mut self) -> Self {
        self.position_torque = PositionTorque::new(self.gravity, &self.torque_ripples);
        self.series.phases = vec![PhaseSeries::default(); self.position_torque.waves().len()];
        self.step_most_s = STEP_RATE / self.rate_bound();
        self
    }

    /// Returns this motion with forces, friction or walls at the tip.
    ///
    /// # Errors
    /// [`RigError`] if a friction is negative, or if the beam is modal and so has no tip.
    pub fn with_world(mut self, world: TipWorld) -> Result<Self, RigError> {
        world.check()?;
        if self.arm.beam().lumped().is_none() && !world.is_empty() {
            return Err(RigError::Unsupported {
                what: "a world at the tip of a beam by its modes",
            });
        }
        let tip = self.state[self.tip_index()];
        self.touching = world.walls.iter().map(|w| w.depth(tip) > 0.0).collect();
        self.tip_mode = Mode::of(self.state[self.tip_rate_index()]);
        self.world = (!world.is_empty()).then_some(world);
        self.step_most_s = STEP_RATE / self.rate_bound();
        Ok(self)
    }

    /// Returns this motion with other arms that replace the first at given times \[s\]: payloads
    /// that are picked up or released.
    ///
    /// Angles and velocities are continuous. A payload is picked up at the velocity of the tip; if it resists turning,
    /// it starts with the slope of the end of the massless beam.
    ///
    /// # Errors
    /// [`RigError`] unless times are positive and increase, and all arms have the same number of masses.
    pub fn with_changes(mut self, changes: &[(f64, &'a Arm)]) -> Result<Self, RigError> {
        for (row, (time_s, arm)) in changes.iter().enumerate() {
            let before = if row == 0 { 0.0 } else { changes[row - 1].0 };
            if !(*time_s > before && time_s.is_finite()) {
                return Err(RigError::TableOrder { row, before_s: before, after_s: *time_s });
            }
            let (expected, found) = (self.arm.beam().len(), arm.beam().len());
            if expected != found {
                return Err(RigError::Masses { expected, found });
            }
        }
        self.changes = changes.iter().rev().copied().collect();
        Ok(self)
    }

    /// Present state `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    pub fn state(&self) -> &[f64] {
        &self.state
    }
    /// Time since the start \[s\].
    pub fn time_s(&self) -> f64 {
        self.time_s
    }
    /// Whether the joint sticks, or in which direction it slips.
    pub fn mode(&self) -> Mode {
        self.mode
    }
    /// Number of times that the joint began to stick.
    pub fn sticks(&self) -> usize {
        self.sticks
    }
    /// Number of events so far: of the joint, of a tip with friction, at walls.
    pub fn events(&self) -> usize {
        self.events
    }
    /// Total time for which the joint stuck \[s\].
    pub fn stuck_s(&self) -> f64 {
        self.stuck_s
    }

    /// Advances by `duration_s` under a constant motor torque \[N·m\].
    pub fn advance(&mut self, torque_nm: f64, duration_s: f64) {
        self.advance_under(Torque::Held(torque_nm), duration_s, false);
    }

    /// Advances by `duration_s` under a motor torque \[N·m\] that is a function of the motion's own
    /// [`time_s`](Self::time_s): a drive in continuous time.
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}};
    /// # use lissom::rig::{Harmonic, Hybrid, Signal};
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    /// let swing = Harmonic { amplitude: 0.05, omega_rad_s: 3.0, phase_rad: 0.0 }; // N·m
    /// let mut hybrid = Hybrid::at_rest(&arm);
    /// hybrid.advance_driven(&Signal::harmonics(&[swing])?, 10.0);
    /// assert!(hybrid.sticks() > 5);
    /// # Ok::<(), lissom::rig::RigError>(())
    /// ```
    pub fn advance_driven(&mut self, torque_nm: &Signal, duration_s: f64) {
        self.advance_under(Torque::Over(torque_nm), duration_s, false);
    }

    /// Advances by at most `duration_s` under a constant motor torque \[N·m\], and ends at the next event: the
    /// joint or a tip with friction sticks, breaks loose or reverses, or the tip touches or leaves a wall.
    /// Returns the time that passed \[s\].
    ///
    /// ```
    /// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, Motor}, rig::{Hybrid, Mode}};
    /// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// # let beam = LumpedBeam::new(&[span]).unwrap();
    /// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), Coulomb::symmetric(0.03).unwrap()).unwrap();
    /// let mut hybrid = Hybrid::with_state(&arm, vec![0.0, 1.0]); // coasting at 1 rad/s
    /// let time_s = hybrid.advance_to_event(0.0, 1.0);
    /// assert!(time_s < 0.02 && hybrid.mode() != Mode::Forward);
    /// ```
    pub fn advance_to_event(&mut self, torque_nm: f64, duration_s: f64) -> f64 {
        self.advance_under(Torque::Held(torque_nm), duration_s, true)
    }

    fn advance_under(&mut self, torque: Torque<'_>, duration_s: f64, to_event: bool) -> f64 {
        let (mut passed, mut stalled, events) = (0.0, 0, self.events);
        while passed < duration_s {
            let left = duration_s - passed;
            // A remainder of rounding only.
            if left <= f64::EPSILON * duration_s {
                break;
            }
            let time = if stalled < EVENTS_AT_ONCE {
                self.step(torque, left)
            } else {
                self.pause(torque, left)
            };
            stalled = if time > 0.0 { 0 } else { stalled + 1 };
            passed += time;
            if to_event && self.events != events || !time.is_finite() {
                break;
            }
        }
        passed.min(duration_s)
    }

    /// Whether the motion of a slipping motor is nonlinear.
    fn bends(&self) -> bool {
        !self.position_torque.is_empty() || !self.friction.is_constant()
    }
}

impl Motion for Hybrid<'_> {
    fn state(&self) -> &[f64] {
        Hybrid::state(self)
    }
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        Hybrid::advance(self, torque_nm, duration_s);
        if self.state.iter().all(|v| v.is_finite()) {
            Ok(())
        } else {
            Err(RigError::Lost { time_s: self.time_s })
        }
    }
    fn scale_friction(&mut self, factor: f64) -> Result<(), RigError> {
        not_negative("factor of the friction", factor)?;
        let unscaled = self.unscaled.get_or_insert_with(|| Box::new(self.friction.clone()));
        self.friction = unscaled.scaled(factor);
        Ok(())
    }
    fn stuck_s(&self) -> f64 {
        Hybrid::stuck_s(self)
    }
    fn tolerance(&self) -> Option<f64> {
        self.bends().then_some(Self::BENT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::{LumpedBeam, Span};
    use crate::drive::{Coulomb, Motor};

    fn arm(coulomb: f64) -> Arm {
        let span = Span {
            length_m: 0.2,
            flexural_rigidity_n_m2: 0.005,
            mass_kg: 0.05,
            damping_n_s_per_m: 0.0,
        };
        let motor = Motor::new(6e-4, 1e-3, 0.25).unwrap();
        let beam = LumpedBeam::new(&[span]).unwrap();
        Arm::new(beam, motor, Coulomb::symmetric(coulomb).unwrap()).unwrap()
    }

    #[test]
    fn a_torque_exactly_at_the_limit_holds() {
        let arm = arm(0.033);
        let mut hybrid = Hybrid::at_rest(&arm);
        for torque in [0.033, -0.033, 0.033 * (1.0 - f64::EPSILON)] {
            hybrid.advance(torque, 1.0);
            assert_eq!(hybrid.mode(), Mode::Stick);
        }
        assert!((hybrid.stuck_s() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn without_friction_nothing_sticks() {
        let arm = arm(0.0);
        let mut hybrid = Hybrid::at_rest(&arm);
        hybrid.advance(0.0, 1.0);
        assert_eq!((hybrid.sticks(), hybrid.state()[0]), (0, 0.0));
        hybrid.advance(1e-3, 1.0);
        assert!(hybrid.state()[1] > 0.0);
    }

    #[test]
    fn free_motion_of_a_frictionless_arm_keeps_its_momentum() {
        let mut arm = arm(0.0);
        let m = arm.motor;
        arm.motor = Motor::new(m.inertia_kg_m2(), 0.0, m.torque_constant_nm_per_a()).unwrap();
        let mut hybrid = Hybrid::with_state(&arm, vec![0.0, 1.0, 0.1, -2.0]);
        let inertia = 0.05 * 0.2 * 0.2;
        let momentum = |x: &[f64]| 6e-4 * x[1] + inertia * x[3];
        let before = momentum(hybrid.state());
        hybrid.advance(0.0, 100.0);
        assert!((momentum(hybrid.state()) - before).abs() < 1e-12 * inertia);
    }
}
