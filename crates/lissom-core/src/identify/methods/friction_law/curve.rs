//! Friction against speed without a law: hat functions for each direction, in addition to a linear part.

use num_complex::Complex64;

use crate::identify::estimate::Estimate;
use crate::identify::friction_estimates::Friction;
use crate::identify::methods::friction_law::blocks::{Acts, BlockRows, Gram, Regressor};
use crate::identify::methods::friction_law::column_values::hat;
use crate::identify::methods::friction_law::law_term::Column;
use crate::identify::methods::friction_law::rows::{Cut, Sampled};
use crate::identify::methods::friction_law::thresholds::KNOT_ROWS;
use crate::identify::methods::regression::{MotorColumns, Solution, coupled_tips};
use crate::replay::ModalArm;

/// Ratio of one knot's speed to that of the next, from the fastest down.
const RATIO: f64 = 2.0;
/// Most knots in a direction.
const MOST: usize = 9;
/// Quantiles of the windows' speeds at which the first and the last knot stand.
const ENDS: [f64; 2] = [0.01, 0.99];

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
    rows: BlockRows,
    /// Columns of inertia and couplings, of what is no friction by speed, of hats forward and hats backward.
    columns: Vec<usize>,
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

/// An arm that a method above this one has found, with what is known of it.
pub(crate) trait KnownArm {
    fn arm(&self) -> &ModalArm;
    /// Its friction without back-EMF.
    fn friction(&self, back_emf_viscous: f64) -> Friction;
    /// Variances of quantities of the arm, by the errors of its parameters.
    fn variances(&self, of: &dyn Fn(&ModalArm) -> Option<Vec<Complex64>>) -> Option<Vec<f64>>;
}

impl CurveSums {
    /// `beside` are the regressors of what is no friction by speed.
    pub(super) fn new(
        sampled: &Sampled<'_>,
        cut: &Cut,
        speeds: &[f64],
        beside: &[Regressor],
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
        let tips = coupled_tips(campaign);
        let mut rows = BlockRows::of(sampled, cut);
        let first = rows.width();
        let hats = [Acts::Forward, Acts::Backward]
            .map(|acts| (0..knots.len()).map(move |j| Regressor::Function(Column::Hat(j), acts)));
        let mut further = beside.to_vec();
        further.extend(hats.into_iter().flatten());
        let rates = first + further.len();
        let rate = |tip: usize| Regressor::Function(Column::Rate(tip), Acts::Alike);
        further.extend((0..tips.len()).map(rate));
        rows.add(sampled, &further, &knots);
        // Viscous and Coulomb friction and the offset are the hats'.
        let couplings = MotorColumns::of(campaign).couplings();
        let mut columns: Vec<usize> = std::iter::once(0).chain(couplings.start..first).collect();
        let linear = columns.len();
        columns.extend(first..rates);
        let windows = [1.0, -1.0].map(|sign| {
            let near = |j: usize| {
                let there = places.iter().filter(|p| p.sign * sign > 0.0);
                there.filter(|p| hat(&knots, j, p.speed) > 0.5).count()
            };
            (0..knots.len()).map(near).collect()
        });
        Some(Self {
            rows,
            columns,
            linear,
            rates,
            tips,
            knots,
            windows,
            back_emf_viscous: campaign.channels.command.back_emf_viscous,
        })
    }

    /// The curve with inertia and couplings from the same windows, and what it leaves. Its standard errors are
    /// by leaving out blocks of slip phases, and no less than the regression's own.
    pub(super) fn by_blocks(&self) -> Option<(Vec<CurvePoint>, f64)> {
        let solution = self.rows.solved(&self.columns)?;
        let by_blocks = jackknife(&self.rows, &self.columns, &solution)?;
        Some((self.points(&solution, &by_blocks), solution.relative_residual))
    }

    /// The curve with inertia and couplings of the arm that the output error found, far better known than by
    /// the slip phases: what they are off by does not go into friction. The standard errors are those by leaving out slip
    /// phases and those of the arm, all longer by one factor where the curve is further from the law that describes the log
    /// than they say: a sensor's steps come back with a repeated motion, alike in all its phases. `None` where the tips do not show all of its coupling torque, at once.
    pub(crate) fn beside_arm(&self, found: &dyn KnownArm) -> Option<Vec<CurvePoint>> {
        let known = self.known(found.arm())?;
        let columns = &self.columns[self.linear..];
        let rows = self.rows.less(&known);
        let solution = rows.solved(columns)?;
        let by_blocks = jackknife(&rows, columns, &solution)?;
        let total = self.rows.total();
        let by_arm = found.variances(&|arm| {
            let estimates = total.less(&self.known(arm)?).values(columns)?;
            Some(estimates.iter().map(|v| Complex64::new(*v, 0.0)).collect())
        })?;
        let variances: Vec<f64> = by_blocks.iter().zip(by_arm).map(|(a, b)| a + b).collect();
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
        let linear = self.columns[..self.linear].iter().copied();
        let known = linear.zip(values.iter().copied());
        let rates = per_rate.into_iter().enumerate().map(|(i, rate)| (self.rates + i, rate));
        (shown && values.len() == self.linear).then(|| known.chain(rates).collect())
    }

    /// A curve by the phases alone, where the arm that the output error found has in it what these windows do not
    /// show: its standard errors are longer by one factor where it is further from the law of that arm than they say.
    pub(crate) fn beside_law(
        &self,
        mut points: Vec<CurvePoint>,
        found: &dyn KnownArm,
    ) -> Vec<CurvePoint> {
        if let Some(longer) = self.beyond_law(&points, found) {
            for point in &mut points {
                point.friction.std *= longer;
            }
        }
        points
    }

    /// How many of their standard errors points are off an arm's law of friction, root mean square; one at least.
    fn beyond_law(&self, points: &[CurvePoint], found: &dyn KnownArm) -> Option<f64> {
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

/// Variance of every estimate by leaving out one block of slip phases after another: residuals within a
/// block may belong together as they like, and a few phases that carry much count fully.
fn jackknife(rows: &BlockRows, columns: &[usize], full: &Solution) -> Option<Vec<f64>> {
    let total = rows.total();
    let without = |block: &Gram| total.without(block).values(columns);
    let estimates: Vec<_> = rows.blocks.iter().map(without).collect::<Option<_>>()?;
    let square = |i: usize| estimates.iter().map(|v| (v[i] - full.value[i]).powi(2)).sum();
    Some((0..columns.len()).map(square).collect())
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
