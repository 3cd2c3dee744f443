//! Common poles and residues of the tips' responses to the motor's angle.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::fit_covariance::{joined, of_coefficients};
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::refine::{PolePoint, refined};
use crate::identify::responses::rational::shared_poles::with_one_more;
use crate::identify::responses::rational::weighted::{Basis, Output, Weighted};
use crate::identify::responses::rational::{
    Pole, common_denominator, information, others, part_error,
};
use crate::identify::responses::thresholds::{
    MODE_DAMPING_MOST, MODES_MOST, POLE_ABOVE, POLE_BELOW, POLE_DAMPING_LEAST, POLE_DAMPING_MOST,
    RESPONSE_FLOOR,
};
use crate::identify::thresholds::{CLEARLY_PRESENT, SIGN_SHOWN};
use crate::lti::{CoefficientCovariance, TransferFunction, add, multiply};

/// How the response of a tip follows from the modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipForm {
    /// Angle: `Σ r_k/(s² + 2ζ_kω_k·s + ω_k²)`, relative degree two.
    Angle,
    /// Acceleration, or a deflection of unknown scale: `s²` times the form of an angle.
    SecondDerivative,
}

/// Responses of one tip.
#[derive(Debug, Clone)]
pub struct TipData {
    /// Form of its model.
    pub form: TipForm,
    /// Response of the tip to the motor's angle at each frequency.
    pub response: Vec<Response>,
}

/// Modes and residues of a beam, fitted to the responses of its tips.
#[derive(Debug, Clone)]
pub struct BeamFit {
    /// Poles, ascending in frequency.
    pub poles: Vec<Pole>,
    /// The poles that are modes, with standard errors, ascending: those within the measured frequencies and lightly
    /// damped. Other poles improve the model at the edges of the range.
    pub modes: Vec<ModeEstimate>,
    /// Index into `poles` of each mode.
    pub mode_poles: Vec<usize>,
    /// Residue r_ik of tip i (outer index) in mode k \[1/s²\].
    pub residues: Vec<Vec<Estimate>>,
    /// θ_i/θ_m of each tip (or its second derivative), with a monic denominator.
    pub transfer_functions: Vec<TransferFunction>,
    /// Root mean square of the residuals divided by their standard errors: about one if
    /// the model is as good as the data.
    pub weighted_rms: f64,
    /// Root mean square of the residuals relative to that of the responses \[1\].
    pub relative_residual: f64,
    /// Form of each tip's model.
    pub(super) forms: Vec<TipForm>,
    /// Covariance of ω_k \[rad/s\] and ζ_k of each pole, then of the residues tip by tip.
    pub(super) covariance: DMatrix<f64>,
}

