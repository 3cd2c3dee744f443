//! Dry friction of a joint in the rig: Coulomb friction by direction, friction near rest, ripple, growth with the root of
//! speed and with the load, and viscous friction that differs by direction.

use super::coulomb::Coulomb;
use super::dry_terms::{DryTerms, TermSeries};
use super::error::DriveError;
use super::falloff::Falloff;
use super::near_rest::NearRest;
use super::place::Place;
use super::ripple::Ripple;
use super::root::Root;
use super::taylor_row::Row;
use super::with_load::WithLoad;
use crate::load::GravityLoad;

/// Dry friction of a joint, with true sticking.
///
/// While the joint turns forward, friction is
/// `F = F_c + (F_s − F_c)·g(v/v_s) + r·C·cos(N·θ_m + φ) + A·√|v| + μ·|g_s·sin θ_m + g_c·cos θ_m| + D·|v|`. F_c is Coulomb friction and F_s friction at rest
/// \[N·m\]; v is the velocity of the motor and v_s the speed over which friction changes \[rad/s\]; g is 1 at rest and
/// 0 at high speed ([`Falloff`]). r is the share of the ripple \[1\], C the mean Coulomb friction of both directions, N
/// the number of waves per turn and φ a phase \[rad\]. A and μ are explained at [`Root`] and [`WithLoad`]. D is half the
/// difference of viscous friction by direction \[N·m·s/rad\].
///
/// While the joint turns backward, the same law holds with F_c and F_s of that direction and −D. At rest the joint
/// holds any torque up to `F_s + r·C·cos(N·θ_m + φ) + μ·|g_s·sin θ_m + g_c·cos θ_m|`. The mean viscous friction V belongs to the
/// [`Motor`](crate::drive::Motor): the total is V + D forward and V − D backward.
///
/// `F_s > F_c` is the Stribeck effect. With `F_s < F_c`, friction grows less than in proportion to speed: a straight
/// line through measurements at high speed, extrapolated to rest, then gives too much Coulomb friction.
///
/// ```
/// use lissom::drive::{Coulomb, DryFriction, Falloff};
/// let sliding = Coulomb::symmetric(0.03)?; // N·m
/// let joint = DryFriction::from(sliding)
///     .with_rest(Coulomb::symmetric(0.05)?, 0.1, Falloff::Exponential)?; // v_s = 0.1 rad/s
/// assert_eq!(joint.at(0.0, 0.0).forward(), 0.05);
/// assert!((joint.at(10.0, 0.0).forward() - 0.03).abs() < 1e-12);
/// # Ok::<(), lissom::drive::DriveError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 5]` for the constant; `[Armstrong1994]` for the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct DryFriction {
    sliding: Coulomb,
    terms: DryTerms,
    viscous_apart_nm_s_per_rad: f64,
}

impl From<Coulomb> for DryFriction {
    fn from(sliding: Coulomb) -> Self {
        Self { sliding, terms: DryTerms::default(), viscous_apart_nm_s_per_rad: 0.0 }
    }
}

impl DryFriction {
    /// Returns this law with friction `rest` at rest (F_s), which passes into Coulomb friction over the speed
    /// `velocity_rad_s` (v_s).
    ///
    /// # Errors
    /// [`DriveError`] unless v_s is positive and finite, and friction in both directions stays
    /// positive or zero with its ripple.
    pub fn with_rest(
        mut self,
        rest: Coulomb,
        velocity_rad_s: f64,
        falloff: Falloff,
    ) -> Result<Self, DriveError> {
        if !(velocity_rad_s > 0.0 && velocity_rad_s.is_finite()) {
            let quantity = "velocity of the Stribeck law";
            return Err(DriveError::NotPositive { quantity, found: velocity_rad_s });
        }
        let (forward, backward) =
            (rest.forward() - self.sliding.forward(), rest.backward() - self.sliding.backward());
        self.terms.near_rest = Some(NearRest {
            torque_nm: 0.5 * (forward + backward),
            offset_nm: 0.5 * (forward - backward),
            speed_rad_s: velocity_rad_s,
            falloff,
        });
        self.braking()
    }

    /// Returns this law with a ripple over the angle: amplitude `share` (r) times the mean Coulomb friction, `per_turn`
    /// (N) waves per turn, phase `phase_rad` (φ) at angle zero.
    ///
    /// # Errors
    /// [`DriveError`] unless 0 ≤ r < 1, N > 0, φ is finite, and friction in both directions stays
    /// positive or zero with its ripple.
    pub fn with_ripple(
        mut self,
        share: f64,
        per_turn: f64,
        phase_rad: f64,
    ) -> Result<Self, DriveError> {
        if !(0.0..1.0).contains(&share) {
            let quantity = "share of the friction's ripple (below 1)";
            return Err(DriveError::Negative { quantity, found: share });
        }
        if !(per_turn > 0.0 && per_turn.is_finite()) {
            let quantity = "periods of the ripple in a turn";
            return Err(DriveError::NotPositive { quantity, found: per_turn });
        }
        if !phase_rad.is_finite() {
            return Err(DriveError::NotFinite {
                quantity: "phase of the ripple",
                found: phase_rad,
            });
        }
        let amplitude = 0.5 * share * (self.sliding.forward() + self.sliding.backward());
        let (sine, cosine) = phase_rad.sin_cos();
        self.terms.ripples = vec![Ripple {
            per_rad: per_turn,
            cosine_nm: amplitude * cosine,
            sine_nm: -amplitude * sine,
        }];
        self.braking()
    }

