//! Friction against speed without a law: hat functions, forward and backward, beside the linear part.

use super::choice::solved;
use super::held::without_each;
use super::rows::{Block, Column, Cut, Sampled, fixed, hat};
use crate::identify::Estimate;
use crate::identify::regression::{Solution, Term};

/// Ratio of one knot's speed to that of the next, from the fastest down.
const RATIO: f64 = 2.0;
/// Most knots in a direction.
const MOST: usize = 9;
/// Quantiles of the windows' speeds at which the first and the last knot stand.
const ENDS: [f64; 2] = [0.01, 0.99];
/// Most groups of slip phases that are left out, one after another, for the deviation.
const MOST_GROUPS: usize = 100;
/// A knot is left out where fewer windows than this lie about it.
const LEAST_ROWS: f64 = 20.0;

/// Friction at one speed in one direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// +1 forward, −1 backward.
    pub direction: f64,
    /// |v| \[rad/s or m/s\].
    pub speed: f64,
    /// Torque (force) against the motion: positive where it brakes. A constant load is in it, with
    /// the sign that it has against this direction; back-EMF is not.
    pub friction: Estimate,
    /// Windows about this speed.
    pub windows: usize,
}

/// The curve, and what it leaves; `beside` are columns of what is no friction by speed, with `terms`.
///
/// A hat is one at its knot and zero at its neighbours, so that its coefficient is friction there. The
/// deviation is by leaving out slip phases, and no less than the regression's own. Speeds that no window has are left out.
pub(super) fn curve(
    sampled: &Sampled<'_>,
    cut: &Cut,
    speeds: &[f64],
    beside: &[Column],
    terms: &[Term],
) -> Option<(Vec<CurvePoint>, f64)> {
    let places = sampled.places();
    let knots = knots(speeds, |knots, j| {
        let about = |sign: f64| {
            places
                .iter()
                .filter(|p| p.sign * sign > 0.0)
                .map(|p| hat(knots, j, p.speed))
                .sum::<f64>()
        };
        [about(1.0), about(-1.0)]
    })?;
    let first = fixed(sampled.campaign);
    let mut columns = beside.to_vec();
    columns.extend((0..knots.len()).map(Column::Hat));
    let blocks = sampled.blocks(&columns, &knots, cut);
    let mut all = vec![Term::Plain(0)];
    all.extend((3..first).map(Term::Plain));
    all.extend(terms);
    let hats = all.len();
    let at = first + beside.len();
    all.extend((0..knots.len()).map(|j| Term::Forward(at + j)));
    all.extend((0..knots.len()).map(|j| Term::Backward(at + j)));
    let solution = solved(&blocks, &all)?;
    let moved = jackknife(&blocks, &all, &solution)?;
    let back_emf = sampled.campaign.channels.command.back_emf_viscous;
    let mut points = Vec::new();
    for (d, sign) in [1.0, -1.0].into_iter().enumerate() {
        for (j, speed) in knots.iter().enumerate() {
            let i = hats + d * knots.len() + j;
            let weight =
                |p: &&super::rows::Place| p.sign * sign > 0.0 && hat(&knots, j, p.speed) > 0.5;
            let windows = places.iter().filter(weight).count();
            if solution.inseparable[i] || windows == 0 {
                continue;
            }
            let by_phases = moved[i].max(solution.covariance[(i, i)]);
            let std = by_phases.max(0.0).sqrt();
            let value = sign * solution.value[i] - back_emf * speed;
            let friction = Estimate { value, std };
            points.push(CurvePoint { direction: sign, speed: *speed, friction, windows });
        }
    }
    Some((points, solution.relative_residual))
}

/// Variance of every figure by leaving out one group of slip phases after another: residuals within a
/// group may belong together as they like, and a few phases that carry much count fully.
fn jackknife(blocks: &[Block], terms: &[Term], full: &Solution) -> Option<Vec<f64>> {
    let phases = blocks.iter().map(|b| b.phase + 1).max()?;
    let groups = phases.min(MOST_GROUPS);
    let figures = without_each(blocks, terms, groups, |b| b.phase % groups)?;
    let square = |i: usize| figures.iter().flatten().map(|v| (v[i] - full.value[i]).powi(2)).sum();
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
        if poor(poorest) >= LEAST_ROWS {
            break;
        }
        knots.remove(poorest);
    }
    Some(knots)
}