/// Fits the responses of the tips with common poles, weighted with their standard errors.
///
/// `θ_i/θ_m = Σ_k r_ik/(s² + 2ζ_kω_k·s + ω_k²)`, with r_ik in 1/s²; times s² for [`TipForm::SecondDerivative`].
///
/// Modes are added one at a time. Each starts at the frequency where it lowers the cost most; then all are refined
/// together by the Gauss-Newton method. The number of modes is the one with the lowest Bayesian information
/// criterion. `None` with fewer than four frequencies.
///
/// ```
/// # use {lissom::identify::{Pole, Response}, num_complex::Complex64};
/// # let omega: Vec<f64> = (0..30).map(|k| 1.15_f64.powi(k)).collect();
/// # let pole = Pole { omega_rad_s: 6.6, damping_ratio: 0.005 };
/// # let response: Vec<Response> = omega.iter().map(|&w| 43.75 / pole.denominator(w)).map(|value: Complex64| Response { value, std: 1e-4 }).collect();
/// use lissom::identify::{TipData, TipForm, fit_beam}; // of 43.75/(s² + 2ζω·s + ω²), ω = 6.6
/// let fit = fit_beam(&omega, &[TipData { form: TipForm::Angle, response }]).unwrap();
/// assert!((fit.modes[0].natural_frequency_rad_s.value - 6.6).abs() < 1e-6);
/// assert!((fit.residues[0][0].value - 43.75).abs() < 1e-4);
/// ```
///
/// # Source
/// `[Feliu1989, eqs. (19), (36)]`: common denominator, relative degree of at least two.
///
/// # Differences from the source
/// Poles may be damped. Residues are real, so a damped mode has the shape of the undamped one.
pub fn fit_beam(omega_rad_s: &[f64], tips: &[TipData]) -> Option<BeamFit> {
    let m = omega_rad_s.len();
    if m < 4 || tips.is_empty() || tips.iter().any(|t| t.response.len() != m) {
        return None;
    }
    let outputs: Option<_> = tips.iter().map(|tip| output(omega_rad_s, tip, 1.0)).collect();
    let data = Weighted { omega: omega_rad_s.to_vec(), outputs: outputs? };
    let (readings, (low, high)) = (data.readings(), data.range());
    let mut best: Option<(f64, BeamFit)> = None;
    let mut poles: Vec<Pole> = Vec::new();
    for count in 1..=MODES_MOST {
        let unknowns = count * (2 + tips.len());
        if unknowns + 2 > readings {
            break;
        }
        let start = with_one_more(&data, &poles, Damping::Small);
        let Some(point) = start.and_then(|poles| refined(&data, poles, Damping::Small)) else {
            break;
        };
        let plausible = |p: &Pole| {
            (POLE_DAMPING_LEAST..POLE_DAMPING_MOST).contains(&p.damping_ratio)
                && p.omega_rad_s > POLE_BELOW * low
                && p.omega_rad_s < POLE_ABOVE * high
        };
        if !point.poles.iter().all(plausible) {
            break;
        }
        let free = (readings - unknowns) as f64;
        let weighted_rms = (point.cost / free).sqrt();
        let spread = part_error(weighted_rms);
        let covariance = point.covariance()? * spread.powi(2);
        let fit = BeamFit::of_point(tips, &point, &covariance, (0..count).collect());
        // Standard errors by the residual, also where it is smaller than the responses claim.
        let clear = CLEARLY_PRESENT * weighted_rms / spread;
        let felt = |k: usize| fit.residues.iter().any(|r| r[k].value.abs() > clear * r[k].std);
        let score = information(readings, unknowns, point.cost);
        let improved = best.as_ref().is_none_or(|(least, _)| score < *least);
        if !(0..count).all(felt) || !improved {
            break;
        }
        poles.clone_from(&point.poles);
        let relative_residual = fit.relative_residual(omega_rad_s, tips);
        best = Some((score, BeamFit { weighted_rms, relative_residual, ..fit }));
        if point.cost <= free {
            // Within what the responses claim: another mode would fit their errors.
            break;
        }
    }
    let fit = best?.1;
    let is_mode = |k: &usize| {
        let ModeEstimate { natural_frequency_rad_s: at, damping_ratio: zeta } = fit.modes[*k];
        let damped = zeta.value < MODE_DAMPING_MOST && zeta.value > -SIGN_SHOWN * zeta.std;
        damped && at.std.is_finite() && (low..=high).contains(&at.value)
    };
    let mode_poles: Vec<usize> = (0..fit.poles.len()).filter(is_mode).collect();
    let modes = mode_poles.iter().map(|&k| fit.modes[k]).collect();
    Some(BeamFit { modes, mode_poles, ..fit })
}

/// The response of a tip as that of an angle, standard errors stretched by `stretch`. `None` where one has none.
pub(super) fn output(omega_rad_s: &[f64], tip: &TipData, stretch: f64) -> Option<Output> {
    let (mut values, mut weights) = (Vec::new(), Vec::new());
    for (&omega, r) in omega_rad_s.iter().zip(&tip.response) {
        let shape = tip.form.shape(omega);
        let sigma = r.std.hypot(RESPONSE_FLOOR * r.value.norm());
        if !(sigma > 0.0 && sigma.is_finite()) {
            return None;
        }
        values.push(r.value / shape);
        weights.push(shape.abs() / (sigma * stretch));
    }
    Some(Output::new(Basis::Residues, &values, weights))
}

