//! Poles and zeros in the s plane, with damping.

use num_complex::Complex64;

use super::chain::Joined;
use super::element::At;
use super::frequencies::{degrees, from_tip};
use super::response::at_damped;
use super::roots::together;
use super::span::Damping;
use super::zeros::{at_joint, log_slope};
use super::{Base, LumpedBeam, Mode};
use crate::drive::Motor;
use crate::number::{Dual, Number, Scaled};

/// Poles or zeros in the s plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Roots {
    /// The roots \[1/s\]; conjugate roots follow each other.
    pub s: Vec<Complex64>,
    /// Number of roots that were not found, or not to ten digits; zero except for extreme beams.
    pub missing: usize,
}

type Jet = Dual<Complex64>;

/// Where a starting point leaves the axis that symmetry would keep it on.
const ASIDE: Complex64 = Complex64::new(-1e-3, 7e-4);

impl LumpedBeam {
    /// Poles of θ_i/θ_m \[1/s\]: those of the beam with the motor clamped, with damping.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]`, with damping added.
    pub fn poles(&self) -> Roots {
        let squares: Vec<Complex64> =
            self.natural_frequencies_rad_s().iter().map(|w| Complex64::from(-w * w)).collect();
        self.in_s(&squares, 0, |s| self.characteristic(s).0)
    }

    /// Zeros of θ_i/θ_m \[1/s\] at mass `mass`, counted from 0 at the base, with damping.
    /// `None` if there is no such mass.
    ///
    /// Damping in proportion to the stiffness adds a zero at −1/β, because it transmits motion without delay.
    pub fn zeros_s(&self, mass: usize) -> Option<Roots> {
        let undamped = self.zeros(mass)?;
        let joint = self.joints().nth(mass)?;
        if let Damping::Modal { .. } = self.damping() {
            let modes = self.modes(usize::MAX);
            let numerator = |s| self.modal_characteristic(s, &modes, Some(mass)).0;
            let mut starts = starts(&undamped.z);
            // Modal damping moves a point through its modes' rates: relative degree one.
            let rate: f64 = (0..modes.len())
                .map(|k| {
                    let zeta = self.damping().ratio(k).unwrap_or(0.0);
                    2.0 * zeta * modes[k].natural_frequency_rad_s * modes[k].share[mass]
                })
                .sum();
            let acceleration: f64 =
                modes.iter().map(|m| m.share[mass] * m.natural_frequency_rad_s.powi(2)).sum();
            if rate != 0.0 {
                starts.push(Complex64::from(-acceleration / rate));
            }
            let (s, unsettled) = together(|s| log_slope(numerator(Jet::variable(s))), starts);
            return Some(Roots { s: sorted(s), missing: unsettled + undamped.missing });
        }
        let numerator = |s: Jet| {
            let (at, elastic): (At<Jet>, Jet) = at_damped(s, self.damping());
            let joined: Joined<Jet> = at_joint(self.elements(), joint, at);
            // β's poles at −1/β are those of the denominator too.
            (1..degrees(self.elements())).fold(joined.numerator(), |n, _| n.times(elastic))
        };
        let mut found = self.in_s(&undamped.z, undamped.missing, numerator);
        let (_, beta) = self.damping().proportional();
        if beta > 0.0 {
            found.s.push(Complex64::from(-1.0 / beta));
        }
        Some(found)
    }

    /// Roots in s from those in z = s² of the undamped beam: themselves, by the map of
    /// proportional damping, or as starting points.
    fn in_s(
        &self,
        squares: &[Complex64],
        missing: usize,
        function: impl Fn(Jet) -> Scaled<Jet>,
    ) -> Roots {
        let (alpha, beta) = self.damping().proportional();
        let points = self.spans().iter().any(|s| s.damping_n_s_per_m > 0.0);
        if let Damping::Modal { .. } = self.damping() {
            let ratio = |k: usize| self.damping().ratio(k).unwrap_or(0.0);
            let s = squares.iter().enumerate().flat_map(|(k, z)| {
                quadratic(Complex64::from(2.0 * ratio(k) * (-z.re).max(0.0).sqrt()), -z)
            });
            return Roots { s: s.collect(), missing };
        }
        if !points {
            // s² + α·s = z·(1 + β·s)
            let s = squares.iter().flat_map(|z| quadratic(alpha - z * beta, -z));
            return Roots { s: s.collect(), missing };
        }
        let (s, unsettled) = together(|s| log_slope(function(Jet::variable(s))), starts(squares));
        Roots { s: sorted(s), missing: missing + unsettled }
    }

