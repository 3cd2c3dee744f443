//! Terms with a value that is searched for: the period of a ripple, and the speed of a change near rest.

use rayon::prelude::*;

use crate::drive::Falloff;
use crate::identify::methods::friction_law::blocks::Regressor;
use crate::identify::methods::friction_law::candidates::{Candidate, ModelTerm, law_regressors};
use crate::identify::methods::friction_law::choice::{Offer, Search};
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::prediction::Divided;
use crate::identify::methods::friction_law::ripple;

/// A ripple has one period in both halves if its frequencies there differ by less than this many steps of the search.
const SAME_RIPPLE: f64 = 2.0;
/// A scanned speed or frequency is improved so many times by its derivative, or until it moves by less than this share.
const SCANNED_ROUNDS: usize = 6;
const SCANNED_SETTLED: f64 = 1e-6;
/// A speed near rest is moved by this factor at most, about the distance of neighbours that are tried.
const NEAR_REST_APART: f64 = 1.8;

impl Search<'_> {
    /// Ripples of friction and of torque whose period is the same in both halves, beside further terms; their columns are
    /// added to the rows.
    pub(super) fn offer_ripples(&mut self, further: &[&Candidate]) -> Vec<Vec<Offer>> {
        let columns = self.with(further);
        let block = self.rows.block_of_windows();
        let blocks = self.rows.blocks.len();
        let mut found = Vec::new();
        for friction in [true, false] {
            let at = |half: Option<usize>| {
                let sums = half.map_or(self.divided.total(), |half| self.divided.of_half(half));
                let left = self.rows.left(&columns, &sums.values(&columns)?);
                let wanted = |i: usize| half.is_none_or(|h| Divided::half(block[i], blocks) == h);
                ripple::strongest(self.sampled, &left, friction, wanted)
            };
            let parts = [Some(0), Some(1), None].into_par_iter().map(at);
            let Some(parts) = parts.collect::<Option<Vec<f64>>>() else { continue };
            let [first, second, whole] = [0, 1, 2].map(|i| parts[i]);
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

    /// Takes a term whose speed or frequency was scanned; friction near rest in the shape that leaves less.
    pub(super) fn take_scanned(&mut self, term: LawTerm) {
        let (width, count) = (self.rows.width(), self.taken.len());
        self.take_at_least(term);
        let Some(LawTerm::NearRest { speed, .. }) = self.taken.last().and_then(|t| t.term.law())
        else {
            return;
        };
        // The Gaussian that is nearest to an exponential has a larger speed.
        let speed = NEAR_REST_APART * speed;
        let (rows, taken, left) = (self.rows.clone(), self.taken.clone(), self.left());
        self.rows.truncate(width);
        self.taken.truncate(count);
        self.take_at_least(LawTerm::NearRest { speed, falloff: Falloff::Gaussian });
        if self.left() > left {
            (self.rows, self.taken) = (rows, taken);
        }
    }

    /// What the terms taken leave of the torque.
    fn left(&self) -> f64 {
        let (columns, total) = (self.columns(), self.rows.total());
        total.values(&columns).map_or(f64::INFINITY, |value| total.squared(&columns, &value))
    }

    /// Moves the speed or the frequency of a term to the least residual, and adds a column for what the term gains with it, so that
    /// it is estimated with the rest.
    fn take_at_least(&mut self, term: LawTerm) {
        let first = self.rows.width();
        let start = term.scanned();
        let [least, most] = if let LawTerm::NearRest { .. } = term {
            [start / NEAR_REST_APART, start * NEAR_REST_APART]
        } else {
            let apart = SAME_RIPPLE * ripple::step(self.sampled);
            [(start - apart).max(ripple::least(self.sampled)), start + apart]
        };
        let mut now = start;
        let mut taken = None;
        for _ in 0..SCANNED_ROUNDS {
            let term = term.with_scanned(now);
            self.rows.truncate(first);
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
            self.rows.truncate(own.columns.last().map_or(first, |last| last + 1));
        }
        self.taken.extend(taken);
    }
}
