//! Findings about the estimates of the output-error method.

use crate::finding::result_key as key;
use crate::identify::estimate::Estimate;
use crate::identify::findings::{Channel, Finding, rows};
use crate::identify::judge::Evidence;
use crate::identify::methods::regression::MotorRegression;
use crate::identify::output_error::thresholds::{
    DAMPER_DRIVES, LAG_COMPARED, MODE_FAINT, RESIDUAL_GROWN,
};
use crate::identify::output_error::{OutputError, SearchEnd, StageReport, highest, is_left};
use crate::identify::thresholds::{LAG_HALF_SAMPLE, PRESENT};
use crate::record::{Campaign, Hold, Run, Tip};
use crate::replay::{ModalArm, Oscillator, Parameter};

/// Findings of the replay, among them that it does not describe the runs.
pub(crate) fn findings(evidence: &Evidence<'_>) -> Vec<Finding> {
    let campaign = evidence.campaign;
    let Some(oe) = &evidence.methods.output_error else {
        return Vec::new();
    };
    let mut findings = Vec::new();
    if oe.stands() {
        findings.extend(lag_of(evidence, oe).map(|lag| command_lag(campaign, lag)));
        findings.extend(tip_lags(campaign, oe));
        findings.extend(modes_missing(campaign, oe));
        findings.extend(modes_by_the_motor(campaign, oe));
        findings.extend(faint_mode(&oe.arm, |p| oe.estimate(p)));
        findings.extend(more_than_noise(campaign, oe));
        findings.extend(damping_kind(oe));
        let estimates = oe.parameters.iter().filter_map(|p| Some((*p, oe.estimate(*p)?)));
        findings.extend(driving_damper(estimates));
    }
    findings.extend(if oe.end == SearchEnd::Done {
        departs(evidence, oe)
    } else {
        budget_spent(oe)
    });
    findings.extend(motions_part(oe));
    findings
}

/// The lag of the command: that of slip phases, by which the command was late in the replay, with what the replay adds to it.
fn lag_of(evidence: &Evidence<'_>, oe: &OutputError) -> Option<Estimate> {
    let by_phases = evidence.methods.friction_law.as_ref().and_then(|law| law.lag);
    let by_phases = by_phases.filter(|lag| !lag.is_delay_of(evidence.campaign));
    let own = oe.estimate(Parameter::CommandLag);
    let first = by_phases.map(|lag| Estimate { value: lag.time_s, std: lag.std_s });
    match (first, own) {
        (Some(first), Some(own)) => Some(Estimate { value: first.value + own.value, ..own }),
        (first, own) => own.or(first),
    }
}

/// Windows are shorter than the runs, because neighbouring motions grow apart.
fn motions_part(oe: &OutputError) -> Option<Finding> {
    let window_s = oe.stages.last()?.window_s;
    (oe.describes_whole_runs() && oe.is_in_windows())
        .then(|| Finding::new(rows::MotionsPart { window_s }))
}

/// The limit of evaluations ended the search.
fn budget_spent(oe: &OutputError) -> Option<Finding> {
    Some(Finding::new(rows::BudgetSpent {
        evaluations: oe.evaluations,
        window_s: longest(oe)?.window_s,
        used: oe.stands(),
        interrupted: oe.end == SearchEnd::Interrupted,
    }))
}

/// The arm does not describe whole runs.
fn departs(evidence: &Evidence<'_>, oe: &OutputError) -> Option<Finding> {
    if oe.describes_whole_runs() {
        return None;
    }
    // Noise of the command moves the arm; of friction that varies the regression's finding tells.
    if command_is_noise(evidence) {
        return Some(Finding::new(rows::CommandNoise {}));
    }
    let regression = evidence.methods.regression.as_ref();
    let varies = regression.is_some_and(|r| r.varies_by().is_some()) && !lawful(evidence);
    let flexible = regression.is_some_and(|r| r.mode.is_some()) && oe.arm.modes.is_empty();
    if (varies || flexible) && !oe.stands() {
        return None;
    }
    let (first, last) = (oe.stages.first()?, longest(oe)?);
    let grown = first.residual.iter().zip(&last.residual).map(|(a, b)| b / a).fold(0.0, f64::max);
    let hides_mode = oe.beyond_noise < oe.accepted_residual && !oe.sees_modes;
    Some(Finding::new(rows::ReplayDeparts {
        window_s: last.window_s,
        grown_from: (grown > RESIDUAL_GROWN && last.window_s > first.window_s)
            .then_some((first.window_s, grown)),
        noise_ratio: oe.beyond_noise,
        used: oe.stands(),
        agree_s: oe.stages.last().map(|stage| stage.window_s).filter(|_| hides_mode),
    }))
}

