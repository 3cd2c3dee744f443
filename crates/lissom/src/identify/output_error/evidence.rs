//! Which parameters beyond the simplest law the residual calls for.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::coordinates::Body;
use super::covariance::{Covariances, deviation};
use super::law;
use super::search::Stop;
use super::stages::{Fit, Fitting, Laws, Report};
use crate::information::{inverse, normal_equations};
use crate::record::TipQuantity;
use crate::replay::{Parameter, SensorNoise, WindowSums};

/// A parameter is called for where it would stand this many deviations from what it is without…
const DEVIATIONS: f64 = 4.0;
/// …and take at least this share of the cost away. Small as it is, it counts: damping against the frame
/// that is left out goes into viscous friction, by many of its deviations.
const SHARE: f64 = 1e-4;
/// A group that takes this share of the cost is called for whatever its deviations: what it lacks is in
/// them.
const LARGE: f64 = 0.02;
/// Residual beside the noise of the samples from which on friction may have another law.
const BEYOND_NOISE: f64 = 1.2;
/// Share of what is beyond the noise that another law may leave: a term takes some of anything else too.
const LAW_LEAVES: f64 = 0.7;
/// Share of the cost by which point masses may leave more than free modes.
const RIGID_SHARE: f64 = 1e-3;
/// A kind of dampers is there when one of them stands this many deviations from zero.
const THERE: f64 = 2.0;
/// Deviations at which a group is as likely to be there as not.
pub(super) const EVEN: f64 = 3.0;
/// Most groups added at a time.
const MOST: usize = 3;

/// A parameter that was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extension {
    /// Which.
    pub parameter: Parameter,
    /// The one that a single step promises.
    pub value: f64,
    /// Deviation of that.
    pub std: f64,
    /// Share of the cost that it, or its group, was expected to take away.
    pub share: f64,
    /// Whether it was added.
    pub added: bool,
}

/// Adds parameters while the residual calls for some, each time the group that takes most away.
pub(super) fn extend(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    for _ in 0..MOST {
        let mut found = all_scores(fitting, fit, &candidates(fitting, fit)).1;
        let called_for = |(_, promise): &(usize, &Promise)| {
            let stands = |e: &Extension| e.value.abs() > DEVIATIONS * e.std;
            let stand = promise.group.iter().any(stands) || promise.stands_together();
            promise.share() > LARGE || (promise.share() > SHARE && stand)
        };
        let best = found.iter().enumerate().filter(called_for);
        let best = best.max_by(|a, b| a.1.share().total_cmp(&b.1.share())).map(|(k, _)| k);
        let floor = if takes_likelier(fitting, fit) { SHARE } else { LARGE };
        let least = best.map_or(floor, |k| found[k].share().max(floor));
        if add_to_law(fitting, fit, report, least) {
            continue;
        }
        let added = best.map(|k| found.remove(k).group);
        report.refused = found.into_iter().flat_map(|promise| promise.group).collect();
        let Some(added) = added else { break };
        fit.free.extend(added.iter().map(|e| e.parameter));
        report.added.extend(added.into_iter().map(|e| Extension { added: true, ..e }));
        fitting.search(fit, report);
        drop_dampers(fitting, fit, report);
    }
}

/// Adds a term to friction's law where more than the sensors' noise is left, and it promises to take
/// more than the share `least` of that, or where it need only be likelier than none; tells whether it did.
fn add_to_law(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report, least: f64) -> bool {
    let likelier = takes_likelier(fitting, fit);
    let calls = likelier || fitting.beyond_noise(fit) >= BEYOND_NOISE;
    if fitting.laws == Laws::AsStarted || !calls {
        return false;
    }
    let Some((trial, found)) = law::best(fitting, fit, least) else { return false };
    if share(&found) <= least {
        return false;
    }
    let mut with = fit.clone();
    trial.put_into(&mut with);
    fitting.search(&mut with, report);
    let better = if likelier {
        price(fitting, &with, &fit.noise) < price(fitting, fit, &fit.noise)
    } else {
        fitting.excess(&with) <= LAW_LEAVES * fitting.excess(fit)
    };
    if better {
        *fit = with;
        report.law_changed();
        report.added.extend(found.into_iter().map(|e| Extension { added: true, ..e }));
    }
    better
}