    /// The characteristic function in s with the motor clamped, and C_t/θ_m.
    pub(crate) fn characteristic(&self, s: Jet) -> (Scaled<Jet>, Jet) {
        if let Damping::Modal { .. } = self.damping() {
            return self.modal_characteristic(s, &self.modes(usize::MAX), None);
        }
        let (at, elastic) = at_damped(s, self.damping());
        let at: At<Jet> = at;
        let side = from_tip(self.elements(), at);
        // β's poles at −1/β are no poles of the arm.
        let mut det = side.det;
        for _ in 0..degrees(self.elements()) {
            det = det.times(elastic);
        }
        (det, side.stiffness.c * elastic)
    }

    /// The same with a damping ratio for each mode; with a mass, its numerator and its response.
    pub(crate) fn modal_characteristic(
        &self,
        s: Jet,
        modes: &[Mode],
        mass: Option<usize>,
    ) -> (Scaled<Jet>, Jet) {
        let mut det = Scaled::one();
        let mut angle = Jet::real(1.0);
        let mut inertia = Jet::real(self.inertia_kg_m2());
        for (k, mode) in modes.iter().enumerate() {
            let omega = mode.natural_frequency_rad_s;
            let zeta = self.damping().ratio(k).unwrap_or(0.0);
            let factor = s * s + s.times(2.0 * zeta * omega) + Jet::real(omega * omega);
            let driven = s * s / factor;
            det = det.times(factor.times(1.0 / (omega * omega)));
            inertia = inertia - driven.times(mode.inertia_kg_m2);
            if let Some(mass) = mass {
                angle = angle - driven.times(mode.share[mass]);
            }
        }
        if mass.is_some() { (det.times(angle), angle) } else { (det, s * s * inertia) }
    }
}

/// Roots of `s² + b·s + c`, without cancellation.
pub(crate) fn quadratic(b: Complex64, c: Complex64) -> [Complex64; 2] {
    let root = (b * b - c * 4.0).sqrt();
    let far = if (b.conj() * root).re >= 0.0 { b + root } else { b - root };
    if far.norm() == 0.0 {
        return [Complex64::ZERO; 2];
    }
    let first = -far / 2.0;
    let second = c / first;
    // The upper one first.
    if first.im < second.im { [second, first] } else { [first, second] }
}

/// Starting points ±√z, moved a little off the axes.
pub(crate) fn starts(squares: &[Complex64]) -> Vec<Complex64> {
    squares
        .iter()
        .flat_map(|z| {
            let s = z.sqrt();
            [s + ASIDE * s.norm(), -s + ASIDE.conj() * s.norm()]
        })
        .collect()
}

/// By growing modulus, the upper of a conjugate pair first; rounding off the real axis is dropped.
pub(crate) fn sorted(mut s: Vec<Complex64>) -> Vec<Complex64> {
    for root in &mut s {
        if root.im.abs() < 1e-12 * root.norm() {
            root.im = 0.0;
        }
    }
    s.sort_by(|a, b| {
        let close = (a.norm() - b.norm()).abs() <= 1e-10 * a.norm();
        let by_size = if close { std::cmp::Ordering::Equal } else { a.norm().total_cmp(&b.norm()) };
        by_size.then(a.re.total_cmp(&b.re)).then(b.im.total_cmp(&a.im))
    });
    s
}

