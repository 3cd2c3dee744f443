//! The choice of the simplest friction law that the data do not reject.

use nalgebra::DVector;
use rayon::prelude::*;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::described::Described;
use crate::identify::methods::friction_law::held::Held;
use crate::identify::methods::friction_law::law_rows::LawRows;
use crate::identify::methods::friction_law::law_term::{Column, LawTerm};
use crate::identify::methods::friction_law::rows::{Cut, Sampled, fixed};
use crate::identify::methods::friction_law::thresholds::{
    AFTER_TRAVEL_FALLS_TO, LAG_FALLS_TO, LAG_KNOWN, TERMS_MOST,
};
use crate::identify::methods::friction_law::{LawFit, ripple};
use crate::identify::methods::regression::{DRY, Fitted, MotorColumns, Solution, Term, Terms};
use crate::identify::thresholds::{CLEARLY_PRESENT, PRESENT, RESIDUAL_FALLS_TO, SIGN_SHOWN};
use crate::record::{Campaign, Run};

/// A term that was tried for the friction law, in addition to the terms accepted before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawCandidate {
    /// The term.
    pub term: LawTerm,
    /// Number of terms that the law had before.
    pub beside: usize,
    /// Amplitude of the term; for a ripple, that of its cosine and sine together.
    pub amplitude: Estimate,
    /// Residual with the term divided by the residual without it \[1\].
    pub residual_ratio: f64,
    /// Improvement of the prediction of slip phases that were left out of the fit, divided by its standard error \[1\].
    pub paired: f64,
    /// The same ratio for predictions of whole kinds of motion (by direction, speed, and side of the travel) that were
    /// left out of the fit \[1\].
    pub stretch_ratio: f64,
    /// Friction at rest with this term, in the direction that has less.
    pub at_rest: f64,
    /// Standard error of that friction.
    pub at_rest_std: f64,
    /// Whether the term was accepted.
    pub taken: bool,
}

/// What was chosen.
pub(super) struct Choice {
    pub(super) fit: LawFit,
    pub(super) candidates: Vec<LawCandidate>,
    pub(super) simplest: f64,
    pub(super) residual: f64,
    /// Columns and terms of what is not friction by speed: a lag and a ripple, for the curve.
    pub(super) beside: (Vec<Column>, Vec<Term>),
    /// All of it, for other windows.
    pub(super) described: Described,
}

/// One candidate, as columns and terms of a regression.
pub(super) struct Tried {
    pub(super) term: LawTerm,
    pub(super) terms: Vec<Term>,
    /// What was found beside the terms that are taken.
    estimates: Option<Estimates>,
}

/// A candidate with its cost on phases left out. Its `taken` is before the rule that a lag waits for the law by speed.
type Estimates = (f64, LawCandidate);

impl Tried {
    fn new(term: LawTerm, terms: Vec<Term>) -> Self {
        Self { term, terms, estimates: None }
    }
}

/// Adds one term after another while some are called for.
///
/// Of the terms that do better on phases left out, on kinds of stretches left out and in what is left,
/// and with which friction at rest stays positive, the one that does best on phases left out is taken.
/// A test by standard errors alone would take them all: in a log of seconds everything is significant.
pub(super) fn choose(sampled: &Sampled<'_>, cut: &Cut, fastest: f64) -> Option<Choice> {
    let mut search = LawSearch::new(sampled, cut, fastest)?;
    let simplest = search.solution.relative_residual;
    while search.taken.len() < TERMS_MOST && search.add_best() {}
    search.refine_near_rest();
    search.settled = true;
    // A ripple and a lag may stand in for each other: both are open at once.
    while search.taken.len() < TERMS_MOST {
        search.offer_ripple();
        if !search.add_best() {
            break;
        }
        search.refine_ripple();
    }
    let fit = search.fit();
    let beside = search.beside_friction();
    let residual = search.solution.relative_residual;
    let described =
        Described { columns: search.columns, terms: search.terms, value: search.solution.value };
    Some(Choice { fit, candidates: search.candidates, simplest, residual, beside, described })
}

