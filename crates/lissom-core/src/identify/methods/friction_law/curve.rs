//! Friction against speed without a law: hat functions for each direction, in addition to a linear part.

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::column_values::hat;
use crate::identify::methods::friction_law::held::{by_direction, without_each};
use crate::identify::methods::friction_law::law_rows::LawRows;
use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::{Cut, Sampled, fixed};
use crate::identify::methods::friction_law::thresholds::KNOT_ROWS;
use crate::identify::methods::output_error::OutputError;
use crate::identify::methods::regression::{Cluster, Solution, Term, coupled_tips, values};
use crate::replay::ModalArm;

/// Ratio of one knot's speed to that of the next, from the fastest down.
const RATIO: f64 = 2.0;
/// Most knots in a direction.
const MOST: usize = 9;
/// Quantiles of the windows' speeds at which the first and the last knot stand.
const ENDS: [f64; 2] = [0.01, 0.99];
/// Most groups of slip phases that are left out, one after another, for the standard error.
const MOST_GROUPS: usize = 100;

/// Friction at one speed in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// +1 forward, −1 backward.
    pub direction: f64,
    /// Speed |v| \[rad/s or m/s\].
    pub speed: f64,
    /// Torque or force against the motion, positive if it brakes. It includes a constant load, with its sign in this
    /// direction, but not the damping by back-EMF.
    pub friction: Estimate,
    /// Number of windows around this speed.
    pub windows: usize,
}

/// Sums of the slip phases' windows with a hat function of speed at every knot, and what the curve is
/// solved from them with.
///
/// A hat is one at its knot and zero at its neighbours, so that its coefficient is friction there.
#[derive(Debug)]
pub(crate) struct CurveSums {
    rows: LawRows,
    /// Inertia and couplings, what is no friction by speed, hats forward, hats backward.
    terms: Vec<Term>,
    /// Of inertia and couplings.
    linear: usize,
    /// First column of the tips' rates, which no term has: damping within the beam, where it is known.
    rates: usize,
    /// Tips of the couplings.
    tips: Vec<usize>,
    knots: Vec<f64>,
    /// Windows about each knot, forward and backward; none: a speed that no window has.
    windows: [Vec<usize>; 2],
    back_emf_viscous: f64,
}

impl CurveSums {
    /// `beside` are columns of what is no friction by speed, with their `terms`.
    pub(super) fn new(
        sampled: &Sampled<'_>,
        cut: &Cut,
        speeds: &[f64],
        (beside, terms): (&[Column], &[Term]),
    ) -> Option<Self> {
        let places = sampled.places();
        let knots = knots(speeds, |knots, j| {
            let about = |sign: f64| {
                let there = places.iter().filter(|p| p.sign * sign > 0.0);
                there.map(|p| hat(knots, j, p.speed).max(0.0)).sum::<f64>()
            };
            [about(1.0), about(-1.0)]
        })?;
        let campaign = sampled.campaign;
        let first = fixed(campaign);
        let tips = coupled_tips(campaign);
        let mut columns = beside.to_vec();
        columns.extend((0..knots.len()).map(Column::Hat));
        let rates = first + columns.len();
        columns.extend((0..tips.len()).map(Column::Rate));
        let rows = LawRows::of(sampled, &columns, &knots, cut);
        let mut all = vec![Term::Plain(0)];
        all.extend((3..first).map(Term::Plain));
        let linear = all.len();
        all.extend(terms);
        let at = first + beside.len();
        all.extend((0..knots.len()).map(|j| Term::Forward(at + j)));
        all.extend((0..knots.len()).map(|j| Term::Backward(at + j)));
        let windows = [1.0, -1.0].map(|sign| {
            let near = |j: usize| {
                let there = places.iter().filter(|p| p.sign * sign > 0.0);
                there.filter(|p| hat(&knots, j, p.speed) > 0.5).count()
            };
            (0..knots.len()).map(near).collect()
        });
        Some(Self {
            rows,
            terms: all,
            linear,
            rates,
            tips,
            knots,
            windows,
            back_emf_viscous: campaign.channels.command.back_emf_viscous,
        })
    }

    /// The curve with inertia and couplings from the same windows, and what it leaves. Its standard errors are
    /// by leaving out slip phases, and no less than the regression's own.
    pub(super) fn by_phases(&self) -> Option<(Vec<CurvePoint>, f64)> {
        let solution = self.rows.solved(&self.terms)?;
        let by_phases = jackknife(&self.rows, &self.terms, &solution)?;
        Some((self.points(&solution, &by_phases), solution.relative_residual))
    }

    /// The curve with inertia and couplings of the arm that the output error found, far better known than by
    /// the slip phases: what they are off by does not go into friction. The standard errors are those by leaving out slip
    /// phases and those of the arm, all longer by one factor where the curve is further from the law that describes the log
    /// than they say: a sensor's steps come back with a repeated motion, alike in all its phases. `None` where the tips do not show all of its coupling torque, at once.
    pub(crate) fn beside_arm(&self, found: &OutputError) -> Option<Vec<CurvePoint>> {
        let known = self.known(&found.arm)?;
        let terms = &self.terms[self.linear..];
        let rows = self.rows.without(&known);
        let solution = rows.solved(terms)?;
        let by_phases = jackknife(&rows, terms, &solution)?;
        let totals = by_direction(self.rows.classes());
        let by_arm = found.variances(&|arm| {
            let known = self.known(arm)?;
            let totals = totals.each_ref().map(|sum| without_linear(sum, &known));
            let estimates = values(&totals, terms)?;
            Some(estimates.iter().map(|v| Complex64::new(*v, 0.0)).collect())
        })?;
        let variances: Vec<f64> = by_phases.iter().zip(by_arm).map(|(a, b)| a + b).collect();
        let mut points = self.points(&solution, &variances);
        let longer = self.beyond_law(&points, found)?;
        for point in &mut points {
            point.friction.std *= longer;
        }
        Some(points)
    }

