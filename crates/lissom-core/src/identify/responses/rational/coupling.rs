//! Inertia, viscous friction and coupling for given poles of a beam, with the effect of errors of the poles.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::responses::rational::motor::MotorData;
use crate::identify::responses::rational::shared_poles::SharedPoles;
use crate::identify::responses::rational::{Pole, information};
use crate::identify::responses::thresholds::MOTOR_DELAY_CALLED_FOR;

/// Most steps, and halvings of one.
const STEPS: usize = 30;
const HALVINGS: usize = 12;
/// Steps end that promise less than this share of what is left.
const SHARE: f64 = 1e-12;
/// Starts tried.
const STARTS: usize = 4;
/// Rounds in which what is left and the room of ζ_w, which counts in it, settle.
const ROUNDS: usize = 3;
/// A delay of less than this of a turn \[rad\] at the highest frequency, or found to this and no better, is
/// rounding.
const LEAST_TURN: f64 = 1e-7;
/// Steps of ln ω and ζ for slopes by them.
const DIFFERENCE: f64 = 1e-6;

/// J, V and c_k, which have the shape of [`coupled`]: without damping within the beam, of `K/G = J·s² + V·s + Σ c_k(s² + 2ζ_kω_k·s)/(s² + 2ζ_kω_k·s + ω_k²)`.
pub(crate) struct CouplingFit {
    /// J, V, then c_k of each pole.
    pub(crate) value: DVector<f64>,
    /// Their covariance where the poles are known, from the responses' standard errors, stretched where more is
    /// left.
    pub(crate) covariance: DMatrix<f64>,
    /// Their slopes by the poles' unknowns, in the order of [`SharedPoles::covariance`].
    pub(crate) by_poles: DMatrix<f64>,
    /// ζ_w of each pole, between what the points and what the motor says of it.
    pub(crate) damping_within: Vec<f64>,
    /// By how much the motor comes later than the command, where the response calls for it \[s\].
    pub(crate) delay_s: Option<Estimate>,
    /// How many standard errors a torque against the motion that does not grow with its speed, Coulomb friction left
    /// in, is from zero: the farther one of an amplitude of the angle that is the same at all frequencies, and
    /// of one of the command.
    pub(crate) friction_left: f64,
    /// Root mean square of the residuals in the responses' standard errors, the unknowns counted.
    pub(crate) weighted_rms: f64,
    /// Bayesian information criterion, standard errors known but for one factor.
    pub(crate) criterion: f64,
}

/// Step 6(c): J, V and c_k from the motor's response once the poles are known. `None` where the
/// frequencies are too few, or a response is zero.
///
/// The torque per angle is linear in them, and its least squares the start; the estimates are those most likely
/// by the response itself, whose errors are large where it is small. ζ_w, the part of each damping ratio that is
/// within the beam, is free with the standard error that the points leave it; so is a delay where the response
/// calls for one.
///
/// `beyond` are poles that stand for modes above the frequencies measured: they carry torque within them, and
/// below them turn with the motor, so that J has c/ω² of each.
///
/// # Source
/// `[Feliu1989, Section 4, step 6(c)]`
pub(crate) fn fit_coupling(
    data: &MotorData,
    fit: &SharedPoles,
    beyond: &[Pole],
) -> Option<CouplingFit> {
    let motor = Motor::new(data, fit, beyond);
    let prompt = motor.fitted(false)?;
    let highest = data.omega_rad_s.iter().copied().fold(0.0, f64::max);
    let late = motor.fitted(true).filter(|late| {
        let turn = highest * late.values.delay_s.unwrap_or(0.0).abs();
        late.criterion < prompt.criterion - MOTOR_DELAY_CALLED_FOR && turn > LEAST_TURN
    });
    motor.estimates(&late.unwrap_or(prompt))
}

/// Torque per angle and c_k of a mode, `(1 + 2ζ_w·s/ω)·(s² + 2(ζ − ζ_w)ω·s)/(s² + 2ζω·s + ω²)`: ζ_w of its damping
/// is within the beam.
pub(crate) fn coupled(pole: &Pole, within: f64, omega_rad_s: f64) -> Complex64 {
    let w = pole.omega_rad_s;
    let through = Complex64::new(1.0, 2.0 * within * omega_rad_s / w);
    through * (1.0 - through * (w * w) / pole.denominator(omega_rad_s))
}

/// What is fitted to what.
struct Motor<'a> {
    data: &'a MotorData,
    fit: &'a SharedPoles,
    /// Those of the fit, then those beyond.
    poles: Vec<Pole>,
}

