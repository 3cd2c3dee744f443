//! The choice of the terms that a model of the torque has beyond the line, by what it predicts.
//!
//! Candidates are complete models: the line, and the line with further terms, singly and in pairs. A term is adopted if the
//! model with it predicts blocks that were left out of the fit better than the model without it, by two standard errors of
//! the difference, and whole kinds of motion that were left out better, too. A period or a speed is chosen in one half of the
//! blocks and judged in the other.

use rayon::prelude::*;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::blocks::{BlockRows, Gram, Regressor};
use crate::identify::methods::friction_law::candidates::{
    Candidate, Family, ModelTerm, families, law_regressors,
};
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::prediction::{ByBlock, Divided, Improvement, LeftOut};
use crate::identify::methods::friction_law::rows::{Cut, Sampled};
use crate::identify::methods::friction_law::thresholds::{RIPPLE_OF_ONE_MOTION, TERMS_MOST};
use crate::identify::methods::regression::Solution;
use crate::record::Run;

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

/// The term of a lag.
pub(super) const LAG: ModelTerm = ModelTerm::Law(LawTerm::CommandLag);

/// Chooses the terms of the model; also the relative residual of the line. `None` if the rows do not give the line. Where the
/// lag is known, the commands are as late as the angle.
pub(super) fn choose<'a>(
    sampled: &'a Sampled<'a>,
    cut: &Cut,
    fastest: f64,
    lag_known: bool,
) -> Option<(Search<'a>, f64)> {
    let mut search = Search::new(sampled, cut, fastest, lag_known)?;
    let line_residual = search.solution.relative_residual;
    // A term that is dropped may come back: rounds are counted.
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
pub(super) struct Offer {
    pub(super) halves: [Candidate; 2],
    pub(super) all: Candidate,
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
    pub(super) divided: Divided,
    pub(super) families: Vec<Family>,
    pub(super) taken: Vec<Candidate>,
    pub(super) candidates: Vec<LawCandidate>,
    /// The column of a lag that is known.
    pub(super) known_lag: Option<usize>,
    pub(super) solution: Solution,
    /// Number of columns of the line.
    pub(super) line: usize,
    pub(super) largest_torque: f64,
    /// Shortest sample time.
    pub(super) sample_s: f64,
}

impl<'a> Search<'a> {
    fn new(sampled: &'a Sampled<'a>, cut: &Cut, fastest: f64, lag_known: bool) -> Option<Self> {
        let mut rows = BlockRows::of(sampled, cut);
        let line = rows.width();
        let (mut families, regressors) = families(sampled, fastest, line);
        let lag = families.iter().position(|f| lag_known && is_lag(&f[0]));
        let known_lag = lag.map(|place| families.remove(place)[0].columns[0]);
        rows.add(sampled, &regressors, &[]);
        let divided = Divided::of(&rows);
        let solution = rows.solved(&(0..line).collect::<Vec<_>>())?;
        let largest_torque = sampled.largest_torque();
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
            known_lag,
            solution,
            line,
            largest_torque,
            sample_s,
        })
    }

    /// Columns of the line and of the terms taken.
    pub(super) fn columns(&self) -> Vec<usize> {
        self.with(&[])
    }

    pub(super) fn with(&self, further: &[&Candidate]) -> Vec<usize> {
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
            offers.into_par_iter().filter_map(|offers| self.judged(offers, &before)).collect();
        self.note(&judged);
        if !judged.iter().any(|j| j.accepted) {
            judged = self.pairs(&before);
        }
        let best = judged
            .into_iter()
            .filter(|j| j.accepted)
            .max_by(|a, b| a.improvement.saved.total_cmp(&b.improvement.saved));
        let Some(best) = best else {
            self.rows.truncate(width);
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

    /// What speaks for the terms of some offers together; `None` for several that do not predict better,
    /// and for a ripple that the errors of a sensor can be.
    fn judged(&self, offers: Vec<Offer>, before: &LeftOut) -> Option<Judged> {
        let of = |half: Option<usize>| -> Vec<usize> {
            self.with(&offers.iter().map(|o| o.of(half)).collect::<Vec<_>>())
        };
        let all = of(None);
        let amplitudes = offers.iter().map(|o| o.all.columns.len()).sum();
        let after = self.divided.left_out(&all)?;
        let scanned = offers.iter().any(|o| o.halves[0] != o.all || o.halves[1] != o.all);
        let improvement = if scanned {
            let own = self.columns();
            let without = self.divided.across_halves([&own, &own])?;
            let with = self.divided.across_halves([&of(Some(0)), &of(Some(1))])?;
            Improvement::between(&without, &with, amplitudes)
        } else {
            Improvement::between(&before.by_block, &after.by_block, amplitudes)
        };
        let is_ripple = |offer: &Offer| {
            let law = offer.all.term.law();
            matches!(law, Some(LawTerm::Ripple { .. } | LawTerm::TorqueRipple { .. }))
        };
        let may_be_of_sensor = improvement.saved < RIPPLE_OF_ONE_MOTION
            && offers.iter().any(is_ripple)
            && self.sampled.is_one_motion_repeated();
        if may_be_of_sensor {
            return None;
        }
        let across_kinds = after.is_better_across_kinds(before);
        if offers.len() > 1 && !(improvement.is_sure && across_kinds) {
            return None;
        }
        let solution = self.rows.solved(&all)?;
        if solution.inseparable[self.line..].iter().any(|lost| *lost) {
            return None;
        }
        let terms: Vec<&Candidate> =
            self.taken.iter().chain(offers.iter().map(|o| &o.all)).collect();
        let accepted = improvement.is_sure && across_kinds && self.is_possible(&solution, &terms);
        Some(Judged { offers, improvement, solution, across_kinds, accepted })
    }

    /// Pairs of open families, none of which predicts better alone: each with a lag or one another.
    fn pairs(&mut self, before: &LeftOut) -> Vec<Judged> {
        let open: Vec<Family> = self.open().cloned().collect();
        let both = |(one, other): (&Family, &Family)| {
            let first = self.offer(one, &[]);
            let second = self.offer(other, &[&first]);
            self.judged(vec![first, second], before)
        };
        let each = open.iter().enumerate();
        let pairs: Vec<_> =
            each.flat_map(|(i, one)| open[i + 1..].iter().map(move |o| (one, o))).collect();
        let mut judged: Vec<Judged> = pairs.into_par_iter().filter_map(both).collect();
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
        let mut first = self.columns().len();
        for candidate in &taken {
            let count = candidate.columns.len();
            let noted = self.candidates.iter_mut().rev().take_while(|c| c.beside == beside);
            let same = noted.into_iter().find(|c| c.term.name() == candidate.term.name());
            if let Some(noted) = same {
                // What speaks for a pair speaks for both.
                *noted = LawCandidate {
                    term: candidate.term,
                    beside,
                    amplitude: amplitude(&best.solution, first, count, candidate.term),
                    saved: best.improvement.saved,
                    standard_errors: best.improvement.standard_errors,
                    across_kinds: best.across_kinds,
                    taken: true,
                };
            }
            first += count;
        }
        self.rows.truncate(width);
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

    /// Drops terms without which the model predicts as well as with them, but not the last one, which was just taken.
    fn drop_needless(&mut self) {
        self.drop_among(self.taken.len().saturating_sub(1), |_| true);
        if let Some(solution) = self.rows.solved(&self.columns()) {
            self.solution = solution;
        }
    }

    /// Drops terms of the law that predict better only beside an effect which the model does not contain.
    fn drop_needless_alone(&mut self) {
        let is_law = |c: &Candidate| c.term.law().is_some();
        if !self.taken.iter().all(is_law) {
            self.drop_among(self.taken.len(), is_law);
        }
    }

    /// Drops those of the first `count` terms without which all of one sort predict as well as with them, the last one first. A
    /// lag stays.
    fn drop_among(&mut self, count: usize, of_sort: impl Fn(&Candidate) -> bool) {
        for i in (0..count).rev() {
            let one = &self.taken[i];
            if !of_sort(one) || is_lag(one) {
                continue;
            }
            let all: Vec<&Candidate> = self.taken.iter().filter(|c| of_sort(c)).collect();
            let without: Vec<&Candidate> = all.iter().copied().filter(|c| *c != one).collect();
            if !self.is_needed(&without, &all) {
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
        let columns = |terms: &[&Candidate]| terms.iter().map(|c| c.columns.len()).sum::<usize>();
        let more = columns(all) - columns(without);
        both.is_none_or(|(a, b)| Improvement::between(&a.by_block, &b.by_block, more).is_sure)
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

    /// Squared residuals of blocks that were left out of the fit of the line.
    pub(super) fn left_out_by_line(&self) -> Option<ByBlock> {
        Some(self.divided.left_out(&(0..self.line).collect::<Vec<_>>())?.by_block)
    }

    /// The same with the terms of the law that were adopted.
    pub(super) fn left_out_by_law(&self) -> Option<ByBlock> {
        Some(self.divided.left_out(&self.adopted().1)?.by_block)
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
}

fn is_lag(candidate: &Candidate) -> bool {
    candidate.term == LAG
}

impl Offer {
    /// The candidate for the fit of a half, or of all rows.
    fn of(&self, half: Option<usize>) -> &Candidate {
        half.map_or(&self.all, |half| &self.halves[half])
    }
}

/// The length of `count` amplitudes from `first` on, with its standard error.
pub(super) fn amplitude(s: &Solution, first: usize, count: usize, term: ModelTerm) -> Estimate {
    let value = s.value.rows(first, count);
    // ∫wτ(t) = ∫w·(equation) − Δ∫ẇτ for τ that acts Δ later.
    let sign = if term == LAG { -1.0 } else { 1.0 };
    if count == 1 {
        let std = s.covariance[(first, first)].max(0.0).sqrt();
        return Estimate { value: sign * value[0], std };
    }
    let size = value.norm();
    let block = s.covariance.view((first, first), (count, count));
    let direction = value / size.max(f64::MIN_POSITIVE);
    Estimate { value: size, std: direction.dot(&(block * &direction)).max(0.0).sqrt() }
}