pub(super) struct LawSearch<'a> {
    pub(super) sampled: &'a Sampled<'a>,
    pub(super) columns: Vec<Column>,
    pub(super) rows: LawRows,
    pub(super) terms: Vec<Term>,
    pub(super) solution: Solution,
    open: Vec<Tried>,
    pub(super) taken: Vec<Tried>,
    candidates: Vec<LawCandidate>,
    /// Whether friction's law by speed is found.
    settled: bool,
    /// Fastest speed of the windows.
    pub(super) fastest: f64,
    /// Of the logs.
    largest_torque: f64,
}

impl<'a> LawSearch<'a> {
    fn new(sampled: &'a Sampled<'a>, cut: &Cut, fastest: f64) -> Option<Self> {
        let first = fixed(sampled.campaign);
        let mut columns = Vec::new();
        let mut open = Vec::new();
        for term in LawTerm::offered(fastest, sampled.after() <= 0.0, sampled.load) {
            let at = first + columns.len();
            columns.extend(term.columns());
            let terms = match term {
                LawTerm::ViscousByDirection => vec![Term::Signed(1)],
                LawTerm::CommandLag => vec![Term::Plain(at)],
                _ => (at..first + columns.len()).map(Term::Signed).collect(),
            };
            open.push(Tried::new(term, terms));
        }
        let rows = LawRows::of(sampled, &columns, &[], cut);
        let terms = MotorColumns::of(sampled.campaign).terms(Term::Signed(DRY));
        let solution = rows.solved(&terms)?;
        let (taken, candidates) = (Vec::new(), Vec::new());
        Some(Self {
            sampled,
            columns,
            rows,
            terms,
            solution,
            open,
            taken,
            candidates,
            settled: false,
            fastest,
            largest_torque: largest_torque(sampled.campaign),
        })
    }

    /// Tries every open term beside those taken and takes the best that is called for.
    fn add_best(&mut self) -> bool {
        let Some(before) = Held::of(&self.rows, &self.terms) else { return false };
        let mut best: Option<(f64, usize, LawCandidate)> = None;
        let mut shown: Vec<(f64, LawCandidate)> = Vec::new();
        let known = |tried: &Tried| tried.estimates.or_else(|| self.estimates(&before, tried));
        let estimates: Vec<_> = self.open.par_iter().map(known).collect();
        for (i, estimates) in estimates.into_iter().enumerate() {
            self.open[i].estimates = estimates;
            let Some((cost, mut candidate)) = estimates else { continue };
            candidate.taken &= self.settled || candidate.term != LawTerm::CommandLag;
            if candidate.taken && best.as_ref().is_none_or(|b| cost < b.0) {
                best = Some((cost, i, candidate));
            }
            // Of terms of a kind only the best is worth telling.
            let same = |c: &(f64, LawCandidate)| c.1.term.name() == candidate.term.name();
            match shown.iter_mut().find(|c| same(c)) {
                Some(other) if other.0 <= cost => {}
                Some(other) => *other = (cost, candidate),
                None => shown.push((cost, candidate)),
            }
        }
        if let Some((_, _, best)) = &best {
            for (_, c) in &mut shown {
                if c.term.name() == best.term.name() {
                    *c = *best;
                }
                c.taken = c.term == best.term;
            }
        }
        // Tried again beside the same terms: the last word counts.
        let beside = self.taken.len();
        self.candidates.retain(|c| c.beside != beside);
        self.candidates.extend(shown.into_iter().map(|c| c.1));
        let Some((_, i, _)) = best else { return false };
        let taken = self.open.remove(i);
        self.terms.extend(&taken.terms);
        self.forget_estimates();
        // Root and near rest are two shapes of one thing.
        let by_speed = |t: &LawTerm| *t == LawTerm::Root || t.is_near_rest();
        let gone =
            |t: &LawTerm| t.name() == taken.term.name() || (by_speed(t) && by_speed(&taken.term));
        self.open.retain(|t| !gone(&t.term));
        self.taken.push(taken);
        match self.rows.solved(&self.terms) {
            Some(solution) => self.solution = solution,
            None => return false,
        }
        true
    }

    /// To be called where the terms taken change.
    pub(super) fn forget_estimates(&mut self) {
        self.open.iter_mut().for_each(|tried| tried.estimates = None);
    }

