//! Order of the steps, from a starting arm on short windows to an arm identified from whole runs.
//!
//! 1. Starting arms, the likelier first ([`best`]).
//! 2. Short windows ([`begin`]): search, modes, significant parameters. An arm that does not describe short windows is
//!    given up.
//! 3. Longer and longer windows ([`widen`]), until they are whole runs or the residual grows.
//! 4. Choice of modes, dampers and point masses ([`settle`]); sensors' steps are counted as steps.
//! 5. A slower repetition if the search may have ended in a wrong minimum ([`again`]).

use crate::identify::output_error::engine::data::Masks;
use crate::identify::output_error::engine::windows::widen as widened;
use crate::identify::output_error::found::OutputErrorStart;
use crate::identify::output_error::model::describes::{accepted_residual, is_left, is_sound};
use crate::identify::output_error::model::fit::{ArmFit, Report};
use crate::identify::output_error::model::fitting::{Fitting, some};
use crate::identify::output_error::model::left_over::left_over;
use crate::identify::output_error::moves::dampers::{dampers_at_points, drop_dampers};
use crate::identify::output_error::moves::extend::{add_terms, drop_lags, extend};
use crate::identify::output_error::moves::modes;
use crate::identify::output_error::moves::rigid_points::tighten;
use crate::identify::output_error::thresholds::{
    PROBE_STEPS, RESIDUAL_AT_NOISE, RESIDUAL_FAR_ABOVE_NOISE, START_COST_FAR, STARTS_ALIKE,
    WINDOW_WIDENING, WINDOW_WIDENING_SLOW,
};
use crate::replay::{Body, ModalArm, Oscillator, Parameter};

/// Result of a search from one starting arm.
pub(super) struct Attempt {
    pub(super) fit: ArmFit,
    pub(super) report: Report,
    /// Samples that are used if readings that only repeat a step of their sensor are left out.
    pub(super) without_repeats: Option<Vec<Masks>>,
    /// Share of each channel's squared residual, motor first, that is slower than its sensor's noise.
    pub(super) left: Vec<f64>,
}

/// The first attempt that describes the runs; if none does, the closest one. It is repeated with slower widening, and
/// from other frequencies of the highest mode, if it ended in a wrong minimum.
pub(super) fn best(fitting: &Fitting<'_>, start: &OutputErrorStart) -> Option<Attempt> {
    let mut best: Option<Attempt> = None;
    for arm in likely_first(fitting, start) {
        let Some(found) = attempt(fitting, &arm, start.first_window_s) else { continue };
        let stands = found.stands(fitting);
        if stands || best.as_ref().is_none_or(|b| found.nearness(fitting) > b.nearness(fitting)) {
            best = Some(found);
        }
        if stands || fitting.budget.is_spent() {
            break;
        }
    }
    Some(again(fitting, best?, start.first_window_s))
}

/// Orders the starting arms. Those whose cost after a short search is far above the best one's go last, in the order
/// of that cost: a search from there takes long and ends elsewhere. All short searches are on the same short windows.
/// An arm that its short search brings to the modes of an earlier arm is left out.
fn likely_first(fitting: &Fitting<'_>, start: &OutputErrorStart) -> Vec<ModalArm> {
    if start.arms.len() < 2 {
        return start.arms.clone();
    }
    let window_s = |arm: &ModalArm| fitting.first_window_s(arm);
    let shortest = start.arms.iter().map(window_s).fold(f64::INFINITY, f64::min);
    let window_s = start.first_window_s.unwrap_or(shortest);
    let probed = |arm: &ModalArm| {
        let found =
            fitting.first_fit(arm, window_s).and_then(|fit| fitting.probe(&fit, PROBE_STEPS));
        found.map_or((f64::INFINITY, arm.clone()), |(cost, body)| (cost, body.arm))
    };
    let probed: Vec<(f64, ModalArm)> = start.arms.iter().map(probed).collect();
    let near = START_COST_FAR * probed.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let mut order: Vec<usize> = (0..probed.len()).collect();
    let rank = |i: &usize| if probed[*i].0 <= near { 0.0 } else { probed[*i].0 };
    order.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
    let mut kept: Vec<usize> = Vec::new();
    for i in order {
        if !kept.iter().any(|k| are_alike(&probed[*k].1, &probed[i].1)) {
            kept.push(i);
        }
    }
    kept.into_iter().map(|i| start.arms[i].clone()).collect()
}

