//! What the output error's figures are worth, in findings.

use crate::identify::estimate::Estimate;
use crate::identify::finding::{Finding, Severity, key};
use crate::identify::judge::Evidence;
use crate::identify::methods::output_error::describes::is_left;
use crate::identify::methods::output_error::fit::{GROWN, StageReport};
use crate::identify::methods::output_error::found::OutputError;
use crate::identify::methods::output_error::modes::{FAINT, highest};
use crate::record::{Campaign, Hold, Run, Tip};
use crate::replay::{ModalArm, Parameter};

/// Deviations below zero from which on a damper is none.
const DRIVES: f64 = 5.0;
/// A lag is half a sample to this share of it.
const HALF: f64 = 0.05;

/// What the replay found, and that it does not describe the runs where it does not.
pub(crate) fn findings(evidence: &Evidence<'_>) -> Vec<Finding> {
    let campaign = evidence.campaign;
    let Some(oe) = &evidence.methods.output_error else { return Vec::new() };
    let mut findings = Vec::new();
    if oe.stands() {
        findings.extend(oe.estimate(Parameter::CommandLag).map(|lag| command_lag(campaign, lag)));
        findings.extend(tip_lags(campaign, oe));
        findings.extend(modes_missing(campaign, oe));
        findings.extend(modes_by_the_motor(campaign, oe));
        findings.extend(faint_mode(&oe.arm, |p| oe.estimate(p)));
        findings.extend(more_than_noise(campaign, oe));
        findings.extend(damping_kind(oe));
        let figures = oe.parameters.iter().filter_map(|p| Some((*p, oe.estimate(*p)?)));
        findings.extend(driving_damper(figures));
    }
    findings.extend(departs(oe));
    findings.extend(motions_part(oe));
    findings
}

/// Windows are shorter than the runs that they describe.
fn motions_part(oe: &OutputError) -> Option<Finding> {
    let window_s = oe.stages.last()?.window_s;
    (oe.describes_whole_runs() && oe.is_in_windows()).then(|| {
        Finding::new(
            "motions-part",
            Severity::Info,
            &[],
            format!(
                "friction drives neighbouring motions apart, as it does where it changes over the angle or falls with \
                 speed: the runs are replayed {window_s:.2} s at a time, each time from a state of its own"
            ),
            "nothing is wrong: a prediction from a run's first state alone does not hold for longer",
        )
    })
}

/// The arm does not describe the runs from end to end.
fn departs(oe: &OutputError) -> Option<Finding> {
    if oe.describes_whole_runs() {
        return None;
    }
    let (first, last) = (oe.stages.first()?, longest(oe)?);
    let grown = first.residual.iter().zip(&last.residual).map(|(a, b)| b / a).fold(0.0, f64::max);
    let taken = if oe.stands() {
        "the figures are those of the windows that it describes"
    } else {
        "the regression's figures are taken"
    };
    Some(Finding::new(
        "replay-departs",
        Severity::Warning,
        &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
        if grown > GROWN {
            format!(
                "replayed over {:.2} s at a time the residual is {grown:.1} times that over {:.2} s: \
                 something moves the axis that the arm has not; {taken}",
                last.window_s, first.window_s
            )
        } else {
            format!(
                "replayed over {:.2} s at a time the residual is {:.1} times the sensors' noise, as it is over shorter \
                 ones: something moves the axis that the arm has not, or the search did not find the arm; {taken}",
                last.window_s, oe.beyond_noise
            )
        },
        "other friction than Coulomb and viscous, a load, backlash, a mode without a tip",
    ))
}

/// Whole runs are described, and yet not to the noise of the sensors.
fn more_than_noise(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    if !oe.whole_runs || !is_left(&oe.left_over) {
        return None;
    }
    let (channel, share) = oe.left_over.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let name = match channel.checked_sub(1) {
        None => "the motor".to_owned(),
        Some(tip) => format!("tip {}", campaign.channels.tips[tip].name),
    };
    Some(Finding::new(
        "more-than-noise",
        Severity::Warning,
        &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
        format!(
            "{:.1} % of what the replay leaves of {name} is slower than its sensor's noise: something \
             small moves that the arm has not, or the highest mode stands at a wrong frequency",
            100.0 * share
        ),
        "the intervals do not count it: add runs near the highest mode, and look at lissom validate",
    ))
}