/// The unknowns at some values.
#[derive(Clone)]
struct Values {
    /// J, V, then c_k of each pole, those beyond last.
    torque: DVector<f64>,
    within: Vec<f64>,
    delay_s: Option<f64>,
}

struct FittedCoupling {
    values: Values,
    /// Slopes of the model by the unknowns over standard errors, two rows a frequency; a row more of each ζ_w.
    rows: ResponseRows,
    /// (AᵀA)⁻¹ of the rows.
    inverse: DMatrix<f64>,
    weighted_rms: f64,
    criterion: f64,
}

/// The equation in its unknowns J, V and c_k: two rows a frequency, real part first.
struct ResponseRows {
    a: DMatrix<f64>,
    b: DVector<f64>,
    /// One over the standard error of the torque per angle, of each frequency.
    weights: Vec<f64>,
}

impl ResponseRows {
    /// The torque per angle and c_k of each of `count` poles is as `shape` has it. `None` where there are too few responses.
    fn of_shapes(
        data: &MotorData,
        count: usize,
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
            let relative = r.std / r.value.norm();
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
    fn solved(&self) -> Option<(DVector<f64>, DMatrix<f64>)> {
        least_squares(&self.a, &self.b)
    }
}

/// Least squares of `a·x = b`, and (aᵀa)⁻¹. The columns are brought to one size: c_k and J differ by orders.
fn least_squares(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
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

impl<'a> Motor<'a> {
    fn new(data: &'a MotorData, fit: &'a SharedPoles, beyond: &[Pole]) -> Self {
        Self { data, fit, poles: fit.poles.iter().chain(beyond).copied().collect() }
    }

    fn shape(&self, values: &Values, k: usize, omega: f64) -> Complex64 {
        coupled(&self.poles[k], values.within.get(k).copied().unwrap_or(0.0), omega)
    }

    /// Torque per angle.
    fn torque(&self, values: &Values, omega: f64) -> Complex64 {
        let s = Complex64::new(0.0, omega);
        let rigid = s * (s * values.torque[0] + values.torque[1]);
        let each =
            (0..self.poles.len()).map(|k| values.torque[2 + k] * self.shape(values, k, omega));
        rigid + each.sum::<Complex64>()
    }

    /// Torque per angle, and what it makes of the motor's response.
    fn response(&self, values: &Values, omega: f64) -> (Complex64, Complex64) {
        let torque = self.torque(values, omega);
        let late = Complex64::cis(-omega * values.delay_s.unwrap_or(0.0));
        (torque, self.data.torque_per_command / torque * late)
    }

    /// Places of the ζ_w that are free.
    fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.fit.within.len()).filter(|k| self.fit.within[*k].std > 0.0)
    }

    /// Residuals and slopes over standard errors; a ζ_w has a row of its own, in which `spread` standard errors of the
    /// responses count as one.
    fn rows(&self, values: &Values, spread: f64) -> ResponseRows {
        let frequencies = self.data.response.len();
        let free: Vec<usize> = self.free().collect();
        let (torques, delays) = (values.torque.len(), usize::from(values.delay_s.is_some()));
        let unknowns = torques + free.len() + delays;
        let mut a = DMatrix::zeros(2 * frequencies + free.len(), unknowns);
        let mut b = DVector::zeros(2 * frequencies + free.len());
        let mut weights = Vec::with_capacity(frequencies);
        for (i, (&w, r)) in self.data.omega_rad_s.iter().zip(&self.data.response).enumerate() {
            let (s, weight) = (Complex64::new(0.0, w), 1.0 / r.std);
            let (torque, model) = self.response(values, w);
            let by_torque = -model / torque;
            let of_torques = [s * s, s].into_iter();
            let of_torques =
                of_torques.chain((0..self.poles.len()).map(|k| self.shape(values, k, w)));
            let of_within = free.iter().map(|&k| {
                let own = self.poles[k].omega_rad_s;
                let turned = Complex64::new(0.0, 2.0 * w / own);
                let through = 1.0 + values.within[k] * turned;
                let share = own * own / self.poles[k].denominator(w);
                values.torque[2 + k] * turned * (1.0 - 2.0 * through * share)
            });
            let by_estimates = of_torques.chain(of_within).map(|z| by_torque * z);
            let by_delay = values.delay_s.map(|_| -s * model);
            for (k, z) in by_estimates.chain(by_delay).enumerate() {
                (a[(2 * i, k)], a[(2 * i + 1, k)]) = (weight * z.re, weight * z.im);
            }
            let left = weight * (r.value - model);
            (b[2 * i], b[2 * i + 1]) = (left.re, left.im);
            weights.push(weight);
        }
        for (row, &k) in free.iter().enumerate() {
            // Either part of a response has 1/√2 of its standard error.
            let weight = spread * std::f64::consts::FRAC_1_SQRT_2 / self.fit.within[k].std;
            a[(2 * frequencies + row, torques + row)] = weight;
            b[2 * frequencies + row] = weight * (self.fit.within[k].value - values.within[k]);
        }
        ResponseRows { a, b, weights }
    }

