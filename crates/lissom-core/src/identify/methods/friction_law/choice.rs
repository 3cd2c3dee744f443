//! The choice of the terms that a model of the torque has beyond the line, by what it predicts.
//!
//! Candidates are complete models: the line, and the line with further terms, singly and in pairs. A term is adopted if the
//! model with it predicts blocks that were left out of the fit better than the model without it, by two standard errors of
//! the difference, and whole kinds of motion that were left out better, too. A period or a speed is chosen in one half of the
//! blocks and judged in the other.

use nalgebra::DVector;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::blocks::{BlockRows, Gram, Regressor};
use crate::identify::methods::friction_law::candidates::{
    Candidate, Family, MissingKind, ModelTerm, families, law_regressors,
};
use crate::identify::methods::friction_law::lag::AngleLag;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::prediction::{ByBlock, Divided, Improvement, LeftOut};
use crate::identify::methods::friction_law::projection::Speeds;
use crate::identify::methods::friction_law::ripple;
use crate::identify::methods::friction_law::rows::{Cut, Sampled};
use crate::identify::methods::friction_law::thresholds::{
    LAG_MOST_S, LAG_SETTLED, MAY_BE_PRESENT, NEGLIGIBLE_TERM, TERMS_MOST,
};
use crate::identify::methods::friction_law::unadopted::{MissingTerm, Moved};
use crate::identify::methods::regression::{
    Fitted, MotorColumns, PLACE_COULOMB, PLACE_INERTIA, PLACE_OFFSET, PLACE_VISCOUS, Solution,
    Terms,
};
use crate::identify::thresholds::{LAG_HALF_SAMPLE, SIGN_SHOWN};
use crate::record::{Campaign, Hold, Run};

/// A ripple has one period in both halves if its frequencies there differ by less than this many steps of the search.
const SAME_RIPPLE: f64 = 2.0;
/// A scanned speed or frequency is improved so many times by its derivative, or until it moves by less than this share.
const SCANNED_ROUNDS: usize = 6;
const SCANNED_SETTLED: f64 = 1e-6;
/// A speed near rest is moved by this factor at most, about the distance of neighbours that are tried.
const NEAR_REST_APART: f64 = 1.8;

/// A term that was tried, in addition to the terms accepted before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawCandidate {
    /// The term.
    pub term: ModelTerm,
    /// Number of terms that the model had before.
    pub beside: usize,
    /// Amplitude of the term; for a term with several numbers, their length.
    pub amplitude: Estimate,
    /// Squared residual that the term saves in blocks that were left out of the fit, as a share of that without it \[1\];
    /// negative if it predicts worse.
    pub saved: f64,
    /// The same divided by its standard error \[1\].
    pub standard_errors: f64,
    /// Whether kinds of motion that were left out (by direction, speed, side of the travel, and run) are predicted better.
    pub across_kinds: bool,
    /// Whether the term was adopted.
    pub taken: bool,
}

/// Chooses the terms of the model; also the relative residual of the line. `None` if the rows do not give the line.
///
/// The commands of `lagged` rows were made late already: the rest of the lag is estimated with the line.
pub(super) fn choose<'a>(
    sampled: &'a Sampled<'a>,
    cut: &Cut,
    fastest: f64,
    lagged: bool,
) -> Option<(Search<'a>, f64)> {
    let mut search = Search::new(sampled, cut, fastest)?;
    let line_residual = search.solution.relative_residual;
    if lagged {
        search.keep_lag();
    }
    for _ in 0..TERMS_MOST {
        if search.taken.len() >= TERMS_MOST || !search.adopt_best() {
            break;
        }
        search.drop_needless();
    }
    search.drop_needless_alone();
    Some((search, line_residual))
}

/// Candidates of one family with their columns for the fit of each half, and for that of all rows.
struct Offer {
    halves: [Candidate; 2],
    all: Candidate,
}

/// An offer with what speaks for it.
struct Judged {
    offers: Vec<Offer>,
    improvement: Improvement,
    solution: Solution,
    across_kinds: bool,
    accepted: bool,
}

