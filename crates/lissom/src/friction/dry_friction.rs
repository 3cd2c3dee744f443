//! Dry friction whose size follows speed and position: Coulomb, Stribeck, ripple.

use super::coulomb::Coulomb;
use super::error::DriveError;
use super::falloff::Falloff;

/// Friction at rest that differs from the friction at speed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stribeck {
    rest: Coulomb,
    velocity_rad_s: f64,
    falloff: Falloff,
}

/// Friction that differs over the turn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ripple {
    share: f64,
    per_turn: f64,
    phase_rad: f64,
}

/// A joint's dry friction, with true sticking.
///
/// While the joint turns forward it takes `F = [F_c + (F_s − F_c)·g(v/v_s)]·[1 + r·cos(N·θ_m + φ)] + D·|v|`,
/// with `g` = 1 at rest and 0 at speed; backward likewise with that direction's figures, and −D. At rest
/// the joint holds any torque up to `F_s` times the ripple at its angle. Viscous friction is the
/// [`Motor`](crate::drive::Motor)'s, V + D forward and V − D backward.
///
/// `F_s > F_c` is the Stribeck effect. `F_s < F_c` is viscous friction that grows less than
/// linearly: a line through fast points then meets rest above the true friction.
///
/// ```
/// use lissom::drive::{Coulomb, DryFriction, Falloff};
/// let sliding = Coulomb::symmetric(0.03)?; // N·m
/// let joint = DryFriction::from(sliding)
///     .with_rest(Coulomb::symmetric(0.05)?, 0.1, Falloff::Exponential)?; // v_s = 0.1 rad/s
/// assert_eq!(joint.at(0.0, 0.0).forward, 0.05);
/// assert!((joint.at(10.0, 0.0).forward - 0.03).abs() < 1e-12);
/// # Ok::<(), lissom::drive::DriveError>(())
/// ```
///
/// # Source
/// `[Feliu1989, Section 5]` for the constant; `[Armstrong1994]` for the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DryFriction {
    sliding: Coulomb,
    stribeck: Option<Stribeck>,
    ripple: Option<Ripple>,
    viscous_apart_nm_s_per_rad: f64,
}

impl From<Coulomb> for DryFriction {
    fn from(sliding: Coulomb) -> Self {
        Self { sliding, stribeck: None, ripple: None, viscous_apart_nm_s_per_rad: 0.0 }
    }
}

impl DryFriction {
    /// The same with another friction `rest` at rest (F_s), which falls off, or grows, to that at
    /// speed over `velocity_rad_s` (v_s).
    ///
    /// # Errors
    /// [`DriveError`] unless v_s > 0 and finite.
    pub fn with_rest(
        self,
        rest: Coulomb,
        velocity_rad_s: f64,
        falloff: Falloff,
    ) -> Result<Self, DriveError> {
        if !(velocity_rad_s > 0.0 && velocity_rad_s.is_finite()) {
            let quantity = "velocity of the Stribeck law";
            return Err(DriveError::NotPositive { quantity, found: velocity_rad_s });
        }
        Ok(Self { stribeck: Some(Stribeck { rest, velocity_rad_s, falloff }), ..self })
    }

    /// The same with friction that changes over the turn by the share `share` (r), `per_turn` (N)
    /// times a turn, from the phase `phase_rad` (φ) at angle zero.
    ///
    /// # Errors
    /// [`DriveError`] unless 0 ≤ r < 1, N > 0 and φ is finite.
    pub fn with_ripple(
        self,
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
        Ok(Self { ripple: Some(Ripple { share, per_turn, phase_rad }), ..self })
    }

    /// The same with `apart_nm_s_per_rad` (D) more viscous friction forward, and as much less backward.
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

    /// The friction at speed, ripple and viscous friction left out.
    pub fn sliding(&self) -> Coulomb {
        self.sliding
    }

    /// Whether there is none.
    pub fn is_zero(&self) -> bool {
        let none = |c: Coulomb| c.forward == 0.0 && c.backward == 0.0;
        let constant = none(self.sliding) && self.stribeck.is_none_or(|s| none(s.rest));
        constant && self.viscous_apart_nm_s_per_rad == 0.0
    }

    /// Whether it is constant in slip, so that the motion between events is linear.
    pub fn is_constant(&self) -> bool {
        let terms = self.stribeck.is_some() || self.ripple.is_some();
        !terms && self.viscous_apart_nm_s_per_rad == 0.0
    }