    /// The torque per angle by linear least squares, each response with the standard error that it would have if
    /// the torque were that of `before`; its own at first.
    fn linear(&self, before: Option<&Values>) -> Option<Values> {
        let start = Values {
            torque: DVector::zeros(2 + self.poles.len()),
            within: self.fit.within.iter().map(|w| w.value).collect(),
            delay_s: None,
        };
        let mut rows =
            ResponseRows::of_shapes(self.data, self.poles.len(), |k, w| self.shape(&start, k, w))?;
        for (i, (&w, r)) in self.data.omega_rad_s.iter().zip(&self.data.response).enumerate() {
            let Some(before) = before else { break };
            let measured = self.data.torque_per_command / r.value;
            let factor = (measured / self.torque(before, w)).norm();
            for row in [2 * i, 2 * i + 1] {
                rows.a.row_mut(row).scale_mut(factor);
                rows.b[row] *= factor;
            }
        }
        let (torque, _) = rows.solved()?;
        Some(Values { torque, ..start })
    }

    /// The torque per angle by linear least squares, and again by turns with the errors that it says.
    fn starts(&self) -> Vec<Values> {
        let next = |before: &Option<Values>| Some(self.linear(Some(before.as_ref()?)));
        let turns = std::iter::successors(Some(self.linear(None)), next);
        turns.take(STARTS).map_while(|v| v).collect()
    }

    /// The most likely, from the start that comes farthest.
    fn fitted(&self, with_delay: bool) -> Option<FittedCoupling> {
        let delay_s = with_delay.then_some(0.0);
        let ends = self.starts().into_iter().filter_map(|start| {
            let (values, rows) = self.refined(Values { delay_s, ..start }, 1.0)?;
            Some((values, rows.b.norm_squared()))
        });
        let (mut values, _) = ends.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let frequencies = self.data.response.len();
        let free = (2 * frequencies).checked_sub(values.torque.len() + usize::from(with_delay));
        let free = free.filter(|free| *free > 0)? as f64;
        let mut spread = 1.0;
        for round in 0.. {
            let (refined, rows) = self.refined(values, spread)?;
            values = refined;
            let cost = rows.b.rows(0, 2 * frequencies).norm_squared();
            let weighted_rms = (2.0 * cost / free).sqrt();
            if round + 1 == ROUNDS {
                let (_, inverse) = least_squares(&rows.a, &rows.b)?;
                let unknowns = values.torque.len() + usize::from(with_delay);
                let criterion = information(2 * frequencies, unknowns, 2.0 * rows.b.norm_squared());
                let sound = weighted_rms.is_finite();
                let fitted = FittedCoupling { values, rows, inverse, weighted_rms, criterion };
                return sound.then_some(fitted);
            }
            spread = weighted_rms.max(1.0);
        }
        None
    }

    /// Gauss-Newton.
    fn refined(&self, mut values: Values, spread: f64) -> Option<(Values, ResponseRows)> {
        let mut rows = self.rows(&values, spread);
        for _ in 0..STEPS {
            let (step, _) = least_squares(&rows.a, &rows.b)?;
            let cost = rows.b.norm_squared();
            let promised = cost - (&rows.b - &rows.a * &step).norm_squared();
            if promised.is_nan() || promised <= SHARE * cost {
                break;
            }
            let mut share = 1.0;
            let better = (0..HALVINGS).find_map(|_| {
                let next = self.moved(&values, &step, share);
                share *= 0.5;
                let rows = self.rows(&next, spread);
                (rows.b.norm_squared() < cost).then_some((next, rows))
            });
            let Some(better) = better else { break };
            (values, rows) = better;
        }
        Some((values, rows))
    }

    fn moved(&self, values: &Values, step: &DVector<f64>, share: f64) -> Values {
        let torques = values.torque.len();
        let mut within = values.within.clone();
        for (i, k) in self.free().enumerate() {
            within[k] += share * step[torques + i];
        }
        let last = step.len().checked_sub(1).map_or(0.0, |last| step[last]);
        Values {
            torque: &values.torque + share * step.rows(0, torques),
            within,
            delay_s: values.delay_s.map(|late| late + share * last),
        }
    }