pub(super) struct Search<'a> {
    pub(super) sampled: &'a Sampled<'a>,
    pub(super) rows: BlockRows,
    divided: Divided,
    families: Vec<Family>,
    pub(super) taken: Vec<Candidate>,
    pub(super) candidates: Vec<LawCandidate>,
    pub(super) solution: Solution,
    /// Number of columns of the line.
    line: usize,
    largest_torque: f64,
    /// Fastest speed, without outliers.
    fastest: f64,
    /// Shortest sample time.
    sample_s: f64,
}

impl<'a> Search<'a> {
    fn new(sampled: &'a Sampled<'a>, cut: &Cut, fastest: f64) -> Option<Self> {
        let mut rows = BlockRows::of(sampled, cut);
        let line = rows.width();
        let (families, regressors) = families(sampled, fastest, line);
        rows.add(sampled, &regressors, &[]);
        let divided = Divided::of(&rows);
        let solution = rows.solved(&(0..line).collect::<Vec<_>>())?;
        let largest_torque = largest_torque(sampled.campaign);
        let runs = sampled.campaign.runs.iter();
        let sample_s = runs.map(Run::sample_time_s).fold(f64::INFINITY, f64::min);
        let (taken, candidates) = (Vec::new(), Vec::new());
        Some(Self {
            sampled,
            rows,
            divided,
            families,
            taken,
            candidates,
            solution,
            line,
            largest_torque,
            fastest,
            sample_s,
        })
    }

    /// Takes the lag of a command that was made late already: what is left of it is estimated with the rest.
    fn keep_lag(&mut self) {
        if let Some(place) = self.families.iter().position(|f| is_lag(&f[0])) {
            let lag = self.families.remove(place).remove(0);
            self.taken.push(lag);
            if let Some(solution) = self.rows.solved(&self.columns()) {
                self.solution = solution;
            }
        }
    }

    /// Columns of the line and of the terms taken.
    pub(super) fn columns(&self) -> Vec<usize> {
        self.with(&[])
    }

    fn with(&self, further: &[&Candidate]) -> Vec<usize> {
        let taken = self.taken.iter().chain(further.iter().copied());
        (0..self.line).chain(taken.flat_map(|c| c.columns.iter().copied())).collect()
    }

    /// Tries every open family with the terms taken, then pairs of them, and adopts the best that predicts better.
    fn adopt_best(&mut self) -> bool {
        let Some(before) = self.divided.left_out(&self.columns()) else { return false };
        let width = self.rows.width();
        let mut offers: Vec<Vec<Offer>> = self.open().map(|f| vec![self.offer(f, &[])]).collect();
        offers.extend(self.offer_ripples(&[]));
        let mut judged: Vec<Judged> =
            offers.into_iter().filter_map(|offers| self.judged(offers, &before)).collect();
        self.note(&judged);
        if !judged.iter().any(|j| j.accepted) {
            judged = self.pairs(&before);
        }
        let best = judged
            .into_iter()
            .filter(|j| j.accepted)
            .max_by(|a, b| a.improvement.saved.total_cmp(&b.improvement.saved));
        let Some(best) = best else {
            self.rows.truncate(self.sampled, width);
            return false;
        };
        self.adopt(best, width);
        true
    }

    /// Families of which no term is taken.
    fn open(&self) -> impl Iterator<Item = &Family> {
        let name = |c: &Candidate| c.term.name();
        self.families.iter().filter(move |f| !self.taken.iter().any(|t| name(t) == name(&f[0])))
    }

    /// The member of a family that describes each half best, and all rows, beside further terms.
    fn offer(&self, family: &Family, further: &[&Offer]) -> Offer {
        let best = |sums: &Gram, half: Option<usize>| -> Candidate {
            let beside: Vec<&Candidate> = further.iter().map(|o| o.of(half)).collect();
            let left = |candidate: &Candidate| {
                let columns = self.with(&[&beside[..], &[candidate]].concat());
                sums.values(&columns).map_or(f64::INFINITY, |value| sums.squared(&columns, &value))
            };
            if family.len() == 1 {
                return family[0].clone();
            }
            let left = family.iter().map(|candidate| (left(candidate), candidate));
            let best = left.min_by(|a, b| a.0.total_cmp(&b.0));
            best.map_or_else(|| family[0].clone(), |(_, candidate)| candidate.clone())
        };
        Offer {
            halves: [0, 1].map(|half| best(self.divided.of_half(half), Some(half))),
            all: best(self.divided.total(), None),
        }
    }