/// Whether a term of friction's law need only be likelier than none: the level of bristles seldom is one constant.
fn takes_likelier(fitting: &Fitting<'_>, fit: &Fit) -> bool {
    let bristles = fit.body.arm.dry_terms.bristles.is_some();
    fitting.laws == Laws::Likelier || (bristles && fitting.laws != Laws::AsStarted)
}

/// Whether every term of friction's law stands as many deviations from zero as make it likelier than none, now that
/// residuals may belong together.
pub(super) fn terms_stand_out(fitting: &Fitting<'_>, fit: &Fit) -> bool {
    let covariance = fitting.covariances(fit).larger();
    let share = |p: Parameter| {
        let at = fit.free.iter().position(|q| *q == p)?;
        Some(p.of(&fit.body.arm) / deviation(&covariance, at))
    };
    let stands = |parts: &[Parameter]| {
        let all: Vec<f64> = parts.iter().filter_map(|p| share(*p)).collect();
        all.is_empty() || all.iter().map(|d| d * d).sum::<f64>() > EVEN * EVEN
    };
    let ripples = 0..fit.body.arm.dry_terms.ripples.len();
    let ripple = |i: usize| [Parameter::RippleCosine(i), Parameter::RippleSine(i)];
    stands(&[Parameter::NearRest]) && ripples.map(ripple).all(|r| stands(&r))
}

/// Takes damping against the frame for dampers at the tips' points where these leave less than a damper
/// for each mode: single ones of both kinds can hardly be told apart, and all of them can. Alone where that
/// leaves hardly more than with damping within the beam beside them: each mode damped against the frame by
/// itself is not what dampers at points do, and damping within makes up for some of that.
pub(super) fn dampers_at_points(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    let grounded = |p: &Parameter| matches!(p, Parameter::DampingGrounded(_));
    let within = |p: &Parameter| matches!(p, Parameter::DampingWithin(_));
    let modes = fit.body.arm.modes.len();
    let possible = fit.body.arm.shapes.len() == modes && fit.free.iter().any(grounded);
    if !possible {
        return;
    }
    let mut other = fit.clone();
    other.free.retain(|p| !grounded(p));
    let arm = &mut other.body.arm;
    let mean = arm.modes.iter().map(|m| m.grounded_per_s).sum::<f64>() / modes as f64;
    arm.modes.iter_mut().for_each(|m| m.grounded_per_s = 0.0);
    arm.at_points_per_s = vec![mean.max(0.0); modes];
    let points = (0..modes).map(Parameter::DampingAtPoint);
    other.free.extend(points.filter(|p| !fit.free.contains(p)));
    let mut alone = other.clone();
    let noise = fit.noise.clone();
    let mut take = |mut other: Fit| {
        fitting.search(&mut other, report);
        if price(fitting, &other, &noise) < price(fitting, fit, &noise) {
            *fit = other;
        }
    };
    take(other);
    if alone.free.extract_if(.., |p| within(p)).count() > 0 {
        alone.body.arm.modes.iter_mut().for_each(|m| m.within_per_s = 0.0);
        take(alone);
    }
}

/// Cost of a fit where the noise is `noise`, and what its coordinates are worth: with as many more a fit that
/// costs as much is as likely as without.
pub(super) fn price(fitting: &Fitting<'_>, fit: &Fit, noise: &[SensorNoise]) -> f64 {
    fitting.cost(fit, noise) + EVEN * EVEN * fit.coordinates() as f64
}

