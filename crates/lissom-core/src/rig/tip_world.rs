//! What acts on the tip: the force F_n and the torque T_n of (13)-(15).

use super::{RigError, Signal};

/// An elastic wall that stops the tip.
///
/// It pushes back with `k·L_n·(θ_n − θ_w)` while the tip is beyond θ_w; L_n is the distance
/// of the tip from the axis \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// θ_w, angle of the wall \[rad\].
    pub angle_rad: f64,
    /// k, stiffness \[N/m\].
    pub stiffness_n_per_m: f64,
    /// Whether the wall stops forward motion of the tip; otherwise it stops backward motion.
    pub ahead: bool,
}

impl Wall {
    /// How far the tip is beyond it \[rad\].
    pub(super) fn depth(&self, tip_rad: f64) -> f64 {
        if self.ahead { tip_rad - self.angle_rad } else { self.angle_rad - tip_rad }
    }
}

/// Forces and torques on the tip of the arm.
///
/// `F_n = F(t) − c·L_n·θ̇_n − F_c·sgn θ̇_n − walls`, with true sticking of the tip if F_c > 0, and `T_n = T(t)`. Signs
/// are those of (13): a positive force moves the tip forward.
///
/// ```
/// use lissom::rig::{TipWorld, Wall};
/// let wall = Wall { angle_rad: 0.4, stiffness_n_per_m: 500.0, ahead: true };
/// let world = TipWorld { viscous_n_s_per_m: 0.003, walls: vec![wall], ..TipWorld::default() };
/// assert!(world.check().is_ok() && !world.is_empty());
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15)]`; for viscous friction of an air table `[Feliu1989, Section 6.2.1]`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TipWorld {
    /// External force F(t) \[N\].
    pub force: Signal,
    /// External torque T(t) \[N·m\].
    pub torque: Signal,
    /// Viscous friction c of the tip \[N·s/m\].
    pub viscous_n_s_per_m: f64,
    /// Coulomb friction F_c of the tip \[N\].
    pub coulomb_n: f64,
    /// Walls that stop the tip.
    pub walls: Vec<Wall>,
}

impl TipWorld {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`RigError`] if a friction is negative, a wall has no stiffness, or a number is not finite.
    pub fn check(&self) -> Result<(), RigError> {
        let frictions = [
            ("viscous friction at the tip in N*s/m", self.viscous_n_s_per_m),
            ("Coulomb friction at the tip in N", self.coulomb_n),
        ];
        for (quantity, found) in frictions {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(RigError::Negative { quantity, found });
            }
        }
        for wall in &self.walls {
            let found = wall.stiffness_n_per_m;
            if !(found > 0.0 && found.is_finite()) {
                let quantity = "stiffness of a wall in N/m";
                return Err(RigError::NotPositive { quantity, found });
            }
            if !wall.angle_rad.is_finite() {
                let quantity = "angle of a wall in rad";
                return Err(RigError::NotFinite { quantity, found: wall.angle_rad });
            }
        }
        Ok(())
    }

    /// Whether nothing acts on the tip.
    pub fn is_empty(&self) -> bool {
        self.force.is_zero()
            && self.torque.is_zero()
            && self.viscous_n_s_per_m == 0.0
            && self.coulomb_n == 0.0
            && self.walls.is_empty()
    }
}