/// Whether two arms have the same lag, modes, and terms of friction.
fn are_alike(a: &ModalArm, b: &ModalArm) -> bool {
    let near = |(p, q): (&Oscillator, &Oscillator)| {
        (p.omega_rad_s / q.omega_rad_s - 1.0).abs() < STARTS_ALIKE
            && (p.stiffness_nm_per_rad / q.stiffness_nm_per_rad - 1.0).abs() < STARTS_ALIKE
    };
    let lag_s = a.command_lag_s.abs().max(b.command_lag_s.abs());
    a.dry_terms.numbers() == b.dry_terms.numbers()
        && (a.command_lag_s - b.command_lag_s).abs() <= STARTS_ALIKE * lag_s
        && a.modes.len() == b.modes.len()
        && a.modes.iter().zip(&b.modes).all(near)
}

/// Searches from a starting arm to whole runs and the sensors' steps. Ends at the first windows if these show that
/// the arm does not describe the runs: on longer windows the residual is larger.
fn attempt(fitting: &Fitting<'_>, arm: &ModalArm, first_window_s: Option<f64>) -> Option<Attempt> {
    let mut report = Report::default();
    let window_s = first_window_s.unwrap_or_else(|| fitting.first_window_s(arm));
    let fit = begin(fitting, arm, window_s, &mut report)?;
    if fitting.beyond_noise(&fit) > RESIDUAL_FAR_ABOVE_NOISE {
        let left = vec![0.0; fit.noise.len()];
        return Some(Attempt { fit, report, without_repeats: None, left });
    }
    Some(go_on(fitting, fit, report))
}

/// Searches on the first windows, which are short, with point masses at the tips where these are possible, and with free modes if
/// that is better; `None` if no window can be cut.
fn begin(
    fitting: &Fitting<'_>,
    arm: &ModalArm,
    window_s: f64,
    report: &mut Report,
) -> Option<ArmFit> {
    let mut fit = fitting.first_fit(arm, window_s)?;
    let mut free = ArmFit { body: Body::free(arm.clone()), ..fit.clone() };
    fitting.search(&mut fit, report);
    if fit.body.masses.is_some() {
        fitting.search(&mut free, report);
        if fitting.is_better(&free, &fit) {
            fit = free;
        }
    }
    make(complete, fitting, &mut fit, report);
    Some(fit)
}

/// Adds what the residual shows: as many modes as tips, then lags and kinds of damping, which are simpler than the further modes
/// that follow, and last terms of friction.
fn complete(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    make(modes::grow_to_tips, fitting, fit, report);
    make(extend, fitting, fit, report);
    make(modes::grow, fitting, fit, report);
    make(add_terms, fitting, fit, report);
}

