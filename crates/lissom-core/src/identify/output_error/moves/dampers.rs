//! Choice between the kinds of damping.

use crate::identify::output_error::engine::covariance::standard_error;
use crate::identify::output_error::model::fit::{ArmFit, Report};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::thresholds::SIGN_SHOWN;
use crate::replay::Parameter;

/// Replaces the damping of each mode against the frame by dampers at the tips' points, if that is better.
///
/// Single dampers of the two kinds can hardly be distinguished, but all of them together can. The dampers at points
/// are tried with damping within the beam and without it: it can partly replace the difference between the two kinds.
pub(crate) fn dampers_at_points(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let grounded = |p: &Parameter| matches!(p, Parameter::DampingGrounded(_));
    let within = |p: &Parameter| matches!(p, Parameter::DampingWithin(_));
    let modes = fit.body.arm.modes.len();
    let possible = fit.body.arm.shapes.len() == modes && fit.free.iter().any(grounded);
    if !possible {
        return;
    }
    let mut other = fit.clone();
    other.free.retain(|p| !grounded(p));
    let arm = &mut other.body.arm;
    let mean = arm.modes.iter().map(|m| m.grounded_per_s).sum::<f64>() / modes as f64;
    arm.modes.iter_mut().for_each(|m| m.grounded_per_s = 0.0);
    arm.at_points_per_s = vec![mean.max(0.0); modes];
    let points = (0..modes).map(Parameter::DampingAtPoint);
    other.free.extend(points.filter(|p| !fit.free.contains(p)));
    let mut alone = other.clone();
    let mut take = |mut other: ArmFit| {
        fitting.search(&mut other, report);
        if fitting.is_better(&other, fit) {
            *fit = other;
        }
    };
    take(other);
    if alone.free.extract_if(.., |p| within(p)).count() > 0 {
        alone.body.arm.modes.iter_mut().for_each(|m| m.within_per_s = 0.0);
        take(alone);
    }
}

/// Removes a kind of dampers of which none is significantly above zero, if the fit is better without it. Where the
/// logs do not distinguish two kinds, a damper of one kind may replace those of the other.
pub(crate) fn drop_dampers(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let kinds: [fn(&Parameter) -> bool; 3] = [
        |p| matches!(p, Parameter::DampingWithin(_)),
        |p| matches!(p, Parameter::DampingGrounded(_)),
        |p| matches!(p, Parameter::DampingAtPoint(_)),
    ];
    if kinds.iter().filter(|kind| fit.free.iter().any(kind)).count() < 2 {
        return;
    }
    let covariance = fitting.covariances(fit).larger();
    let nothing = |kind: &fn(&Parameter) -> bool| {
        let mut own = fit.free.iter().enumerate().filter(|(_, p)| kind(p));
        own.all(|(i, p)| p.of(&fit.body.arm) < SIGN_SHOWN * standard_error(&covariance, i))
    };
    let Some(gone) = kinds.iter().find(|kind| fit.free.iter().any(kind) && nothing(kind)) else {
        return;
    };
    let mut without = fit.clone();
    let dropped: Vec<Parameter> = without.free.extract_if(.., |p| gone(p)).collect();
    for p in &dropped {
        p.set(&mut without.body.arm, 0.0);
    }
    // The others may be negative to compensate for them, and a replay would diverge.
    for p in without.free.iter().filter(|p| kinds.iter().any(|kind| kind(p))) {
        let least = p.of(&without.body.arm).max(0.0);
        p.set(&mut without.body.arm, least);
    }
    fitting.search(&mut without, report);
    if fitting.is_better(&without, fit) {
        *fit = without;
    }
}