/// Lets the modes go each its own way where point masses at the tips leave more than noise.
pub(super) fn relax(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    // Before a search has ended anything promises to help.
    let ended = report.stages.last().is_some_and(|s| s.stop != Stop::StepsUsedUp);
    if fit.body.masses.is_none() || !ended {
        return;
    }
    let free = Fit { body: Body::free(fit.body.arm.clone()), ..fit.clone() };
    let promised = |fit: &Fit| Promised::of(&fitting.point(fit, &fit.free).sums, fit.coordinates());
    if promised(&free).share - promised(fit).share > RIGID_SHARE {
        *fit = free;
        fitting.search(fit, report);
    }
}

/// Takes the beam for point masses at the tips where that leaves no more than modes that go each its own
/// way.
pub(super) fn tighten(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    let body = Body::of_masses(fitting.campaign, fit.body.arm.clone());
    if fit.body.masses.is_some() || body.masses.is_none() {
        return;
    }
    let mut tight = Fit { body, ..fit.clone() };
    fitting.search(&mut tight, report);
    if fitting.cost(&tight, &fit.noise) <= fitting.cost(fit, &fit.noise) * (1.0 + RIGID_SHARE) {
        *fit = tight;
    }
}

/// What one step of a search with each group beside the free parameters promises: score tests, all
/// from one replay.
pub(super) fn promises(fitting: &Fitting<'_>, fit: &Fit) -> Vec<Vec<Extension>> {
    scores(fitting, fit, &candidates(fitting, fit))
}

/// The same of some groups of one's own choice.
pub(super) fn scores(
    fitting: &Fitting<'_>,
    fit: &Fit,
    groups: &[Vec<Parameter>],
) -> Vec<Vec<Extension>> {
    all_scores(fitting, fit, groups).1.into_iter().map(|promise| promise.group).collect()
}

/// Share of the cost that a group takes.
pub(super) fn share(group: &[Extension]) -> f64 {
    group.first().map_or(0.0, |e| e.share)
}

/// What a group of parameters promises.
pub(super) struct Promise {
    pub(super) group: Vec<Extension>,
    /// Square of how many deviations all of the group together stand from zero, `vᵀ·C⁻¹·v`.
    together: f64,
    /// Change of the coordinates that are free without it, beside the change without it.
    pub(super) moved: DVector<f64>,
    /// The same by each of the group, per unit.
    pub(super) slopes: DMatrix<f64>,
    /// What the samples know of the group, the inverse of its covariance.
    information: DMatrix<f64>,
}

impl Promise {
    fn share(&self) -> f64 {
        share(&self.group)
    }

    /// Whether the group is there, though each of it may be nothing beside the others: dampers of several modes say.
    fn stands_together(&self) -> bool {
        self.together > DEVIATIONS * DEVIATIONS * self.group.len() as f64
    }

    /// The most that a parameter of the group stands from zero, in its deviations.
    pub(super) fn deviations(&self) -> f64 {
        let of = |e: &Extension| if e.std > 0.0 { (e.value / e.std).abs() } else { 0.0 };
        self.group.iter().map(of).fold(0.0, f64::max)
    }

    /// How likely `other` values are beside none, both held for as likely beforehand.
    pub(super) fn instead(&self, other: &DVector<f64>) -> f64 {
        let values = DVector::from_iterator(self.group.len(), self.group.iter().map(|e| e.value));
        let off = |v: &DVector<f64>| v.dot(&(&self.information * v));
        1.0 / (1.0 + (0.5 * (off(&(other - &values)) - off(&values))).exp())
    }

    /// How likely the group is to be there: `1/(1 + exp((9 − d²)/2))`. The likelihoods' ratio is
    /// exp(d²/2), and beforehand a group is held for as rare as lets d = 3 decide nothing.
    pub(super) fn likelihood(&self) -> f64 {
        1.0 / (1.0 + (0.5 * (EVEN * EVEN - self.deviations().powi(2))).exp())
    }
}