    /// Ripples of friction and of torque whose period is the same in both halves, beside further terms; their columns are
    /// added to the rows.
    fn offer_ripples(&mut self, further: &[&Candidate]) -> Vec<Vec<Offer>> {
        let columns = self.with(further);
        let block = self.rows.block_of_windows();
        let blocks = self.rows.blocks;
        let all: Vec<f64> = match self.divided.total().values(&columns) {
            Some(value) => self.rows.left(&columns, &value),
            None => return Vec::new(),
        };
        let mut found = Vec::new();
        for friction in [true, false] {
            let at = |half: Option<usize>| {
                let wanted = |i: usize| half.is_none_or(|h| Divided::half(block[i], blocks) == h);
                match half {
                    None => ripple::strongest(self.sampled, &all, friction, wanted),
                    Some(half) => {
                        let value = self.divided.of_half(half).values(&columns)?;
                        let left = self.rows.left(&columns, &value);
                        ripple::strongest(self.sampled, &left, friction, wanted)
                    }
                }
            };
            let Some([first, second, whole]) = at(Some(0))
                .zip(at(Some(1)))
                .zip(at(None))
                .map(|((first, second), whole)| [first, second, whole])
            else {
                continue;
            };
            let same = SAME_RIPPLE * ripple::step(self.sampled);
            if (first - second).abs() < same && (first - whole).abs() < same {
                found.push((friction, [first, second, whole]));
            }
        }
        let mut offers = Vec::new();
        let mut regressors: Vec<Regressor> = Vec::new();
        let width = self.rows.width();
        for (friction, frequencies) in found {
            let [first, second, whole] = frequencies.map(|per_angle| {
                let term = if friction {
                    LawTerm::Ripple { per_angle }
                } else {
                    LawTerm::TorqueRipple { per_angle }
                };
                let from = width + regressors.len();
                regressors.extend(law_regressors(term));
                Candidate { term: ModelTerm::Law(term), columns: vec![from, from + 1] }
            });
            offers.push(vec![Offer { halves: [first, second], all: whole }]);
        }
        if !regressors.is_empty() {
            self.rows.add(self.sampled, &regressors, &[]);
            self.divided = Divided::of(&self.rows);
        }
        offers
    }

    /// What speaks for the terms of some offers together.
    fn judged(&self, offers: Vec<Offer>, before: &LeftOut) -> Option<Judged> {
        let of = |half: Option<usize>| -> Vec<usize> {
            self.with(&offers.iter().map(|o| o.of(half)).collect::<Vec<_>>())
        };
        let all = of(None);
        let solution = self.rows.solved(&all)?;
        if solution.inseparable[self.line..].iter().any(|lost| *lost) {
            return None;
        }
        let after = self.divided.left_out(&all)?;
        let scanned = offers.iter().any(|o| o.halves[0] != o.all || o.halves[1] != o.all);
        let improvement = if scanned {
            let own = self.columns();
            let without = self.divided.across_halves([&own, &own])?;
            let with = self.divided.across_halves([&of(Some(0)), &of(Some(1))])?;
            Improvement::between(&without, &with)
        } else {
            Improvement::between(&before.by_block, &after.by_block)
        };
        let across_kinds = after.is_better_across_kinds(before);
        let terms: Vec<&Candidate> =
            self.taken.iter().chain(offers.iter().map(|o| &o.all)).collect();
        let accepted = improvement.is_sure && across_kinds && self.is_possible(&solution, &terms);
        Some(Judged { offers, improvement, solution, across_kinds, accepted })
    }

