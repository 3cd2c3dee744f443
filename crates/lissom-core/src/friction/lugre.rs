//! LuGre friction: bristles that bend before the joint slips.

use super::coulomb::Coulomb;
use super::error::DriveError;
use super::place::Place;

/// The LuGre law: the joint rests on elastic bristles, whose mean deflection z \[rad\] is a state.
///
/// ```text
/// ż = v − σ0·|v|/g(v)·z,   F = σ0·z + σ1·ż,   g(v) = Fc + (Fs − Fc)·e^{−(v/vs)²}
/// ```
///
/// F \[N·m\] acts against the motion and is positive while the joint moves forward; v = θ̇_m \[rad/s\]. Fc (`coulomb`)
/// is friction at high speed and Fs (`at_rest`) friction at rest, forward for v > 0 and backward for v < 0; vs
/// \[rad/s\] is the Stribeck speed. In steady motion `F = g(v)·sgn(v)`. Viscous friction, the source's σ2·v, is the
/// motor's own V.
///
/// There is no sticking: a joint under a torque below Fs creeps and swings on its bristles by about Fs/σ0 (presliding).
///
/// ```
/// # use lissom::drive::{Coulomb, LuGre};
/// let law = LuGre::new(300.0, 0.3, Coulomb::symmetric(0.03)?, Coulomb::symmetric(0.04)?, 0.1)?;
/// let z = law.steady_torque_nm(-5.0) / law.stiffness_nm_per_rad(); // bent as in steady motion
/// assert!(law.bristle_rate(-5.0, z).abs() < 1e-12);
/// assert!((law.torque_nm(-5.0, z) + 0.03).abs() < 1e-12);
/// # Ok::<(), lissom::drive::DriveError>(())
/// ```
///
/// # Source
/// `[deWit1995, eqs. (2)-(5)]`
///
/// # Differences from the source
/// Fc and Fs may differ by direction. ż stays continuous at v = 0 nevertheless, because 1/g is multiplied by |v|.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LuGre {
    stiffness_nm_per_rad: f64,
    damping_nm_s_per_rad: f64,
    coulomb: Coulomb,
    at_rest: Coulomb,
    stribeck_rad_s: f64,
}

