//! Choice between point masses at the tips and independent modes.

use crate::identify::methods::output_error::engine::coordinates::Body;
use crate::identify::methods::output_error::engine::search::Stop;
use crate::identify::methods::output_error::model::fit::{ArmFit, Report};
use crate::identify::methods::output_error::model::fitting::Fitting;
use crate::identify::methods::output_error::moves::scores::Promised;
use crate::identify::methods::output_error::thresholds::POINT_MASSES_COST;

/// Replaces point masses at the tips by independent modes, if that is expected to lower the cost.
pub(crate) fn relax(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    // Before a search has converged, any coordinate is expected to lower the cost.
    let ended = report.stages.last().is_some_and(|s| s.stop != Stop::StepsUsedUp);
    if fit.body.masses.is_none() || !ended {
        return;
    }
    let free = ArmFit { body: Body::free(fit.body.arm.clone()), ..fit.clone() };
    let promised =
        |fit: &ArmFit| Promised::of(&fitting.point(fit, &fit.free).sums, fit.coordinates());
    if promised(&free).share - promised(fit).share > POINT_MASSES_COST {
        *fit = free;
        fitting.search(fit, report);
    }
}

/// Replaces independent modes by point masses at the tips, if that is better.
pub(crate) fn tighten(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let body = Body::of_masses(fitting.campaign, fit.body.arm.clone());
    if fit.body.masses.is_some() || body.masses.is_none() {
        return;
    }
    let mut tight = ArmFit { body, ..fit.clone() };
    fitting.search(&mut tight, report);
    if fitting.is_better(&tight, fit) {
        *fit = tight;
    }
}
