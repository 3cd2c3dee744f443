//! Estimates under the law of friction, and the finding that reports it.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{BetterLaw, EstimateUnits, Finding, FrictionLawFinding, LawSource};
use crate::identify::friction_estimates::{Friction, NearRestEstimate, RippleEstimate};
use crate::identify::judge::{Chosen, Evidence};
use crate::identify::methods::friction_law::LawFit;
use crate::identify::methods::friction_law::law_term::LawTerm;
use crate::identify::methods::friction_law::refine::NEAR_REST_STEP;
use crate::identify::methods::friction_law::thresholds::NEGLIGIBLE_TERM;
use crate::identify::methods::output_error::OutputError;

impl LawFit {
    /// All estimates under this law.
    pub fn estimates(&self) -> DriveEstimates {
        DriveEstimates {
            friction: friction(self),
            inertia: self.inertia,
            coupling: self.total_coupling,
            coupling_by_tip: self.coupling.clone(),
        }
    }
}

/// Friction under another law than Coulomb and one viscous constant.
fn friction(law: &LawFit) -> Friction {
    let sum = |a: Option<Estimate>, b: Option<Estimate>, sign: f64| {
        let (a, b) = (a?, b?);
        Some(Estimate { value: a.value + sign * b.value, std: a.std.hypot(b.std) })
    };
    let difference = law.term(|t| *t == LawTerm::ViscousByDirection);
    let by_direction = |sign: f64| sum(law.viscous, difference, sign);
    let near_rest = law.terms.iter().find_map(|(term, amplitude)| match term {
        LawTerm::NearRest { speed, falloff } => {
            let speed = Estimate { value: *speed, std: NEAR_REST_STEP * speed };
            Some(NearRestEstimate { torque: *amplitude.first()?, speed, falloff: *falloff })
        }
        _ => None,
    });
    let ripple = |(term, amplitude): &(LawTerm, Vec<Estimate>)| match (term, &amplitude[..]) {
        (LawTerm::Ripple { per_angle }, [cosine, sine, rate @ ..]) => Some(RippleEstimate {
            torque: Estimate {
                value: cosine.value.hypot(sine.value),
                std: cosine.std.hypot(sine.std),
            },
            per_angle: rate
                .first()
                .copied()
                .unwrap_or(Estimate { value: *per_angle, std: f64::INFINITY }),
        }),
        _ => None,
    };
    Friction {
        near_rest,
        ripples: law.terms.iter().filter_map(ripple).collect(),
        coulomb: law.coulomb,
        forward: sum(law.coulomb, law.offset, 1.0),
        backward: sum(law.coulomb, law.offset, -1.0),
        offset: law.offset,
        viscous: law.viscous,
        viscous_by_direction: by_direction(1.0).zip(by_direction(-1.0)),
    }
}

/// The law of friction that the data call for: that of the replay where it describes the runs.
pub(crate) fn finding(evidence: &Evidence<'_>, chosen: &Chosen) -> Option<Finding> {
    let units = EstimateUnits::new(&evidence.campaign.channels);
    let reported = |terms: Vec<(LawTerm, Vec<Estimate>)>, source: LawSource| {
        Some(Finding::new(FrictionLawFinding::FrictionLaw { terms, source, units }))
    };
    let replay = evidence.replay();
    let by_replay = replay.map_or(Vec::new(), OutputError::law_terms);
    if !by_replay.is_empty() {
        let friction = &chosen.drive.friction;
        let source = LawSource::OutputError {
            whole_runs: replay.is_some_and(|oe| oe.describes_whole_runs() && !oe.is_in_windows()),
            // Of exact logs everything is known, and whatever the simulator or the sensor adds is found.
            negligible: by_replay.iter().all(|term| is_negligible(friction, term)),
        };
        return reported(by_replay, source);
    }
    let law = evidence.methods.friction_law.as_ref().filter(|law| law.chosen.departs())?;
    let taken = law.candidates.iter().filter(|c| c.taken && c.term != LawTerm::CommandLag);
    let paired = taken.map(|c| c.paired).fold(f64::INFINITY, f64::min);
    let source = LawSource::SlipPhases {
        // The replay describes whole runs with the simplest law, and its estimates are taken.
        replayed_without: replay.is_some(),
        better: paired.is_finite().then(|| BetterLaw {
            residual_ratio: law.relative_residual[1] / law.relative_residual[0],
            standard_errors: paired,
        }),
    };
    reported(law.chosen.terms.clone(), source)
}

/// Whether a term changes friction by less than [`NEGLIGIBLE_TERM`]; a root of speed is never taken for that little.
fn is_negligible(friction: &Friction, (term, amplitude): &(LawTerm, Vec<Estimate>)) -> bool {
    let of = match term {
        LawTerm::ViscousByDirection => friction.viscous,
        LawTerm::NearRest { .. } | LawTerm::Ripple { .. } => friction.coulomb,
        LawTerm::Root | LawTerm::AfterTravel { .. } => None,
        LawTerm::CommandLag => return true,
    };
    let largest = amplitude.iter().take(2).map(|a| a.value.abs()).fold(0.0, f64::max);
    of.is_some_and(|of| largest < NEGLIGIBLE_TERM * of.value)
}