/// A highest mode that the runs hardly drive: what they show of it is k/ω², and its frequency is where the
/// noise happens to ring like it.
fn faint_mode(arm: &ModalArm, estimate: impl Fn(Parameter) -> Option<Estimate>) -> Option<Finding> {
    let mode = highest(arm);
    let stiffness = estimate(Parameter::Stiffness(mode)).filter(|_| arm.modes.len() > 1)?;
    let share = stiffness.std / stiffness.value.abs();
    (share > FAINT).then(|| {
        Finding::new(
            "faint-mode",
            Severity::Warning,
            &[key::COUPLING, key::MODES],
            format!(
                "the runs hardly drive the highest mode, at {:.1} rad/s: its stiffness is known to {:.1} %, and at another \
                 frequency it would leave hardly more. Others have been tried; the coupling goes with it",
                arm.modes[mode].omega_rad_s,
                100.0 * share
            ),
            "add a run that drives it, about the frequency that `lissom model` gives for the beam's dimensions",
        )
    })
}

/// A damper that is less than none: what dampers of one kind take too much, one of another kind gives back, and
/// viscous friction and damping ratios are moved by what is left.
fn driving_damper(figures: impl Iterator<Item = (Parameter, Estimate)>) -> Option<Finding> {
    let drives = figures.filter(|(p, e)| p.is_damper() && e.value < -DRIVES * e.std);
    let (damper, found) =
        drives.min_by(|(_, a), (_, b)| (a.value / a.std).total_cmp(&(b.value / b.std)))?;
    Some(Finding::new(
        "damper-drives",
        Severity::Warning,
        &[key::VISCOUS, key::MODES],
        format!(
            "{} comes out at {:.3e} ± {:.1e} 1/s: a damper takes energy, and gives none. Viscous friction \
             and damping ratios make up for it",
            damper.name(),
            found.value,
            found.std
        ),
        "add runs near the modes, where damping shows most",
    ))
}

/// The stage of the longest windows tried.
fn longest(oe: &OutputError) -> Option<&StageReport> {
    oe.stages.iter().max_by(|a, b| a.window_s.total_cmp(&b.window_s))
}

/// Modes that no tip shows.
fn modes_by_the_motor(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    let modes = oe.arm.modes.len();
    (modes > 0 && campaign.channels.tips.is_empty()).then(|| {
        Finding::new(
            "modes-by-the-motor",
            Severity::Info,
            &[key::COUPLING, key::MODES],
            format!(
                "{modes} flexible {} from the motor's motion alone: modes that it hardly feels ride on \
                 its inertia",
                if modes == 1 { "mode" } else { "modes" }
            ),
            "measure a tip to see how the arm itself moves",
        )
    })
}

/// Fewer modes than tips: a mode that no run shows, whose inertia rides on the motor's.
fn modes_missing(campaign: &Campaign, oe: &OutputError) -> Option<Finding> {
    let (modes, tips) = (oe.arm.modes.len(), campaign.channels.tips.len());
    (modes > 0 && modes < tips).then(|| {
        Finding::new(
            "modes-missing",
            Severity::Warning,
            &[key::COULOMB, key::VISCOUS, key::INERTIA, key::COUPLING, key::MODES],
            format!(
                "{tips} tips are measured and the runs show {modes} modes: what the others add to \
                 inertia and coupling is counted wrongly"
            ),
            "add runs above the modes found: a sweep, or sines at several times the highest",
        )
    })
}

/// Damping within the beam that cannot be told from damping against the frame. A warning where more than damping
/// depends on it.
fn damping_kind(oe: &OutputError) -> Option<Finding> {
    let of_figure = |p: &Parameter| match p {
        Parameter::Inertia => Some(key::INERTIA),
        Parameter::Viscous | Parameter::ViscousDifference => Some(key::VISCOUS),
        Parameter::Coulomb => Some(key::COULOMB),
        Parameter::Stiffness(_) => Some(key::COUPLING),
        _ => None,
    };
    let open = &oe.open_by_damping;
    let mut affects: Vec<&'static str> = open.iter().filter_map(of_figure).collect();
    let damping_alone = affects.is_empty();
    affects.push(key::MODES);
    affects.dedup();
    (!open.is_empty()).then(|| {
        Finding::new(
            "damping-kind",
            if damping_alone { Severity::Info } else { Severity::Warning },
            &affects,
            "these runs do not tell damping within the beam from damping against the frame, and figures depend on it: \
             their deviations count both"
                .to_owned(),
            "one steady sine shows the two alike: add a run at another frequency, best a sweep, or log from the start",
        )
    })
}