/// Whether the equation lacks no term, and leaves little more than the noise of a measured command.
fn command_is_noise(evidence: &Evidence<'_>) -> bool {
    let alone = |r: &MotorRegression| evidence.methods.missing.is_empty() && r.left.is_noise();
    evidence.campaign.channels.command.hold == Hold::Measured
        && evidence.methods.regression.as_ref().is_some_and(alone)
}

/// Whether friction has terms beyond Coulomb and viscous friction.
fn lawful(evidence: &Evidence<'_>) -> bool {
    evidence.methods.friction_law.as_ref().is_some_and(|law| law.chosen.departs())
}

/// Whole runs are described, but the residual is larger than the sensors' noise explains.
fn more_than_noise(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    if !oe.whole_runs || !is_left(&oe.left_over, 0.0) {
        return None;
    }
    let (channel, share) = oe.left_over.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let channel = match channel.checked_sub(1) {
        None => Channel::Motor,
        Some(tip) => Channel::Tip(campaign.channels.tips[tip].name.clone()),
    };
    Some(Finding::new(rows::MoreThanNoise { channel, share: *share }))
}

/// The runs hardly drive the highest mode: they show its k/ω², and noise determines its frequency.
fn faint_mode(arm: &ModalArm, estimate: impl Fn(Parameter) -> Option<Estimate>) -> Option<Finding> {
    let mode = highest(arm);
    let stiffness = estimate(Parameter::Stiffness(mode)).filter(|_| arm.modes.len() > 1)?;
    let share = stiffness.std / stiffness.value.abs();
    let omega_rad_s = arm.modes[mode].omega_rad_s;
    let found = rows::FaintMode { omega_rad_s, stiffness_std_share: share };
    (share > MODE_FAINT).then(|| Finding::new(found))
}

/// A damping coefficient is below zero. Dampers of one kind are too large, and one of another kind compensates for
/// them. Viscous friction and damping ratios are then wrong.
fn driving_damper(estimates: impl Iterator<Item = (Parameter, Estimate)>) -> Option<Finding> {
    let drives = estimates.filter(|(p, e)| p.is_damper() && e.value < -DAMPER_DRIVES * e.std);
    let (damper, rate_per_s) =
        drives.min_by(|(_, a), (_, b)| (a.value / a.std).total_cmp(&(b.value / b.std)))?;
    Some(Finding::new(rows::DamperDrives { damper, rate_per_s }))
}

/// The stage with the longest windows.
fn longest(oe: &OutputError) -> Option<&StageReport> {
    oe.stages.iter().max_by(|a, b| a.window_s.total_cmp(&b.window_s))
}

/// Modes that only the motor shows.
fn modes_by_the_motor(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    let arm = &oe.arm;
    let modes = arm.modes.len();
    let behind: f64 = arm.modes.iter().map(Oscillator::inertia_kg_m2).sum();
    let lowest = arm.modes.iter().map(|m| m.omega_rad_s).fold(f64::INFINITY, f64::min);
    (modes > 0 && campaign.channels.tips.is_empty()).then(|| {
        Finding::new(rows::ModesByTheMotor {
            modes,
            lowest_rad_s: lowest,
            inertia_share: arm.inertia_kg_m2 / (arm.inertia_kg_m2 + behind),
        })
    })
}

/// There are fewer modes than tips: no run shows the missing mode, and its inertia is counted with the motor's.
fn modes_missing(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    let (modes, tips) = (oe.arm.modes.len(), campaign.channels.tips.len());
    (modes > 0 && modes < tips).then(|| Finding::new(rows::ModesMissing { modes, tips }))
}

