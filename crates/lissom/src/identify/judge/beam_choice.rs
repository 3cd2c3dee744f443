//! Modes of the beam: which method's are taken.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::ModeEstimate;
use crate::identify::findings::{BeamFinding, Finding};
use crate::identify::identified::Beam;
use crate::identify::judge::evidence::Evidence;
use crate::identify::judge::thresholds::MODEL_MISFIT;
use crate::identify::judge::thresholds::TIPS_COMPLETE;
use crate::identify::methods::regression::BeamRegression;

/// Whether the beam's equations on the measured tips explain their motion.
pub(super) fn complete(r: &BeamRegression) -> bool {
    r.relative_residual.iter().all(|left| *left < TIPS_COMPLETE)
}

/// The beam beside the drive's estimates, which its coupling is of: modes of the output error where that is taken,
/// else of the beam's regression, else of its tips' responses.
pub(super) fn choose(evidence: &Evidence<'_>, drive: &DriveEstimates) -> Beam {
    let of_coupling = |modes: Vec<ModeEstimate>| Beam {
        modes,
        coupling: drive.coupling,
        coupling_by_tip: drive.coupling_by_tip.clone(),
    };
    if let Some(oe) = evidence.replay().filter(|oe| !oe.arm.modes.is_empty()) {
        return of_coupling(oe.mode_estimates());
    }
    let methods = evidence.methods;
    let tips = evidence.campaign.channels.tips.len();
    let fitted = methods.beam_model.as_ref().map_or(&[][..], |b| &b.modes[..]);
    of_coupling(match &methods.beam_regression {
        // As many equations as tips: where they leave nothing there are no further modes.
        Some(r) if fitted.len() <= tips || complete(r) => r.modes.clone(),
        _ => fitted.to_vec(),
    })
}

/// What is missing of the beam.
pub(super) fn findings(evidence: &Evidence<'_>, beam: &Beam) -> Vec<Finding> {
    let mut found = Vec::new();
    let tips = evidence.campaign.channels.tips.len();
    if evidence.replay().is_some_and(|oe| !oe.arm.modes.is_empty()) {
        return found;
    }
    if beam.modes.is_empty() && tips > 0 && !evidence.has_only_constant_velocities() {
        found.push(Finding::new(BeamFinding::ModesNotFound));
    }
    let model = evidence.methods.motor_model.as_ref();
    if tips == 0
        && let Some(model) = model.filter(|m| m.weighted_rms < MODEL_MISFIT)
        && let Some(pole) = model.poles.first()
    {
        let omega_rad_s = pole.omega_rad_s;
        found.push(Finding::new(BeamFinding::FlexibleWithoutTip { omega_rad_s }));
    }
    found
}
