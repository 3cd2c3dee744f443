//! Motion of an arm whose joint rests on bristles (LuGre).

mod linear_steps;
mod stepper;

use stepper::{Bristling, Stepper};

use super::{Motion, RigError};
use crate::arm::Arm;
use crate::drive::LuGre;
use crate::load::{GravityLoad, PositionTorque};

/// Tolerances that a motion can have, finest and coarsest.
const TOLERANCES: [f64; 2] = [1e-12, 1e-2];
/// The first step that is tried, as a share of the time in which the motor swings by 1 rad on its bristles.
const FIRST_STEP: f64 = 0.1;

/// Motion of an arm on LuGre bristles.
///
/// The equations are those of [`Hybrid`](super::Hybrid), with the torque of [`LuGre`] in place of the arm's own Coulomb
/// friction, which is ignored. Over a step the arm moves by its exact linear solution. Friction is computed as in the
/// [`replay`](crate::replay): the deflection follows its steady value exactly over the travel, and friction acts as a
/// line in time with the mean of a parabola (order 4). Every step is repeated as two half steps, which are kept; their
/// difference from the whole step controls the step length to a given [tolerance]. Steps are a sample divided by powers
/// of two, so that the matrices of the linear part are computed only once.
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
/// `[deWit1995]` with `[Feliu1989, eqs. (13)-(15)]`.
#[derive(Debug, Clone)]
pub struct LuGreMotion {
    stepper: Stepper,
    now: Bristling,
    /// The step to try first in the next sample \[s\].
    step_s: f64,
    time_s: f64,
    /// In presliding.
    held_s: f64,
    steps: usize,
}

impl LuGreMotion {
    /// Starts at rest, at angle zero, with bristles that are not bent.
    ///
    /// The estimated error of a step is kept below `r·(|x| + a)` in every element of the state, where r is the
    /// `tolerance` and a is Fs/σ0 for angles and √(Fs²/(σ0·J)) for velocities. Errors of steps add up: see
    /// [`tolerance`](Motion::tolerance).
    ///
    /// # Errors
    /// [`RigError::Tolerance`] unless the tolerance is between 1e-12 and 1e-2.
    pub fn at_rest(arm: &Arm, law: LuGre, tolerance: f64) -> Result<Self, RigError> {
        Self::with_state(arm, law, tolerance, &[], 0.0)
    }

    /// Starts in `state`, `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\], with the bristles bent by `deflection_rad`;
    /// missing values count as zero, further values are ignored.
    ///
    /// # Errors
    /// [`RigError::Tolerance`] unless the tolerance is between 1e-12 and 1e-2; [`RigError::NotFollowed`] for a state
    /// that is not finite.
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
        let mut x = state.to_vec();
        x.resize(arm.state_len(), 0.0);
        if !x.iter().chain([&deflection_rad]).all(|x| x.is_finite()) {
            return Err(RigError::NotFollowed { time_s: 0.0, step_s: 0.0 });
        }
        let stepper = Stepper::new(arm, law, tolerance);
        let step_s = FIRST_STEP * stepper.swing_s();
        let now = Bristling { x, z: deflection_rad };
        Ok(Self { stepper, now, step_s, time_s: 0.0, held_s: 0.0, steps: 0 })
    }

    /// Returns this motion with gravity of an unbalanced load on the motor. Gravity is assumed linear in time over a
    /// step, so that steps are of order 2; the tolerance is kept all the same.
    #[must_use]
    pub fn with_gravity(self, load: GravityLoad) -> Self {
        self.with_position_torque(PositionTorque::new(Some(load), &[]))
    }

    /// Returns this motion with gravity and torque ripples (cogging) on the motor, as [`with_gravity`](Self::with_gravity).
    #[must_use]
    pub fn with_position_torque(mut self, load: PositionTorque) -> Self {
        self.stepper.load = load;
        self
    }

    /// Present state `[θ_m, θ̇_m, θ_i.., θ̇_i..]` \[rad, rad/s\].
    pub fn state(&self) -> &[f64] {
        &self.now.x
    }

    /// Deflection z of the bristles \[rad\].
    pub fn deflection_rad(&self) -> f64 {
        self.now.z
    }

    /// Friction F at the joint \[N·m\], positive against forward motion.
    pub fn friction_nm(&self) -> f64 {
        self.stepper.law.torque_nm(self.now.x[1], self.now.z)
    }

    /// Number of steps so far, without those that were too long and were discarded.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Advances by `duration_s` under a constant motor torque \[N·m\].
    ///
    /// # Errors
    /// [`RigError::NotFollowed`] if no step length keeps the tolerance, if millions of steps are not enough, if the
    /// deflection of the bristles cannot be resolved in double precision at the angles reached, or if the torque is not
    /// finite. The state is then unchanged.
    pub fn advance(&mut self, torque_nm: f64, duration_s: f64) -> Result<(), RigError> {
        if duration_s <= 0.0 {
            return Ok(());
        }
        if !(torque_nm.is_finite() && duration_s.is_finite()) {
            return Err(RigError::NotFollowed { time_s: self.time_s, step_s: 0.0 });
        }
        let followed = self.stepper.follow(&self.now, torque_nm, duration_s, self.step_s);
        let followed = followed.map_err(|(passed_s, step_s)| RigError::NotFollowed {
            time_s: self.time_s + passed_s,
            step_s,
        })?;
        self.now = followed.end;
        self.steps += followed.steps;
        self.held_s += followed.held_s;
        self.step_s = followed.step_s;
        self.time_s += duration_s;
        Ok(())
    }
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
    /// That of each step; errors of steps add up, as a motor without a loop does not forget.
    fn tolerance(&self) -> Option<f64> {
        Some(self.stepper.tolerance)
    }
}