    /// Inertia, the coupling of each tip and its damping within the beam, by their columns.
    fn known(&self, arm: &ModalArm) -> Option<Vec<(usize, f64)>> {
        let shown =
            self.tips.len() == arm.shapes.len() && arm.tip_lags_s.iter().all(|lag| *lag == 0.0);
        let [per_angle, per_rate] = if arm.modes.is_empty() {
            [vec![], vec![]]
        } else {
            [arm.coupling_by_tip()?, arm.coupling_rate_by_tip()?]
        };
        let values = std::iter::once(arm.inertia_kg_m2).chain(per_angle).collect::<Vec<f64>>();
        let linear = self.terms[..self.linear].iter().map(|term| term.column());
        let known = linear.zip(values.iter().copied());
        let rates = per_rate.into_iter().enumerate().map(|(i, rate)| (self.rates + i, rate));
        (shown && values.len() == self.linear).then(|| known.chain(rates).collect())
    }

    /// A curve by the phases alone, where the arm that the output error found has in it what these windows do not
    /// show: its standard errors are longer by one factor where it is further from the law of that arm than they say.
    pub(crate) fn beside_law(
        &self,
        mut points: Vec<CurvePoint>,
        found: &OutputError,
    ) -> Vec<CurvePoint> {
        if let Some(longer) = self.beyond_law(&points, found) {
            for point in &mut points {
                point.friction.std *= longer;
            }
        }
        points
    }

    /// How many of their standard errors points are off an arm's law of friction, root mean square; one at least.
    fn beyond_law(&self, points: &[CurvePoint], found: &OutputError) -> Option<f64> {
        let law = found.friction(self.back_emf_viscous);
        let beyond = |p: &CurvePoint| {
            Some(((p.friction.value - law.at(p.speed, p.direction)?) / p.friction.std).powi(2))
        };
        let squares: Vec<f64> = points.iter().map(beyond).collect::<Option<_>>()?;
        Some((squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt().max(1.0))
    }

    /// The curve of a solution whose last estimates are the hats'.
    fn points(&self, solution: &Solution, variances: &[f64]) -> Vec<CurvePoint> {
        let knots = self.knots.len();
        let hats = solution.value.len() - 2 * knots;
        let mut points = Vec::new();
        for (d, sign) in [1.0, -1.0].into_iter().enumerate() {
            for (j, speed) in self.knots.iter().enumerate() {
                let (i, windows) = (hats + d * knots + j, self.windows[d][j]);
                if solution.inseparable[i] || windows == 0 {
                    continue;
                }
                let std = variances[i].max(solution.covariance[(i, i)]).max(0.0).sqrt();
                let value = sign * solution.value[i] - self.back_emf_viscous * speed;
                let friction = Estimate { value, std };
                points.push(CurvePoint { direction: sign, speed: *speed, friction, windows });
            }
        }
        points
    }
}

/// The sums with some columns, times what is known of them, taken off the right side.
fn without_linear(sums: &Cluster, known: &[(usize, f64)]) -> Cluster {
    let right = sums.products.ncols() - 1;
    let mut taken = DMatrix::identity(right + 1, right + 1);
    for (column, value) in known {
        taken[(*column, right)] = -value;
    }
    let of = |sums: &DMatrix<f64>| taken.transpose() * sums * &taken;
    Cluster { products: of(&sums.products), noise: of(&sums.noise), ..sums.clone() }
}

/// Variance of every estimate by leaving out one group of slip phases after another: residuals within a
/// group may belong together as they like, and a few phases that carry much count fully.
fn jackknife(rows: &LawRows, terms: &[Term], full: &Solution) -> Option<Vec<f64>> {
    let phases = rows.blocks().iter().map(|b| b.phase + 1).max()?;
    let groups = phases.min(MOST_GROUPS);
    let sums = rows.sums(2 * groups, |b| 2 * (b.phase % groups) + usize::from(b.sign < 0.0));
    let sums: Vec<[Cluster; 2]> = sums.chunks(2).map(by_direction).collect();
    let estimates = without_each(&sums, terms)?;
    let square =
        |i: usize| estimates.iter().flatten().map(|v| (v[i] - full.value[i]).powi(2)).sum();
    Some((0..terms.len()).map(square).collect())
}

/// Speeds of the knots, ascending; `about` gives the windows about a knot in either direction.
fn knots(speeds: &[f64], about: impl Fn(&[f64], usize) -> [f64; 2]) -> Option<Vec<f64>> {
    let [low, high] = ENDS.map(|q| speeds[(q * (speeds.len() - 1) as f64) as usize]);
    if !(low > 0.0 && high > low) {
        return None;
    }
    let mut knots = vec![high];
    let mut next = high / RATIO;
    while next > RATIO.sqrt() * low && knots.len() + 1 < MOST {
        knots.push(next);
        next /= RATIO;
    }
    knots.push(low);
    knots.reverse();
    // The poorest goes until all have windows.
    while knots.len() > 2 {
        let poor = |j: usize| about(&knots, j).into_iter().fold(f64::INFINITY, f64::min);
        let poorest = (0..knots.len()).min_by(|a, b| poor(*a).total_cmp(&poor(*b)))?;
        if poor(poorest) >= KNOT_ROWS {
            break;
        }
        knots.remove(poorest);
    }
    Some(knots)
}
