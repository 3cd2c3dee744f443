//! Finds which number of an arm's description best explains that the logs show a different arm.

use nalgebra::{DMatrix, DVector};

use crate::arm::Arm;
use crate::beam::{BeamError, LumpedBeam, Payload, Span};
use crate::identify::estimate::Estimate;
use crate::identify::output_error::OutputError;
use crate::identify::thresholds::{
    GEOMETRY_AGREES, GEOMETRY_AS_GOOD, GEOMETRY_KNOWN, SINGLE_SPANS_MOST,
};
use crate::replay::ModalArm;

/// Steps of the search, the largest of them, and the one for slopes, all of the factor's logarithm.
const STEPS: usize = 30;
const LARGEST: f64 = 0.2;
const SLOPE: f64 = 1e-4;
/// A step below which it ends.
const ENOUGH: f64 = 1e-9;

/// A quantity of an arm that may differ from its description.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmQuantity {
    /// Length of one span (counted from 0), or of all spans if `None`.
    Length(Option<usize>),
    /// Flexural rigidity of one span, or of all.
    Stiffness(Option<usize>),
    /// Mass at the end of one span, or all masses.
    Mass(Option<usize>),
    /// The payload, with its rotary inertia.
    Payload,
    /// Inertia of the motor.
    MotorInertia,
}

/// How well a change of one quantity explains the difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Explanation {
    /// The quantity.
    pub quantity: ArmQuantity,
    /// True value divided by the value in the description \[1\], assuming that all other quantities are right.
    pub factor: Estimate,
    /// Root mean square of the relative differences of the parameters that remain after this change \[1\].
    pub left: f64,
    /// Its weighted squares.
    cost: f64,
}

/// An arm as described, compared with the arm that the logs show.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometryCheck {
    /// Root mean square of the relative differences of the parameters: J, and frequency
    /// and coupling of each mode \[1\].
    pub before: f64,
    /// The change of each quantity alone, the best explanation first.
    pub explanations: Vec<Explanation>,
}

/// Compares J, ω_k and k_k of the identified arm with those of the arm `described`. Then one quantity of the
/// description at a time is multiplied by the factor that brings these parameters closest to the identified ones.
/// Differences are weighted by their covariance, in which each standard error counts as at least 0.1 %.
///
/// The inertia that belongs to modes that were not found counts as part of J. The standard error of a factor is
/// increased if the quantity does not explain the difference. `None` if `described` is known only by its modes or has
/// fewer modes than were found, if no modes were found, or if one of them is without stiffness.
pub fn geometry_check(described: &Arm, found: &OutputError) -> Option<GeometryCheck> {
    let modes = found.arm.modes.len();
    if found.arm.modes.iter().any(|mode| mode.stiffness_nm_per_rad == 0.0) {
        return None;
    }
    let estimates = 1 + 2 * modes;
    let shown = |arm: &ModalArm, i: usize| match i.checked_sub(1) {
        None => arm.inertia_kg_m2.ln(),
        Some(k) if k < modes => arm.modes[k].omega_rad_s.ln(),
        Some(k) => arm.modes[k - modes].stiffness_nm_per_rad.ln(),
    };
    let variance = |of: &dyn Fn(&ModalArm) -> f64| found.estimate_of(of).std.powi(2);
    let own: Vec<f64> = (0..estimates).map(|i| variance(&|arm| shown(arm, i))).collect();
    let covariance = DMatrix::from_fn(estimates, estimates, |i, j| {
        if i == j {
            return own[i] + GEOMETRY_KNOWN * GEOMETRY_KNOWN;
        }
        0.5 * (variance(&|arm| shown(arm, i) + shown(arm, j)) - own[i] - own[j])
    });
    let weight = covariance.try_inverse()?;
    let problem = GeometryProblem {
        described,
        modes,
        weight,
        found: DVector::from_fn(estimates, |i, _| shown(&found.arm, i)),
    };
    let as_described = problem.difference(None, 0.0)?;
    let mut explanations: Vec<Explanation> =
        quantities(described).into_iter().filter_map(|d| problem.explained(d)).collect();
    explanations.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    Some(GeometryCheck { before: rms(&as_described), explanations })
}

impl GeometryCheck {
    /// Whether the description agrees with the identified arm, so that there is nothing to explain.
    pub fn agrees(&self) -> bool {
        self.before < GEOMETRY_AGREES * GEOMETRY_KNOWN
    }

    /// The explanations that are as good as the best, or nearly as good.
    pub fn as_good(&self) -> impl Iterator<Item = &Explanation> {
        let best = self.explanations.first().map_or(0.0, |e| e.left.max(GEOMETRY_KNOWN));
        let near = move |e: &&Explanation| e.left <= GEOMETRY_AS_GOOD * best;
        self.explanations.iter().take_while(near)
    }
}