    /// Pairs of open families, none of which predicts better alone: each with a lag or one another.
    fn pairs(&mut self, before: &LeftOut) -> Vec<Judged> {
        let open: Vec<Family> = self.open().cloned().collect();
        let mut judged = Vec::new();
        for (i, one) in open.iter().enumerate() {
            for other in &open[i + 1..] {
                let first = self.offer(one, &[]);
                let second = self.offer(other, &[&first]);
                judged.extend(self.judged(vec![first, second], before));
            }
        }
        if let Some(lag) = open.iter().find(|f| is_lag(&f[0])) {
            let lag = &lag[0];
            for ripples in self.offer_ripples(&[lag]) {
                let first = Offer { halves: [lag.clone(), lag.clone()], all: lag.clone() };
                let pair = std::iter::once(first).chain(ripples).collect();
                judged.extend(self.judged(pair, before));
            }
        }
        for pair in &mut judged {
            pair.accepted = pair.accepted && self.is_each_needed(&pair.offers);
        }
        judged
    }

    /// Whether some terms predict better together than without any one of them.
    fn is_each_needed(&self, offers: &[Offer]) -> bool {
        let further: Vec<&Candidate> = offers.iter().map(|o| &o.all).collect();
        let all: Vec<&Candidate> = self.taken.iter().chain(further.iter().copied()).collect();
        further.iter().all(|one| {
            let without: Vec<&Candidate> = all.iter().copied().filter(|c| c != one).collect();
            self.is_needed(&without, &all)
        })
    }

    /// Keeps the candidates for the result; of those of one name the last word counts.
    fn note(&mut self, judged: &[Judged]) {
        let beside = self.taken.len();
        for j in judged {
            let [offer] = &j.offers[..] else { continue };
            let first = self.columns().len();
            self.candidates.push(LawCandidate {
                term: offer.all.term,
                beside,
                amplitude: amplitude(&j.solution, first, offer.all.columns.len(), offer.all.term),
                saved: j.improvement.saved,
                standard_errors: j.improvement.standard_errors,
                across_kinds: j.across_kinds,
                taken: false,
            });
        }
    }

    /// Takes the terms of an offer; columns of ripples that are not taken go.
    fn adopt(&mut self, best: Judged, width: usize) {
        let beside = self.taken.len();
        let taken: Vec<Candidate> = best.offers.into_iter().map(|o| o.all).collect();
        for candidate in &taken {
            let noted = self.candidates.iter_mut().rev();
            let same = noted.take_while(|c| c.beside == beside).find(|c| c.term == candidate.term);
            if let Some(noted) = same {
                noted.taken = true;
            }
        }
        self.rows.truncate(self.sampled, width);
        for candidate in taken {
            match candidate.term.law().filter(|law| law.scale().is_some()) {
                Some(law) => self.take_scanned(law),
                None => self.taken.push(candidate),
            }
        }
        self.divided = Divided::of(&self.rows);
        if let Some(solution) = self.rows.solved(&self.columns()) {
            self.solution = solution;
        }
    }

    /// Takes a term whose speed or frequency was scanned: moves that to the least residual, and adds a column for what the term
    /// gains with it, so that it is estimated with the rest.
    fn take_scanned(&mut self, term: LawTerm) {
        let first = self.rows.width();
        let start = term.scanned();
        let [least, most] = if let LawTerm::NearRest { .. } = term {
            [start / NEAR_REST_APART, start * NEAR_REST_APART]
        } else {
            let apart = SAME_RIPPLE * ripple::step(self.sampled);
            let longest = ripple::LEAST_PERIODS * 4.0 * ripple::step(self.sampled);
            [(start - apart).max(longest), start + apart]
        };
        let mut now = start;
        let mut taken = None;
        for _ in 0..SCANNED_ROUNDS {
            let term = term.with_scanned(now);
            self.rows.truncate(self.sampled, first);
            let regressors = law_regressors(term);
            self.rows.add(self.sampled, &regressors, &[]);
            let mut columns: Vec<usize> = (first..self.rows.width()).collect();
            let own = Candidate { term: ModelTerm::Law(term), columns: columns.clone() };
            let Some(value) = self.rows.total().values(&self.with(&[&own])) else { break };
            let amplitudes = value.rows(value.len() - columns.len(), columns.len());
            let Some(Regressor::Function(_, acts)) = regressors.first().copied() else { break };
            let gain = Regressor::Function(term.gain(amplitudes.as_slice()), acts);
            self.rows.add(self.sampled, &[gain], &[]);
            columns.push(self.rows.width() - 1);
            let own = Candidate { term: ModelTerm::Law(term), columns };
            let step = self.rows.total().values(&self.with(&[&own])).map(|v| v[v.len() - 1]);
            taken = Some(own);
            let Some(step) = step.filter(|step| step.abs() > SCANNED_SETTLED * now) else { break };
            let next = now + step;
            if !(least..=most).contains(&next) {
                break;
            }
            now = next;
        }
        // The gain's column takes part in the standard errors of a ripple. That of a speed near rest would take up what the
        // speed alone does not: its amplitude is part of no model, and the speed's standard error is that of its steps.
        if let (LawTerm::NearRest { .. }, Some(own)) = (term, &mut taken) {
            own.columns.pop();
            self.rows.truncate(self.sampled, own.columns.last().map_or(first, |last| last + 1));
        }
        self.taken.extend(taken);
    }