    /// Returns this law with friction that grows with the square root of speed, `A·√|v|` ([`Root`]).
    ///
    /// # Errors
    /// [`DriveError`] unless A is finite and not negative.
    pub fn with_root(mut self, torque_nm_per_root_rad_s: f64) -> Result<Self, DriveError> {
        not_negative("torque of the square root of speed", torque_nm_per_root_rad_s)?;
        self.terms.root = Some(Root { torque_nm_per_root_rad_s });
        Ok(self)
    }

    /// Returns this law with friction that grows with the torque of gravity: `coefficient` (μ) times that of `load`
    /// ([`WithLoad`]). It does not make this gravity act on the joint.
    ///
    /// # Errors
    /// [`DriveError`] unless μ and the load are finite and μ is not negative.
    pub fn with_load(mut self, coefficient: f64, load: GravityLoad) -> Result<Self, DriveError> {
        not_negative("friction coefficient of the load", coefficient)?;
        not_negative("load of the friction", load.amplitude_nm())?;
        self.terms.with_load = Some(WithLoad { coefficient, load });
        Ok(self)
    }

    /// Returns this law with `apart_nm_s_per_rad` (D) more viscous friction forward, and D less backward.
    ///
    /// # Errors
    /// [`DriveError`] unless D is finite.
    pub fn with_viscous_apart(self, apart_nm_s_per_rad: f64) -> Result<Self, DriveError> {
        if !apart_nm_s_per_rad.is_finite() {
            let quantity = "difference of viscous friction by direction";
            return Err(DriveError::NotFinite { quantity, found: apart_nm_s_per_rad });
        }
        Ok(Self { viscous_apart_nm_s_per_rad: apart_nm_s_per_rad, ..self })
    }

    /// Refuses friction that would push somewhere.
    fn braking(self) -> Result<Self, DriveError> {
        let waves: f64 = self.terms.ripples.iter().map(Ripple::amplitude_nm).sum();
        let (forward, backward) = (self.sliding.forward(), self.sliding.backward());
        let (near, apart) = self.terms.near_rest.map_or((0.0, 0.0), |n| (n.torque_nm, n.offset_nm));
        let rest = [forward + near + apart, backward + near - apart];
        let least = rest.into_iter().fold(forward.min(backward), f64::min);
        // A sum of the same numbers in another order is off by its rounding.
        if least - waves < -f64::EPSILON * (forward + backward) {
            let quantity = "friction in one direction, its ripple taken off";
            return Err(DriveError::Negative { quantity, found: least - waves });
        }
        Ok(self)
    }

    /// The same with all of its dry friction times `factor`, which is not negative; viscous friction stays.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        scaled.sliding = self.sliding.scaled(factor);
        if let Some(near) = &mut scaled.terms.near_rest {
            near.torque_nm *= factor;
            near.offset_nm *= factor;
        }
        for ripple in &mut scaled.terms.ripples {
            ripple.cosine_nm *= factor;
            ripple.sine_nm *= factor;
        }
        if let Some(root) = &mut scaled.terms.root {
            root.torque_nm_per_root_rad_s *= factor;
        }
        if let Some(load) = &mut scaled.terms.with_load {
            load.coefficient *= factor;
        }
        scaled
    }

    /// Coulomb friction F_c: friction at high speed, without ripple and viscous friction.
    pub fn sliding(&self) -> Coulomb {
        self.sliding
    }

    /// All terms besides Coulomb friction and viscous friction.
    pub fn terms(&self) -> &DryTerms {
        &self.terms
    }

    /// Whether there is no friction at all.
    pub fn is_zero(&self) -> bool {
        let rest = self.at(0.0, 0.0);
        let (forward, backward) = (rest.forward(), rest.backward());
        let none = self.sliding.forward() == 0.0 && self.sliding.backward() == 0.0;
        let by_speed = self.viscous_apart_nm_s_per_rad != 0.0
            || self.terms.root.is_some_and(|r| r.torque_nm_per_root_rad_s != 0.0);
        none && forward == 0.0 && backward == 0.0 && !by_speed
    }

    /// Whether friction is constant while the joint slips, so that the motion between events is linear.
    pub fn is_constant(&self) -> bool {
        self.terms.is_empty() && self.viscous_apart_nm_s_per_rad == 0.0
    }

    /// Friction in both directions at the velocity `velocity_rad_s` and the angle `angle_rad`; at velocity zero, the
    /// limits of the torque that the joint holds.
    pub fn at(&self, velocity_rad_s: f64, angle_rad: f64) -> Coulomb {
        let speed = velocity_rad_s.abs();
        let terms = |sign| self.terms.braking_nm(Place { angle: angle_rad, speed, sign });
        let apart = self.viscous_apart_nm_s_per_rad * speed;
        Coulomb::of_limits(
            self.sliding.forward() + terms(1.0) + apart,
            self.sliding.backward() + terms(-1.0) - apart,
        )
    }
}

