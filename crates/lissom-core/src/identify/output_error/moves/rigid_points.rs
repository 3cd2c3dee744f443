//! Choice between point masses at the tips and independent modes.

use crate::identify::output_error::model::fit::{ArmFit, Report};
use crate::identify::output_error::model::fitting::Fitting;
use crate::replay::Body;

/// Replaces independent modes by point masses at the tips, if that is better.
pub(crate) fn tighten(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let body = Body::of_masses(&fitting.campaign.channels, fit.body.arm.clone());
    if fit.body.masses.is_some() || body.masses.is_none() {
        return;
    }
    let mut tight = ArmFit { body, ..fit.clone() };
    fitting.search(&mut tight, report);
    if fitting.is_better(&tight, fit) {
        *fit = tight;
    }
}