    /// Drops terms without which the model predicts as well as with them; the last one was just taken.
    fn drop_needless(&mut self) {
        for i in (0..self.taken.len().saturating_sub(1)).rev() {
            let others = |c: &&Candidate| **c != self.taken[i];
            let all: Vec<&Candidate> = self.taken.iter().collect();
            let without: Vec<&Candidate> = self.taken.iter().filter(others).collect();
            if !is_lag(&self.taken[i]) && !self.is_needed(&without, &all) {
                self.taken.remove(i);
            }
        }
        if let Some(solution) = self.rows.solved(&self.columns()) {
            self.solution = solution;
        }
    }

    /// Drops terms of the law that predict better only beside an effect which the model does not contain.
    fn drop_needless_alone(&mut self) {
        if self.taken.iter().all(|c| c.term.law().is_some()) {
            return;
        }
        for i in (0..self.taken.len()).rev() {
            let laws = || self.taken.iter().filter(|c| c.term.law().is_some());
            let others = |c: &&Candidate| **c != self.taken[i];
            let all: Vec<&Candidate> = laws().collect();
            let without: Vec<&Candidate> = laws().filter(others).collect();
            if without.len() < all.len()
                && !is_lag(&self.taken[i])
                && !self.is_needed(&without, &all)
            {
                self.taken.remove(i);
            }
        }
    }

    /// Whether all of some terms predict better than those without one.
    fn is_needed(&self, without: &[&Candidate], all: &[&Candidate]) -> bool {
        let left_out = |terms: &[&Candidate]| {
            let further = terms.iter().flat_map(|c| c.columns.iter().copied());
            self.divided.left_out(&(0..self.line).chain(further).collect::<Vec<_>>())
        };
        let both = left_out(without).zip(left_out(all));
        both.is_none_or(|(a, b)| Improvement::between(&a.by_block, &b.by_block).is_sure)
    }

    /// Whether a joint may have such a model: friction brakes at rest and at speed, no more than the logs contain, the inertia is
    /// positive, and a lag is not longer than a drive's.
    fn is_possible(&self, solution: &Solution, terms: &[&Candidate]) -> bool {
        let n = solution.value.len();
        let not_negative = |weight: &DVector<f64>| {
            let (value, std) = known(solution, weight);
            value > -SIGN_SHOWN * std
        };
        let unit = |place: usize| DVector::from_fn(n, |i, _| f64::from(i == place));
        let least = unit(PLACE_COULOMB);
        let (mut at_rest, mut viscous, mut apart) = (least.clone(), unit(PLACE_VISCOUS), None);
        let mut first = self.line;
        let mut possible = true;
        let [coulomb, slope] = [PLACE_COULOMB, PLACE_VISCOUS].map(|i| solution.value[i].abs());
        let size = NEGLIGIBLE_TERM * coulomb;
        for term in terms {
            let own = &solution.value.rows(first, term.columns.len());
            match term.term {
                ModelTerm::Law(LawTerm::NearRest { .. }) => {
                    at_rest[first] = 1.0;
                    possible &= own[0].abs() > size;
                }
                ModelTerm::Law(LawTerm::ViscousByDirection) => {
                    apart = Some(first);
                    possible &= own[0].abs() > NEGLIGIBLE_TERM * slope;
                }
                ModelTerm::Law(LawTerm::WithLoad { .. }) => possible &= own[0] > 0.0,
                ModelTerm::Law(LawTerm::Ripple { .. }) => {
                    possible &= (size..coulomb).contains(&own[0].hypot(own[1]));
                }
                ModelTerm::Law(LawTerm::TorqueRipple { .. }) => {
                    possible &= own[0].hypot(own[1]) > size;
                }
                ModelTerm::Law(LawTerm::CommandLag) => {
                    possible &= self.is_lag(self.sampled.lag_s - own[0]);
                }
                ModelTerm::Missing(MissingKind::WithTorque | MissingKind::BeamDamping) => {
                    possible &= own.sum() > 0.0;
                }
                ModelTerm::Law(LawTerm::Root) => {
                    possible &= own[0].abs() * self.fastest.sqrt() > size;
                }
                ModelTerm::Missing(_) => {}
            }
            first += term.columns.len();
        }
        if let Some(apart) = apart {
            viscous[apart] = -solution.value[apart].signum();
        }
        possible
            && solution.value[PLACE_INERTIA] > 0.0
            && solution.value[PLACE_COULOMB] < self.largest_torque
            && not_negative(&viscous)
            && not_negative(&least)
            && not_negative(&at_rest)
    }
}