/// Sums by what is free, and what each group promises beside: from one replay.
pub(super) fn all_scores(
    fitting: &Fitting<'_>,
    fit: &Fit,
    groups: &[Vec<Parameter>],
) -> (Vec<WindowSums>, Vec<Promise>) {
    let free = fit.coordinates();
    let all: Vec<Parameter> = fit.free.iter().chain(groups.iter().flatten()).copied().collect();
    let point = fitting.point(fit, &all);
    let first_of_windows = fit.body.coordinates(&all).len();
    let own: Vec<usize> = (0..free).collect();
    let without: Vec<WindowSums> =
        point.sums.iter().map(|s| s.of(&own, first_of_windows)).collect();
    let alone = Promised::of(&without, free);
    let of_group = |(i, group): (usize, &Vec<Parameter>)| {
        let first = free + groups[..i].iter().map(Vec::len).sum::<usize>();
        let kept: Vec<usize> = (0..free).chain(first..first + group.len()).collect();
        let sums: Vec<WindowSums> =
            point.sums.iter().map(|s| s.of(&kept, first_of_windows)).collect();
        score(&sums, free, group, &alone)
    };
    let found = groups.par_iter().with_max_len(1).enumerate().map(of_group).collect();
    (without, found)
}

/// A kind of dampers of which those of another kind leave nothing goes, as a whole: one damper of a
/// kind stands for the others where they cannot be told apart. Not where the others cannot do without it.
pub(super) fn drop_dampers(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    let kinds: [fn(&Parameter) -> bool; 3] = [
        |p| matches!(p, Parameter::DampingWithin(_)),
        |p| matches!(p, Parameter::DampingGrounded(_)),
        |p| matches!(p, Parameter::DampingAtPoint(_)),
    ];
    if kinds.iter().filter(|kind| fit.free.iter().any(kind)).count() < 2 {
        return;
    }
    let covariance = fitting.covariances(fit).larger();
    let nothing = |kind: &fn(&Parameter) -> bool| {
        let mut own = fit.free.iter().enumerate().filter(|(_, p)| kind(p));
        own.all(|(i, p)| p.of(&fit.body.arm) < THERE * deviation(&covariance, i))
    };
    let Some(gone) = kinds.iter().find(|kind| fit.free.iter().any(kind) && nothing(kind)) else {
        return;
    };
    let mut without = fit.clone();
    let dropped: Vec<Parameter> = without.free.extract_if(.., |p| gone(p)).collect();
    for p in &dropped {
        p.set(&mut without.body.arm, 0.0);
    }
    // What is left may have been less than none to make up for them: a replay would run away.
    for p in without.free.iter().filter(|p| kinds.iter().any(|kind| kind(p))) {
        let least = p.of(&without.body.arm).max(0.0);
        p.set(&mut without.body.arm, least);
    }
    fitting.search(&mut without, report);
    if price(fitting, &without, &fit.noise) < price(fitting, fit, &fit.noise) {
        *fit = without;
    }
}

/// Lags of tips that are not there for certain go again: what is called for before the arm is found need not be after.
pub(super) fn drop_tip_lags(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    let covariance = fitting.covariances(fit).larger();
    let is_nothing = |(i, p): (usize, &Parameter)| {
        let lag = matches!(p, Parameter::TipLag(_));
        let stands = p.of(&fit.body.arm).abs() > DEVIATIONS * deviation(&covariance, i);
        (lag && !stands).then_some(*p)
    };
    let gone: Vec<Parameter> = fit.free.iter().enumerate().filter_map(is_nothing).collect();
    if gone.is_empty() {
        return;
    }
    fit.free.retain(|p| !gone.contains(p));
    for p in &gone {
        p.set(&mut fit.body.arm, 0.0);
    }
    report.added.retain(|e| !gone.contains(&e.parameter));
    fitting.search(fit, report);
}

