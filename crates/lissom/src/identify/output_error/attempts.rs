//! One search after another, from this arm and from that, until one comes to an arm that describes the
//! runs.

use super::data::Masks;
use super::figures::{BEYOND, stands};
use super::left_over::left_over;
use super::stages::{Fit, Fitting, Laws, Report, SLOWER, STEPS_OF_A_PROBE};
use super::{AT_NOISE, OutputErrorStart};
use super::{evidence, law, modes};
use crate::replay::{ModalArm, Oscillator, Parameter};

/// An arm is tried after the others where a few steps on short windows leave this many times what they
/// leave from the best.
const FAR: f64 = 3.0;
/// Steps of a probe with bristles, which ask for more than others.
const STEPS_ON_BRISTLES: usize = 20;
/// Modes are the same to this share.
const ALIKE: f64 = 0.05;
/// Share of a channel's squared residual that is slower than its sensor's noise, from which on the arm
/// has not all that moves.
const LEFT: f64 = 0.003;

/// Cost on short windows, beside that of a joint that sticks, with which bristles are worth a search: a few steps
/// do not bring them all the way.
const NO_MORE: f64 = 2.0;

/// Where a search has come to.
pub(super) struct Attempt {
    pub(super) fit: Fit,
    pub(super) report: Report,
    /// The samples that count where some only repeat a step of their sensor.
    pub(super) without_repeats: Option<Vec<Masks>>,
    /// Share of each channel's squared residual, motor first, that is slower than what its sensor adds.
    pub(super) left: Vec<f64>,
}

/// The first attempt that describes the runs, else the one that comes nearest. Where more than the
/// sensors' noise is left it is made again more slowly, from other frequencies of the highest mode, too. A joint
/// that sticks is put on bristles where it does not describe the runs to the noise.
/// Where no other law of friction describes the runs either: one under the simplest law.
pub(super) fn best(fitting: &Fitting<'_>, start: &OutputErrorStart) -> Option<Attempt> {
    let arms = likely_first(fitting, start);
    let mut best: Option<Attempt> = None;
    let mut tried = false;
    for (i, arm) in arms.iter().enumerate() {
        let Some(mut found) = attempt(fitting, arm, start.first_window_s) else { continue };
        if best.is_none() {
            if !found.is_at_noise(fitting) && !found.leaves_noise(fitting) {
                tried = true;
                found = by_another_law(fitting, found, arm, start.first_window_s);
            }
            if i + 1 == arms.len() {
                // There is no other: whether it stands takes a replay to tell.
                best = Some(found);
                break;
            }
        }
        let stands = found.stands(fitting);
        if stands || best.as_ref().is_none_or(|b| found.nearness(fitting) > b.nearness(fitting)) {
            best = Some(found);
        }
        if stands {
            break;
        }
    }
    let mut found = again(fitting, best?, start.first_window_s);
    if !tried && is_left(&found.left) {
        found = by_another_law(fitting, found, &arms[0], start.first_window_s);
    }
    let lawful = !found.fit.body.arm.dry_terms.is_empty();
    if !lawful || found.stands(fitting) {
        return Some(found);
    }
    // Terms that do not describe the runs bend every figure: which run does not fit the others is seen
    // under the simplest law.
    let plainly = Fitting { laws: Laws::AsStarted, ..*fitting };
    let plain = arms.iter().find(|arm| arm.dry_terms.is_empty());
    plain.and_then(|arm| attempt(&plainly, arm, start.first_window_s)).or(Some(found))
}

/// Whether some channel's share is more than its sensor's noise leaves.
pub(super) fn is_left(shares: &[f64]) -> bool {
    most(shares) > LEFT
}