impl Search<'_> {
    /// The lag, if it was adopted.
    pub(super) fn lag(&self) -> Option<Estimate> {
        let place = self.taken.iter().position(is_lag)?;
        let first = self.line + self.taken[..place].iter().map(|c| c.columns.len()).sum::<usize>();
        Some(amplitude(&self.solution, first, 1, self.taken[place].term))
    }

    /// Squared residuals of blocks that were left out, as shares of the squared torque of the campaign.
    pub(super) fn left_out_shares(&self) -> Option<ByBlock> {
        let left_out = self.divided.left_out(&self.columns())?;
        Some(left_out.by_block.scaled(1.0 / self.divided.total().power()))
    }

    /// Relative residual with the terms taken, without a lag.
    pub(super) fn residual_without_lag(&self) -> Option<f64> {
        let others = self.taken.iter().filter(|c| !is_lag(c));
        let columns: Vec<usize> =
            (0..self.line).chain(others.flat_map(|c| c.columns.iter().copied())).collect();
        Some(self.rows.solved(&columns)?.relative_residual)
    }

    /// The same terms in windows of a late command: relative residual, and the lag that remains.
    pub(super) fn with_lagged(&self, sampled: &Sampled<'_>, cut: &Cut) -> Option<(f64, f64)> {
        let mut rows = BlockRows::of(sampled, cut);
        let place = rows.width();
        let laws = self.taken.iter().filter(|c| !is_lag(c)).filter_map(|c| c.term.law());
        let mut regressors = law_regressors(LawTerm::CommandLag);
        regressors.extend(laws.flat_map(law_regressors));
        rows.add(sampled, &regressors, &[]);
        let solution = rows.solved(&(0..rows.width()).collect::<Vec<_>>())?;
        Some((solution.relative_residual, -solution.value[place]))
    }

    /// Regressors of the terms of the law that are no function of speed, for the curve.
    pub(super) fn not_by_speed(&self) -> Vec<Regressor> {
        let laws = self.taken.iter().filter_map(|c| c.term.law());
        laws.filter(|law| !law.is_by_speed()).flat_map(law_regressors).collect()
    }

    /// The estimates under the terms of the law that were adopted, their relative residual, the effects that the logs show
    /// beyond them, and what terms that are not known to be absent would change.
    #[expect(clippy::type_complexity, clippy::too_many_lines, reason = "the parts of one result")]
    pub(super) fn fit(
        &self,
        speeds: &Speeds,
        lag: Option<AngleLag>,
    ) -> Option<(LawFit, f64, Vec<MissingTerm>, Vec<Vec<f64>>)> {
        let laws: Vec<(LawTerm, &Candidate)> =
            self.taken.iter().filter_map(|c| Some((c.term.law()?, c))).collect();
        let columns: Vec<usize> = (0..self.line)
            .chain(laws.iter().flat_map(|(_, c)| c.columns.iter().copied()))
            .collect();
        let solution = &self.rows.solved(&columns)?;
        let total = self.rows.total();
        let mut missing = Vec::new();
        for candidate in &self.taken {
            let ModelTerm::Missing(kind) = candidate.term else { continue };
            let with = [&columns[..], &candidate.columns].concat();
            let Some(found) = self.rows.solved(&with) else { continue };
            let noted = self.candidates.iter().rev().find(|c| c.term == candidate.term);
            let own = found.value.rows(columns.len(), candidate.columns.len());
            missing.push(MissingTerm {
                kind,
                value: self.coefficient(kind, own.as_slice(), solution),
                moves: Moved::between(solution, found.value.as_slice()),
                standard_errors: noted.map_or(0.0, |c| c.standard_errors),
                residual_ratio: found.relative_residual / solution.relative_residual,
            });
        }
        let mut moves = Vec::new();
        for family in &self.families {
            if laws.iter().any(|(law, _)| law.name() == family[0].term.name()) {
                continue;
            }
            let tried = family.iter().filter_map(|candidate| {
                let with = [&columns[..], &candidate.columns].concat();
                let value = total.values(&with)?;
                Some((total.squared(&with, &value), value, with, candidate))
            });
            let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, value, with, candidate)) = best else { continue };
            let Some(found) = self.rows.solved(&with) else { continue };
            let first = columns.len();
            let size = amplitude(&found, first, candidate.columns.len(), candidate.term);
            let terms: Vec<&Candidate> = laws.iter().map(|(_, c)| *c).chain([candidate]).collect();
            let lost = found.inseparable[first..].iter().any(|lost| *lost);
            if !lost
                && size.value.abs() > MAY_BE_PRESENT * size.std
                && self.is_possible(&found, &terms)
            {
                let projected = |v: &DVector<f64>, all: &[&Candidate]| {
                    projected_line(v, all, speeds, self.line)
                };
                let before = projected(&solution.value, &terms[..laws.len()]);
                let after = projected(&value, &terms);
                moves.push(after.iter().zip(&before).map(|(a, b)| a - b).collect());
            }
        }
        let own = MotorColumns::of(self.sampled.campaign);
        let unchanged = vec![0.0; solution.value.len()];
        let fitted = Fitted { solution, change: &unchanged, columns: &own };
        let found = fitted.estimates(&self.sampled.campaign.channels);
        let mut weights = [vec![(PLACE_COULOMB, 1.0)], vec![(PLACE_VISCOUS, 1.0)]];
        let mut at_rest = None;
        let mut terms = Vec::new();
        let mut at = self.line;
        for (term, candidate) in &laws {
            let n = candidate.columns.len();
            let mut own: Vec<Estimate> =
                (at..at + n).map(|i| amplitude(solution, i, 1, candidate.term)).collect();
            for (weights, by) in weights.iter_mut().zip(speeds.of_term(*term)) {
                weights.push((at, by));
            }
            if matches!(term, LawTerm::NearRest { .. }) {
                at_rest = fitted.combined(&[(PLACE_COULOMB, 1.0), (at, 1.0)]);
            }
            match (term, &mut own[..]) {
                (LawTerm::CommandLag, [late]) => {
                    late.value = lag.map_or(late.value, |lag| lag.time_s);
                }
                (
                    LawTerm::Ripple { per_angle } | LawTerm::TorqueRipple { per_angle },
                    [_, _, rate],
                ) => {
                    rate.value += per_angle;
                }
                _ => {}
            }
            terms.push((*term, own));
            at += n;
        }
        let back_emf = self.sampled.campaign.channels.command.back_emf_viscous;
        let [level, slope] = weights;
        let by_direction = |sign: f64| {
            let with_offset: Vec<_> = level.iter().copied().chain([(PLACE_OFFSET, sign)]).collect();
            fitted.combined(&with_offset)
        };
        let viscous = fitted.combined(&slope).map(|e| Estimate { value: e.value - back_emf, ..e });
        let fit = LawFit {
            terms,
            inertia: found.inertia,
            viscous: found.friction.viscous,
            coulomb: found.friction.coulomb,
            projected: [fitted.combined(&level), viscous],
            projected_by_direction: [1.0, -1.0].map(by_direction),
            at_rest,
            offset: found.friction.offset,
            forward: found.friction.forward,
            backward: found.friction.backward,
            coupling: found.coupling_by_tip,
            total_coupling: found.coupling,
            gravity: found.gravity,
            joint: Terms::of(&fitted),
        };
        Some((fit, solution.relative_residual, missing, moves))
    }

    /// What is reported of an effect with some amplitudes.
    fn coefficient(&self, kind: MissingKind, own: &[f64], solution: &Solution) -> f64 {
        let size = own.iter().map(|v| v * v).sum::<f64>().sqrt();
        match kind {
            MissingKind::Position => {
                let [low, high] = self.sampled.travel();
                own[0] / (0.5 * (high - low))
            }
            MissingKind::BeamDamping => {
                let couplings = MotorColumns::of(self.sampled.campaign).couplings();
                own.iter().sum::<f64>() / couplings.map(|i| solution.value[i]).sum::<f64>()
            }
            // ∫wτ = ∫w·(equation) − ε∫w|τ| where (1 + ε·sgn τ)·τ acts.
            MissingKind::CommandBySign => -own[0],
            MissingKind::Gravity | MissingKind::OverTravel => size,
            MissingKind::WithTorque | MissingKind::CoulombDrift | MissingKind::ViscousDrift => {
                own[0]
            }
        }
    }
}

