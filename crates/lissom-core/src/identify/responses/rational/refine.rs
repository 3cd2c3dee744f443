//! Maximum likelihood: refines poles and residues together, starting from the result of vector fitting.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use num_complex::Complex64;

use crate::identify::responses::rational::Pole;
use crate::identify::responses::rational::columns::{inverses, push_column, push_weighted, shape};
use crate::identify::responses::rational::pole_damping::Damping;
use crate::identify::responses::rational::products::products;
use crate::identify::responses::rational::weighted::{Basis, Output, Weighted};

/// Most steps.
const STEPS: usize = 40;
/// A step is not worth making that promises less than this, in squared deviations.
const PROMISE: f64 = 1e-7;
/// The same as a share of what is left.
const SHARE: f64 = 1e-12;
/// Most halvings of a step.
const HALVINGS: usize = 12;
/// Largest change of a frequency's logarithm in one step.
const LARGEST: f64 = 0.2;
/// Most times that the responses are turned back by their delays.
const TURNS: usize = 40;
/// Delays are found where this much of a turn \[rad\] is left at the highest frequency…
const STILL: f64 = 1e-9;
/// …and they move by no more than this at a time.
const FARTHEST: f64 = 0.5;

/// Poles with the residues that are best at them.
pub(super) struct PolePoint {
    pub(super) poles: Vec<Pole>,
    /// Of output i (outer): `ρ_ik = r_ik/ω_k²` of each pole k, then ρ'_ik of each where the residues have terms in
    /// s, then the delay not yet taken out where one is looked for, in 1/ω of the highest frequency.
    pub(super) own_estimates: Vec<DVector<f64>>,
    /// Squares of the residuals, each part in its deviations.
    pub(super) cost: f64,
    /// The same of each output.
    pub(super) costs: Vec<f64>,
    /// By ln ω_k and, of damped poles, ζ_k, the gains eliminated.
    normal: DMatrix<f64>,
    right: DVector<f64>,
    /// Of each output: the gains' own normal matrix, factored, and its products with the poles'.
    own: Vec<Own>,
}

struct Own {
    factor: Cholesky<f64, Dyn>,
    across: DMatrix<f64>,
}

/// The same with the delays of the outputs that look for one: what is left of each is taken out of the data
/// until nothing is. `data` is turned back by them.
pub(super) fn refined_with_delays(
    data: &mut Weighted,
    mut poles: Vec<Pole>,
    damping: Damping,
) -> Option<PolePoint> {
    let highest = data.range().1;
    for _ in 0..TURNS {
        let point = refined(data, poles, damping)?;
        let each = data.outputs.iter().zip(&point.own_estimates);
        let late = each.map(|(output, own)| match output.delay_s {
            Some(_) => own.iter().next_back().copied().unwrap_or(0.0),
            None => 0.0,
        });
        let late: Vec<f64> = late.collect();
        let most = late.iter().fold(0.0, |most: f64, l| most.max(l.abs()));
        if most < STILL {
            return Some(point);
        }
        let share = (FARTHEST / most).min(1.0);
        for (output, late) in late.iter().enumerate() {
            data.turn_back(output, share * late / highest);
            data.outputs[output].model = point.weighted_model(data, output);
        }
        poles = point.poles;
    }
    None
}

/// Gauss-Newton on the poles, the gains being linear (variable projection), from `poles`. `None` where two
/// poles have come together.
pub(super) fn refined(
    data: &Weighted,
    mut poles: Vec<Pole>,
    damping: Damping,
) -> Option<PolePoint> {
    if damping == Damping::None {
        for pole in &mut poles {
            pole.damping_ratio = 0.0;
        }
    }
    let mut point = PolePoint::new(data, poles, damping)?;
    for _ in 0..STEPS {
        let step = point.normal.clone().cholesky()?.solve(&point.right);
        let promised = step.dot(&point.right);
        if promised < PROMISE.max(SHARE * point.cost) {
            break;
        }
        let mut share = (LARGEST / largest(&step, damping)).min(1.0);
        let halved = (0..HALVINGS).find_map(|_| {
            let found = PolePoint::new(data, point.moved(&step, share, damping), damping);
            share *= 0.5;
            found.filter(|f| f.cost < point.cost)
        });
        let Some(better) = halved else { break };
        point = better;
    }
    let ascending = |a: &Pole, b: &Pole| a.omega_rad_s <= b.omega_rad_s;
    if point.poles.is_sorted_by(ascending) {
        return Some(point);
    }
    point.poles.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s));
    PolePoint::new(data, point.poles, damping)
}

