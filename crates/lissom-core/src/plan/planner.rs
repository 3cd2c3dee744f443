//! From motions within the limits to a plan: the choices, the goal, and the expected precision.

use nalgebra::{DMatrix, DVector};

use super::choose::{self, Choice, Chosen, Goal};
use super::known::KnownRig;
use super::{
    ArmParameter, BETWEEN_S, Candidate, Expected, Kinds, Plan, PlanError, PlanNote, PlannedMotion,
    PlannedParameter, PlannedRun, Unfit, Wishes, note,
};
use crate::information::{Inverse, along, inverted};
use crate::rig::Rig;

/// The choices and the goal of a plan.
pub(super) struct Planner<'a> {
    known: &'a KnownRig<'a>,
    rig: &'a Rig,
    wishes: &'a Wishes,
    /// Motions that are chosen together.
    sets: Vec<&'a Vec<Candidate>>,
    pub(super) choices: Vec<Choice>,
    pub(super) goal: Goal,
    /// Derivatives of the unknowns by the coordinates in which information is added.
    directions: DMatrix<f64>,
}

impl<'a> Planner<'a> {
    pub(super) fn new(
        known: &'a KnownRig<'a>,
        rig: &'a Rig,
        wishes: &'a Wishes,
        found: &'a [Result<Vec<Candidate>, Unfit>],
    ) -> Result<Self, PlanError> {
        let sets: Vec<&Vec<Candidate>> = found.iter().flatten().collect();
        if sets.is_empty() {
            let reasons = note::reasons(found);
            let reasons = reasons.iter().map(|(why, n)| format!("{n} {why}")).collect();
            return Err(PlanError::NoMotion { tried: found.len(), reasons });
        }
        let unknowns = known.unknowns();
        let directions = known.directions();
        let choices: Vec<Choice> = sets.iter().map(|set| choice(set, &directions)).collect();
        let shortest_s = choices.iter().map(|c| c.time_s[0]).fold(f64::INFINITY, f64::min);
        if shortest_s > wishes.within_s {
            return Err(PlanError::NoTime { within_s: wishes.within_s, shortest_s });
        }
        let wanted = known.parameters().into_iter().map(|parameter| {
            let slopes = unknowns.iter().map(|(of, _)| known.slope(parameter, *of));
            let slopes = DVector::from_iterator(unknowns.len(), slopes);
            let along = directions.tr_mul(&slopes) / known.value(parameter);
            (along, wishes.precision.of_planned(parameter))
        });
        let goal = Goal {
            wanted: wanted.collect(),
            within_s: wishes.within_s,
            pair: wishes.kinds != Kinds::Any,
        };
        Ok(Self { known, rig, wishes, sets, choices, goal, directions })
    }

    pub(super) fn plan(
        &self,
        chosen: &Chosen,
        mut notes: Vec<PlanNote>,
        longest_wait_s: f64,
    ) -> Plan {
        let size = self.directions.ncols();
        let total = choose::information(&self.choices, chosen, size);
        let ratios = self.goal.ratios(&total);
        let parameters = self.known.parameters();
        let expected: Vec<Expected> = parameters
            .iter()
            .zip(&ratios)
            .map(|(parameter, ratio)| {
                let wanted = self.wishes.precision.of_planned(*parameter);
                let value = self.known.value(*parameter);
                Expected { parameter: *parameter, value, std: ratio * wanted, wanted }
            })
            .collect();
        let mut runs: Vec<PlannedRun> = Vec::new();
        for (i, k) in chosen.iter().enumerate().filter(|(_, k)| **k > 0) {
            let without = self.without(&total, &self.choices[i].information[k - 1], &expected);
            runs.extend(self.sets[i].iter().map(|c| PlannedRun {
                record_s: c.run.motion.stretch_s() * *k as f64,
                without,
                paired: self.choices[i].pair,
                ..c.run.clone()
            }));
        }
        runs.sort_by(|a, b| order(&a.motion).total_cmp(&order(&b.motion)));
        let time_s = choose::time_s(&self.choices, chosen);
        if self.goal.pair && !self.choices.iter().zip(chosen).any(|(c, k)| c.pair && *k > 0) {
            notes.push(PlanNote::NoPair);
        }
        let damped = self.known.arm.damping_ratios().iter().any(|ratio| *ratio > 0.0);
        if damped && runs.iter().all(|r| matches!(r.motion, PlannedMotion::Sine { .. })) {
            notes.push(PlanNote::SinesAlone);
        }
        notes.extend(self.unreached(chosen, &expected, time_s));
        let Inverse { matrix, lost } = inverted(&total);
        let std = |i: usize| {
            let by = self.directions.row(i).transpose();
            let is_lost = lost.iter().zip(&by).any(|(lost, by)| *lost && *by != 0.0);
            if is_lost { f64::INFINITY } else { along(&by, &matrix) }
        };
        let unknowns = self.known.unknowns().into_iter().enumerate();
        let parameters = unknowns.map(|(i, (of, value))| (of, value, std(i))).collect();
        Plan { runs, expected, parameters, time_s, notes, longest_wait_s }
    }

