//! Common poles and residues of the tips' responses to the motor's angle.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use num_complex::Complex64;

use crate::identify::estimate::{Estimate, ModeEstimate};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::fit_covariance::{joined, of_coefficients};
use crate::identify::responses::rational::{
    Pole, common_denominator, information, others, part_error, trial_frequencies,
};
use crate::identify::responses::thresholds::{
    MODE_DAMPING_MOST, MODES_MOST, POLE_ABOVE, POLE_BELOW, POLE_DAMPING_LEAST, POLE_DAMPING_MOST,
    RESPONSE_FLOOR,
};
use crate::identify::thresholds::{CLEARLY_PRESENT, SIGN_SHOWN};
use crate::information::covariance;
use crate::lti::{CoefficientCovariance, TransferFunction, add, multiply};

/// Damping ratio with which a new mode starts.
const START_DAMPING: f64 = 0.02;

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
/// together by the Levenberg-Marquardt method. The number of modes is the one with the lowest Bayesian information
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
    let data = Data::new(omega_rad_s, tips)?;
    let mut best: Option<(f64, BeamProblem)> = None;
    let mut poles: Vec<Pole> = Vec::new();
    for count in 1..=MODES_MOST {
        let parameters = count * (2 + tips.len());
        if parameters + 2 > 2 * m * tips.len() {
            break;
        }
        let Some(start) = data.best_start(&poles) else { break };
        poles.push(start);
        let residues = data.residues(&poles)?;
        let problem = BeamProblem { data: &data, x: pack(&poles, &residues) };
        let (solved, _) = LevenbergMarquardt::new().with_patience(200).minimize(problem);
        poles = solved.poles();
        let low = omega_rad_s.iter().copied().fold(f64::INFINITY, f64::min);
        let high = omega_rad_s.iter().copied().fold(0.0, f64::max);
        let plausible = |p: &Pole| {
            (POLE_DAMPING_LEAST..POLE_DAMPING_MOST).contains(&p.damping_ratio)
                && p.omega_rad_s > POLE_BELOW * low
                && p.omega_rad_s < POLE_ABOVE * high
        };
        if !poles.iter().all(plausible) || !solved.all_residues_are_there() {
            break;
        }
        let cost = solved.residuals()?.norm_squared();
        let score = information(2 * m * tips.len(), parameters, cost);
        let improved = best.as_ref().is_none_or(|(least, _)| score < *least);
        if !improved {
            break;
        }
        let explained = cost <= (2 * m * tips.len() - parameters) as f64;
        best = Some((score, solved));
        if explained {
            // Within what the responses claim: another mode would fit their errors.
            break;
        }
    }
    best.and_then(|(_, solved)| finish(&data, tips, &solved))
}

pub(super) struct Data {
    omega: Vec<f64>,
    forms: Vec<TipForm>,
    /// By tip: response and weight 1/σ at each frequency.
    points: Vec<Vec<(Complex64, f64)>>,
}

impl Data {
    pub(super) fn new(omega: &[f64], tips: &[TipData]) -> Option<Self> {
        let points = tips
            .iter()
            .map(|t| {
                t.response
                    .iter()
                    .map(|r| {
                        let sigma = r.std.hypot(RESPONSE_FLOOR * r.value.norm());
                        (sigma > 0.0 && sigma.is_finite()).then_some((r.value, 1.0 / sigma))
                    })
                    .collect::<Option<Vec<_>>>()
            })
            .collect::<Option<Vec<_>>>()?;
        Some(Self { omega: omega.to_vec(), forms: tips.iter().map(|t| t.form).collect(), points })
    }

    /// How many tips.
    pub(super) fn len(&self) -> usize {
        self.forms.len()
    }

    fn shape(&self, tip: usize, omega: f64) -> f64 {
        match self.forms[tip] {
            TipForm::Angle => 1.0,
            TipForm::SecondDerivative => -omega * omega,
        }
    }

    /// Weighted linear least squares for the residues of one tip, and what it leaves.
    pub(super) fn residues_of(
        &self,
        tip: usize,
        poles: &[Pole],
    ) -> Option<(DVector<f64>, DVector<f64>)> {
        let (a, b) = self.residue_rows(tip, poles);
        let solution = a.clone().svd(true, true).solve(&b, 1e-12).ok()?;
        let left = b - a * &solution;
        Some((solution, left))
    }

