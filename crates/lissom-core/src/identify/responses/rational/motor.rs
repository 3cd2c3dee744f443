//! Inertia, viscous friction and coupling from the corrected response of the motor.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::fit_covariance::{joined, of_coefficients};
use crate::identify::responses::rational::{
    Pole, common_denominator, information, others, part_error, trial_frequencies,
};
use crate::identify::responses::thresholds::RESPONSE_FLOOR;
use crate::information::{Inverse, inverted};
use crate::lti::{CoefficientCovariance, TransferFunction, add, multiply};
use crate::record::Command;

/// Damping ratios tried for a pole that no tip shows.
const TRIAL_DAMPING: [f64; 4] = [0.005, 0.02, 0.06, 0.15];
/// Halvings of the grid about the best trial pole.
const REFINEMENTS: usize = 12;
/// Share of a pole over which slopes are taken to either side.
const STEP: f64 = 1e-6;

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
    /// Torque per unit of command.
    torque_per_command: f64,
    /// Covariance of J, V, c_k, then of ω_k \[rad/s\] and ζ_k of each pole, then of the delay \[s\]; poles that were given
    /// have none until [`MotorFit::with_poles_of`].
    covariance: DMatrix<f64>,
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
        Some((pole, s)) => {
            let fit = finish(data, &[pole], false, &s);
            fit.with_poles_of(data, pole_covariance(data, pole, fit.weighted_rms).as_ref())
        }
        None => finish(data, &[], false, &rigid),
    })
}

impl MotorFit {
    /// θ_m per unit of command at `omega_rad_s`, with the delay.
    pub fn response(&self, omega_rad_s: f64) -> Complex64 {
        let delay_s = self.delay_s.map_or(0.0, |d| d.value);
        self.transfer_function.response(omega_rad_s) * Complex64::cis(-omega_rad_s * delay_s)
    }

    /// The model that a regression's estimates make: rigid, or with the one mode of `mode` through which the beam is
    /// coupled. `drive` are J, V without back-EMF and the coupling, if there is a mode, with their `correlation`.
    pub(crate) fn of_estimates(
        drive: &[Estimate],
        correlation: &DMatrix<f64>,
        mode: Option<ModeEstimate>,
        command: &Command,
    ) -> Option<Self> {
        let (&[inertia, viscous], coupling) = drive.split_first_chunk()?;
        let viscous = Estimate { value: viscous.value + command.back_emf_viscous, ..viscous };
        let poles: Vec<Pole> = mode.iter().map(Pole::of_mode).collect();
        let all = [inertia, viscous].into_iter().chain(coupling.iter().copied());
        let known = DMatrix::from_fn(drive.len(), drive.len(), |i, k| {
            correlation[(i, k)] * drive[i].std * drive[k].std
        });
        let of_mode = mode.iter().flat_map(|m| [m.natural_frequency_rad_s, m.damping_ratio]);
        let others = of_mode.map(|e| e.std * e.std).chain([0.0]);
        let others = DMatrix::from_diagonal(&DVector::from_iterator(2 * poles.len() + 1, others));
        let value = DVector::from_iterator(drive.len(), all.map(|e| e.value));
        let slopes = DMatrix::zeros(drive.len(), others.nrows());
        Some(Self::of_values(
            &value,
            &joined(&known, &slopes, &others),
            poles,
            command.torque_per_unit(),
        ))
    }

    /// The same with a delay of the command \[s\] that does not depend on the others.
    pub(crate) fn with_delay(mut self, delay_s: Estimate) -> Self {
        let last = self.covariance.nrows() - 1;
        self.covariance[(last, last)] = delay_s.std * delay_s.std;
        Self { delay_s: Some(delay_s), ..self }
    }

    /// Of J, V and c_k, without a delay. The covariance is that of all, of the poles and of the delay.
    pub(super) fn of_values(
        value: &DVector<f64>,
        covariance: &DMatrix<f64>,
        poles: Vec<Pole>,
        torque_per_command: f64,
    ) -> Self {
        let estimate =
            |i: usize| Estimate { value: value[i], std: covariance[(i, i)].max(0.0).sqrt() };
        let coupling: Vec<Estimate> = (2..value.len()).map(estimate).collect();
        Self {
            inertia: estimate(0),
            viscous: estimate(1),
            transfer_function: transfer_function(
                [value[0], value[1]],
                &coupling.iter().map(|c| c.value).collect::<Vec<_>>(),
                &poles,
                torque_per_command,
            ),
            coupling,
            poles,
            poles_given: true,
            delay_s: None,
            weighted_rms: 0.0,
            torque_per_command,
            covariance: covariance.clone(),
        }
    }

    /// The same with the errors of the poles counted: `of_poles` is the covariance of ω_k \[rad/s\] and ζ_k of each. If
    /// that is unknown, or the fit to `data` has no solution near the poles, so is that of the transfer function.
    pub(crate) fn with_poles_of(&self, data: &MotorData, of_poles: Option<&DMatrix<f64>>) -> Self {
        let counted = of_poles.and_then(|own| Some((own, self.slopes_by_poles(data)?)));
        let (first, n) = (2 + self.poles.len(), 2 * self.poles.len());
        let Some((of_poles, slopes)) = counted else {
            let mut covariance = self.covariance.clone();
            covariance.view_mut((first, first), (n, n)).fill(f64::NAN);
            return Self { covariance, ..self.clone() };
        };
        self.with_errors_of(&slopes, &of_poles.clone().resize(n + 1, n + 1, 0.0))
    }

