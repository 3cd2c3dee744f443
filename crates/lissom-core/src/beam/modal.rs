//! A beam that is known by its modes at some points, for example from measured responses.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use super::damped::{quadratic, sorted, starts};
use super::modal_form::{ModalForm, completed, zero_squares};
use super::response::BeamResponse;
use super::roots::together;
use super::transfer::{driven, ratio};
use super::zeros::log_slope;
use super::{Base, BeamDynamics, BeamError, Mode, Roots, Zeros};
use crate::drive::Motor;
use crate::lti::ZeroPoleGain;
use crate::number::{Dual, Number, Scaled};

/// Points whose gains are dependent to this are refused.
const DEPENDENT: f64 = 1e-10;
/// A point's gains add up to one to this: numbers in a file are rounded.
const SUM: f64 = 1e-6;

type Jet = Dual<Complex64>;

/// A mode with the motor clamped, as it appears at the points and at the motor.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownMode {
    /// ω_k, natural frequency \[rad/s\].
    pub omega_rad_s: f64,
    /// ζ_k, damping ratio \[1\]; damping acts against the fixed frame.
    pub damping_ratio: f64,
    /// c_k, coupling torque through this mode per angle \[N·m/rad\].
    pub coupling_nm_per_rad: f64,
    /// ρ_ik, gain at rest of this mode at each point \[1\].
    pub gains: Vec<f64>,
}

/// A beam without dimensions, known by its modes at as many points as there are modes:
///
/// `η̈_k = ω_k²·(θ_m − η_k) − 2ζ_kω_k·η̇_k`, `θ_i = Σ_k ρ_ik·η_k`, `C_t = Σ_k c_k·(θ_m − η_k)`.
///
/// η_k is the coordinate of mode k \[rad\], θ_i the angle of point i; the other symbols are explained at [`KnownMode`].
/// The gains of each point add up to one, so that the beam is not bent when it turns as one body. In the angles of the
/// points this is (17)-(18) with `Â = −ρ·Ω²·ρ⁻¹` and `Ĥ = −cᵀ·ρ⁻¹`, ρ the matrix of gains and Ω² = diag(ω_k²). The
/// inertia of the beam about the axis is `Σ c_k/ω_k²`.
///
/// # Source
/// `[Feliu1989, eqs. (17), (18), Section 4]`
#[derive(Debug, Clone, PartialEq)]
pub struct ModalBeam {
    modes: Vec<KnownMode>,
    /// ρ, points × modes.
    gains: DMatrix<f64>,
    /// ρ⁻¹.
    inverse: DMatrix<f64>,
}

impl ModalBeam {
    /// Builds a beam from its modes, in any order; they are sorted by frequency.
    ///
    /// # Errors
    /// [`BeamError::NoModes`] without modes. [`BeamError::ModesAndPoints`] if a mode has more or fewer gains than there
    /// are modes. [`BeamError::KnownMode`] if a frequency or a coupling is not positive, a damping ratio is negative,
    /// or a number is not finite. [`BeamError::GainsSum`] if the gains of a point do not add up to one.
    /// [`BeamError::PointsTooClose`] if the modes look alike at the points. [`BeamError::OutOfRange`] if the stiffness
    /// leaves the range of a double.
    ///
    /// ```
    /// use lissom::beam::{KnownMode, ModalBeam};
    /// let mode = |omega_rad_s, gain| KnownMode {
    ///     omega_rad_s,
    ///     damping_ratio: 0.0,
    ///     coupling_nm_per_rad: 0.5,
    ///     gains: vec![gain, 1.2 - 0.5 * gain],
    /// };
    /// let beam = ModalBeam::new(vec![mode(40.0, 0.4), mode(9.0, 0.6)]);
    /// assert!(beam.is_err()); // the second point's gains add up to 1.9
    /// ```
    pub fn new(mut modes: Vec<KnownMode>) -> Result<Self, BeamError> {
        let count = modes.len();
        if count == 0 {
            return Err(BeamError::NoModes);
        }
        for (index, m) in modes.iter().enumerate() {
            let mode = index + 1;
            if m.gains.len() != count {
                let points = m.gains.len();
                return Err(BeamError::ModesAndPoints { mode, points, modes: count });
            }
            let positive = |x: f64| x > 0.0 && x.is_finite();
            let sound = [
                ("omega_rad_s", m.omega_rad_s, positive(m.omega_rad_s)),
                ("damping_ratio", m.damping_ratio, (0.0..f64::MAX).contains(&m.damping_ratio)),
                ("coupling_nm_per_rad", m.coupling_nm_per_rad, positive(m.coupling_nm_per_rad)),
            ];
            let gains = m.gains.iter().map(|g| ("gains", *g, g.is_finite()));
            if let Some((quantity, found, _)) = sound.into_iter().chain(gains).find(|q| !q.2) {
                return Err(BeamError::KnownMode { mode, quantity, found });
            }
        }
        modes.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
        let given = DMatrix::from_fn(count, count, |i, k| modes[k].gains[i]);
        let sums = given.row_iter().map(|row| row.sum()).enumerate();
        if let Some((index, sum)) = sums.into_iter().find(|(_, s)| (s - 1.0).abs() > SUM) {
            return Err(BeamError::GainsSum { point: index + 1, sum });
        }
        let gains = completed(given);
        let values = gains.singular_values();
        let condition = values.min() / values.max();
        let inverse = gains.clone().try_inverse().filter(|_| condition > DEPENDENT);
        let inverse = inverse.ok_or(BeamError::PointsTooClose { condition })?;
        for (k, mode) in modes.iter_mut().enumerate() {
            mode.gains = gains.column(k).iter().copied().collect();
        }
        let beam = Self { modes, gains, inverse };
        let sound = beam.dynamics().elastic.iter().all(|v| v.is_finite());
        if sound { Ok(beam) } else { Err(BeamError::OutOfRange { quantity: "the stiffness" }) }
    }

