//! Inertia, viscous friction and coupling from the corrected response of the motor.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    Pole, common_denominator, information, others, trial_frequencies,
};
use crate::identify::responses::thresholds::RESPONSE_FLOOR;
use crate::lti::{TransferFunction, add, multiply};

/// Damping ratios tried for a pole that no tip shows.
const TRIAL_DAMPING: [f64; 4] = [0.005, 0.02, 0.06, 0.15];
/// Halvings of the grid about the best trial pole.
const REFINEMENTS: usize = 12;

/// The motor's response, corrected for friction.
#[derive(Debug, Clone)]
pub struct MotorData {
    /// Frequencies \[rad/s\].
    pub omega_rad_s: Vec<f64>,
    /// θ_m per unit of command at each frequency.
    pub response: Vec<Response>,
    /// Torque per unit of command; one if it is unknown.
    pub torque_per_command: f64,
}

/// The motor's equation, fitted to its response. Torques are in N·m, or in the unit of the command if the torque
/// constant is unknown.
#[derive(Debug, Clone)]
pub struct MotorFit {
    /// Inertia J \[kg·m²\].
    pub inertia: Estimate,
    /// Viscous friction V, with the damping by back-EMF \[N·m·s/rad\].
    pub viscous: Estimate,
    /// Coupling c_k through each mode \[N·m/rad\]: `C_t/θ_m = Σ c_k(s² + 2ζ_kω_k·s)/(s² + 2ζ_kω_k·s + ω_k²)`.
    pub coupling: Vec<Estimate>,
    /// Poles of the coupling torque, given or fitted.
    pub poles: Vec<Pole>,
    /// Whether the poles were given.
    pub poles_given: bool,
    /// θ_m per unit of command as (35), with a monic denominator, without the delay.
    pub transfer_function: TransferFunction,
    /// Delay of the command \[s\], if it was searched for and found.
    pub delay_s: Option<Estimate>,
    /// Root mean square of the residuals divided by their standard errors; zero for a model that
    /// was built from other estimates.
    pub weighted_rms: f64,
}

/// Fits `K/G(s) = J·s² + V·s + Σ c_k(s² + 2ζ_kω_k·s)/(s² + 2ζ_kω_k·s + ω_k²)` to the motor's response G, weighted with
/// its standard errors.
///
/// With `poles` from the fit of the beam, the problem is linear (step 6(c) of Section 4): the coupling torque has the
/// poles of the beam and vanishes at zero frequency (ΣH + h = 0). Without poles (no tips), a scan finds none or one, as
/// the information criterion decides. `None` if there are fewer frequencies than unknowns.
///
/// ```
/// # use {lissom::identify::{Pole, Response}, num_complex::Complex64};
/// # let omega: Vec<f64> = (0..30).map(|k| 1.15_f64.powi(k)).collect();
/// # let rigid = |w: f64| 2.0 / (Complex64::new(0.0, w) * Complex64::new(0.01, 0.05 * w));
/// # let response: Vec<Response> = omega.iter().map(|&w| Response { value: rigid(w), std: 1e-4 * rigid(w).norm() }).collect();
/// use lissom::identify::{MotorData, fit_motor}; // of 2/(0.05·s² + 0.01·s)
/// let fit = fit_motor(&MotorData { omega_rad_s: omega, response, torque_per_command: 2.0 }, None).unwrap();
/// assert!((fit.inertia.value - 0.05).abs() < 1e-6 && (fit.viscous.value - 0.01).abs() < 1e-6);
/// ```
///
/// # Source
/// `[Feliu1989, Section 4 step 6, 6.2.2, eqs. (35), (37)]`
pub fn fit_motor(data: &MotorData, poles: Option<&[Pole]>) -> Option<MotorFit> {
    if let Some(poles) = poles {
        return solve(data, poles).map(|s| finish(data, poles, true, &s));
    }
    let rigid = solve(data, &[])?;
    let n = 2 * data.response.len();
    let flexible = scan(data).filter(|(_, s)| {
        information(n, 5, s.cost()) < information(n, 2, rigid.cost()) && s.value[2] > 0.0
    });
    Some(match flexible {
        Some((pole, s)) => finish(data, &[pole], false, &s),
        None => finish(data, &[], false, &rigid),
    })
}