impl TipForm {
    /// By which the response of an angle is multiplied.
    fn shape(self, omega_rad_s: f64) -> f64 {
        match self {
            Self::Angle => 1.0,
            Self::SecondDerivative => -omega_rad_s * omega_rad_s,
        }
    }
}

impl BeamFit {
    /// Of poles and residues that were fitted to the tips first, and whose unknowns have this covariance, with residuals of zero.
    pub(super) fn of_point(
        tips: &[TipData],
        point: &PolePoint,
        covariance: &DMatrix<f64>,
        mode_poles: Vec<usize>,
    ) -> Self {
        let (count, (places, size)) = (point.poles.len(), point.places());
        // ω_k and ζ_k, then r_ik = ρ_ik·ω_k², by ln ω_k, ζ_k and ρ_ik.
        let mut by_unknowns = DMatrix::zeros(count * (2 + tips.len()), size);
        for (k, pole) in point.poles.iter().enumerate() {
            let w = pole.omega_rad_s;
            by_unknowns[(2 * k, 2 * k)] = w;
            by_unknowns[(2 * k + 1, 2 * k + 1)] = 1.0;
            for (tip, place) in places.iter().take(tips.len()).enumerate() {
                let row = 2 * count + tip * count + k;
                by_unknowns[(row, place + k)] = w * w;
                by_unknowns[(row, 2 * k)] = 2.0 * w * w * point.own_estimates[tip][k];
            }
        }
        let covariance = &by_unknowns * covariance * by_unknowns.transpose();
        let estimate =
            |value: f64, at: usize| Estimate { value, std: covariance[(at, at)].max(0.0).sqrt() };
        let mode = |&k: &usize| ModeEstimate {
            natural_frequency_rad_s: estimate(point.poles[k].omega_rad_s, 2 * k),
            damping_ratio: estimate(point.poles[k].damping_ratio, 2 * k + 1),
        };
        let residue = |tip: usize, k: usize| {
            let value = point.own_estimates[tip][k] * point.poles[k].omega_rad_s.powi(2);
            estimate(value, 2 * count + tip * count + k)
        };
        let of_tip = |tip: usize| (0..count).map(|k| residue(tip, k)).collect();
        let residues: Vec<Vec<Estimate>> = (0..tips.len()).map(of_tip).collect();
        let forms: Vec<TipForm> = tips.iter().map(|tip| tip.form).collect();
        Self {
            modes: mode_poles.iter().map(mode).collect(),
            mode_poles,
            transfer_functions: functions(&point.poles, &residues, &forms),
            residues,
            weighted_rms: 0.0,
            relative_residual: 0.0,
            forms,
            covariance,
            poles: point.poles.clone(),
        }
    }

    /// Root mean square of the residual of the tips' responses, relative to that of the responses.
    fn relative_residual(&self, omega_rad_s: &[f64], tips: &[TipData]) -> f64 {
        let (mut left, mut power) = (0.0, 0.0);
        for (tip, residues) in tips.iter().zip(&self.residues) {
            for (&omega, r) in omega_rad_s.iter().zip(&tip.response) {
                let part = |(p, r): (&Pole, &Estimate)| r.value / p.denominator(omega);
                let model: Complex64 = self.poles.iter().zip(residues).map(part).sum();
                left += (tip.form.shape(omega) * model - r.value).norm_sqr();
                power += r.value.norm_sqr();
            }
        }
        (left / power).sqrt()
    }

    /// Natural frequencies of its modes \[rad/s\].
    pub(crate) fn frequencies_rad_s(&self) -> Vec<f64> {
        self.modes.iter().map(|mode| mode.natural_frequency_rad_s.value).collect()
    }