    /// Rows of the residues of one tip over the standard errors of its responses.
    pub(super) fn residue_rows(&self, tip: usize, poles: &[Pole]) -> (DMatrix<f64>, DVector<f64>) {
        let m = self.omega.len();
        let mut a = DMatrix::zeros(2 * m, poles.len());
        let mut b = DVector::zeros(2 * m);
        for (row, (&w, &(value, weight))) in self.omega.iter().zip(&self.points[tip]).enumerate() {
            for (k, pole) in poles.iter().enumerate() {
                let z = weight * self.shape(tip, w) / pole.denominator(w);
                (a[(2 * row, k)], a[(2 * row + 1, k)]) = (z.re, z.im);
            }
            (b[2 * row], b[2 * row + 1]) = (weight * value.re, weight * value.im);
        }
        (a, b)
    }

    fn residues(&self, poles: &[Pole]) -> Option<Vec<DVector<f64>>> {
        (0..self.forms.len()).map(|i| Some(self.residues_of(i, poles)?.0)).collect()
    }

    /// The pole whose addition lowers the cost most.
    fn best_start(&self, poles: &[Pole]) -> Option<Pole> {
        let cost = |candidate: Pole| -> Option<f64> {
            let all: Vec<Pole> = poles.iter().copied().chain([candidate]).collect();
            let each = (0..self.forms.len()).map(|i| self.residues_of(i, &all));
            each.map(|found| Some(found?.1.norm_squared())).sum()
        };
        trial_frequencies(&self.omega)
            .into_iter()
            .map(|omega_rad_s| Pole { omega_rad_s, damping_ratio: START_DAMPING })
            .filter_map(|p| Some((p, cost(p)?)))
            .filter(|(_, c)| c.is_finite())
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(p, _)| p)
    }
}

/// Parameters: ω_k, ζ_k of each pole, then the residues tip by tip.
fn pack(poles: &[Pole], residues: &[DVector<f64>]) -> DVector<f64> {
    let head = poles.iter().flat_map(|p| [p.omega_rad_s, p.damping_ratio]);
    let tail = residues.iter().flat_map(|r| r.iter().copied());
    DVector::from_iterator(poles.len() * (2 + residues.len()), head.chain(tail))
}

struct BeamProblem<'a> {
    data: &'a Data,
    x: DVector<f64>,
}

impl BeamProblem<'_> {
    fn modes(&self) -> usize {
        self.x.len() / (2 + self.data.forms.len())
    }
    fn poles(&self) -> Vec<Pole> {
        (0..self.modes())
            .map(|k| Pole { omega_rad_s: self.x[2 * k].abs(), damping_ratio: self.x[2 * k + 1] })
            .collect()
    }
    fn residue(&self, tip: usize, mode: usize) -> usize {
        2 * self.modes() + tip * self.modes() + mode
    }
    /// Calls `visit` with the row of each real residual's first half, its data and weight.
    fn rows(&self, mut visit: impl FnMut(usize, usize, f64, Complex64, f64)) {
        let mut row = 0;
        for (tip, points) in self.data.points.iter().enumerate() {
            for (&w, &(value, weight)) in self.data.omega.iter().zip(points) {
                visit(row, tip, w, value, weight);
                row += 2;
            }
        }
    }
    /// Whether each mode has a residue in some tip that stands clear of its standard error.
    fn all_residues_are_there(&self) -> bool {
        let Some((jacobian, residuals)) = self.jacobian().zip(self.residuals()) else {
            return false;
        };
        let covariance = covariance(&jacobian.tr_mul(&jacobian));
        let free = residuals.len().saturating_sub(self.x.len()).max(1) as f64;
        let spread = (residuals.norm_squared() / free).sqrt();
        (0..self.modes()).all(|k| {
            (0..self.data.forms.len()).any(|tip| {
                let at = self.residue(tip, k);
                self.x[at].abs() > CLEARLY_PRESENT * spread * covariance[(at, at)].max(0.0).sqrt()
            })
        })
    }
    fn rows_len(&self) -> usize {
        2 * self.data.omega.len() * self.data.forms.len()
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for BeamProblem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
    }
    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }
    fn residuals(&self) -> Option<DVector<f64>> {
        let poles = self.poles();
        let mut out = DVector::zeros(self.rows_len());
        self.rows(|row, tip, w, value, weight| {
            let model: Complex64 = poles
                .iter()
                .enumerate()
                .map(|(k, p)| {
                    self.x[self.residue(tip, k)] * self.data.shape(tip, w) / p.denominator(w)
                })
                .sum();
            let r = (model - value) * weight;
            (out[row], out[row + 1]) = (r.re, r.im);
        });
        out.iter().all(|v| v.is_finite()).then_some(out)
    }
    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let poles = self.poles();
        let mut out = DMatrix::zeros(self.rows_len(), self.x.len());
        self.rows(|row, tip, w, _, weight| {
            for (k, p) in poles.iter().enumerate() {
                let inverse = 1.0 / p.denominator(w);
                let unit = weight * self.data.shape(tip, w) * inverse;
                let r = self.residue(tip, k);
                let steep = -self.x[r] * unit * inverse;
                let by_omega = steep
                    * Complex64::new(2.0 * p.omega_rad_s, 2.0 * p.damping_ratio * w)
                    * self.x[2 * k].signum();
                let by_damping = steep * Complex64::new(0.0, 2.0 * p.omega_rad_s * w);
                for (column, z) in [(2 * k, by_omega), (2 * k + 1, by_damping), (r, unit)] {
                    (out[(row, column)], out[(row + 1, column)]) = (z.re, z.im);
                }
            }
        });
        out.iter().all(|v| v.is_finite()).then_some(out)
    }
}