impl LuGre {
    /// Builds the law from σ0 \[N·m/rad\], σ1 \[N·m·s/rad\], Fc, Fs \[N·m\] and vs \[rad/s\].
    ///
    /// # Errors
    /// [`DriveError`] unless σ0, vs and Fc > 0, σ1 ≥ 0 and Fs ≥ Fc in both directions, all finite.
    pub fn new(
        stiffness_nm_per_rad: f64,
        damping_nm_s_per_rad: f64,
        coulomb: Coulomb,
        at_rest: Coulomb,
        stribeck_rad_s: f64,
    ) -> Result<Self, DriveError> {
        let positive = [
            ("bristle stiffness_nm_per_rad", stiffness_nm_per_rad),
            ("stribeck_rad_s", stribeck_rad_s),
            ("forward Coulomb below the bristles", coulomb.forward()),
            ("backward Coulomb below the bristles", coulomb.backward()),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(DriveError::NotPositive { quantity, found });
            }
        }
        let not_negative = [
            ("bristle damping_nm_s_per_rad", damping_nm_s_per_rad),
            ("forward friction at rest above Coulomb's", at_rest.forward() - coulomb.forward()),
            ("backward friction at rest above Coulomb's", at_rest.backward() - coulomb.backward()),
        ];
        for (quantity, found) in not_negative {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(DriveError::Negative { quantity, found });
            }
        }
        Ok(Self { stiffness_nm_per_rad, damping_nm_s_per_rad, coulomb, at_rest, stribeck_rad_s })
    }

    /// Friction at high speed, Fc \[N·m\].
    pub fn coulomb(&self) -> Coulomb {
        self.coulomb
    }

    /// Friction at rest, Fs \[N·m\].
    pub fn at_rest(&self) -> Coulomb {
        self.at_rest
    }

    /// Bristle stiffness σ0 \[N·m/rad\].
    pub fn stiffness_nm_per_rad(&self) -> f64 {
        self.stiffness_nm_per_rad
    }

    /// Bristle damping σ1 \[N·m·s/rad\].
    pub fn damping_nm_s_per_rad(&self) -> f64 {
        self.damping_nm_s_per_rad
    }

    /// Largest deflection at which the bristles can stay, max Fs/σ0 \[rad\].
    pub fn deflection_most_rad(&self) -> f64 {
        self.at_rest.forward().max(self.at_rest.backward()) / self.stiffness_nm_per_rad
    }

    /// g(v) in the direction of v, forward at rest \[N·m\].
    fn level(&self, v: f64) -> f64 {
        self.level_nm(Place::of_velocity(0.0, v, 0.0))
    }

    /// g(v) at a place \[N·m\].
    pub(crate) fn level_nm(&self, at: Place) -> f64 {
        let (fc, fs) = if at.sign < 0.0 {
            (self.coulomb.backward(), self.at_rest.backward())
        } else {
            (self.coulomb.forward(), self.at_rest.forward())
        };
        if fs <= fc {
            return fc;
        }
        let ratio = at.speed / self.stribeck_rad_s;
        fc + (fs - fc) * (-ratio * ratio).exp()
    }

    /// Friction in steady motion at v \[rad/s\], `g(v)·sgn(v)` \[N·m\]; zero at rest.
    pub fn steady_torque_nm(&self, v: f64) -> f64 {
        if v == 0.0 { 0.0 } else { self.level(v).copysign(v) }
    }

    /// Rate of the deflection, ż \[rad/s\], at the velocity v \[rad/s\] and the deflection z \[rad\].
    pub fn bristle_rate(&self, v: f64, z: f64) -> f64 {
        v - self.stiffness_nm_per_rad * v.abs() / self.level(v) * z
    }

    /// Friction torque F \[N·m\] at the velocity v \[rad/s\] and the deflection z \[rad\].
    pub fn torque_nm(&self, v: f64, z: f64) -> f64 {
        self.stiffness_nm_per_rad * z + self.damping_nm_s_per_rad * self.bristle_rate(v, z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(sigma0: f64, sigma1: f64, fs: f64, vs: f64) -> Result<LuGre, DriveError> {
        let coulomb = Coulomb::by_direction(0.03, 0.02)?;
        LuGre::new(sigma0, sigma1, coulomb, Coulomb::by_direction(fs, fs)?, vs)
    }

    #[test]
    fn numbers_that_make_no_law_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(law(bad, 0.1, 0.04, 0.1).is_err());
            assert!(law(300.0, 0.1, 0.04, bad).is_err());
        }
        for bad in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(law(300.0, bad, 0.04, 0.1).is_err());
        }
        let below = law(300.0, 0.1, 0.025, 0.1);
        assert!(matches!(below, Err(DriveError::Negative { .. })), "{below:?}");
        let free = Coulomb::symmetric(0.0).unwrap();
        assert!(LuGre::new(300.0, 0.1, free, free, 0.1).is_err());
    }

    #[test]
    fn friction_at_speed_and_near_rest_is_that_of_its_direction() {
        let law = law(300.0, 0.1, 0.04, 0.1).unwrap();
        for (v, torque) in
            [(10.0, 0.03), (-10.0, -0.02), (1e-12, 0.04), (-1e-12, -0.04), (0.0, 0.0)]
        {
            assert!((law.steady_torque_nm(v) - torque).abs() < 1e-15, "{v}");
        }
    }

    /// Passive where σ1·|v| ≤ 4·g: the quadratic form in z of F·v − σ0·z·ż has no real zero.
    #[test]
    fn bristles_that_are_little_damped_only_take_energy() {
        let law = law(300.0, 0.05, 0.04, 0.1).unwrap();
        for i in -100..=100 {
            let v = 0.016 * f64::from(i); // up to 4·0.02/0.05 = 1.6 rad/s
            for j in -300..=300 {
                let z = 1e-6 * f64::from(j);
                let stored = law.stiffness_nm_per_rad() * z * law.bristle_rate(v, z);
                assert!(law.torque_nm(v, z) * v - stored >= -1e-15, "v {v}, z {z}");
            }
        }
    }
}