/// Damping within the beam cannot be distinguished from damping against the frame. It is a warning if other estimates
/// depend on it.
fn damping_kind(oe: &OutputError) -> Option<Finding> {
    let of_parameter = |p: &Parameter| match p {
        Parameter::Inertia => Some(key::INERTIA),
        Parameter::Viscous | Parameter::ViscousDifference => Some(key::VISCOUS),
        Parameter::Coulomb => Some(key::COULOMB),
        Parameter::Stiffness(_) => Some(key::COUPLING),
        _ => None,
    };
    let open = &oe.open_by_damping;
    let parameters = open.iter().filter_map(of_parameter).collect();
    (!open.is_empty()).then(|| Finding::new(rows::DampingKind { parameters }))
}

/// The command acts later than it is logged.
pub(crate) fn command_lag(campaign: &Campaign, lag: Estimate) -> Finding {
    let hold = campaign.channels.command.hold;
    // A held sample acts, on average, half a sample later than its time.
    let (towards_other, other) = match hold {
        Hold::Measured => (0.5, Hold::Sampled),
        Hold::Sampled => (-0.5, Hold::Measured),
    };
    let is_half = |run: &Run| {
        let half_s = towards_other * run.sample_time_s();
        (lag.value - half_s).abs() < (PRESENT * lag.std).max(LAG_HALF_SAMPLE * half_s.abs())
    };
    let told = lag.std < LAG_COMPARED * lag.value.abs();
    if told && campaign.runs.iter().all(is_half) {
        return Finding::new(rows::LooksLikeHold { lag_s: lag, hold: other });
    }
    Finding::new(rows::CommandLag { lag_s: lag })
}

/// Tips that are read later than the motor.
fn tip_lags(campaign: &Campaign, oe: &OutputError) -> Vec<Finding> {
    let late = |(i, tip): (usize, &Tip)| {
        let lag_s = oe.estimate(Parameter::TipLag(i))?;
        Some(Finding::new(rows::TipLag { tip: tip.name.clone(), lag_s }))
    };
    campaign.channels.tips.iter().enumerate().filter_map(late).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::DryTerms;

    #[test]
    fn a_highest_mode_that_hardly_shows_is_said() {
        let mode = |omega_rad_s: f64| Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad: 2.0,
            within_per_s: 0.0,
            grounded_per_s: 0.0,
        };
        let arm = |modes: Vec<Oscillator>| ModalArm {
            inertia_kg_m2: 1.0,
            viscous_nm_s_per_rad: [0.1; 2],
            coulomb_nm: 0.1,
            offset_nm: 0.0,
            dry_terms: DryTerms::default(),
            shapes: vec![vec![1.0 / modes.len() as f64; modes.len()]],
            modes,
            at_points_per_s: vec![],
            gravity: None,
            torque_ripples: Vec::new(),
            command_lag_s: 0.0,
            tip_lags_s: vec![],
        };
        // The second of three is the highest.
        let three = arm(vec![mode(5.0), mode(80.0), mode(20.0)]);
        let known = |p: Parameter, std: f64| {
            (p == Parameter::Stiffness(1)).then_some(Estimate { value: 2.0, std })
        };
        let said = faint_mode(&three, |p| known(p, 0.05)).unwrap();
        let text = said.message();
        assert!(text.contains("80.0 rad/s") && text.contains("2.5 %"), "{text}");
        assert!(faint_mode(&three, |p| known(p, 0.01)).is_none());
        // A single mode is driven or absent.
        let alone = |_: Parameter| Some(Estimate { value: 2.0, std: 0.5 });
        assert!(faint_mode(&arm(vec![mode(5.0)]), alone).is_none());
    }

    #[test]
    fn a_damper_that_drives_is_said() {
        let estimate = |value: f64, std: f64| Estimate { value, std };
        let sound = [
            (Parameter::Offset, estimate(-3.0, 0.1)),
            (Parameter::DampingWithin(0), estimate(-0.04, 0.01)),
            (Parameter::DampingAtPoint(1), estimate(0.2, 0.01)),
        ];
        assert!(driving_damper(sound.into_iter()).is_none());
        let drives = [(Parameter::DampingAtPoint(2), estimate(-0.011, 0.0003))];
        let said = driving_damper(sound.into_iter().chain(drives)).unwrap();
        assert!(said.message().contains("damping-at-point-3"), "{said}");
    }
}