    /// Slopes of J, V and c_k by ω_k and ζ_k of each pole, and by the delay, which is not there.
    fn slopes_by_poles(&self, data: &MotorData) -> Option<DMatrix<f64>> {
        let beside = |k: usize, by: f64| {
            let mut poles = self.poles.clone();
            let pole = poles.get_mut(k / 2)?;
            match k % 2 {
                0 => pole.omega_rad_s *= 1.0 + by,
                _ => pole.damping_ratio += by,
            }
            Some(solve(data, &poles)?.value)
        };
        let column = |k: usize| {
            let size = if k.is_multiple_of(2) { self.poles[k / 2].omega_rad_s } else { 1.0 };
            Some((beside(k, STEP)? - beside(k, -STEP)?) / (2.0 * STEP * size))
        };
        let n = 2 * self.poles.len();
        let columns = (0..n).map(column).collect::<Option<Vec<_>>>()?;
        Some(DMatrix::from_fn(2 + self.poles.len(), n + 1, |i, k| {
            columns.get(k).map_or(0.0, |column| column[i])
        }))
    }

    /// The same with the errors of poles and delay counted, whose covariance is `others`; `slopes` are those of J, V and
    /// c_k by them.
    fn with_errors_of(&self, slopes: &DMatrix<f64>, others: &DMatrix<f64>) -> Self {
        let own = 2 + self.poles.len();
        let known = self.covariance.view((0, 0), (own, own)).into_owned();
        let covariance = joined(&known, slopes, others);
        let counted =
            |e: Estimate, i: usize| Estimate { std: covariance[(i, i)].max(0.0).sqrt(), ..e };
        let coupling = self.coupling.iter().enumerate();
        Self {
            inertia: counted(self.inertia, 0),
            viscous: counted(self.viscous, 1),
            coupling: coupling.map(|(k, c)| counted(*c, 2 + k)).collect(),
            covariance,
            ..self.clone()
        }
    }

    /// Σc_k, with the covariance of the c_k.
    pub(crate) fn total_coupling(&self) -> Estimate {
        let own = self.covariance.view((2, 2), (self.coupling.len(), self.coupling.len()));
        let value = self.coupling.iter().map(|c| c.value).sum();
        Estimate { value, std: own.sum().max(0.0).sqrt() }
    }

    /// Covariance of the coefficients of the transfer function and of the delay.
    pub(crate) fn coefficient_covariance(&self) -> Option<CoefficientCovariance> {
        let (modes, first) = (self.poles.len(), 2 + self.poles.len());
        let drive = [self.inertia, self.viscous].into_iter().chain(self.coupling.iter().copied());
        let of_poles = self.poles.iter().flat_map(|p| [p.omega_rad_s, p.damping_ratio]);
        let late = self.delay_s.map_or(0.0, |delay| delay.value);
        let all = drive.map(|e| e.value).chain(of_poles).chain([late]);
        let unknowns = DVector::from_iterator(first + 2 * modes + 1, all);
        of_coefficients(&unknowns, &self.covariance, |x| {
            let poles: Vec<Pole> = (0..modes)
                .map(|k| Pole {
                    omega_rad_s: x[first + 2 * k],
                    damping_ratio: x[first + 2 * k + 1],
                })
                .collect();
            let coupling: Vec<f64> = x.rows(2, modes).iter().copied().collect();
            transfer_function([x[0], x[1]], &coupling, &poles, self.torque_per_command)
        })
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

    /// Root mean square of the residuals, the unknowns counted and `further` ones that were fitted.
    pub(super) fn weighted_rms(&self, further: usize) -> f64 {
        let free = self.left.len().saturating_sub(self.value.len() + further).max(1) as f64;
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

fn finish(data: &MotorData, poles: &[Pole], poles_given: bool, s: &Solution) -> MotorFit {
    // A pole that was fitted has two numbers.
    let fitted = if poles_given { 0 } else { 2 * poles.len() };
    let weighted_rms = s.weighted_rms(fitted);
    let known = &s.covariance * part_error(weighted_rms).powi(2);
    let all = known.nrows() + 2 * poles.len() + 1;
    let covariance = known.resize(all, all, 0.0);
    let fit = MotorFit::of_values(&s.value, &covariance, poles.to_vec(), data.torque_per_command);
    MotorFit { poles_given, weighted_rms, ..fit }
}

/// Covariance of ω \[rad/s\] and ζ of the one pole that was fitted; `None` if the response does not tell them.
fn pole_covariance(data: &MotorData, pole: Pole, weighted_rms: f64) -> Option<DMatrix<f64>> {
    let left = |by_omega: f64, by_damping: f64| {
        let pole = Pole {
            omega_rad_s: pole.omega_rad_s * (1.0 + by_omega),
            damping_ratio: pole.damping_ratio + by_damping,
        };
        Some(solve(data, &[pole])?.left)
    };
    let by_omega = (left(STEP, 0.0)? - left(-STEP, 0.0)?) / (2.0 * STEP * pole.omega_rad_s);
    let by_damping = (left(0.0, STEP)? - left(0.0, -STEP)?) / (2.0 * STEP);
    let jacobian = DMatrix::from_columns(&[by_omega, by_damping]);
    let Inverse { matrix, lost } = inverted(&jacobian.tr_mul(&jacobian));
    let told = lost.iter().all(|lost| !lost) && matrix.iter().all(|v| v.is_finite());
    told.then(|| matrix * part_error(weighted_rms).powi(2))
}