    /// Friction in both directions at the speed `velocity_rad_s` and the angle `angle_rad`; at rest
    /// what the joint holds.
    pub fn at(&self, velocity_rad_s: f64, angle_rad: f64) -> Coulomb {
        let ripple = self
            .ripple
            .map_or(1.0, |r| 1.0 + r.share * (r.per_turn * angle_rad + r.phase_rad).cos());
        let side = |pick: fn(Coulomb) -> f64| {
            let rest = self.stribeck.map_or(0.0, |s| {
                let fall = s.falloff.share(velocity_rad_s.abs() / s.velocity_rad_s);
                (pick(s.rest) - pick(self.sliding)) * fall
            });
            ripple * (pick(self.sliding) + rest)
        };
        let apart = self.viscous_apart_nm_s_per_rad * velocity_rad_s.abs();
        Coulomb { forward: side(|c| c.forward) + apart, backward: side(|c| c.backward) - apart }
    }
}

/// Most Taylor coefficients of a friction torque.
pub(crate) const COEFFICIENTS: usize = 25;
type Row = [f64; COEFFICIENTS];

/// Taylor coefficients of a friction torque along a motion, one after the other.
///
/// For `f = e^u`: `k·f_k = Σ j·u_j·f_{k−j}`, and likewise for the pair of sine and cosine.
#[derive(Debug, Clone)]
pub(crate) struct FrictionSeries {
    exponent: Row,
    fall: Row,
    sine: Row,
    cosine: Row,
}

impl Default for FrictionSeries {
    fn default() -> Self {
        let zero = [0.0; COEFFICIENTS];
        Self { exponent: zero, fall: zero, sine: zero, cosine: zero }
    }
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
        let pick = |c: Coulomb| if sign > 0.0 { c.forward } else { c.backward };
        let sliding = pick(law.sliding);
        let constant = if k == 0 { sliding } else { 0.0 };
        let smooth = law.stribeck.map_or(0.0, |s| {
            self.extend_fall(&s, k, sign, velocity);
            (pick(s.rest) - sliding) * self.fall[k]
        });
        let apart = law.viscous_apart_nm_s_per_rad * velocity[k];
        let Some(ripple) = law.ripple else { return sign * (constant + smooth + apart) };
        self.extend_waves(&ripple, k, angle);
        // The product of the series (F_c + fall) and (1 + r·cos).
        let rest = law.stribeck.map_or(0.0, |s| pick(s.rest) - sliding);
        let size = |j: usize| if j == 0 { sliding } else { 0.0 } + rest * self.fall[j];
        let product: f64 = (0..=k).map(|j| size(j) * self.cosine[k - j]).sum();
        sign * (constant + smooth + apart + ripple.share * product)
    }

    fn extend_fall(&mut self, law: &Stribeck, k: usize, sign: f64, velocity: &Row) {
        let scale = 1.0 / law.velocity_rad_s;
        self.exponent[k] = match law.falloff {
            Falloff::Exponential => -sign * scale * velocity[k],
            Falloff::Gaussian => {
                let square: f64 = (0..=k).map(|j| velocity[j] * velocity[k - j]).sum();
                -scale * scale * square
            }
        };
        self.fall[k] = if k == 0 {
            self.exponent[0].exp()
        } else {
            let sum: f64 = (1..=k).map(|j| j as f64 * self.exponent[j] * self.fall[k - j]).sum();
            sum / k as f64
        };
    }

    fn extend_waves(&mut self, law: &Ripple, k: usize, angle: &Row) {
        if k == 0 {
            (self.sine[0], self.cosine[0]) = (law.per_turn * angle[0] + law.phase_rad).sin_cos();
            return;
        }
        let (mut sine, mut cosine) = (0.0, 0.0);
        for (j, turned) in angle[..=k].iter().enumerate() {
            let rate = j as f64 * law.per_turn * turned;
            sine += rate * self.cosine[k - j];
            cosine -= rate * self.sine[k - j];
        }
        self.sine[k] = sine / k as f64;
        self.cosine[k] = cosine / k as f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Friction along θ = 0.3 + 0.5·t − 0.2·t², summed and asked for directly.
    #[test]
    fn series_add_up_to_the_law() {
        for falloff in [Falloff::Exponential, Falloff::Gaussian] {
            let law = DryFriction::from(Coulomb::by_direction(0.03, 0.02).unwrap())
                .with_rest(Coulomb::by_direction(0.05, 0.01).unwrap(), 0.7, falloff)
                .and_then(|law| law.with_ripple(0.3, 7.0, 0.4))
                .and_then(|law| law.with_viscous_apart(4e-3))
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
        assert!(law.with_rest(rest, 0.0, Falloff::Gaussian).is_err());
        assert!(law.with_rest(rest, f64::NAN, Falloff::Gaussian).is_err());
        assert!(law.with_ripple(1.0, 6.0, 0.0).is_err());
        assert!(law.with_ripple(0.1, 0.0, 0.0).is_err());
        assert!(law.with_ripple(0.1, 6.0, f64::INFINITY).is_err());
        assert!(law.with_viscous_apart(f64::NAN).is_err());
    }
}