/// Largest change of ln ω in a step.
fn largest(step: &DVector<f64>, damping: Damping) -> f64 {
    step.iter().step_by(damping.unknowns()).map(|s| s.abs()).fold(0.0, f64::max)
}

impl PolePoint {
    pub(super) fn new(data: &Weighted, poles: Vec<Pole>, damping: Damping) -> Option<Self> {
        let (count, unknowns) = (poles.len(), poles.len() * damping.unknowns());
        let columns = columns(data, &poles, damping);
        let each = data.each(columns.ncols(), |output| {
            OneOutput::new(data, output, &columns, count, damping)
        })?;
        let mut found = Self {
            poles,
            own_estimates: Vec::new(),
            cost: 0.0,
            costs: Vec::new(),
            normal: DMatrix::zeros(unknowns, unknowns),
            right: DVector::zeros(unknowns),
            own: Vec::new(),
        };
        for one in each {
            found.normal += one.normal;
            found.right += one.right;
            found.cost += one.cost;
            found.costs.push(one.cost);
            found.own_estimates.push(one.estimates);
            found.own.push(one.own);
        }
        (found.cost.is_finite()).then_some(found)
    }

    fn moved(&self, step: &DVector<f64>, share: f64, damping: Damping) -> Vec<Pole> {
        let unknowns = damping.unknowns();
        let moved = |(k, pole): (usize, &Pole)| Pole {
            omega_rad_s: pole.omega_rad_s * (share * step[unknowns * k]).exp(),
            damping_ratio: match damping {
                Damping::None => 0.0,
                Damping::Small | Damping::Within => {
                    pole.damping_ratio + share * step[unknowns * k + 1]
                }
            },
        };
        self.poles.iter().enumerate().map(moved).collect()
    }

    /// The model of one output without delay, as the data are weighted.
    fn weighted_model(&self, data: &Weighted, output: usize) -> Vec<Complex64> {
        let (estimates, count) = (&self.own_estimates[output], self.poles.len());
        let delayed = usize::from(data.outputs[output].delay_s.is_some());
        let in_s = estimates.len() - delayed > count;
        let at = |(omega, weight): (&f64, &f64)| {
            if let Basis::Torque(coupled) = &data.outputs[output].basis {
                let s = Complex64::new(0.0, *omega);
                let through = |(c, k): (&f64, &usize)| {
                    let pole = &self.poles[*k];
                    c * (1.0 - pole.omega_rad_s.powi(2) / pole.denominator(*omega))
                };
                let coupling = estimates.iter().skip(2).zip(coupled).map(through);
                let rigid = s * (s * estimates[0] + estimates[1]);
                return weight * (rigid + coupling.sum::<Complex64>());
            }
            let part = |(k, pole): (usize, &Pole)| {
                let w = pole.omega_rad_s;
                let term = if in_s { estimates[count + k] * w * omega } else { 0.0 };
                Complex64::new(estimates[k] * w * w, term) / pole.denominator(*omega)
            };
            weight * self.poles.iter().enumerate().map(part).sum::<Complex64>()
        };
        data.omega.iter().zip(&data.outputs[output].weights).map(at).collect()
    }

    /// Where the estimates of each output begin in the covariance, and its size.
    pub(super) fn places(&self) -> (Vec<usize>, usize) {
        let mut next = self.normal.nrows();
        let mut begin = |estimates: &DVector<f64>| {
            next += estimates.len();
            next - estimates.len()
        };
        let places = self.own_estimates.iter().map(&mut begin).collect();
        (places, next)
    }