impl MotorFit {
    /// θ_m per unit of command at `omega_rad_s`, with the delay.
    pub fn response(&self, omega_rad_s: f64) -> Complex64 {
        let delay_s = self.delay_s.map_or(0.0, |d| d.value);
        self.transfer_function.response(omega_rad_s) * Complex64::cis(-omega_rad_s * delay_s)
    }

    /// The model that the regression's estimates make: rigid, or with the one mode of `pole` through
    /// which the beam is coupled. The command's `torque_per_command` and the damping of its
    /// back-EMF, `back_emf_viscous`, are those of the channel.
    pub(crate) fn of_estimates(
        inertia: Estimate,
        viscous: Estimate,
        mode: Option<(Pole, Estimate)>,
        torque_per_command: f64,
        back_emf_viscous: f64,
    ) -> Self {
        let poles: Vec<Pole> = mode.iter().map(|m| m.0).collect();
        let coupling: Vec<Estimate> = mode.iter().map(|m| m.1).collect();
        let viscous = Estimate { value: viscous.value + back_emf_viscous, ..viscous };
        Self {
            transfer_function: transfer_function(
                [inertia.value, viscous.value],
                &coupling.iter().map(|c| c.value).collect::<Vec<_>>(),
                &poles,
                torque_per_command,
            ),
            inertia,
            viscous,
            coupling,
            poles,
            poles_given: true,
            delay_s: None,
            weighted_rms: 0.0,
        }
    }
}

/// `K·d_c/((J·s² + V·s)·d_c + n_c)`, monic.
fn transfer_function(
    [inertia, viscous]: [f64; 2],
    coupling: &[f64],
    poles: &[Pole],
    torque_per_command: f64,
) -> TransferFunction {
    let shared = common_denominator(poles);
    let rigid = multiply(&[inertia, viscous, 0.0], &shared);
    let coupled = poles.iter().zip(coupling).enumerate().fold(Vec::new(), |sum, (k, (p, c))| {
        let [one, two_zeta_omega, _] = p.polynomial();
        add(&sum, &multiply(&[c * one, c * two_zeta_omega, 0.0], &others(poles, k)))
    });
    let num = multiply(&[torque_per_command], &shared);
    TransferFunction { num, den: add(&rigid, &coupled) }.monic()
}

/// J, V and c_k at a choice of poles.
pub(super) struct Solution {
    pub(super) value: DVector<f64>,
    covariance: DMatrix<f64>,
    /// Residuals in their deviations.
    pub(super) left: DVector<f64>,
}

fn coupling_shape(pole: &Pole, omega: f64) -> Complex64 {
    1.0 - pole.omega_rad_s * pole.omega_rad_s / pole.denominator(omega)
}

/// The equation in its unknowns J, V and c_k: two rows a frequency, real part first.
pub(super) struct ResponseRows {
    pub(super) a: DMatrix<f64>,
    pub(super) b: DVector<f64>,
    /// One over the standard error of the torque per angle, of each frequency.
    pub(super) weights: Vec<f64>,
}

impl ResponseRows {
    /// Responses are trusted to the share `floor` of their size at best. `None` where there are too few.
    pub(super) fn new(data: &MotorData, poles: &[Pole], floor: f64) -> Option<Self> {
        Self::of_shapes(data, poles.len(), floor, |k, w| coupling_shape(&poles[k], w))
    }

