//! The motor's equation without a beam, where the coupling to the tips is hardly known and spoils the other estimates.

use crate::identify::estimate::Estimate;
use crate::identify::findings::{BeamFinding, EstimateUnits, Finding};
use crate::identify::methods::regression::thresholds::{COUPLING_HARDLY_KNOWN, RIGID_LEAVES};
use crate::identify::methods::regression::{MotorRegression, motor_regression};
use crate::identify::options::Options;
use crate::identify::prepare::prepared::Prepared;

/// The prepared runs with tips that give no angle, the regression of these, and a finding that says so. `None` where the
/// coupling is known or surely negative, or the equation without it leaves more of the torque.
pub(crate) fn rigid_equation<'a>(
    prepared: &Prepared<'a>,
    options: &Options,
    regression: &MotorRegression,
) -> Option<(Prepared<'a>, MotorRegression, Finding)> {
    // One that is surely negative is of a tip whose sign is reversed.
    let coupling = regression.total_coupling.filter(|c| !c.is_negative())?;
    let known = |e: Estimate| e.value > 0.0 && e.std < COUPLING_HARDLY_KNOWN * e.value;
    if known(coupling) {
        return None;
    }
    let mut used = prepared.used().clone();
    used.channels.tips.iter_mut().for_each(|tip| tip.calibrated = false);
    let rigid = prepared.using(used);
    let found = motor_regression(&rigid, options)?;
    let residual_shares = [regression.relative_residual, found.relative_residual];
    let holds = residual_shares[1] < RIGID_LEAVES * residual_shares[0];
    let units = EstimateUnits::new(&prepared.campaign().channels);
    let finding = BeamFinding::RigidEquation { coupling, units, residual_shares };
    holds.then(|| (rigid, found, Finding::new(finding)))
}