/// The values of the line, with Coulomb and viscous friction projected.
fn projected_line(
    value: &DVector<f64>,
    terms: &[&Candidate],
    speeds: &Speeds,
    line: usize,
) -> Vec<f64> {
    let mut found: Vec<f64> = value.iter().take(line).copied().collect();
    let mut at = line;
    for candidate in terms {
        if let Some(law) = candidate.term.law() {
            let [level, slope] = speeds.of_term(law);
            found[PLACE_COULOMB] += level * value[at];
            found[PLACE_VISCOUS] += slope * value[at];
        }
        at += candidate.columns.len();
    }
    found
}

fn is_lag(candidate: &Candidate) -> bool {
    candidate.term == ModelTerm::Law(LawTerm::CommandLag)
}

impl Search<'_> {
    /// Whether a drive may have a lag of this time. A command that a controller holds acts no earlier than it is logged, but for
    /// the half sample of one that is measured.
    fn is_lag(&self, lag_s: f64) -> bool {
        let held = self.sampled.campaign.channels.command.hold == Hold::Sampled;
        let early = lag_s / self.sample_s + 0.5;
        let possible = lag_s > 0.0 || !held || early.abs() < 0.5 * LAG_HALF_SAMPLE;
        possible && (LAG_SETTLED * self.sample_s..LAG_MOST_S).contains(&lag_s.abs())
    }
}