fn not_negative(quantity: &'static str, found: f64) -> Result<(), DriveError> {
    if found >= 0.0 && found.is_finite() {
        return Ok(());
    }
    Err(DriveError::Negative { quantity, found })
}

/// Taylor coefficients of a friction torque along a motion, one after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionSeries {
    terms: TermSeries,
}

impl FrictionSeries {
    /// The signed coefficient of order `k` while slipping in the direction of `sign`, from those of
    /// angle and velocity up to that order.
    pub(crate) fn next(
        &mut self,
        law: &DryFriction,
        k: usize,
        sign: f64,
        (angle, velocity): (&Row, &Row),
    ) -> f64 {
        let sliding = if sign > 0.0 { law.sliding.forward() } else { law.sliding.backward() };
        let constant = if k == 0 { sliding } else { 0.0 };
        let terms = self.terms.next(&law.terms, k, sign, (angle, velocity));
        sign * (constant + terms + law.viscous_apart_nm_s_per_rad * velocity[k])
    }
}

#[cfg(test)]
mod tests {
    use super::super::taylor_row::COEFFICIENTS;
    use super::*;

    /// Friction along θ = 0.3 + 0.5·t − 0.2·t², summed and asked for directly.
    #[test]
    fn series_add_up_to_the_law() {
        for falloff in [Falloff::Exponential, Falloff::Gaussian] {
            let law = DryFriction::from(Coulomb::by_direction(0.03, 0.02).unwrap())
                .with_rest(Coulomb::by_direction(0.05, 0.015).unwrap(), 0.7, falloff)
                .and_then(|law| law.with_ripple(0.3, 7.0, 0.4))
                .and_then(|law| law.with_viscous_apart(4e-3))
                .and_then(|law| law.with_root(0.02))
                .and_then(|law| law.with_load(0.1, GravityLoad { sine_nm: 0.3, cosine_nm: 0.1 }))
                .unwrap();
            for sign in [1.0, -1.0] {
                let mut angle = [0.0; COEFFICIENTS];
                angle[..3].copy_from_slice(&[0.3, sign * 0.5, sign * -0.2]);
                let mut velocity = [0.0; COEFFICIENTS];
                velocity[..2].copy_from_slice(&[sign * 0.5, sign * -0.4]);
                let mut series = FrictionSeries::default();
                let (t, mut power, mut sum) = (0.1_f64, 1.0, 0.0);
                for k in 0..COEFFICIENTS {
                    sum += power * series.next(&law, k, sign, (&angle, &velocity));
                    power *= t;
                }
                let v = sign * (0.5 - 0.4 * t);
                let exact = law.at(v, 0.3 + sign * (0.5 * t - 0.2 * t * t)).slipping(sign);
                assert!((sum - exact).abs() < 1e-15, "{sum} {exact}");
            }
        }
    }

    #[test]
    fn senseless_numbers_are_refused() {
        let law = DryFriction::from(Coulomb::symmetric(0.03).unwrap());
        let rest = Coulomb::symmetric(0.05).unwrap();
        assert!(law.clone().with_rest(rest, 0.0, Falloff::Gaussian).is_err());
        assert!(law.clone().with_rest(rest, f64::NAN, Falloff::Gaussian).is_err());
        assert!(law.clone().with_ripple(1.0, 6.0, 0.0).is_err());
        assert!(law.clone().with_ripple(0.1, 0.0, 0.0).is_err());
        assert!(law.clone().with_ripple(0.1, 6.0, f64::INFINITY).is_err());
        assert!(law.clone().with_viscous_apart(f64::NAN).is_err());
        assert!(law.clone().with_root(-0.1).is_err() && law.clone().with_root(f64::NAN).is_err());
        let load = GravityLoad { sine_nm: 1.0, cosine_nm: 0.0 };
        assert!(law.clone().with_load(-0.1, load).is_err());
        let infinite = GravityLoad { sine_nm: f64::INFINITY, ..load };
        assert!(law.clone().with_load(0.1, infinite).is_err());
        let least = Coulomb::symmetric(0.01).unwrap();
        let rippled = law.with_ripple(0.5, 6.0, 0.0).unwrap();
        assert!(rippled.with_rest(least, 1.0, Falloff::Gaussian).is_err());
    }
}