    /// The parameter that misses its requested precision most without a part of the information; `None` if all requested
    /// precisions would still be reached.
    fn without(
        &self,
        total: &DMatrix<f64>,
        part: &DMatrix<f64>,
        expected: &[Expected],
    ) -> Option<(PlannedParameter, f64)> {
        let ratios = self.goal.ratios(&(total - part));
        let then = expected.iter().zip(ratios).filter(|(_, ratio)| *ratio > 1.0);
        let worst = then.max_by(|a, b| a.1.total_cmp(&b.1));
        worst.map(|(e, ratio)| (e.parameter, ratio * e.wanted))
    }

    /// Notes about requested precisions that are not reached within the time.
    fn unreached(&self, chosen: &Chosen, expected: &[Expected], time_s: f64) -> Vec<PlanNote> {
        let used = || {
            let sets = self.sets.iter().zip(chosen).filter(|(_, k)| **k > 0);
            sets.flat_map(|(set, _)| set.iter())
        };
        let constant = self.rig.arm.motor.torque_constant_nm_per_a();
        let peak_nm = constant * used().map(|c| c.run.peak_current_a).fold(0.0, f64::max);
        let speed = used().map(|c| c.speed_rad_s).fold(0.0, f64::max);
        let share = |parameter: PlannedParameter| match parameter {
            PlannedParameter::Arm(ArmParameter::Viscous) => {
                Some(self.known.value(parameter) * speed / peak_nm)
            }
            PlannedParameter::Arm(ArmParameter::Coulomb) | PlannedParameter::Gravity => {
                Some(self.known.value(parameter) / peak_nm)
            }
            PlannedParameter::Arm(_) => None,
        };
        let missed = expected.iter().filter(|e| e.std > e.wanted);
        missed
            .map(|e| PlanNote::Unreached {
                expected: *e,
                within_s: self.wishes.within_s,
                // StdSource fall with the root of the time.
                needed_s: time_s * (e.std / e.wanted).powi(2),
                torque_share: share(e.parameter),
            })
            .collect()
    }
}

/// Information and times of motions that are chosen together.
fn choice(set: &[Candidate], directions: &DMatrix<f64>) -> Choice {
    let stretches = set.iter().map(|c| c.information.len()).min().unwrap_or(0);
    let size = directions.ncols();
    let all = |k: usize| {
        let parts = set.iter().map(|c| directions.tr_mul(&(&c.information[k] * directions)));
        parts.fold(DMatrix::zeros(size, size), |sum, part| sum + part)
    };
    let time = |k: usize| {
        let one =
            |c: &Candidate| BETWEEN_S + c.run.waited_s + c.run.motion.stretch_s() * (k + 1) as f64;
        set.iter().map(one).sum()
    };
    Choice {
        information: (0..stretches).map(all).collect(),
        time_s: (0..stretches).map(time).collect(),
        pair: set.len() > 1,
    }
}

/// Sort key: sines first, then multisines, then sweeps, each by its lowest frequency.
fn order(motion: &PlannedMotion) -> f64 {
    match *motion {
        PlannedMotion::Sine { omega_rad_s } => omega_rad_s,
        PlannedMotion::Multisine { omega_rad_s, .. } => 1e6 * omega_rad_s,
        PlannedMotion::Chirp { from_rad_s, .. } => 1e12 * from_rad_s,
    }
}