    /// Cost on phases left out, and all estimates; `taken` says whether it may be.
    fn estimates(&self, before: &Held, tried: &Tried) -> Option<Estimates> {
        let mut terms = self.terms.clone();
        let first = terms.len();
        terms.extend(&tried.terms);
        let solution = self.rows.solved(&terms)?;
        if solution.inseparable[first] {
            return None;
        }
        let held = Held::of(&self.rows, &terms)?;
        let residual_ratio = solution.relative_residual / self.solution.relative_residual;
        let paired = before.paired(&held);
        let stretch_ratio = (held.stretches / before.stretches).sqrt();
        let amplitude = amplitude(&solution, first, tried.terms.len());
        let (at_rest, at_rest_std) = self.at_rest(&solution, tried.term, first);
        let (least, allowed) = match tried.term {
            LawTerm::CommandLag => (LAG_FALLS_TO, self.lag_allowed(&late(amplitude))),
            term if term.is_near_rest() && self.sampled.after() > 0.0 => {
                (AFTER_TRAVEL_FALLS_TO, true)
            }
            _ => (RESIDUAL_FALLS_TO, true),
        };
        let part_of_coulomb = tried.term.is_near_rest()
            || matches!(tried.term, LawTerm::Root | LawTerm::WithLoad { .. });
        let allowed = allowed && (!part_of_coulomb || self.is_within_data(&solution));
        let taken = paired > PRESENT
            && allowed
            && amplitude.value.abs() > CLEARLY_PRESENT * amplitude.std
            && self.sampled.resolves(tried.term)
            && residual_ratio < least
            && stretch_ratio < 1.0
            && at_rest > -SIGN_SHOWN * at_rest_std;
        let (term, beside) = (tried.term, self.taken.len());
        let candidate = LawCandidate {
            term,
            beside,
            amplitude: if term == LawTerm::CommandLag { late(amplitude) } else { amplitude },
            residual_ratio,
            paired,
            stretch_ratio,
            at_rest,
            at_rest_std,
            taken,
        };
        Some((held.phases(), candidate))
    }

    /// Whether Coulomb and viscous friction are of the size that the logs contain: of a curve that the speeds driven
    /// show a part of, one extrapolates to any Coulomb friction and a slope of either sign.
    pub(super) fn is_within_data(&self, solution: &Solution) -> bool {
        let (coulomb, coulomb_std) = known(solution, &coulomb_weight(solution));
        let (viscous, viscous_std) = (solution.value[1], solution.covariance[(1, 1)].sqrt());
        coulomb > -SIGN_SHOWN * coulomb_std
            && solution.value[2] < self.largest_torque
            && viscous > -SIGN_SHOWN * viscous_std
    }

    /// Friction at rest in the direction where it is less, with its standard error.
    fn at_rest(&self, solution: &Solution, tried: LawTerm, first: usize) -> (f64, f64) {
        let mut weight = coulomb_weight(solution);
        let mut at = self.first_added();
        for t in &self.taken {
            weight[at] = f64::from(t.term.is_near_rest());
            at += t.terms.len();
        }
        weight[first] = f64::from(tried.is_near_rest());
        known(solution, &weight)
    }

    /// Friction at rest, its mean of both directions, under the terms taken; `None` without one near rest.
    fn mean_at_rest(&self) -> Option<Estimate> {
        let mut weight = DVector::zeros(self.solution.value.len());
        let mut at = self.first_added();
        for t in &self.taken {
            weight[at] = f64::from(t.term.is_near_rest());
            at += t.terms.len();
        }
        let any = weight.amax() > 0.0;
        weight[2] = 1.0;
        let (value, std) = known(&self.solution, &weight);
        any.then_some(Estimate { value, std })
    }

    fn lag_allowed(&self, lag: &Estimate) -> bool {
        let runs = &self.sampled.campaign.runs;
        let sample_s = runs.iter().map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        lag.value > 0.0 && lag.std < LAG_KNOWN * sample_s
    }

    /// Place of the first term beyond those of the motor's equation.
    fn first_added(&self) -> usize {
        MotorColumns::of(self.sampled.campaign).terms(Term::Signed(DRY)).len()
    }

    /// Adds the strongest ripple of what is left to what may be tried, unless one is taken.
    fn offer_ripple(&mut self) {
        if self.taken.iter().any(|t| t.term.is_ripple()) {
            return;
        }
        let left = self.rows.left(&self.terms, &self.solution.value);
        let Some(k) = ripple::strongest(self.sampled, &left) else { return };
        let at = fixed(self.sampled.campaign) + self.columns.len();
        let term = LawTerm::Ripple { per_angle: k };
        self.columns.extend(term.columns());
        self.rows = self.rows.with_columns(self.sampled, &term.columns());
        let terms = vec![Term::Signed(at), Term::Signed(at + 1)];
        self.open.push(Tried::new(term, terms));
    }