/// A command that acts later than it is logged.
pub(crate) fn command_lag(campaign: &Campaign, lag: Estimate) -> Finding {
    let hold = campaign.channels.command.hold;
    // A held command's samples are half a sample earlier than what they stand for.
    let (towards_other, hint) = match hold {
        Hold::Measured => (
            0.5,
            "half a sample: the command looks as if it were held from sample to sample, hold = \"sampled\"",
        ),
        Hold::Sampled => (
            -0.5,
            "half a sample: the command looks measured rather than held from sample to sample, hold = \
             \"measured\"",
        ),
    };
    let is_half = |run: &Run| {
        let half_s = towards_other * run.sample_time_s();
        (lag.value - half_s).abs() < (3.0 * lag.std).max(HALF * half_s.abs())
    };
    let told = lag.std < 0.1 * lag.value.abs();
    let hint = if told && campaign.runs.iter().all(is_half) {
        hint
    } else {
        "an amplifier's delay, or channels that are not sampled together"
    };
    let digits = digits(1e3 * lag.std);
    Finding::new(
        "command-lag",
        Severity::Info,
        &[key::INERTIA, key::VISCOUS, key::RAW],
        format!(
            "the command acts {:.digits$} ms (± {:.digits$}) {} than it is logged: counted in all figures",
            1e3 * lag.value.abs(),
            1e3 * lag.std,
            if lag.value < 0.0 { "earlier" } else { "later" }
        ),
        hint,
    )
}

/// Decimals with which a deviation has two digits, three at least.
fn digits(std: f64) -> usize {
    let first = std.log10().floor();
    if first.is_finite() { (1.0 - first).clamp(3.0, 9.0) as usize } else { 3 }
}

/// Tips that are read later than the motor.
fn tip_lags(campaign: &Campaign, oe: &OutputError) -> Vec<Finding> {
    let late = |(i, tip): (usize, &Tip)| {
        let lag = oe.estimate(Parameter::TipLag(i))?;
        let digits = digits(1e3 * lag.std);
        Some(Finding::new(
            "tip-lag",
            Severity::Info,
            &[key::COUPLING, key::MODES, key::TIPS],
            format!(
                "tip {} is read {:.digits$} ms (± {:.digits$}) {} than the motor: counted in the figures, and left in the tips' \
                 responses",
                tip.name,
                1e3 * lag.value.abs(),
                1e3 * lag.std,
                if lag.value < 0.0 { "earlier" } else { "later" }
            ),
            "a camera's or a filter's delay, or channels that are not sampled together",
        ))
    };
    campaign.channels.tips.iter().enumerate().filter_map(late).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::replay::{DryTerms, Oscillator};

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
            command_lag_s: 0.0,
            tip_lags_s: vec![],
        };
        // The second of three is the highest.
        let three = arm(vec![mode(5.0), mode(80.0), mode(20.0)]);
        let known = |p: Parameter, std: f64| {
            (p == Parameter::Stiffness(1)).then_some(Estimate { value: 2.0, std })
        };
        let said = faint_mode(&three, |p| known(p, 0.05)).unwrap();
        assert!(
            said.message.contains("80.0 rad/s") && said.message.contains("2.5 %"),
            "{}",
            said.message
        );
        assert!(faint_mode(&three, |p| known(p, 0.01)).is_none());
        // One alone is driven or not there.
        let alone = |_: Parameter| Some(Estimate { value: 2.0, std: 0.5 });
        assert!(faint_mode(&arm(vec![mode(5.0)]), alone).is_none());
    }

    #[test]
    fn a_damper_that_drives_is_said() {
        let figure = |value: f64, std: f64| Estimate { value, std };
        let sound = [
            (Parameter::Offset, figure(-3.0, 0.1)),
            (Parameter::DampingWithin(0), figure(-0.04, 0.01)),
            (Parameter::DampingAtPoint(1), figure(0.2, 0.01)),
        ];
        assert!(driving_damper(sound.into_iter()).is_none());
        let drives = [(Parameter::DampingAtPoint(2), figure(-0.011, 0.0003))];
        let said = driving_damper(sound.into_iter().chain(drives)).unwrap();
        assert!(said.message.contains("damping-at-point-3"), "{}", said.message);
    }
}