    /// Slopes of the model by the poles' unknowns, over deviations.
    fn by_poles(&self, values: &Values, rows: &ResponseRows) -> DMatrix<f64> {
        let unknowns = self.fit.damping.unknowns();
        let count = self.fit.poles.len() * unknowns;
        let mut slopes = DMatrix::zeros(rows.a.nrows(), count);
        for (i, (&w, weight)) in self.data.omega_rad_s.iter().zip(&rows.weights).enumerate() {
            let (torque, model) = self.response(values, w);
            for column in 0..count {
                let (k, unknown) = (column / unknowns, column % unknowns);
                let at = |by: f64| {
                    let mut pole = self.poles[k];
                    match unknown {
                        0 => pole.omega_rad_s *= by.exp(),
                        _ => pole.damping_ratio += by,
                    }
                    coupled(&pole, values.within[k], w)
                };
                let slope = (at(DIFFERENCE) - at(-DIFFERENCE)) / (2.0 * DIFFERENCE);
                let z = -model / torque * values.torque[2 + k] * slope * *weight;
                (slopes[(2 * i, column)], slopes[(2 * i + 1, column)]) = (z.re, z.im);
            }
        }
        slopes
    }

    fn estimates(&self, fitted: &FittedCoupling) -> Option<CouplingFit> {
        let FittedCoupling { values, rows, inverse, .. } = fitted;
        let stretch = 0.5 * fitted.weighted_rms.max(1.0).powi(2);
        let slopes = self.by_poles(values, rows);
        let moved = -(inverse * rows.a.tr_mul(&slopes));
        let (estimates, poles) = (2 + self.fit.poles.len(), self.fit.poles.len());
        let beyond = self.poles.get(poles..).unwrap_or_default();
        let torques = values.torque.len();
        let within =
            DMatrix::from_fn(estimates, rows.a.ncols(), |i, j| match j.checked_sub(estimates) {
                Some(b) if i == 0 && j < torques => beyond[b].omega_rad_s.powi(-2),
                _ => f64::from(i == j && j < torques),
            });
        let torque = within.columns(0, torques) * &values.torque;
        let (value, by_poles) = (torque, &within * moved);
        let covariance = &within * inverse * within.transpose() * stretch;
        let sound = value.iter().chain(&by_poles).all(|v| v.is_finite());
        let last = rows.a.ncols() - 1;
        let late =
            |value| Estimate { value, std: (stretch * inverse[(last, last)]).max(0.0).sqrt() };
        sound.then(|| CouplingFit {
            value,
            covariance,
            by_poles,
            damping_within: values.within.clone(),
            delay_s: values.delay_s.map(late),
            friction_left: self.friction_left(fitted, &slopes),
            weighted_rms: fitted.weighted_rms,
            criterion: fitted.criterion,
        })
    }

    /// Of both shapes of friction left in, what the residual has of it beside all unknowns, in deviations.
    fn friction_left(&self, fitted: &FittedCoupling, slopes: &DMatrix<f64>) -> f64 {
        let FittedCoupling { values, rows, .. } = fitted;
        let (unknowns, poles) = (rows.a.ncols(), slopes.ncols());
        let mut all = DMatrix::zeros(rows.a.nrows(), unknowns + poles);
        all.columns_mut(0, unknowns).copy_from(&rows.a);
        all.columns_mut(unknowns, poles).copy_from(slopes);
        let standard_errors = |same_command: bool| {
            let mut column = DVector::zeros(rows.a.nrows());
            for (i, (&w, weight)) in self.data.omega_rad_s.iter().zip(&rows.weights).enumerate() {
                let torque = self.torque(values, w);
                let size = if same_command { torque.norm() } else { 1.0 };
                let model = self.data.torque_per_command / torque
                    * Complex64::cis(-w * values.delay_s.unwrap_or(0.0));
                let z = -model / torque * Complex64::new(0.0, size) * *weight;
                (column[2 * i], column[2 * i + 1]) = (z.re, z.im);
            }
            let (known, _) = least_squares(&all, &column)?;
            let alone = &column - &all * known;
            let spread = fitted.weighted_rms.max(1.0) * std::f64::consts::FRAC_1_SQRT_2;
            // What is left of it may be rounding alone.
            let there = alone.norm() > 1e-6 * column.norm();
            there.then(|| alone.dot(&rows.b) / (spread * alone.norm()))
        };
        let each = [false, true].into_iter().filter_map(standard_errors);
        each.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
    }
}