impl BeamFit {
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

fn finish(data: &Data, tips: &[TipData], solved: &BeamProblem) -> Option<BeamFit> {
    let jacobian = solved.jacobian()?;
    let residuals = solved.residuals()?;
    let free = residuals.len().saturating_sub(solved.x.len()).max(1) as f64;
    let weighted_rms = (residuals.norm_squared() / free).sqrt();
    let spread = part_error(weighted_rms);
    let covariance = covariance(&jacobian.tr_mul(&jacobian));
    let std = |i: usize| spread * covariance[(i, i)].max(0.0).sqrt();
    let found = solved.poles();
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|a, b| found[*a].omega_rad_s.total_cmp(&found[*b].omega_rad_s));
    let poles: Vec<Pole> = order.iter().map(|&k| found[k]).collect();
    let low = data.omega.iter().copied().fold(f64::INFINITY, f64::min);
    let high = data.omega.iter().copied().fold(0.0, f64::max);
    let mode_poles: Vec<usize> = (0..poles.len())
        .filter(|&i| {
            let (zeta, at) = (poles[i].damping_ratio, poles[i].omega_rad_s);
            let damped = zeta < MODE_DAMPING_MOST && zeta > -SIGN_SHOWN * std(2 * order[i] + 1);
            damped && std(2 * order[i]).is_finite() && (low..=high).contains(&at)
        })
        .collect();
    let modes = mode_poles
        .iter()
        .map(|&i| ModeEstimate {
            natural_frequency_rad_s: Estimate {
                value: poles[i].omega_rad_s,
                std: std(2 * order[i]),
            },
            damping_ratio: Estimate { value: poles[i].damping_ratio, std: std(2 * order[i] + 1) },
        })
        .collect();
    let residues: Vec<Vec<Estimate>> = (0..tips.len())
        .map(|i| {
            order
                .iter()
                .map(|&k| {
                    let at = solved.residue(i, k);
                    Estimate { value: solved.x[at], std: std(at) }
                })
                .collect()
        })
        .collect();
    let forms: Vec<TipForm> = tips.iter().map(|tip| tip.form).collect();
    let transfer_functions = functions(&poles, &residues, &forms);
    let of_poles = order.iter().flat_map(|k| [2 * k, 2 * k + 1]);
    let of_residues = (0..tips.len()).flat_map(|i| order.iter().map(move |&k| (i, k)));
    let places: Vec<usize> =
        of_poles.chain(of_residues.map(|(i, k)| solved.residue(i, k))).collect();
    let covariance = DMatrix::from_fn(places.len(), places.len(), |i, k| {
        spread * spread * covariance[(places[i], places[k])]
    });
    let (mut left, mut power) = (0.0, 0.0);
    solved.rows(|row, _, _, value, weight| {
        left += (residuals[row].powi(2) + residuals[row + 1].powi(2)) / (weight * weight);
        power += value.norm_sqr();
    });
    Some(BeamFit {
        poles,
        modes,
        mode_poles,
        residues,
        transfer_functions,
        weighted_rms,
        relative_residual: (left / power).sqrt(),
        forms,
        covariance,
    })
}

/// θ_i/θ_m, or the second derivative's, of each tip.
pub(super) fn functions(
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