    fn fit(&self) -> LawFit {
        let s = &self.solution;
        let columns = MotorColumns::of(self.sampled.campaign);
        let unchanged = vec![0.0; s.value.len()];
        let fitted =
            Fitted { solution: s, change: &unchanged, columns: &columns, difference: None };
        let found = fitted.estimates(&self.sampled.campaign.channels);
        let mut at = self.first_added();
        let mut terms = Vec::new();
        for t in &self.taken {
            let found = (at..at + t.terms.len()).map(|i| amplitude(s, i, 1));
            let found = found.map(|e| if t.term == LawTerm::CommandLag { late(e) } else { e });
            let mut found: Vec<Estimate> = found.collect();
            let mut term = t.term;
            if let (LawTerm::Ripple { per_angle }, [_, _, turned]) = (&mut term, &mut found[..]) {
                *per_angle += turned.value;
                turned.value = *per_angle;
            }
            terms.push((term, found));
            at += t.terms.len();
        }
        if self.sampled.after() > 0.0 {
            terms.push((LawTerm::AfterTravel { travel: self.sampled.after() }, Vec::new()));
        }
        LawFit {
            terms,
            inertia: found.inertia,
            viscous: found.friction.viscous,
            coulomb: found.friction.coulomb,
            at_rest: self.mean_at_rest(),
            offset: found.friction.offset,
            forward: found.friction.forward,
            backward: found.friction.backward,
            coupling: found.coupling_by_tip,
            total_coupling: found.coupling,
            gravity: found.gravity,
            joint: Terms::of(&fitted),
        }
    }

    /// Columns and terms that were taken and are no friction by speed.
    fn beside_friction(&self) -> (Vec<Column>, Vec<Term>) {
        let first = fixed(self.sampled.campaign);
        let beside = |t: &&Tried| !t.term.is_by_speed();
        let (mut columns, mut terms) = (Vec::new(), Vec::new());
        for term in self.taken.iter().filter(beside).flat_map(|t| &t.terms) {
            let at = first + columns.len();
            columns.push(self.columns[term.column() - first]);
            terms.push(if matches!(term, Term::Signed(_)) {
                Term::Signed(at)
            } else {
                Term::Plain(at)
            });
        }
        (columns, terms)
    }
}

/// Largest torque (or force) of the commands.
fn largest_torque(campaign: &Campaign) -> f64 {
    let commands = campaign.runs.iter().flat_map(Run::command);
    commands.fold(0.0, |most: f64, u| most.max(u.abs()))
        * campaign.channels.command.torque_per_unit().abs()
}

/// `∫wτ(t) = ∫w·(equation) − Δ∫ẇτ` for τ that acts Δ later.
fn late(e: Estimate) -> Estimate {
    Estimate { value: -e.value, std: e.std }
}

/// The length of `count` amplitudes from `first` on, with its standard error.
fn amplitude(s: &Solution, first: usize, count: usize) -> Estimate {
    let value = s.value.rows(first, count);
    if count == 1 {
        let std = s.covariance[(first, first)].max(0.0).sqrt();
        return Estimate { value: value[0], std };
    }
    let size = value.norm();
    let block = s.covariance.view((first, first), (count, count));
    let direction = value / size.max(f64::MIN_POSITIVE);
    Estimate { value: size, std: direction.dot(&(block * &direction)).max(0.0).sqrt() }
}

/// What of each estimate Coulomb friction has in the direction where it is less.
fn coulomb_weight(solution: &Solution) -> DVector<f64> {
    let mut weight = DVector::zeros(solution.value.len());
    weight[2] = 1.0;
    weight[3] = -solution.value[3].signum();
    weight
}

/// A weighted sum of the estimates, with its standard error.
fn known(solution: &Solution, weight: &DVector<f64>) -> (f64, f64) {
    let variance = weight.dot(&(&solution.covariance * weight));
    (weight.dot(&solution.value), variance.max(0.0).sqrt())
}