impl Offer {
    /// The candidate for the fit of a half, or of all rows.
    fn of(&self, half: Option<usize>) -> &Candidate {
        half.map_or(&self.all, |half| &self.halves[half])
    }
}

/// Largest torque (or force) of the commands.
fn largest_torque(campaign: &Campaign) -> f64 {
    let commands = campaign.runs.iter().flat_map(Run::command);
    commands.fold(0.0, |most: f64, u| most.max(u.abs()))
        * campaign.channels.command.torque_per_unit().abs()
}

/// The length of `count` amplitudes from `first` on, with its standard error.
pub(super) fn amplitude(s: &Solution, first: usize, count: usize, term: ModelTerm) -> Estimate {
    let value = s.value.rows(first, count);
    // ∫wτ(t) = ∫w·(equation) − Δ∫ẇτ for τ that acts Δ later.
    let sign = if term == ModelTerm::Law(LawTerm::CommandLag) { -1.0 } else { 1.0 };
    if count == 1 {
        let std = s.covariance[(first, first)].max(0.0).sqrt();
        return Estimate { value: sign * value[0], std };
    }
    let size = value.norm();
    let block = s.covariance.view((first, first), (count, count));
    let direction = value / size.max(f64::MIN_POSITIVE);
    Estimate { value: size, std: direction.dot(&(block * &direction)).max(0.0).sqrt() }
}

/// A weighted sum of the estimates, with its standard error.
fn known(solution: &Solution, weight: &DVector<f64>) -> (f64, f64) {
    let variance = weight.dot(&(&solution.covariance * weight));
    (weight.dot(&solution.value), variance.max(0.0).sqrt())
}
