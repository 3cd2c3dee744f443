//! The transfer functions of (16), (15) and (14) in zero-pole-gain form.

use num_complex::Complex64;

use super::damped::quadratic;
use super::{Base, Damping, LumpedBeam, Roots, motor_poles};
use crate::drive::Motor;
use crate::lti::ZeroPoleGain;

impl LumpedBeam {
    /// Transfer function θ_i/θ_m \[1\] of mass `mass`, counted from 0 at the base. `None` if there is no such mass.
    ///
    /// At s = 0 it is one.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]`
    pub fn angle_function(&self, mass: usize) -> Option<ZeroPoleGain> {
        let zeros = self.zeros_s(mass)?;
        let poles = self.poles();
        let gain = ratio(&poles.s, &zeros.s);
        let missing = zeros.missing + poles.missing;
        Some(ZeroPoleGain { zeros: zeros.s, poles: poles.s, gain, missing })
    }

    /// Transfer function C_t/θ_m \[N·m/rad\]; at low frequencies it is I·s², with the inertia I about the axis.
    ///
    /// # Source
    /// `[Feliu1989, eq. (15)]` combined with (13).
    pub fn coupling_function(&self) -> ZeroPoleGain {
        let pinned = self.frequencies_rad_s(Base::Pinned, usize::MAX);
        let squares: Vec<Complex64> = pinned.iter().map(|w| Complex64::from(-w * w)).collect();
        let poles = self.poles();
        let zeros = self.coupling_zeros(&squares);
        let inertia = self.inertia_kg_m2();
        // The zeros at the origin are left out of the low-frequency ratio.
        let apart: Vec<Complex64> =
            zeros.s.iter().filter(|z| **z != Complex64::ZERO).copied().collect();
        let origin = zeros.s.len() - apart.len();
        let low = if origin == 2 { inertia } else { self.drag_nm_s_per_rad() };
        let gain = low * ratio(&poles.s, &apart);
        let missing = zeros.missing + poles.missing;
        ZeroPoleGain { zeros: zeros.s, poles: poles.s, gain, missing }
    }

    /// Torque per rate of turning as one body, of dampers against the fixed frame.
    pub(super) fn drag_nm_s_per_rad(&self) -> f64 {
        let points = self.spans().iter().zip(self.position_m());
        let points: f64 = points.map(|(s, l)| s.damping_n_s_per_m * l * l).sum();
        points + self.damping().proportional().0 * self.inertia_kg_m2()
    }

    fn coupling_zeros(&self, squares: &[Complex64]) -> Roots {
        let (alpha, beta) = self.damping().proportional();
        let points = self.spans().iter().any(|s| s.damping_n_s_per_m > 0.0);
        let modal = matches!(self.damping(), Damping::Modal { .. });
        if !points && !modal {
            // z of the rigid turn is zero: s² + α·s.
            let mut s = vec![Complex64::ZERO, Complex64::from(-alpha)];
            s.extend(squares.iter().flat_map(|z| quadratic(alpha - z * beta, -z)));
            if beta > 0.0 {
                s.push(Complex64::from(-1.0 / beta));
            }
            return Roots { s, missing: 0 };
        }
        self.coupling_zeros_together(squares)
    }
}

/// `Π(−p)/Π(−z)`, real: what makes the value at s = 0 one.
pub(super) fn ratio(poles: &[Complex64], zeros: &[Complex64]) -> f64 {
    let mut value = Complex64::from(1.0);
    for k in 0..poles.len().max(zeros.len()) {
        if let Some(p) = poles.get(k) {
            value *= -p;
        }
        if let Some(z) = zeros.get(k) {
            value /= -z;
        }
    }
    value.re
}

/// Transfer function θ_m/i \[rad/A\] of a beam on a motor, without Coulomb friction. Its
/// zeros are the poles of the beam.
///
/// # Source
/// `[Feliu1989, eqs. (13)-(15)]`; the form of (35).
pub fn motor_function(beam: &LumpedBeam, motor: &Motor) -> ZeroPoleGain {
    driven(beam.poles(), motor_poles(beam, motor), motor)
}

/// θ_m/i from the poles of the beam and those of the whole arm.
pub(super) fn driven(zeros: Roots, poles: Roots, motor: &Motor) -> ZeroPoleGain {
    ZeroPoleGain {
        zeros: zeros.s,
        poles: poles.s,
        gain: motor.torque_constant_nm_per_a() / motor.inertia_kg_m2(),
        missing: zeros.missing + poles.missing,
    }
}

/// Transfer function θ_i/i \[rad/A\], computed from θ_i/θ_m and θ_m/i of the same arm: the zeros of θ_m/i are the poles
/// of θ_i/θ_m and cancel.
pub fn angle_per_current(
    angle: &ZeroPoleGain,
    from_current: &ZeroPoleGain,
    motor: &Motor,
) -> ZeroPoleGain {
    ZeroPoleGain {
        zeros: angle.zeros.clone(),
        poles: from_current.poles.clone(),
        gain: angle.gain * motor.torque_constant_nm_per_a() / motor.inertia_kg_m2(),
        missing: angle.missing + from_current.missing,
    }
}
