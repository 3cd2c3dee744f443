//! Motion of an arm whose joint rests on bristles (LuGre), by a stiff solver.

mod equations;

use diffsol::{
    NalgebraLU, OdeBuilder, OdeSolverMethod, OdeSolverProblem, OdeSolverState, OdeSolverStopReason,
    RkState, Tableau, Vector, VectorCommon,
};

use equations::{Equations, M, V};

use super::{Motion, RigError};
use crate::arm::Arm;
use crate::drive::LuGre;

/// Tolerances that the solver is asked for, finest and coarsest.
const TOLERANCES: [f64; 2] = [1e-12, 1e-2];

/// The first step that is tried, as a share of the time that the bristles take to swing once.
const FIRST_STEP: f64 = 1e-3;

/// Share of a motion by which bristles bend as long as they hold the joint.
const HOLDS: f64 = 0.1;

/// Steps shorter than this mean that the solver gets nowhere \[s\].
const STEP_LEAST_S: f64 = 1e-30;

/// An arm in motion on LuGre bristles.
///
/// The equations are those of [`Hybrid`](super::Hybrid) with [`LuGre`]'s torque in place of the
/// arm's own Coulomb friction, which is left out. They are not piecewise linear: a diagonally
/// implicit Runge-Kutta method of order 3 (ESDIRK) solves them to a stated [tolerance]. At v = 0
/// the bristles' rate has a kink, which the solver's error control takes; finding these instants
/// and starting anew there gained nothing.
///
/// [tolerance]: Self::at_rest
///
/// ```
/// # use lissom::{arm::Arm, beam::{LumpedBeam, Span}, drive::{Coulomb, LuGre, Motor}, rig::LuGreMotion};
/// # let span = Span { length_m: 0.2, flexural_rigidity_n_m2: 0.004, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
/// # let beam = LumpedBeam::new(&[span]).unwrap();
/// # let friction = Coulomb::symmetric(0.03).unwrap();
/// # let arm = Arm::new(beam, Motor::new(6e-4, 1e-3, 0.25).unwrap(), friction).unwrap();
/// let law = LuGre::new(300.0, 0.3, friction, friction, 0.1).unwrap(); // bends by 1e-4 rad at most
/// let mut motion = LuGreMotion::at_rest(&arm, law, 1e-8)?;
/// motion.advance(0.01, 0.1)?; // N·m and s: a third of the friction
/// assert!(motion.state()[0] > 0.0 && motion.state()[0] < 1e-4); // presliding
/// # Ok::<(), lissom::rig::RigError>(())
/// ```
///
/// # Source
/// `[deWit1995]` with `[Feliu1989, eqs. (13)-(15)]`; the solver is that of the crate `diffsol`.
pub struct LuGreMotion {
    problem: OdeSolverProblem<Equations>,
    tableau: Tableau<f64>,
    solved: RkState<V>,
    /// The step to try first in the next sample \[s\].
    step_s: f64,
    time_s: f64,
    /// In presliding.
    held_s: f64,
    steps: usize,
}

impl LuGreMotion {
    /// An arm at rest at angle zero on straight bristles.
    ///
    /// `tolerance` r: a step's error is below `r·(|x| + a)`, in the mean over the state, a = Fs/σ0
    /// for angles and √(Fs²/(σ0·J)) for velocities. Errors of steps add up: see
    /// [`tolerance`](Motion::tolerance).
    ///
    /// # Errors
    /// [`RigError::Tolerance`] outside 1e-12 to 1e-2.
    pub fn at_rest(arm: &Arm, law: LuGre, tolerance: f64) -> Result<Self, RigError> {
        Self::with_state(arm, law, tolerance, &[], 0.0)
    }

    /// An arm in `state`, `[θ_m, θ̇_m, θ_i.., θ̇_i..]`, and its bristles bent by `deflection_rad`;
    /// missing entries are zero, further ones are left out.
    ///
    /// # Errors
    /// [`RigError::Tolerance`] outside 1e-12 to 1e-2, [`RigError::NotFollowed`] for a state that is
    /// not finite.
    pub fn with_state(
        arm: &Arm,
        law: LuGre,
        tolerance: f64,
        state: &[f64],
        deflection_rad: f64,
    ) -> Result<Self, RigError> {
        let [least, most] = TOLERANCES;
        if !(least..=most).contains(&tolerance) {
            return Err(RigError::Tolerance { found: tolerance, least, most });
        }
        let len = arm.state_len();
        let mut start = state.to_vec();
        start.resize(len, 0.0);
        start.push(deflection_rad);
        let stuck = RigError::NotFollowed { time_s: 0.0, step_s: 0.0 };
        if !start.iter().all(|x| x.is_finite()) {
            return Err(stuck);
        }
        let bend = law.deflection_most_rad();
        let swing = (law.stiffness_nm_per_rad() / arm.motor.inertia_kg_m2).sqrt();
        let is_rate = |i: usize| i == 1 || (2 + (len - 2) / 2..len).contains(&i);
        let sizes = (0..=len).map(|i| if is_rate(i) { bend * swing } else { bend });
        let step_s = FIRST_STEP / swing;
        let equations = Equations::new(arm.clone(), law, start);
        let made = OdeBuilder::<M>::new()
            .rtol(tolerance)
            .atol(sizes.map(|size| tolerance * size).collect::<Vec<_>>())
            .h0(step_s)
            .build_from_eqn(equations);
        let mut problem = made.map_err(|_| stuck.clone())?;
        // It counts them over a whole sample, which may be long; steps that get too short end it.
        problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
        problem.ode_options.min_timestep = STEP_LEAST_S;
        let tableau = Tableau::esdirk34();
        let solved = problem.rk_state(&tableau).map_err(|_| stuck)?;
        Ok(Self { problem, tableau, solved, step_s, time_s: 0.0, held_s: 0.0, steps: 0 })
    }

