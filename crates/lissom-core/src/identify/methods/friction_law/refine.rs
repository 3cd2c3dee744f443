//! Refines the speed or the period of an accepted term to the smallest residual.

use rayon::prelude::*;

use crate::identify::methods::friction_law::choice::LawSearch;
use crate::identify::methods::friction_law::law_term::{Column, LawTerm, NEAR_REST};
use crate::identify::methods::friction_law::ripple;
use crate::identify::methods::friction_law::rows::fixed;
use crate::identify::methods::friction_law::thresholds::NEAR_REST_MOST;
use crate::identify::methods::regression::Term;

/// A speed near rest is looked for between its neighbours on the list in so many steps.
const FINER: i32 = 8;
/// A ripple is moved by so many steps either way, as far as its neighbour on the list;…
const RIPPLE_STEPS: i32 = 3;
/// …where the best is no end, steps become so many times finer, down to this share of the list's.
const RIPPLE_FINER: f64 = 3.0;
const RIPPLE_LAST: f64 = 0.01;
/// Most moves altogether.
const RIPPLE_MOVES: usize = 16;

impl LawSearch<'_> {
    /// Moves the speed of a term near rest.
    pub(super) fn refine_near_rest(&mut self) {
        let Some(found) = self.taken.iter().position(|t| t.term.is_near_rest()) else { return };
        let LawTerm::NearRest { speed, falloff } = self.taken[found].term else { return };
        let step = (NEAR_REST[1] / NEAR_REST[0]).ln() / f64::from(FINER);
        let speeds = (-FINER..=FINER).map(|k| speed * (f64::from(k) * step).exp());
        let within = speeds.filter(|speed| *speed <= NEAR_REST_MOST * self.fastest);
        let others = within.map(|speed| {
            let term = LawTerm::NearRest { speed, falloff };
            (term, term.columns())
        });
        self.exchange(found, &others.collect::<Vec<_>>());
    }

    /// Moves the period of the ripple that was taken last, and then estimates it with the rest.
    pub(super) fn refine_ripple(&mut self) {
        let found = self.taken.len() - 1;
        let LawTerm::Ripple { per_angle } = self.taken[found].term else { return };
        self.move_ripple(found, per_angle);
        self.free_ripple(found);
    }

    /// The list of periods tells them apart as far as the travel does, and friction that is many times the
    /// noise does so further; nor has it periods that are longer than the travel.
    fn move_ripple(&mut self, found: usize, mut at: f64) {
        let listed = ripple::step(self.sampled);
        let mut step = listed / f64::from(RIPPLE_STEPS);
        for _ in 0..RIPPLE_MOVES {
            let near = (-RIPPLE_STEPS..=RIPPLE_STEPS).map(|i| at + f64::from(i) * step);
            let others = near.filter(|k| *k > step).map(|per_angle| {
                let term = LawTerm::Ripple { per_angle };
                (term, term.columns())
            });
            self.exchange(found, &others.collect::<Vec<_>>());
            let LawTerm::Ripple { per_angle } = self.taken[found].term else { return };
            let moved = (per_angle - at).abs();
            at = per_angle;
            if moved > step * (f64::from(RIPPLE_STEPS) - 0.5) {
                continue;
            }
            step /= RIPPLE_FINER;
            if step < RIPPLE_LAST * listed {
                return;
            }
        }
    }

    /// Adds a term for what its amplitudes gain with the ripple's k: k is estimated with the rest, and what it
    /// leaves unknown is in all deviations.
    fn free_ripple(&mut self, found: usize) {
        let LawTerm::Ripple { per_angle } = self.taken[found].term else { return };
        let first = self.terms.len() - self.taken[found].terms.len();
        let amplitude = |i: usize| self.solution.value[first + i];
        let column = Column::Turned(per_angle, amplitude(0), amplitude(1));
        self.columns.push(column);
        let turned = Term::Signed(fixed(self.sampled.campaign) + self.columns.len() - 1);
        let rows = self.rows.with_columns(self.sampled, &[column]);
        let terms: Vec<Term> = self.terms.iter().copied().chain([turned]).collect();
        let solution = rows.solved(&terms).filter(|s| !s.inseparable[first + 2]);
        let Some(solution) = solution else {
            self.columns.pop();
            return;
        };
        (self.rows, self.terms, self.solution) = (rows, terms, solution);
        self.taken[found].terms.push(turned);
        self.forget_estimates();
    }

    /// Puts the one of `others` with which least is left in the place of a term that was taken.
    fn exchange(&mut self, found: usize, others: &[(LawTerm, Vec<Column>)]) {
        let own = self.taken[found].terms.clone();
        let first = fixed(self.sampled.campaign);
        // Other columns than those of the terms would be summed up for nothing.
        let used = self.terms.iter().map(|t| t.column()).filter(|column| *column >= first);
        let kept: Vec<usize> = (0..first).chain(used).collect();
        let columns: Vec<Column> = others.iter().flat_map(|o| &o.1).copied().collect();
        let rows = self.rows.narrowed(self.sampled, &kept, &columns);
        let in_place = |i: usize| -> Vec<Term> {
            let other = |j: usize| Term::Signed(kept.len() + i * own.len() + j);
            let narrow =
                |t: &Term| kept.iter().position(|c| *c == t.column()).map_or(*t, |c| t.at(c));
            let of = |t: &Term| own.iter().position(|o| o == t).map_or_else(|| narrow(t), other);
            self.terms.iter().map(of).collect()
        };
        let near_rest = self.taken[found].term.is_near_rest();
        let stands = |terms: &[Term]| {
            !near_rest || rows.solved(terms).is_some_and(|s| self.is_within_data(&s))
        };
        let left = |i: usize| {
            let terms = in_place(i);
            let left = stands(&terms).then(|| rows.relative_residual(&terms)).flatten()?;
            Some((i, left))
        };
        let tried: Vec<_> = (0..others.len()).into_par_iter().map(left).collect();
        let best = tried.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((i, _)) = best else { return };
        let mut exchanged = Vec::with_capacity(own.len());
        for (j, column) in others[i].1.iter().enumerate() {
            let place = own[j].column();
            self.columns[place - first] = *column;
            exchanged.push((place, kept.len() + i * own.len() + j));
        }
        self.rows = self.rows.exchanged(&rows, &exchanged);
        if let Some(solution) = self.rows.solved(&self.terms) {
            self.solution = solution;
        }
        self.taken[found].term = others[i].0;
        self.forget_estimates();
    }
}