struct GeometryProblem<'a> {
    described: &'a Arm,
    modes: usize,
    weight: DMatrix<f64>,
    /// Logarithms of the estimates.
    found: DVector<f64>,
}

impl GeometryProblem<'_> {
    /// Logarithms of the estimates, described less found, where a number is e^x times what is described.
    fn difference(&self, quantity: Option<ArmQuantity>, x: f64) -> Option<DVector<f64>> {
        let factor = x.exp();
        let motor = match quantity {
            Some(ArmQuantity::MotorInertia) => factor,
            _ => 1.0,
        };
        let beam = self.described.beam().lumped()?;
        let beam = match quantity {
            Some(quantity) => scaled(beam, quantity, factor).ok()?,
            None => beam.clone(),
        };
        let modes = beam.modes(usize::MAX);
        if modes.len() < self.modes || self.modes == 0 {
            return None;
        }
        let beyond: f64 = modes[self.modes..].iter().map(|m| m.inertia_kg_m2).sum();
        let inertia = self.described.motor.inertia_kg_m2() * motor + beyond;
        let mut all = vec![inertia.ln()];
        let kept = &modes[..self.modes];
        all.extend(kept.iter().map(|m| m.natural_frequency_rad_s.ln()));
        let stiffness = kept.iter().map(|m| m.inertia_kg_m2 * m.natural_frequency_rad_s.powi(2));
        all.extend(stiffness.map(f64::ln));
        let difference = DVector::from_vec(all) - &self.found;
        difference.iter().all(|d| d.is_finite()).then_some(difference)
    }

    /// The factor of one number that brings the estimates nearest.
    fn explained(&self, quantity: ArmQuantity) -> Option<Explanation> {
        let at = |x: f64| self.difference(Some(quantity), x);
        let cost = |d: &DVector<f64>| d.dot(&(&self.weight * d));
        let mut x = 0.0;
        let mut information = 0.0;
        for _ in 0..STEPS {
            let slope = (at(x + SLOPE)? - at(x - SLOPE)?) / (2.0 * SLOPE);
            information = cost(&slope);
            let step = -slope.dot(&(&self.weight * at(x)?)) / information;
            let step = step.clamp(-LARGEST, LARGEST);
            if !step.is_finite() {
                return None;
            }
            x += step;
            if step.abs() < ENOUGH {
                break;
            }
        }
        let left = at(x)?;
        let free = (left.len() - 1).max(1) as f64;
        let stretch = (cost(&left) / free).max(1.0);
        let value = x.exp();
        let std = value * (stretch / information).sqrt();
        Some(Explanation {
            quantity,
            factor: Estimate { value, std },
            left: rms(&left),
            cost: cost(&left),
        })
    }
}

/// Those that the description has.
fn quantities(described: &Arm) -> Vec<ArmQuantity> {
    let spans = described.beam().len();
    let mut all =
        vec![ArmQuantity::Length(None), ArmQuantity::Stiffness(None), ArmQuantity::Mass(None)];
    if (2..=SINGLE_SPANS_MOST).contains(&spans) {
        for i in 0..spans {
            let one = Some(i);
            all.extend([
                ArmQuantity::Length(one),
                ArmQuantity::Stiffness(one),
                ArmQuantity::Mass(one),
            ]);
        }
    }
    let payload = described.beam().payload();
    if payload.mass_kg > 0.0 || payload.inertia_kg_m2 > 0.0 {
        all.push(ArmQuantity::Payload);
    }
    all.push(ArmQuantity::MotorInertia);
    all
}

/// The beam with one of its numbers multiplied.
fn scaled(beam: &LumpedBeam, quantity: ArmQuantity, factor: f64) -> Result<LumpedBeam, BeamError> {
    let mut spans: Vec<Span> = beam.spans().to_vec();
    let mut payload: Payload = *beam.payload();
    let one = |which: Option<usize>, i: usize| which.is_none_or(|w| w == i);
    for (i, span) in spans.iter_mut().enumerate() {
        match quantity {
            ArmQuantity::Length(which) if one(which, i) => span.length_m *= factor,
            ArmQuantity::Stiffness(which) if one(which, i) => span.flexural_rigidity_n_m2 *= factor,
            ArmQuantity::Mass(which) if one(which, i) => span.mass_kg *= factor,
            _ => {}
        }
    }
    if quantity == ArmQuantity::Payload {
        payload.mass_kg *= factor;
        payload.inertia_kg_m2 *= factor;
    }
    LumpedBeam::new(&spans)?.with_hub_radius(beam.hub_radius_m())?.with_payload(payload)
}

fn rms(differences: &DVector<f64>) -> f64 {
    (differences.norm_squared() / differences.len() as f64).sqrt()
}
