//! Estimates that the data do not support are taken back.

use crate::identify::estimate::Estimate;
use crate::identify::findings::{EstimateFinding, EstimateUnits, Finding, JudgedParameter};
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::{REFUSED_ERROR, UNCERTAIN_ERROR};

/// Figures that are not known to their own size are taken back.
pub(super) fn refuse_the_unknown(evidence: &Evidence<'_>, chosen: &mut Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    let regression = evidence.methods.regression.is_some();
    let Chosen { drive, beam, .. } = chosen;
    let units = EstimateUnits::new(&evidence.campaign.channels);
    // The logs do not separate Coulomb friction: they show it in one direction at most.
    let one_direction = drive.friction.coulomb.is_none();
    let one_direction_told =
        one_direction && drive.friction.forward.is_some() != drive.friction.backward.is_some();
    let mut look = |parameter: JudgedParameter, figure: &mut Option<Estimate>| {
        let Some(estimate) = *figure else {
            // Without a regression one refusal of all of it is enough.
            if regression && !(one_direction_told && parameter == JudgedParameter::Coulomb) {
                findings.push(EstimateFinding::NotSeparable { parameter });
            }
            return;
        };
        let Estimate { value, std } = estimate;
        let share = if value == 0.0 { f64::INFINITY } else { std / value.abs() };
        let refused = share > REFUSED_ERROR || share.is_nan() || value < 0.0;
        if estimate.is_negative() {
            findings.push(EstimateFinding::NegativeFigure { parameter, estimate, units });
            *figure = None;
        } else if refused || share > UNCERTAIN_ERROR {
            findings.push(EstimateFinding::PoorExcitation { parameter, estimate, units, refused });
            *figure = figure.filter(|_| !refused);
        }
    };
    look(JudgedParameter::Coulomb, &mut drive.friction.coulomb);
    look(JudgedParameter::Viscous, &mut drive.friction.viscous);
    look(JudgedParameter::Inertia, &mut drive.inertia);
    if !beam.coupling_by_tip.is_empty() || beam.coupling.is_some() {
        look(JudgedParameter::Coupling, &mut beam.coupling);
    }
    if findings.iter().any(|f| matches!(f, EstimateFinding::NegativeFigure { .. })) {
        findings.push(EstimateFinding::OthersDoubtful);
    }
    let friction = &mut drive.friction;
    if friction.coulomb.is_none() {
        friction.offset = None;
        // One direction alone tells Coulomb friction and a constant load as one number.
        for one in [&mut friction.forward, &mut friction.backward] {
            *one = one.filter(|e| one_direction && e.std < UNCERTAIN_ERROR * e.value.abs());
        }
        let forward = friction.forward.is_some();
        if let Some(sum) = friction.forward.xor(friction.backward) {
            findings.push(EstimateFinding::FrictionWithLoad { forward, sum, units });
        }
    }
    findings.into_iter().map(Finding::new).collect()
}
