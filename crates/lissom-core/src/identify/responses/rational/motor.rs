//! Inertia, viscous friction and coupling from the corrected response of the motor.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::fit_covariance::{joined, of_coefficients};
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::refine::{PolePoint, refined};
use crate::identify::responses::rational::weighted::{Basis, Output, Weighted};
use crate::identify::responses::rational::{
    Pole, common_denominator, information, others, part_error, trial_frequencies,
};
use crate::identify::responses::thresholds::RESPONSE_FLOOR;
use crate::lti::{CoefficientCovariance, TransferFunction, add, multiply};
use crate::record::Command;

/// Damping ratios tried for a pole that no tip shows.
const TRIAL_DAMPING: [f64; 4] = [0.005, 0.02, 0.06, 0.15];
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
    /// may have none.
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
        return fit_motor_at(data, poles, Some(&DMatrix::zeros(2 * poles.len(), 2 * poles.len())));
    }
    let rigid = fit_motor_at(data, &[], None)?;
    let weighted = weighted(data, 1);
    let trials = trial_frequencies(&data.omega_rad_s).into_iter().flat_map(|omega_rad_s| {
        TRIAL_DAMPING.map(|damping_ratio| Pole { omega_rad_s, damping_ratio })
    });
    let tried = trials.filter_map(|pole| PolePoint::new(&weighted, vec![pole], Damping::Small));
    let best = tried.min_by(|a, b| a.cost.total_cmp(&b.cost));
    let flexible = best.and_then(|best| {
        let point = refined(&weighted, best.poles, Damping::Small)?;
        let (n, left) = (weighted.readings(), rigid.weighted_rms.powi(2));
        let of_rigid = information(n, 2, left * (n - 2) as f64);
        (information(n, 5, point.cost) < of_rigid && point.own_estimates[0][2] > 0.0)
            .then_some(point)
    });
    let Some(point) = flexible else { return Some(rigid) };
    let free = weighted.readings().saturating_sub(5).max(1) as f64;
    let weighted_rms = (point.cost / free).sqrt();
    let covariance = point.covariance()? * part_error(weighted_rms).powi(2);
    let fit = MotorFit::of_point(&point, &covariance, &[0], None, data.torque_per_command)?;
    Some(MotorFit { poles_given: false, weighted_rms, ..fit })
}

/// The same with given poles, the errors of which count: `of_poles` is the covariance of ω_k \[rad/s\] and ζ_k of each. If that
/// is unknown, so is that of the transfer function.
pub(crate) fn fit_motor_at(
    data: &MotorData,
    poles: &[Pole],
    of_poles: Option<&DMatrix<f64>>,
) -> Option<MotorFit> {
    let (weighted, n) = (weighted(data, poles.len()), poles.len());
    let free = weighted.readings().checked_sub(2 + n).filter(|free| *free >= 2)?;
    let point = PolePoint::new(&weighted, poles.to_vec(), Damping::Small)?;
    let weighted_rms = (point.cost / free as f64).sqrt();
    // By ln ω_k and ζ_k.
    let units = poles.iter().flat_map(|p| [p.omega_rad_s.recip(), 1.0]);
    let units = DMatrix::from_diagonal(&DVector::from_iterator(2 * n, units));
    let own = of_poles.map_or_else(|| DMatrix::zeros(2 * n, 2 * n), |own| &units * own * &units);
    let covariance = point.covariance_with(0, &own, part_error(weighted_rms).powi(2));
    let modes: Vec<usize> = (0..n).collect();
    let mut fit = MotorFit::of_point(&point, &covariance, &modes, None, data.torque_per_command)?;
    if of_poles.is_none() {
        fit.covariance.view_mut((2 + n, 2 + n), (2 * n, 2 * n)).fill(f64::NAN);
    }
    Some(MotorFit { weighted_rms, ..fit })
}

/// Torque per angle of the motor alone, coupled through so many poles.
fn weighted(data: &MotorData, poles: usize) -> Weighted {
    let outputs = vec![output(data, (0..poles).collect(), 1.0)];
    Weighted { omega: data.omega_rad_s.clone(), outputs }
}

/// Torque per angle of the motor, coupled through the poles of these indices, standard errors stretched by `stretch`.
pub(super) fn output(data: &MotorData, coupled: Vec<usize>, stretch: f64) -> Output {
    let torque = |r: &Response| data.torque_per_command / r.value;
    let weight = |r: &Response| {
        let relative = (r.std / r.value.norm()).hypot(RESPONSE_FLOOR);
        1.0 / (torque(r).norm() * relative * stretch)
    };
    let values: Vec<Complex64> = data.response.iter().map(torque).collect();
    Output::new(Basis::Torque(coupled), &values, data.response.iter().map(weight).collect())
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

    /// Of the last output of what was fitted together, coupled through the poles of these indices: `covariance` is that of all
    /// unknowns, `late` the delay \[s\] and its slope by the last of them, if there is one.
    pub(super) fn of_point(
        point: &PolePoint,
        covariance: &DMatrix<f64>,
        modes: &[usize],
        late: Option<[f64; 2]>,
        torque_per_command: f64,
    ) -> Option<Self> {
        let (own, first) = (2 + modes.len(), *point.places().0.last()?);
        let last = own + 2 * modes.len();
        let mut by_unknowns = DMatrix::zeros(last + 1, covariance.nrows());
        by_unknowns.view_mut((0, first), (own, own)).fill_with_identity();
        for (i, &k) in modes.iter().enumerate() {
            by_unknowns[(own + 2 * i, 2 * k)] = point.poles[k].omega_rad_s;
            by_unknowns[(own + 2 * i + 1, 2 * k + 1)] = 1.0;
        }
        if let Some([_, slope]) = late {
            by_unknowns[(last, first + own)] = slope;
        }
        let covariance = &by_unknowns * covariance * by_unknowns.transpose();
        let std = covariance[(last, last)].max(0.0).sqrt();
        let value = point.own_estimates.last()?.rows(0, own).into_owned();
        let poles = modes.iter().map(|&k| point.poles[k]).collect();
        let fit = Self::of_values(&value, &covariance, poles, torque_per_command);
        Some(Self { delay_s: late.map(|[value, _]| Estimate { value, std }), ..fit })
    }

    /// Of J, V and c_k, without a delay. The covariance is that of all, of the poles and of the delay.
    fn of_values(
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