/// A step of the schedule.
type Move = fn(&Fitting<'_>, &mut ArmFit, &mut Report);

/// Makes a step, unless all evaluations allowed are made.
fn make(step: Move, fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    if !fitting.budget.is_spent() {
        step(fitting, fit, report);
    }
}

/// Lengthens the windows to whole runs, as far as the arm describes them and neighbouring motions do not grow apart.
/// Parameters are added if the residual grows.
fn widen(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    if fit.command_noise > 0.0 {
        if !fit.whole_runs {
            fitting.take_all(fit, report);
        }
        return;
    }
    let longest = fitting.longest_s();
    let mut factor = fitting.widening;
    while !fit.whole_runs && !fitting.budget.is_spent() {
        let (before, added) = (fit.clone(), report.added.len());
        fit.window_s = (fit.window_s * factor).min(longest);
        fit.whole_runs = fit.window_s >= longest;
        let windows = widened(fitting.campaign, &fit.body.arm, &fit.windows, fit.window_s);
        fit.windows = if fit.whole_runs { windows } else { some(windows) };
        fitting.search(fit, report);
        if report.grown(&fit.residual) {
            make(complete, fitting, fit, report);
        }
        let diverges = fitting.diverges(fit);
        if report.grown(&fit.residual) || diverges {
            *fit = before;
            report.added.truncate(added);
            let at_noise = fitting.beyond_noise(fit) <= RESIDUAL_AT_NOISE;
            if factor < WINDOW_WIDENING || !at_noise {
                let lawful = !fit.body.arm.dry_terms.is_empty();
                if diverges && at_noise && lawful {
                    fitting.take_all(fit, report);
                }
                return;
            }
            // The arm describes the shorter windows to the noise: this search ended in a wrong minimum.
            factor = WINDOW_WIDENING_SLOW;
        }
    }
}

/// Continues to whole runs and the sensors' steps.
fn go_on(fitting: &Fitting<'_>, mut fit: ArmFit, mut report: Report) -> Attempt {
    make(widen, fitting, &mut fit, &mut report);
    make(modes::drop_impossible, fitting, &mut fit, &mut report);
    make(modes::grow, fitting, &mut fit, &mut report);
    make(modes::drop_impossible, fitting, &mut fit, &mut report);
    make(modes::lighten, fitting, &mut fit, &mut report);
    make(settle, fitting, &mut fit, &mut report);
    // Whatever the search had time for, no mode is given that the motor is not known to show.
    modes::lighten(fitting, &mut fit, &mut report);
    let without_repeats = fitting.count_steps(&mut fit, &mut report);
    let left = left_over(fitting.campaign, &fit, fitting.masks);
    Attempt { fit, report, without_repeats, left }
}

/// Chooses the kinds of dampers, and between point masses and independent modes.
fn settle(fitting: &Fitting<'_>, fit: &mut ArmFit, report: &mut Report) {
    let dampers = |fit: &ArmFit| {
        fit.free.iter().copied().filter(|p| p.is_damper()).collect::<Vec<Parameter>>()
    };
    make(tighten, fitting, fit, report);
    fit.body.allow_dampers_at_points();
    let added = report.added.len();
    make(extend, fitting, fit, report);
    if report.added.len() > added {
        // The arm may now describe longer windows.
        make(widen, fitting, fit, report);
    }
    let before = dampers(fit);
    make(dampers_at_points, fitting, fit, report);
    make(drop_dampers, fitting, fit, report);
    if dampers(fit) != before {
        // Without the earlier dampers the modes may be those of point masses, and the arm may describe longer
        // windows.
        make(tighten, fitting, fit, report);
        make(widen, fitting, fit, report);
    }
    make(drop_lags, fitting, fit, report);
}

/// Repeats the search with slower widening, if it ended in a wrong minimum: the residual is above the noise. Returns the best
/// result.
fn again(fitting: &Fitting<'_>, first: Attempt, first_window_s: Option<f64>) -> Attempt {
    let mut best = first;
    if fitting.budget.is_spent()
        || !best.fit.whole_runs
        || !is_left(&best.left, best.fit.command_noise)
    {
        return best;
    }
    let slowly = Fitting { widening: WINDOW_WIDENING_SLOW, ..*fitting };
    for arm in modes::starts_again(fitting, &best.fit) {
        let Some(other) = attempt(&slowly, &arm, first_window_s) else { continue };
        if other.fit.whole_runs && best.is_worse(fitting, &other) {
            best = other;
        }
        if fitting.budget.is_spent() || !is_left(&best.left, best.fit.command_noise) {
            break;
        }
    }
    best
}

impl Attempt {
    fn stands(&self, fitting: &Fitting<'_>) -> bool {
        let covariance = fitting.covariances(&self.fit).larger();
        is_sound(&self.fit.body.arm, &covariance)
            && fitting.beyond_noise(&self.fit) < accepted_residual(self.fit.whole_runs)
            && fitting.sees_modes(&self.fit)
    }

    /// Whether another is better over the same samples.
    fn is_worse(&self, fitting: &Fitting<'_>, other: &Self) -> bool {
        let masks = self.without_repeats.as_deref().unwrap_or(fitting.masks);
        Fitting { masks, ..*fitting }.is_better(&other.fit, &self.fit)
    }

    /// Order of attempts that do not describe the runs: whole runs come first, then smaller residuals.
    fn nearness(&self, fitting: &Fitting<'_>) -> (bool, f64) {
        (self.fit.whole_runs, -fitting.beyond_noise(&self.fit))
    }
}