    /// The modes, ascending in frequency.
    pub fn known_modes(&self) -> &[KnownMode] {
        &self.modes
    }
    /// Number of points, which is the number of modes.
    pub fn len(&self) -> usize {
        self.modes.len()
    }
    /// Never true: there is at least one mode.
    pub fn is_empty(&self) -> bool {
        self.modes.is_empty()
    }
    /// Whether there is no damping.
    pub fn is_undamped(&self) -> bool {
        self.modes.iter().all(|m| m.damping_ratio == 0.0)
    }

    /// Inertia about the motor's axis when the beam turns as one rigid body, `Σ c_k/ω_k²` \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        self.modes.iter().map(KnownMode::inertia_kg_m2).sum()
    }

    /// The lowest `count` modes in the form of a beam with dimensions; shapes are angles instead of deflections.
    pub fn modes(&self, count: usize) -> Vec<Mode> {
        let mode = |m: &KnownMode| {
            let most = m.gains.iter().fold(0.0, |a: f64, g| if g.abs() > a.abs() { *g } else { a });
            Mode {
                natural_frequency_rad_s: m.omega_rad_s,
                shape: m.gains.iter().map(|g| g / most).collect(),
                share: m.gains.clone(),
                inertia_kg_m2: m.inertia_kg_m2(),
            }
        };
        self.modes.iter().take(count).map(mode).collect()
    }

    /// The lowest `count` natural frequencies, ascending \[rad/s\], without damping.
    pub fn frequencies_rad_s(&self, base: Base, count: usize) -> Vec<f64> {
        let n = self.len();
        let coupling = |k: usize| self.modes[k].coupling_nm_per_rad;
        let omega = |k: usize| self.modes[k].omega_rad_s;
        let rotor = match base {
            Base::Clamped => return (0..n.min(count)).map(omega).collect(),
            Base::Pinned => None,
            Base::Rotor(inertia) => Some(inertia),
        };
        let total: f64 = (0..n).map(coupling).sum();
        // Over the roots of the modes' inertias c_k/ω_k², and of the rotor's.
        let matrix = match rotor {
            None => DMatrix::from_fn(n, n, |i, k| {
                let own = if i == k { omega(k) * omega(k) } else { 0.0 };
                own - omega(i) * omega(k) * (coupling(i) * coupling(k)).sqrt() / total
            }),
            Some(inertia) => DMatrix::from_fn(n + 1, n + 1, |i, k| {
                let mixed = |k: usize| -omega(k) * (coupling(k) / inertia).sqrt();
                match (i.checked_sub(1), k.checked_sub(1)) {
                    (None, None) => total / inertia,
                    (None, Some(k)) | (Some(k), None) => mixed(k),
                    (Some(i), Some(k)) if i == k => omega(k) * omega(k),
                    _ => 0.0,
                }
            }),
        };
        let mut squares: Vec<f64> = matrix.symmetric_eigenvalues().iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        // The first is the turn as one body.
        squares.iter().skip(1).take(count).map(|z| z.max(0.0).sqrt()).collect()
    }

    /// Poles of θ_i/θ_m \[1/s\], with damping.
    pub fn poles(&self) -> Roots {
        let pair = |m: &KnownMode| {
            let square = Complex64::from(m.omega_rad_s * m.omega_rad_s);
            quadratic(Complex64::from(m.rate_per_s()), square)
        };
        Roots { s: self.modes.iter().flat_map(pair).collect(), missing: 0 }
    }

    /// Poles of θ_m/i \[1/s\] on a motor without Coulomb friction: the roots of
    /// `J·s² + V·s + C_t/θ_m`. One of them is s = 0.
    pub fn motor_poles(&self, motor: &Motor) -> Roots {
        let (j, v) = (motor.inertia_kg_m2(), motor.viscous_nm_s_per_rad());
        let coupled = self.frequencies_rad_s(Base::Rotor(j), usize::MAX);
        self.with_motor(&coupled, j, v)
    }

    /// Transfer function θ_m/i \[rad/A\] without Coulomb friction.
    pub fn motor_function(&self, motor: &Motor) -> ZeroPoleGain {
        driven(self.poles(), self.motor_poles(motor), motor)
    }

    /// Transfer function C_t/θ_m \[N·m/rad\].
    pub fn coupling_function(&self) -> ZeroPoleGain {
        let pinned = self.frequencies_rad_s(Base::Pinned, usize::MAX);
        let (zeros, poles) = (self.with_motor(&pinned, 0.0, 0.0), self.poles());
        let gain = self.modes.iter().map(|m| m.coupling_nm_per_rad).sum();
        ZeroPoleGain { zeros: zeros.s, poles: poles.s, gain, missing: zeros.missing }
    }

    /// Roots of `J·s² + V·s + C_t/θ_m`, from the frequencies without damping.
    fn with_motor(&self, omega_rad_s: &[f64], j: f64, v: f64) -> Roots {
        let drag = v + self.drag_nm_s_per_rad();
        let squares: Vec<Complex64> = omega_rad_s.iter().map(|w| Complex64::from(-w * w)).collect();
        if drag == 0.0 {
            let mut s = vec![Complex64::ZERO; 2];
            s.extend(squares.iter().flat_map(|z| quadratic(Complex64::ZERO, -z)));
            return Roots { s, missing: 0 };
        }
        // The root at zero is divided out.
        let function = |s: Complex64| {
            let s = Jet::variable(s);
            let each = |sum: Jet, m: &KnownMode| {
                let torque = (s + Jet::real(m.rate_per_s())) / m.factor(s);
                sum + torque.times(m.coupling_nm_per_rad)
            };
            let whole = self.modes.iter().fold(s.times(j) + Jet::real(v), each);
            log_slope(self.characteristic(s).times(whole))
        };
        let mut all = starts(&squares);
        all.push(Complex64::from(-drag / (j + self.inertia_kg_m2())));
        let (mut s, missing) = together(function, all);
        s.push(Complex64::ZERO);
        Roots { s: sorted(s), missing }
    }

    /// Transfer function θ_i/θ_m \[1\] of point `point`, counted from 0; `None` if there is no such point.
    pub fn angle_function(&self, point: usize) -> Option<ZeroPoleGain> {
        let (residues, squares) = self.residues(point)?;
        let from = starts(&zero_squares(&residues, &squares));
        let function = |s: Complex64| {
            let s = Jet::variable(s);
            let each = |sum: Jet, (m, r): (&KnownMode, &f64)| sum + Jet::real(*r) / m.factor(s);
            let sum = self.modes.iter().zip(&residues).fold(Jet::real(0.0), each);
            log_slope(self.characteristic(s).times(sum))
        };
        let (zeros, missing) = together(function, from);
        let (zeros, poles) = (sorted(zeros), self.poles().s);
        let gain = ratio(&poles, &zeros);
        Some(ZeroPoleGain { zeros, poles, gain, missing })
    }

    /// Zeros of θ_i/θ_m of point `point`, as s², without damping; `None` if there is no such point.
    pub fn zeros(&self, point: usize) -> Option<Zeros> {
        let (residues, squares) = self.residues(point)?;
        Some(Zeros { z: zero_squares(&residues, &squares), missing: 0 })
    }

    /// ρ_ik·ω_k² of a point, and ω_k².
    fn residues(&self, point: usize) -> Option<(Vec<f64>, Vec<f64>)> {
        let squares: Vec<f64> = self.modes.iter().map(|m| m.omega_rad_s.powi(2)).collect();
        let own = self.gains.row_iter().nth(point)?;
        Some((own.iter().zip(&squares).map(|(g, w)| g * w).collect(), squares))
    }

    /// `Π (s² + 2ζ_kω_k·s + ω_k²)/ω_k²`.
    fn characteristic(&self, s: Jet) -> Scaled<Jet> {
        let each = |product: Scaled<Jet>, m: &KnownMode| {
            product.times(m.factor(s).times(1.0 / (m.omega_rad_s * m.omega_rad_s)))
        };
        self.modes.iter().fold(Scaled::one(), each)
    }

    /// Torque per rate of turning as one body.
    fn drag_nm_s_per_rad(&self) -> f64 {
        self.modes.iter().map(|m| m.inertia_kg_m2() * m.rate_per_s()).sum()
    }

    /// Computes θ_i/θ_m of every point, and C_t/θ_m \[N·m/rad\], at the complex frequency `s` \[1/s\].
    pub fn response(&self, s: Complex64) -> BeamResponse {
        let follows: Vec<Complex64> =
            self.modes.iter().map(|m| m.omega_rad_s * m.omega_rad_s / m.at(s)).collect();
        let angle =
            |i: usize| follows.iter().enumerate().map(|(k, f)| f * self.gains[(i, k)]).sum();
        let torque = |m: &KnownMode| s * (s + m.rate_per_s()) / m.at(s) * m.coupling_nm_per_rad;
        BeamResponse {
            angles: (0..self.len()).map(angle).collect(),
            coupling_nm_per_rad: self.modes.iter().map(torque).sum(),
        }
    }

    /// Its equation of motion in the points' angles. No force or torque acts at a tip: it has none.
    pub(crate) fn dynamics(&self) -> BeamDynamics {
        let n = self.len();
        let of_modes =
            |f: &dyn Fn(&KnownMode) -> f64| DVector::from_iterator(n, self.modes.iter().map(f));
        let squares = of_modes(&|m| m.omega_rad_s * m.omega_rad_s);
        let coupling = of_modes(&|m| m.coupling_nm_per_rad);
        let rates = of_modes(&|m| -m.rate_per_s());
        let ModalForm { a, h, h_motor, .. } =
            ModalForm::new(&self.gains, &self.inverse, &squares, &coupling);
        let absolute = &self.gains * DMatrix::from_diagonal(&rates) * &self.inverse;
        BeamDynamics {
            elastic: a,
            relative: None,
            absolute: (!self.is_undamped()).then_some(absolute),
            coupling: h,
            coupling_motor: h_motor,
            coupling_rate: None,
            force: DVector::zeros(n),
            torque: DVector::zeros(n),
            coupling_torque: 0.0,
        }
    }

    /// The masses of the points' angles, `ρ⁻ᵀ·diag(c_k/ω_k²)·ρ⁻¹` \[kg·m²\].
    pub(crate) fn mass_matrix(&self) -> DMatrix<f64> {
        let inertias = self.modes.iter().map(KnownMode::inertia_kg_m2);
        let inertias = DVector::from_iterator(self.len(), inertias);
        self.inverse.transpose() * DMatrix::from_diagonal(&inertias) * &self.inverse
    }
}

impl KnownMode {
    /// c_k/ω_k² \[kg·m²\].
    fn inertia_kg_m2(&self) -> f64 {
        self.coupling_nm_per_rad / (self.omega_rad_s * self.omega_rad_s)
    }
    /// 2ζ_kω_k \[1/s\].
    fn rate_per_s(&self) -> f64 {
        2.0 * self.damping_ratio * self.omega_rad_s
    }
    /// `s² + 2ζ_kω_k·s + ω_k²`.
    fn factor(&self, s: Jet) -> Jet {
        s * s + s.times(self.rate_per_s()) + Jet::real(self.omega_rad_s * self.omega_rad_s)
    }
    fn at(&self, s: Complex64) -> Complex64 {
        s * (s + self.rate_per_s()) + self.omega_rad_s * self.omega_rad_s
    }
}
