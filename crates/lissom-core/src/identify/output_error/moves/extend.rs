//! Lags and kinds of damping, added if the residual shows them.

use crate::identify::output_error::engine::covariance::standard_error;
use crate::identify::output_error::model::fit::{ArmFit, Extension, Report};
use crate::identify::output_error::model::fitting::Fitting;
use crate::identify::output_error::moves::dampers::drop_dampers;
use crate::identify::output_error::moves::scores::{Promise, all_scores};
use crate::identify::output_error::thresholds::{
    GROUP_SHARE_LARGE, GROUPS_ADDED_MOST, PARAMETER_SHARE_LEAST, RESIDUAL_ABOVE_NOISE,
};
use crate::identify::thresholds::CLEARLY_PRESENT;
use crate::record::TipQuantity;
use crate::replay::Parameter;

/// Adds groups of parameters that are significant, each time the one that lowers the cost most.
pub(crate) fn extend(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    for _ in 0..GROUPS_ADDED_MOST {
        if fitting.budget.is_spent() {
            return;
        }
        let mut found = all_scores(fitting, fit, &candidates(fitting, fit)).1;
        let called_for = |(_, promise): &(usize, &Promise)| {
            let stands = |e: &Extension| e.value.abs() > CLEARLY_PRESENT * e.std;
            let stand = promise.group.iter().any(stands) || promise.stands_together();
            promise.share() > GROUP_SHARE_LARGE
                || (promise.share() > PARAMETER_SHARE_LEAST && stand)
        };
        let best = found.iter().enumerate().filter(called_for);
        let best = best.max_by(|a, b| a.1.share().total_cmp(&b.1.share())).map(|(k, _)| k);
        let added = best.map(|k| found.remove(k).group);
        report.refused = found.into_iter().flat_map(|promise| promise.group).collect();
        let Some(added) = added else { break };
        fit.free.extend(added.iter().map(|e| e.parameter));
        report.added.extend(added.into_iter().map(|e| Extension { added: true, ..e }));
        fitting.search(fit, report);
        drop_dampers(fitting, fit, report);
    }
}

/// Adds terms of friction that slip phases hardly show, if the residual is above the noise and the arm is better with them.
pub(crate) fn add_terms(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    for term in fitting.further_terms {
        let spent = fitting.budget.is_spent();
        if spent || fitting.beyond_noise(fit) < RESIDUAL_ABOVE_NOISE {
            return;
        }
        if term.is_in(&fit.body.arm.dry_terms) {
            continue;
        }
        let mut with = fit.clone();
        let before = with.body.arm.dry_terms.numbers();
        term.put_into(&mut with.body.arm.dry_terms, &[0.0; 2]);
        let all = with.body.arm.dry_terms.numbers().into_iter();
        with.free.extend(all.filter(|n| !before.contains(n)).map(Parameter::Friction));
        fitting.search(&mut with, report);
        if fitting.is_better(&with, fit) {
            *fit = with;
        }
    }
}

/// Removes lags that are not significant, unless the fit is better with them: a lag may have been significant only before the arm
/// was found.
pub(crate) fn drop_lags(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let covariance = fitting.covariances(fit).larger();
    let is_nothing = |(i, p): (usize, &Parameter)| {
        let lag = matches!(p, Parameter::TipLag(_) | Parameter::CommandLag);
        let stands = p.of(&fit.body.arm).abs() > CLEARLY_PRESENT * standard_error(&covariance, i);
        (lag && !stands).then_some(*p)
    };
    let gone: Vec<Parameter> = fit.free.iter().enumerate().filter_map(is_nothing).collect();
    if gone.is_empty() {
        return;
    }
    let mut without = fit.clone();
    without.free.retain(|p| !gone.contains(p));
    for p in &gone {
        p.set(&mut without.body.arm, 0.0);
    }
    fitting.search(&mut without, report);
    if !fitting.is_better(fit, &without) {
        *fit = without;
        report.added.retain(|e| !gone.contains(&e.parameter));
    }
}

/// Groups of parameters that may be added, each as a whole. Lags of tips are among them if the residual is above the
/// noise.
pub(crate) fn candidates(fitting: &Fitting<'_>, fit: &ArmFit) -> Vec<Vec<Parameter>> {
    let arm = &fit.body.arm;
    let modes = 0..arm.modes.len();
    let mut groups = vec![vec![Parameter::CommandLag]];
    groups.push(modes.clone().map(Parameter::DampingWithin).collect());
    groups.push(if arm.at_points_per_s.is_empty() {
        modes.map(Parameter::DampingGrounded).collect()
    } else {
        modes.map(Parameter::DampingAtPoint).collect()
    });
    if fitting.beyond_noise(fit) >= RESIDUAL_ABOVE_NOISE {
        let tips = fitting.campaign.channels.tips.iter().enumerate();
        let shows = tips.filter(|(_, tip)| tip.quantity != TipQuantity::Acceleration);
        groups.push(shows.map(|(i, _)| Parameter::TipLag(i)).collect());
    }
    for group in &mut groups {
        group.retain(|p| !fit.free.contains(p));
    }
    groups.retain(|group| !group.is_empty());
    groups
}