    /// The same with the torque per angle and c_k of each of `count` poles as `shape` has it.
    pub(super) fn of_shapes(
        data: &MotorData,
        count: usize,
        floor: f64,
        shape: impl Fn(usize, f64) -> Complex64,
    ) -> Option<Self> {
        let (m, p) = (data.response.len(), 2 + count);
        if 2 * m < p + 2 {
            return None;
        }
        let mut a = DMatrix::zeros(2 * m, p);
        let mut b = DVector::zeros(2 * m);
        let mut weights = Vec::with_capacity(m);
        for (i, (&w, r)) in data.omega_rad_s.iter().zip(&data.response).enumerate() {
            let inverse = data.torque_per_command / r.value;
            let relative = (r.std / r.value.norm()).hypot(floor);
            let weight = 1.0 / (inverse.norm() * relative);
            let s = Complex64::new(0.0, w);
            let columns = [s * s, s].into_iter().chain((0..count).map(|k| shape(k, w)));
            for (k, z) in columns.enumerate() {
                (a[(2 * i, k)], a[(2 * i + 1, k)]) = (weight * z.re, weight * z.im);
            }
            (b[2 * i], b[2 * i + 1]) = (weight * inverse.re, weight * inverse.im);
            weights.push(weight);
        }
        let sound = a.iter().chain(b.iter()).all(|v| v.is_finite());
        sound.then_some(Self { a, b, weights })
    }

    /// Least squares, and (AᵀA)⁻¹.
    pub(super) fn solved(&self) -> Option<(DVector<f64>, DMatrix<f64>)> {
        least_squares(&self.a, &self.b)
    }
}

/// Least squares of `a·x = b`, and (aᵀa)⁻¹. The columns are brought to one size: c_k and J differ by orders.
pub(super) fn least_squares(
    a: &DMatrix<f64>,
    b: &DVector<f64>,
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let sizes = DVector::from_fn(a.ncols(), |k, _| match a.column(k).norm() {
        0.0 => 1.0,
        size => size,
    });
    let mut scaled = a.clone();
    for (mut column, size) in scaled.column_iter_mut().zip(&sizes) {
        column /= *size;
    }
    if scaled.iter().chain(b.iter()).any(|v| !v.is_finite()) {
        return None;
    }
    let normal = scaled.tr_mul(&scaled);
    let value = scaled.svd(true, true).solve(b, 1e-13).ok()?;
    let mut covariance = normal.pseudo_inverse(1e-15).ok()?;
    for (j, mut column) in covariance.column_iter_mut().enumerate() {
        for (i, v) in column.iter_mut().enumerate() {
            *v /= sizes[i] * sizes[j];
        }
    }
    Some((value.component_div(&sizes), covariance))
}

impl Solution {
    fn cost(&self) -> f64 {
        self.left.norm_squared()
    }

    /// Root mean square of the residuals, the unknowns counted.
    pub(super) fn weighted_rms(&self) -> f64 {
        let free = self.left.len().saturating_sub(self.value.len()).max(1) as f64;
        (self.cost() / free).sqrt()
    }
}

pub(super) fn solve(data: &MotorData, poles: &[Pole]) -> Option<Solution> {
    let rows = ResponseRows::new(data, poles, RESPONSE_FLOOR)?;
    let (value, covariance) = rows.solved()?;
    let left = &rows.b - &rows.a * &value;
    Some(Solution { value, covariance, left })
}

/// The one pole that explains the response best, refined on ever finer grids.
fn scan(data: &MotorData) -> Option<(Pole, Solution)> {
    let mut best: Option<(Pole, Solution)> = None;
    let mut consider = |pole: Pole| {
        if let Some(s) = solve(data, &[pole])
            && best.as_ref().is_none_or(|(_, b)| s.cost() < b.cost())
        {
            best = Some((pole, s));
        }
    };
    for omega_rad_s in trial_frequencies(&data.omega_rad_s) {
        for damping_ratio in TRIAL_DAMPING {
            consider(Pole { omega_rad_s, damping_ratio });
        }
    }
    let (mut by_omega, mut by_damping) = (0.02_f64, 2.0_f64);
    for _ in 0..REFINEMENTS {
        let at = best.as_ref()?.0;
        for i in -2..=2 {
            for k in -2..=2 {
                let pole = Pole {
                    omega_rad_s: at.omega_rad_s * (1.0 + by_omega * 0.5 * f64::from(i)),
                    damping_ratio: at.damping_ratio * by_damping.powf(0.5 * f64::from(k)),
                };
                if let Some(s) = solve(data, &[pole])
                    && best.as_ref().is_none_or(|(_, b)| s.cost() < b.cost())
                {
                    best = Some((pole, s));
                }
            }
        }
        by_omega *= 0.5;
        by_damping = by_damping.sqrt();
    }
    best
}