    /// Current state `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    pub fn state(&self) -> &[f64] {
        let full = self.full();
        &full[..full.len() - 1]
    }

    /// Deflection z of the bristles \[rad\].
    pub fn deflection_rad(&self) -> f64 {
        let full = self.full();
        full[full.len() - 1]
    }

    /// Friction F at the joint \[N·m\], positive against forward motion.
    pub fn friction_nm(&self) -> f64 {
        self.problem.eqn.law.torque_nm(self.full()[1], self.deflection_rad())
    }

    /// Steps that the solver has taken.
    pub fn steps(&self) -> usize {
        self.steps
    }

    fn full(&self) -> &[f64] {
        self.solved.as_ref().y.inner().as_slice()
    }

    /// Moves on by `duration_s` under a constant motor torque \[N·m\].
    ///
    /// # Errors
    /// [`RigError::NotFollowed`] where the solver gets nowhere or the torque is not finite; nothing
    /// has moved then.
    pub fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        if duration_s <= 0.0 {
            return Ok(());
        }
        let stuck = |passed: f64, step_s: f64| RigError::NotFollowed {
            time_s: self.time_s + passed,
            step_s,
        };
        if !(torque_nm.is_finite() && duration_s.is_finite()) {
            return Err(stuck(0.0, 0.0));
        }
        let law = self.problem.eqn.law;
        let first = self.step_s.min(duration_s);
        // The torque has jumped: slopes anew, and time from zero, so that it stays exact.
        self.problem.eqn.torque_nm = torque_nm;
        let mut state = self.solved.clone();
        let now = state.as_mut();
        self.problem.eqn.derivative(now.y.inner().as_slice(), now.dy.inner_mut().as_mut_slice());
        (*now.t, *now.h) = (0.0, first);
        let solver = self.problem.sdirk_solver::<NalgebraLU<f64>, _>(state, self.tableau);
        let mut solver = solver.map_err(|_| stuck(0.0, first))?;
        solver.set_stop_time(duration_s).map_err(|_| stuck(0.0, first))?;
        let (mut largest, mut held_s) = (0.0_f64, 0.0);
        loop {
            let from = solver.state().t;
            let stop = solver.step().map_err(|_| stuck(from, solver.state().h))?;
            let step = solver.state().t - from;
            held_s += if holds(law, solver.state().y.inner().as_slice()) { step } else { 0.0 };
            if stop == OdeSolverStopReason::TstopReached {
                // The last step is as long as what was left. Alone, it may grow.
                let grown = if from > 0.0 { step } else { 4.0 * step };
                largest = largest.max(grown);
                break;
            }
            largest = largest.max(step);
        }
        if !solver.state().y.inner().iter().all(|x| x.is_finite()) {
            return Err(stuck(duration_s, largest));
        }
        self.steps += solver.get_statistics().number_of_steps;
        self.held_s += held_s;
        self.solved = solver.into_state();
        self.step_s = largest;
        self.time_s += duration_s;
        Ok(())
    }
}

/// Whether bristles bend by enough of the motion to count as holding the joint.
fn holds(law: LuGre, state: &[f64]) -> bool {
    let (v, z) = (state[1], state[state.len() - 1]);
    law.bristle_rate(v, z).abs() >= HOLDS * v.abs()
}

impl Motion for LuGreMotion {
    fn state(&self) -> &[f64] {
        LuGreMotion::state(self)
    }
    fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        LuGreMotion::advance(self, torque_nm, duration_s)
    }
    /// In presliding: while bristles bend by at least a tenth of the motion, `|ż| ≥ |v|/10`, which is until they
    /// carry nine tenths of what they carry sliding. Counted by steps. As they stiffen it tends to 95 % of
    /// what Coulomb's law has where the torque passes from one break-away to the other.
    fn stuck_s(&self) -> f64 {
        self.held_s
    }
    /// That of each step; errors of steps add up, as a motor without a loop does not forget. Over
    /// 300 samples of 3 ms and many reversals angles are off by less than 3e-5 rad at 1e-5, 5e-6 rad
    /// at 1e-6 and 7e-7 rad at 1e-8 (`tests/lugre_reference`).
    fn tolerance(&self) -> Option<f64> {
        Some(self.problem.rtol)
    }
}