    /// The same of the poles, known from elsewhere with the covariance `of_poles`, and of the estimates of one output, whose
    /// squared standard errors are stretched by `stretch`.
    pub(super) fn covariance_with(
        &self,
        output: usize,
        of_poles: &DMatrix<f64>,
        stretch: f64,
    ) -> DMatrix<f64> {
        let own = &self.own[output];
        let (poles, estimates) = (of_poles.nrows(), own.across.nrows());
        let slopes = -own.factor.solve(&own.across);
        let mut by_both = DMatrix::identity(poles + estimates, poles + estimates);
        by_both.view_mut((poles, 0), (estimates, poles)).copy_from(&slopes);
        let mut known = own.factor.inverse() * stretch;
        known = known.insert_rows(0, poles, 0.0).insert_columns(0, poles, 0.0);
        known.view_mut((0, 0), (poles, poles)).copy_from(of_poles);
        &by_both * known * by_both.transpose()
    }

    /// Covariance of ln ω_k (and ζ_k), pole by pole, and then of each output's own estimates, where each response
    /// has the standard error it claims.
    pub(super) fn covariance(&self) -> Option<DMatrix<f64>> {
        let poles = self.normal.nrows();
        let of_poles = self.normal.clone().cholesky()?.inverse();
        let (places, size) = self.places();
        let mut all = DMatrix::zeros(size, size);
        all.view_mut((0, 0), (poles, poles)).copy_from(&of_poles);
        // ∂estimates/∂poles of the best estimates.
        let slopes: Vec<DMatrix<f64>> =
            self.own.iter().map(|own| -own.factor.solve(&own.across)).collect();
        for (i, slope) in slopes.iter().enumerate() {
            let (at, own) = (places[i], slope.nrows());
            let with_poles = slope * &of_poles;
            all.view_mut((at, 0), (own, poles)).copy_from(&with_poles);
            all.view_mut((0, at), (poles, own)).copy_from(&with_poles.transpose());
            for (j, other) in slopes.iter().enumerate() {
                let mut block = &with_poles * other.transpose();
                if i == j {
                    block += self.own[i].factor.inverse();
                }
                all.view_mut((at, places[j]), block.shape()).copy_from(&block);
            }
        }
        Some(all)
    }
}

/// `ψ_k = ω_k²/D_k` of all poles, and `s/ω_k` times that where residues have terms in s; then their slopes by
/// ln ω_k and ζ_k pole by pole, in the same order. Real parts stand above imaginary ones.
fn columns(data: &Weighted, poles: &[Pole], damping: Damping) -> DMatrix<f64> {
    let (points, terms) = (data.omega.len(), damping.terms());
    let count = terms * poles.len() * (1 + damping.unknowns());
    let inverse: Vec<_> = poles.iter().map(|pole| inverses(&data.omega, pole)).collect();
    let mut columns = Vec::with_capacity(2 * points * count);
    let each = || poles.iter().zip(&inverse);
    let turns = &[false, true][..terms];
    for &turned in turns {
        for (pole, inverse) in each() {
            push_column(&mut columns, &data.omega, inverse, |omega, inverse| {
                shape(pole, turned, omega, inverse)
            });
        }
    }
    for &turned in turns {
        for (pole, inverse) in each() {
            let (w, power) = (pole.omega_rad_s, if turned { 1.0 } else { 2.0 });
            push_column(&mut columns, &data.omega, inverse, |omega, inverse| {
                let inner = Complex64::new(2.0 * w * w, 2.0 * pole.damping_ratio * w * omega);
                shape(pole, turned, omega, inverse) * (power - inverse * inner)
            });
            if damping != Damping::None {
                push_column(&mut columns, &data.omega, inverse, |omega, inverse| {
                    let by_damping = Complex64::new(0.0, -2.0 * w * omega) * inverse;
                    shape(pole, turned, omega, inverse) * by_damping
                });
            }
        }
    }
    DMatrix::from_vec(2 * points, count, columns)
}

/// What one output says of the poles, its own estimates at their best.
struct OneOutput {
    estimates: DVector<f64>,
    cost: f64,
    normal: DMatrix<f64>,
    right: DVector<f64>,
    own: Own,
}

