//! Estimates that the data do not support are taken back.

use crate::identify::estimate::Estimate;
use crate::identify::finding::Severity::Warning;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::judge::evidence::{Chosen, Evidence};
use crate::identify::judge::thresholds::{REFUSED_ERROR, UNCERTAIN_ERROR};

/// Figures that are not known to their own size are taken back.
pub(super) fn refuse_the_unknown(evidence: &Evidence<'_>, chosen: &mut Chosen) -> Vec<Finding> {
    let mut findings = Vec::new();
    let regression = evidence.methods.regression.is_some();
    let Chosen { drive, beam, .. } = chosen;
    let mut look = |name: &'static str, figure: &mut Option<Estimate>, hint: &'static str| {
        let Some(e) = *figure else {
            if !regression {
                // One refusal of the whole regression says it.
                return;
            }
            findings.push(Finding::new(
                "not-separable",
                Severity::Refusal,
                &[name],
                format!("{name} cannot be told from other terms in these runs"),
                hint,
            ));
            return;
        };
        let share = if e.value == 0.0 { f64::INFINITY } else { e.std / e.value.abs() };
        let (code, what) = if e.is_negative() {
            ("negative-figure", "negative: the model does not fit".to_owned())
        } else if share.is_infinite() {
            ("poor-excitation", "with nothing in the runs that shows it".to_owned())
        } else if share > REFUSED_ERROR || share.is_nan() || e.value < 0.0 {
            ("poor-excitation", format!("uncertain by ±{:.0} %: not known", 100.0 * share))
        } else if share > UNCERTAIN_ERROR {
            let message = format!(
                "{name} is known to ±{:.0} % only (one deviation): these motions hardly show it",
                100.0 * share
            );
            findings.push(Finding::new("poor-excitation", Warning, &[name], message, hint));
            return;
        } else {
            return;
        };
        let message = format!("{name} would be {:.4e}, {what}", e.value);
        findings.push(Finding::new(code, Severity::Refusal, &[name], message, hint));
        *figure = None;
    };
    look(key::COULOMB, &mut drive.friction.coulomb, "add slow runs in both directions");
    look(
        key::VISCOUS,
        &mut drive.friction.viscous,
        "add runs at higher speed and larger amplitude",
    );
    look(
        key::INERTIA,
        &mut drive.inertia,
        "add runs with more acceleration: faster sines, larger amplitude",
    );
    if !beam.coupling_by_tip.is_empty() || beam.coupling.is_some() {
        look(key::COUPLING, &mut beam.coupling, "drive it near the beam's resonance");
    }
    for figure in [drive.friction.forward, drive.friction.backward] {
        if let Some(e) = figure.filter(Estimate::is_negative) {
            findings.push(Finding::new(
                "negative-figure",
                Severity::Refusal,
                &[key::COULOMB, key::OFFSET],
                format!(
                    "friction in one direction would be {:.4e}, negative: the model does not fit",
                    e.value
                ),
                "a large load or an offset of a sensor; check units, signs and a camera's origin",
            ));
            drive.friction.coulomb = None;
        }
    }
    if findings.iter().any(|f| f.code == "negative-figure") {
        findings.push(Finding::new(
            "others-doubtful",
            Warning,
            &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING],
            "a figure that must be positive came out negative: the others are doubtful too"
                .to_owned(),
            "the equation does not describe these runs: check signs, units and what acts on the axis",
        ));
    }
    if drive.friction.coulomb.is_none() {
        drive.friction.forward = None;
        drive.friction.backward = None;
        drive.friction.offset = None;
    }
    findings
}