/// The arms to start from. Those go last, the farther the later, from which a few steps on the same short
/// windows come nowhere near what they come to from the best: a search from there takes long and ends
/// elsewhere. One that these steps bring to the modes of an arm before it is none of its own.
fn likely_first(fitting: &Fitting<'_>, start: &OutputErrorStart) -> Vec<ModalArm> {
    if start.arms.len() < 2 {
        return start.arms.clone();
    }
    let window_s = |arm: &ModalArm| fitting.first_window_s(arm);
    let shortest = start.arms.iter().map(window_s).fold(f64::INFINITY, f64::min);
    let window_s = start.first_window_s.unwrap_or(shortest);
    let probed = |arm: &ModalArm| {
        let found =
            fitting.first_fit(arm, window_s).and_then(|fit| fitting.probe(&fit, STEPS_OF_A_PROBE));
        found.map_or((f64::INFINITY, arm.clone()), |(cost, body)| (cost, body.arm))
    };
    let probed: Vec<(f64, ModalArm)> = start.arms.iter().map(probed).collect();
    let near = FAR * probed.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
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

/// Whether two arms have the same modes, and both or neither a law of friction beyond the simplest.
fn are_alike(a: &ModalArm, b: &ModalArm) -> bool {
    let near = |(p, q): (&Oscillator, &Oscillator)| {
        (p.omega_rad_s / q.omega_rad_s - 1.0).abs() < ALIKE
            && (p.stiffness_nm_per_rad / q.stiffness_nm_per_rad - 1.0).abs() < ALIKE
    };
    a.dry_terms.is_empty() == b.dry_terms.is_empty()
        && a.modes.len() == b.modes.len()
        && a.modes.iter().zip(&b.modes).all(near)
}

/// From an arm to one that whole runs and the sensors' steps have shaped.
fn attempt(fitting: &Fitting<'_>, arm: &ModalArm, first_window_s: Option<f64>) -> Option<Attempt> {
    let (fit, report) = begin(fitting, arm, first_window_s)?;
    Some(go_on(fitting, fit, report))
}

/// From an arm to one that the first windows have shaped.
fn begin(
    fitting: &Fitting<'_>,
    arm: &ModalArm,
    first_window_s: Option<f64>,
) -> Option<(Fit, Report)> {
    let mut report = Report::default();
    let window_s = first_window_s.unwrap_or_else(|| fitting.first_window_s(arm));
    let fit = fitting.begin(arm, window_s, &mut report)?;
    Some((fit, report))
}

/// On to whole runs and the sensors' steps.
fn go_on(fitting: &Fitting<'_>, mut fit: Fit, mut report: Report) -> Attempt {
    fitting.widen(&mut fit, &mut report);
    modes::grow(fitting, &mut fit, &mut report);
    modes::undamp(fitting, &mut fit, &mut report);
    settle(fitting, &mut fit, &mut report);
    while let Some(mut joined) = modes::twins_joined(fitting, &fit, &mut report) {
        settle(fitting, &mut joined, &mut report);
        if !modes::leaves_no_more(fitting, &joined, &fit) {
            break;
        }
        fit = joined;
    }
    if modes::prune(fitting, &mut fit, &mut report) {
        settle(fitting, &mut fit, &mut report);
        fitting.widen(&mut fit, &mut report);
        report.refused = evidence::promises(fitting, &fit).concat();
    }
    let line = law::as_line(fitting, &fit);
    let mut without_repeats = fitting.count_steps(&mut fit, &mut report);
    if let Some((mut line, mut on_the_way)) = line {
        let masks = fitting.count_steps(&mut line, &mut on_the_way);
        // Where sensors' steps count: before, a fit with more to move follows them.
        if law::is_line(fitting, &fit, &line) {
            (fit, without_repeats) = (line, masks);
            report.replaced_by(on_the_way, &fit.free);
        }
    }
    let left = left_over(fitting.campaign, &fit, fitting.masks);
    Attempt { fit, report, without_repeats, left }
}

/// Which kinds of dampers there are, and whether the beam is one of point masses.
fn settle(fitting: &Fitting<'_>, fit: &mut Fit, report: &mut Report) {
    let dampers =
        |fit: &Fit| fit.free.iter().copied().filter(|p| p.is_damper()).collect::<Vec<Parameter>>();
    evidence::tighten(fitting, fit, report);
    fit.body.allow_dampers_at_points();
    let added = report.added.len();
    evidence::extend(fitting, fit, report);
    if report.added.len() > added {
        // It may describe longer windows.
        fitting.widen(fit, report);
    }
    let before = dampers(fit);
    evidence::dampers_at_points(fitting, fit, report);
    evidence::drop_dampers(fitting, fit, report);
    if dampers(fit) != before {
        // Modes that made up for the dampers that there were may be those of point masses now, and longer windows
        // may be described.
        evidence::tighten(fitting, fit, report);
        fitting.widen(fit, report);
    }
    evidence::drop_tip_lags(fitting, fit, report);
    evidence::relax(fitting, fit, report);
}

/// The same once more where its search was caught, if a slower one comes to less: where more than the sensors'
/// noise is left, or the highest mode is so faint that at a wrong frequency it would leave hardly more.
fn again(fitting: &Fitting<'_>, first: Attempt, first_window_s: Option<f64>) -> Attempt {
    let mut best = first;
    let caught = is_left(&best.left);
    // On bristles a replay takes many times as long.
    let faint = || {
        best.fit.body.arm.dry_terms.bristles.is_none()
            && modes::highest_is_faint(fitting, &best.fit)
    };
    if !best.fit.whole_runs || !(caught || faint()) {
        return best;
    }
    // Not for another law: that has had its trial.
    let slowly = Fitting { widening: SLOWER, laws: Laws::AsStarted, ..*fitting };
    for arm in modes::starts_again(fitting, &best.fit) {
        let Some(other) = attempt(&slowly, &arm, first_window_s) else { continue };
        let better = if caught {
            most(&other.left) < most(&best.left)
        } else {
            best.leaves_more(fitting, &other)
        };
        if other.fit.whole_runs && better {
            best = other;
        }
        if caught && !is_left(&best.left) {
            break;
        }
    }
    best
}

/// What describes the runs where an attempt does not to the noise: a law of friction whose terms need only be likelier
/// than none, with which nothing is left, or bristles. Else that attempt.
fn by_another_law(
    fitting: &Fitting<'_>,
    found: Attempt,
    began_with: &ModalArm,
    first_window_s: Option<f64>,
) -> Attempt {
    if let Some(lawful) = by_likelier_law(fitting, &found, first_window_s) {
        return lawful;
    }
    let Some(yields) = on_bristles(fitting, &found, began_with, first_window_s) else {
        return found;
    };
    let better = if found.is_at_noise(fitting) {
        yields.fit.whole_runs && !is_left(&yields.left)
    } else {
        !found.stands(fitting) || yields.nearness(fitting) > found.nearness(fitting)
    };
    if better { yields } else { found }
}

/// Under such a law from where an attempt was on short windows. `None` where it leaves more than noise; beside an attempt
/// that stands also where it does not describe whole runs, or not all of its terms stand out.
fn by_likelier_law(
    fitting: &Fitting<'_>,
    found: &Attempt,
    first_window_s: Option<f64>,
) -> Option<Attempt> {
    let likelier = Fitting { laws: Laws::Likelier, ..*fitting };
    // With a term that was tried there and not taken, perhaps: it has to stand out in the end.
    let start = modes::undamped(found.report.on_first_windows()?.arm.clone());
    let lawful = attempt(&likelier, &start, first_window_s)?;
    let describes = lawful.stands(fitting) && !is_left(&lawful.left);
    // It says no more than one that stands unless it describes whole runs, with terms that are there for certain.
    let says_more =
        || lawful.is_at_noise(fitting) && evidence::terms_stand_out(fitting, &lawful.fit);
    (describes && (!found.stands(fitting) || says_more())).then_some(lawful)
}

/// An arm on bristles that stands, beside an attempt whose joint sticks: from where that was on short windows and
/// from the arm that it began with, by the bristles that a few steps on such windows promise most from, and with two
/// modes that these bring to one frequency taken for one. Not where the steps come to more than the joint that sticks
/// does there, or such windows are not described on bristles either.
fn on_bristles(
    fitting: &Fitting<'_>,
    sticks: &Attempt,
    began_with: &ModalArm,
    first_window_s: Option<f64>,
) -> Option<Attempt> {
    let first = sticks.report.on_first_windows()?;
    let arm = &first.arm;
    let probed = |arm: ModalArm| {
        let fit = fitting.first_fit(&arm, first.window_s)?;
        let (cost, body) = fitting.probe(&fit, STEPS_ON_BRISTLES)?;
        Some((cost, body.arm))
    };
    let least = probed(arm.clone())?.0;
    let bristled = [arm, began_with].into_iter().flat_map(|a| law::bristled(fitting.campaign, a));
    let (cost, arm) = bristled.filter_map(probed).min_by(|a, b| a.0.total_cmp(&b.0))?;
    if cost > NO_MORE * least {
        return None;
    }
    let joined = modes::joined(&fitting.first_fit(&arm, first.window_s)?);
    let arm = joined.map_or(arm, |fit| fit.body.arm);
    let (fit, report) = begin(fitting, &arm, first_window_s)?;
    let describes = fitting.beyond_noise(&fit) < BEYOND;
    describes.then(|| go_on(fitting, fit, report)).filter(|found| found.stands(fitting))
}

impl Attempt {
    /// Whether it leaves of whole runs little beside what the sensors add.
    fn is_at_noise(&self, fitting: &Fitting<'_>) -> bool {
        self.fit.whole_runs && fitting.beyond_noise(&self.fit) < AT_NOISE
    }

    /// Whether it describes whole runs and leaves nothing that is slower than what the sensors add, be that more than
    /// their samples show by themselves: no other friction leaves less.
    fn leaves_noise(&self, fitting: &Fitting<'_>) -> bool {
        self.fit.whole_runs && self.stands(fitting) && !is_left(&self.left)
    }

    fn stands(&self, fitting: &Fitting<'_>) -> bool {
        let covariance = fitting.covariances(&self.fit).larger();
        stands(
            &self.fit.body.arm,
            &covariance,
            self.fit.whole_runs,
            fitting.beyond_noise(&self.fit),
        )
    }

    /// Whether another, with the same noise over the same samples, costs less by more than what it has more of
    /// free is worth.
    fn leaves_more(&self, fitting: &Fitting<'_>, other: &Self) -> bool {
        let masks = self.without_repeats.as_deref().unwrap_or(fitting.masks);
        let fitting = Fitting { masks, ..*fitting };
        let price = |a: &Self| evidence::price(&fitting, &a.fit, &self.fit.noise);
        price(other) < price(self)
    }

    /// How near it comes, for comparison: whole runs before parts of them.
    fn nearness(&self, fitting: &Fitting<'_>) -> (bool, f64) {
        (self.fit.whole_runs, -fitting.beyond_noise(&self.fit))
    }
}

/// The largest of some shares.
fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}