/// Poles of θ_m/i \[1/s\] of a beam on a motor without Coulomb friction: the roots of `J·s² + V·s + C_t/θ_m`. One of
/// them is s = 0.
///
/// # Source
/// `[Feliu1989, eqs. (14), (15)]`
pub fn motor_poles(beam: &LumpedBeam, motor: &Motor) -> Roots {
    let (j, v) = (motor.inertia_kg_m2(), motor.viscous_nm_s_per_rad());
    let coupled = beam.frequencies_rad_s(Base::Rotor(j), usize::MAX);
    let squares: Vec<Complex64> = coupled.iter().map(|w| Complex64::from(-w * w)).collect();
    if beam.is_undamped() && v == 0.0 {
        let mut s = vec![Complex64::ZERO; 2];
        s.extend(squares.iter().flat_map(|z| quadratic(Complex64::ZERO, -z)));
        return Roots { s, missing: 0 };
    }
    let modes = match beam.damping() {
        Damping::Modal { .. } => beam.modes(usize::MAX),
        _ => Vec::new(),
    };
    // Divided by s, or by s² where nothing brakes the arm as a whole: roots at zero are known.
    let drag = v + beam.drag_nm_s_per_rad();
    let free = drag == 0.0;
    let function = |s: Complex64| {
        let s = Jet::variable(s);
        let (det, coupling) = match beam.damping() {
            Damping::Modal { .. } => beam.modal_characteristic(s, &modes, None),
            _ => beam.characteristic(s),
        };
        let whole = s.times(j) + Jet::real(v) + coupling / s;
        log_slope(det.times(if free { whole / s } else { whole }))
    };
    let mut all = starts(&squares);
    let mut known = vec![Complex64::ZERO];
    if free {
        known.push(Complex64::ZERO);
    } else {
        all.push(Complex64::from(-drag / (j + beam.inertia_kg_m2())));
    }
    let (mut s, missing) = together(function, all);
    s.extend(known);
    Roots { s: sorted(s), missing }
}

impl LumpedBeam {
    /// Zeros of C_t/θ_m where dampers at the masses or modal ratios leave no closed form: from
    /// those without damping.
    pub(super) fn coupling_zeros_together(&self, squares: &[Complex64]) -> Roots {
        let modal = matches!(self.damping(), Damping::Modal { .. });
        let modes = if modal { self.modes(usize::MAX) } else { Vec::new() };
        let (_, beta) = self.damping().proportional();
        // Divided by s: the zero at the origin is known, and with modal damping, which turning as
        // one body does not feel, it is double.
        let function = |s: Complex64| {
            let s = Jet::variable(s);
            if modal {
                let (det, coupling) = self.modal_characteristic(s, &modes, None);
                return log_slope(det.times(coupling / (s * s)));
            }
            // −1/β is known as well.
            let (det, coupling) = self.characteristic(s);
            log_slope(det.times(coupling / s / (Jet::real(1.0) + s.times(beta))))
        };
        let mut all = starts(squares);
        let mut known = vec![Complex64::ZERO];
        if modal {
            known.push(Complex64::ZERO);
            // Relative degree one: the modes' rates pass torque on at once.
            let (mut rate, mut stiffness) = (0.0, 0.0);
            for (k, mode) in modes.iter().enumerate() {
                let omega = mode.natural_frequency_rad_s;
                let zeta = self.damping().ratio(k).unwrap_or(0.0);
                rate += 2.0 * zeta * omega * mode.inertia_kg_m2;
                stiffness += omega * omega * mode.inertia_kg_m2;
            }
            if rate > 0.0 {
                all.push(Complex64::from(-stiffness / rate));
            }
        } else {
            let drag = self.drag_nm_s_per_rad();
            all.push(Complex64::from(-drag / self.inertia_kg_m2()));
        }
        if beta > 0.0 {
            known.push(Complex64::from(-1.0 / beta));
        }
        let (mut s, missing) = together(function, all);
        s.extend(known);
        Roots { s: sorted(s), missing }
    }
}