    /// The model of one tip and one mode: `ω²/(s² + 2ζω·s + ω²)`, as (36).
    pub(crate) fn of_mode(mode: ModeEstimate) -> Self {
        let omega = mode.natural_frequency_rad_s;
        let pole = Pole::of_mode(&mode);
        let gain = omega.value * omega.value;
        let residue = Estimate { value: gain, std: 2.0 * omega.value * omega.std };
        Self {
            poles: vec![pole],
            modes: vec![mode],
            mode_poles: vec![0],
            residues: vec![vec![residue]],
            transfer_functions: vec![TransferFunction {
                num: vec![gain],
                den: pole.polynomial().to_vec(),
            }],
            weighted_rms: 0.0,
            relative_residual: 0.0,
            forms: vec![TipForm::Angle],
            // The residue is ω².
            covariance: joined(
                &DMatrix::zeros(1, 1),
                &DMatrix::from_row_slice(1, 2, &[2.0 * omega.value, 0.0]),
                &DMatrix::from_diagonal(&DVector::from_vec(vec![
                    omega.std.powi(2),
                    mode.damping_ratio.std.powi(2),
                ])),
            ),
        }
    }

    /// Covariance of ω_k \[rad/s\] and ζ_k of each mode; `None` if the responses do not determine them.
    pub(crate) fn modal_covariance(&self) -> Option<DMatrix<f64>> {
        let places: Vec<usize> = self.mode_poles.iter().flat_map(|&k| [2 * k, 2 * k + 1]).collect();
        let n = places.len();
        let own = DMatrix::from_fn(n, n, |i, k| self.covariance[(places[i], places[k])]);
        own.iter().all(|v| v.is_finite()).then_some(own)
    }

    /// Covariance of the coefficients of the transfer function of a tip and of its delay, which is not estimated.
    pub(crate) fn coefficient_covariance(&self, tip: usize) -> Option<CoefficientCovariance> {
        let (form, count) = (*self.forms.get(tip)?, self.poles.len());
        let first = 2 * count + tip * count;
        let places: Vec<usize> = (0..2 * count).chain(first..first + count).collect();
        let n = places.len();
        let own = DMatrix::from_fn(n, n, |i, k| self.covariance[(places[i], places[k])]);
        let of_poles = self.poles.iter().flat_map(|p| [p.omega_rad_s, p.damping_ratio]);
        let residues = self.residues[tip].iter().map(|r| r.value);
        let unknowns = DVector::from_iterator(n + 1, of_poles.chain(residues).chain([0.0]));
        of_coefficients(&unknowns, &own.resize(n + 1, n + 1, 0.0), |x| {
            let pole = |k: usize| Pole { omega_rad_s: x[2 * k], damping_ratio: x[2 * k + 1] };
            let poles: Vec<Pole> = (0..count).map(pole).collect();
            let residues: Vec<f64> = x.rows(2 * count, count).iter().copied().collect();
            function(&poles, &residues, form)
        })
    }

    /// The poles that are modes, ascending.
    pub fn modal_poles(&self) -> Vec<Pole> {
        self.mode_poles.iter().map(|&i| self.poles[i]).collect()
    }
}

/// θ_i/θ_m, or the second derivative's, of each tip.
fn functions(
    poles: &[Pole],
    residues: &[Vec<Estimate>],
    forms: &[TipForm],
) -> Vec<TransferFunction> {
    let of_tip = |(row, form): (&Vec<Estimate>, &TipForm)| {
        let residues: Vec<f64> = row.iter().map(|r| r.value).collect();
        function(poles, &residues, *form)
    };
    residues.iter().zip(forms).map(of_tip).collect()
}

fn function(poles: &[Pole], residues: &[f64], form: TipForm) -> TransferFunction {
    let each = residues.iter().enumerate();
    let mut num =
        each.fold(Vec::new(), |sum, (k, r)| add(&sum, &multiply(&[*r], &others(poles, k))));
    if form == TipForm::SecondDerivative {
        num.extend([0.0, 0.0]);
    }
    TransferFunction { num, den: common_denominator(poles) }
}