/// Groups of parameters that may be added to the free ones, each as a whole. Tips may be late where more than the
/// sensors' noise is left.
pub(super) fn candidates(fitting: &Fitting<'_>, fit: &Fit) -> Vec<Vec<Parameter>> {
    let arm = &fit.body.arm;
    let modes = 0..arm.modes.len();
    let mut groups = vec![vec![Parameter::CommandLag], vec![Parameter::ViscousDifference]];
    groups.push(modes.clone().map(Parameter::DampingWithin).collect());
    groups.push(if arm.at_points_per_s.is_empty() {
        modes.map(Parameter::DampingGrounded).collect()
    } else {
        modes.map(Parameter::DampingAtPoint).collect()
    });
    if fitting.beyond_noise(fit) >= BEYOND_NOISE {
        let tips = fitting.campaign.channels.tips.iter().enumerate();
        let shows = tips.filter(|(_, tip)| tip.quantity != TipQuantity::Acceleration);
        groups.push(shows.map(|(i, _)| Parameter::TipLag(i)).collect());
    }
    for group in &mut groups {
        group.retain(|p| !fit.free.contains(p));
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// One step of a search in all coordinates.
struct Promised {
    step: DVector<f64>,
    /// Of the normal matrix.
    inverse: DMatrix<f64>,
    /// Share of the cost that it promises to take.
    share: f64,
}

impl Promised {
    /// In the first `shared` coordinates.
    fn of(sums: &[WindowSums], shared: usize) -> Self {
        let (normal, right) = normal_equations(sums, shared);
        let inverse = inverse(&normal);
        let step = &inverse * &right;
        let share = right.dot(&step) / sums.iter().map(|s| s.cost).sum::<f64>();
        Self { step, inverse, share }
    }
}

/// The step that a search would make in the parameters of `group`, which follow `before` others that
/// promise `alone` by themselves.
fn score(sums: &[WindowSums], before: usize, group: &[Parameter], alone: &Promised) -> Promise {
    let shared = before + group.len();
    let Promised { step, share, inverse: known } = Promised::of(sums, shared);
    let covariance = Covariances::at(sums, shared).larger();
    let share = share - alone.share;
    let figure = |(k, parameter): (usize, &Parameter)| {
        let (value, std) = (step[before + k], deviation(&covariance, before + k));
        Extension { parameter: *parameter, value, std, share, added: false }
    };
    let finite = |e: &Extension| e.value.is_finite() && e.share.is_finite();
    let values = step.rows(before, group.len());
    let own = covariance.view((before, before), (group.len(), group.len()));
    let information = inverse(&own.into_owned());
    let beside = known.view((0, before), (before, group.len()));
    let of_group = known.view((before, before), (group.len(), group.len())).into_owned();
    Promise {
        together: values.dot(&(&information * values)),
        slopes: beside * inverse(&of_group),
        information,
        group: group.iter().enumerate().map(figure).filter(finite).collect(),
        moved: step.rows(0, before) - &alone.step,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two dampers whose readings are nearly the same; what they have in common is ten deviations from zero, and each
    /// less than one, since the other may stand for it.
    #[test]
    fn twins_stand_together() {
        let (alike, shown) = (0.99, 10.0);
        let rows = [1.0, alike, shown, alike, 1.0, shown, shown, shown, 1e4];
        let gram = DMatrix::from_row_slice(3, 3, &rows);
        let sums = WindowSums {
            gram,
            blocks: Vec::new(),
            squares: vec![1e4],
            readings: vec![10_000],
            cost: 1e4,
            slopes: 1.0,
            curvatures: 1.0,
            samples: 10_000,
        };
        let sums = [sums];
        let alone = Promised::of(&sums, 0);
        let found = |group: &[Parameter]| {
            let kept: Vec<usize> = (0..group.len()).collect();
            score(&sums.each_ref().map(|s| s.of(&kept, 2)), 0, group, &alone)
        };
        let twins = found(&[Parameter::DampingAtPoint(0), Parameter::DampingAtPoint(1)]);
        assert!(twins.deviations() < 1.0, "{}", twins.deviations());
        assert!((twins.together - 100.0 * 2.0 / (1.0 + alike)).abs() < 0.1, "{}", twins.together);
        assert!(twins.stands_together());
        let one = found(&[Parameter::DampingAtPoint(0)]);
        assert!((one.deviations() - shown).abs() < 0.01 && one.stands_together());
    }
}
