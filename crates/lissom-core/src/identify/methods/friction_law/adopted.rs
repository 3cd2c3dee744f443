//! The estimates of the model that was adopted, and what terms beyond it would change.

use nalgebra::DVector;

use crate::identify::estimate::Estimate;
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::candidates::{Candidate, MissingKind, ModelTerm};
use crate::identify::methods::friction_law::choice::{Search, amplitude};
use crate::identify::methods::friction_law::lag::AngleLag;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::projection::Motion;
use crate::identify::methods::friction_law::unadopted::{MissingTerm, Moved, PossibleTerm};
use crate::identify::methods::regression::{
    Fitted, MotorColumns, PLACE_COULOMB, PLACE_OFFSET, PLACE_VISCOUS, Solution, Terms,
};

impl Search<'_> {
    /// The terms of the law that were adopted, and their columns with those of the line.
    pub(super) fn adopted(&self) -> (Vec<(LawTerm, &Candidate)>, Vec<usize>) {
        let laws: Vec<_> = self.taken.iter().filter_map(|c| Some((c.term.law()?, c))).collect();
        let further = laws.iter().flat_map(|(_, c)| c.columns.iter().copied());
        let columns = (0..self.line).chain(further).collect();
        (laws, columns)
    }

    /// The estimates under the terms of the law that were adopted, their relative residual, and the effects that the logs show
    /// beyond them.
    pub(super) fn fit(
        &self,
        motion: &Motion,
        lag: Option<AngleLag>,
    ) -> Option<(LawFit, f64, Vec<MissingTerm>)> {
        let (laws, columns) = self.adopted();
        let mut solution = self.rows.solved(&columns)?;
        if let Some(lag) = lag
            && let Some(by_lag) = self.by_known_lag(&columns, &solution)
        {
            solution.covariance += &by_lag * by_lag.transpose() * lag.std_s.powi(2);
        }
        let solution = &solution;
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
            for (weights, by) in weights.iter_mut().zip(motion.of_term(*term)) {
                weights.push((at, by));
            }
            if matches!(term, LawTerm::NearRest { .. }) {
                at_rest = fitted.combined(&[(PLACE_COULOMB, 1.0), (at, 1.0)]);
            }
            if let (
                LawTerm::Ripple { per_angle } | LawTerm::TorqueRipple { per_angle },
                [_, _, rate],
            ) = (term, &mut own[..])
            {
                rate.value += per_angle;
            }
            terms.push((*term, own));
            at += n;
        }
        let late = lag.map(|lag| Estimate { value: lag.time_s, std: lag.std_s });
        terms.extend(late.map(|late| (LawTerm::CommandLag, vec![late])));
        let back_emf = self.sampled.campaign.channels.command.back_emf_viscous;
        let [level, slope] = weights;
        let of_terms = |motion: &Motion| {
            let mut at = self.line;
            laws.iter().fold([0.0; 2], |[level, slope], (term, candidate)| {
                let [a, b] = motion.of_term(*term).map(|by| by * solution.value[at]);
                at += candidate.columns.len();
                [level + a, slope + b]
            })
        };
        let scatter = motion.scatter(of_terms);
        let counted = |e: Estimate, i: usize| Estimate { std: e.std.hypot(scatter[i]), ..e };
        let by_direction = |sign: f64| {
            let with_offset: Vec<_> = level.iter().copied().chain([(PLACE_OFFSET, sign)]).collect();
            Some(counted(fitted.combined(&with_offset)?, 0))
        };
        let viscous = fitted.combined(&slope).map(|e| counted(e, 1));
        let viscous = viscous.map(|e| Estimate { value: e.value - back_emf, ..e });
        let fit = LawFit {
            terms,
            inertia: found.inertia,
            viscous: found.friction.viscous,
            coulomb: found.friction.coulomb,
            projected: [by_direction(0.0), viscous],
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
        Some((fit, solution.relative_residual, missing))
    }

    /// Change of the values of a solution with a known lag, per second of it.
    fn by_known_lag(&self, columns: &[usize], solution: &Solution) -> Option<DVector<f64>> {
        let with = [columns, &[self.known_lag?]].concat();
        let value = self.rows.total().values(&with)?;
        let n = columns.len();
        Some((value.rows(0, n) - &solution.value) / value[n])
    }

    /// The terms that are not known to be absent.
    pub(super) fn possible(&self, motion: &Motion) -> Option<Vec<PossibleTerm>> {
        let (laws, columns) = self.adopted();
        let solution = &self.rows.solved(&columns)?;
        let total = self.rows.total();
        let mut possible = Vec::new();
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
            let terms: Vec<&Candidate> = laws.iter().map(|(_, c)| *c).chain([candidate]).collect();
            let lost = found.inseparable[first..].iter().any(|lost| *lost);
            if !lost && self.is_possible(&found, &terms) {
                let projected = |v: &DVector<f64>, all: &[&Candidate]| {
                    projected_line(v, all, motion, self.line)
                };
                let before = projected(&solution.value, &terms[..laws.len()]);
                let after = projected(&value, &terms);
                let change = after.iter().zip(&before).map(|(a, b)| a - b).collect();
                possible.push(PossibleTerm { term: candidate.term, change });
            }
        }
        Some(possible)
    }

    /// What is reported of an effect with some amplitudes.
    pub(super) fn coefficient(&self, kind: MissingKind, own: &[f64], solution: &Solution) -> f64 {
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
    motion: &Motion,
    line: usize,
) -> Vec<f64> {
    let mut found: Vec<f64> = value.iter().take(line).copied().collect();
    let mut at = line;
    for candidate in terms {
        if let Some(law) = candidate.term.law() {
            let [level, slope] = motion.of_term(law);
            found[PLACE_COULOMB] += level * value[at];
            found[PLACE_VISCOUS] += slope * value[at];
        }
        at += candidate.columns.len();
    }
    found
}