pub(super) fn finish(
    data: &MotorData,
    poles: &[Pole],
    poles_given: bool,
    s: &Solution,
) -> MotorFit {
    let weighted_rms = s.weighted_rms();
    let spread = weighted_rms.max(1.0);
    let estimate = |i: usize| Estimate {
        value: s.value[i],
        std: spread * s.covariance[(i, i)].max(0.0).sqrt(),
    };
    let coupling: Vec<Estimate> = (0..poles.len()).map(|k| estimate(2 + k)).collect();
    let values: Vec<f64> = coupling.iter().map(|c| c.value).collect();
    MotorFit {
        inertia: estimate(0),
        viscous: estimate(1),
        coupling,
        poles: poles.to_vec(),
        poles_given,
        transfer_function: transfer_function(
            [s.value[0], s.value[1]],
            &values,
            poles,
            data.torque_per_command,
        ),
        delay_s: None,
        weighted_rms,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Responses of the report's (35).
    fn report() -> MotorData {
        let g = TransferFunction {
            num: vec![394.94, 394.94 * 0.06, 394.94 * 43.75],
            den: vec![1.0, 2.26, 165.7, 103.56, 0.0],
        };
        let omega_rad_s: Vec<f64> = (0..40).map(|k| 1.1_f64.powi(k)).collect();
        let response = omega_rad_s
            .iter()
            .map(|&w| Response { value: g.response(w), std: 1e-3 * g.response(w).norm() })
            .collect();
        MotorData { omega_rad_s, response, torque_per_command: 2.184 }
    }

    #[test]
    fn reads_the_reports_parameters_off_its_transfer_function() {
        // 6.2.2: J = 0.005529, V = 0.01216, coupling 0.674, from (35) and (36).
        let pole = Pole { omega_rad_s: 43.75_f64.sqrt(), damping_ratio: 0.03 / 43.75_f64.sqrt() };
        let fit = fit_motor(&report(), Some(&[pole])).unwrap();
        assert!((fit.inertia.value / 0.005_529 - 1.0).abs() < 5e-3, "{fit:?}");
        assert!((fit.viscous.value / 0.012_16 - 1.0).abs() < 2e-2, "{fit:?}");
        assert!((fit.coupling[0].value / 0.674 - 1.0).abs() < 5e-3, "{fit:?}");
        let (a, b) = (fit.transfer_function.response(8.0), report_at(8.0));
        assert!((a / b - 1.0).norm() < 0.01);
    }

    fn report_at(omega: f64) -> Complex64 {
        let d = report();
        let k = d.omega_rad_s.iter().position(|w| *w >= omega).unwrap();
        let g = TransferFunction {
            num: vec![394.94, 394.94 * 0.06, 394.94 * 43.75],
            den: vec![1.0, 2.26, 165.7, 103.56, 0.0],
        };
        assert!(d.omega_rad_s[k] > 0.0);
        g.response(omega)
    }

    #[test]
    fn finds_the_pole_without_tips() {
        let fit = fit_motor(&report(), None).unwrap();
        assert_eq!(fit.poles.len(), 1);
        assert!((fit.poles[0].omega_rad_s / 43.75_f64.sqrt() - 1.0).abs() < 5e-3, "{fit:?}");
        assert!((fit.inertia.value / 0.005_529 - 1.0).abs() < 1e-2, "{fit:?}");
    }

    #[test]
    fn too_few_frequencies_give_nothing() {
        let mut d = report();
        d.omega_rad_s.truncate(1);
        d.response.truncate(1);
        assert!(fit_motor(&d, None).is_none());
    }
}