impl OneOutput {
    fn new(
        data: &Weighted,
        output: &Output,
        columns: &DMatrix<f64>,
        count: usize,
        damping: Damping,
    ) -> Option<Self> {
        let points = data.omega.len();
        let gains = match &output.basis {
            Basis::Residues => damping.terms() * count,
            Basis::Torque(coupled) => 2 + coupled.len(),
        };
        let delayed = usize::from(output.delay_s.is_some());
        let (own, unknowns) = (gains + delayed, count * damping.unknowns());
        // What was measured, the basis, then the slopes by the poles.
        let mut all = Vec::with_capacity(2 * points * (1 + own + unknowns));
        let push = |all: &mut Vec<f64>, column: usize, factor: f64| {
            let column = columns.column(column);
            push_weighted(all, column.as_slice(), &output.weights, factor);
        };
        all.extend(output.weighted.iter().map(|value| value.re));
        all.extend(output.weighted.iter().map(|value| value.im));
        match &output.basis {
            Basis::Residues => (0..gains).for_each(|column| push(&mut all, column, 1.0)),
            Basis::Torque(coupled) => {
                let weights = || data.omega.iter().zip(&output.weights);
                let nothing = || std::iter::repeat_n(0.0, points);
                all.extend(
                    weights().map(|(omega, weight)| -omega * omega * weight).chain(nothing()),
                );
                all.extend(nothing().chain(weights().map(|(omega, weight)| omega * weight)));
                for &pole in coupled {
                    push(&mut all, pole, -1.0);
                    let real = all.len() - 2 * points;
                    all[real..]
                        .iter_mut()
                        .zip(&output.weights)
                        .for_each(|(z, weight)| *z += weight);
                }
            }
        }
        if delayed > 0 {
            // e^(s·δ)·d = Σ of the poles: to first order d less −s·δ times the model.
            let highest = data.range().1;
            let late =
                || data.omega.iter().zip(&output.model).map(|(omega, m)| (omega / highest, m));
            all.extend(late().map(|(omega, model)| omega * model.im));
            all.extend(late().map(|(omega, model)| -omega * model.re));
        }
        let linear = products(&all, 2 * points);
        let factor = linear.view((1, 1), (own, own)).into_owned().cholesky()?;
        let estimates = factor.solve(&linear.view((1, 0), (own, 1)).column(0));
        let (left, basis) = all.split_at_mut(2 * points);
        for (column, estimate) in basis.chunks_exact(2 * points).zip(&estimates) {
            left.iter_mut().zip(column).for_each(|(left, part)| *left -= estimate * part);
        }
        // Slopes of the shared columns stand behind the residues' basis.
        let basis = damping.terms() * count;
        for slope in 0..unknowns {
            let pole = slope / damping.unknowns();
            let gain = match &output.basis {
                Basis::Residues => estimates[pole],
                Basis::Torque(coupled) => {
                    let place = coupled.iter().position(|k| *k == pole);
                    place.map_or(0.0, |place| -estimates[2 + place])
                }
            };
            push(&mut all, basis + slope, gain);
            if damping == Damping::Within {
                let sum = all.len() - 2 * points;
                push(&mut all, basis + unknowns + slope, estimates[count + pole]);
                let (sums, more) = all[sum..].split_at_mut(2 * points);
                sums.iter_mut().zip(more).for_each(|(sum, part)| *sum += *part);
                all.truncate(sum + 2 * points);
            }
        }
        let products = products(&all, 2 * points);
        let across = products.view((1, 1 + own), (own, unknowns)).into_owned();
        let normal = products.view((1 + own, 1 + own), (unknowns, unknowns));
        let eliminated = factor.l().solve_lower_triangular(&across)?;
        Some(Self {
            cost: products[(0, 0)],
            normal: normal - eliminated.tr_mul(&eliminated),
            // Left is across the basis: nothing of it is eliminated.
            right: products.view((1 + own, 0), (unknowns, 1)).column(0).into_owned(),
            estimates,
            own: Own { factor, across },
        })
    }
}
