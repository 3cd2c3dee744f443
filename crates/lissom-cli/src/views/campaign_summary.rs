//! Summary of a campaign: what was read, and which parts of the runs are used.

use lissom::identify::{Identified, Method, MotorRegression, RunKind};
use lissom::record::{Campaign, Hold};
use lissom_io::UnitNames;
use lissom_views::digits::{counted, trimmed};

use super::printer::line;

/// Significant digits of sample times.
const TIMES: usize = 5;
/// Significant digits of ranges.
const RANGES: usize = 3;
/// Significant digits of a residual in percent.
const RESIDUAL: usize = 2;

/// Half of the power passes a sin⁴ window at this number divided by the length of the window.
const HALF_POWER: f64 = 0.93;

/// Prints what was read.
pub(crate) fn campaign(names: UnitNames, campaign: &Campaign) {
    let samples: usize = campaign.runs.iter().map(lissom::record::Run::len).sum();
    let (mut shortest, mut longest) = (f64::INFINITY, 0.0_f64);
    for run in &campaign.runs {
        shortest = shortest.min(run.sample_time_s());
        longest = longest.max(run.sample_time_s());
    }
    let sampling = if longest - shortest > 1e-6 * longest {
        format!("{} to {} ms", trimmed(1e3 * shortest, TIMES), trimmed(1e3 * longest, TIMES))
    } else {
        format!("{} ms", trimmed(1e3 * longest, TIMES))
    };
    let hold = match campaign.channels.command.hold {
        Hold::Sampled => "commanded, constant between samples",
        Hold::Measured if campaign.hold_assumed => "taken as measured",
        Hold::Measured => "measured",
    };
    line(&format!(
        "{}, {samples} samples every {sampling}, {} {hold}, {}",
        counted(campaign.runs.len(), "run"),
        names.command_name(),
        match campaign.channels.tips.len() {
            0 => "no tip".to_owned(),
            tips => counted(tips, "tip"),
        }
    ));
}

/// Prints the ranges of angle, speed and command. A wrong unit is easy to see here.
pub(crate) fn ranges(names: UnitNames, campaign: &Campaign) {
    let (mut low, mut high, mut speed, mut drive) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
    for run in &campaign.runs {
        // Speed over several samples: over one sample, the sensor's steps would dominate.
        let reach = (run.len() / 50).clamp(1, 10);
        let moved = run.motor().windows(reach + 1).map(|w| (w[reach] - w[0]).abs());
        speed = moved.fold(0.0, f64::max).max(speed * reach as f64 * run.sample_time_s())
            / (reach as f64 * run.sample_time_s());
        for &x in run.motor() {
            (low, high) = (f64::min(low, x), f64::max(high, x));
        }
        drive = run.command().iter().fold(drive, |m, u| f64::max(m, u.abs()));
    }
    let (angle, unit) = (names.angle(), names.command_unit());
    line(&format!(
        "motor from {} to {} {angle}, up to {} {angle}/s; {} up to {} {unit}",
        trimmed(low, RANGES).replace('-', "−"),
        trimmed(high, RANGES).replace('-', "−"),
        trimmed(speed, RANGES),
        names.command_name(),
        trimmed(drive, RANGES)
    ));
}

/// Prints which parts of the runs are used, and the data of the regression.
pub(crate) fn runs(id: &Identified) {
    let (mut kept, mut dropped, mut general, mut steady) = (0, 0, 0, 0);
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for run in &id.runs {
        match &run.kind {
            RunKind::Sinusoidal(s) => {
                kept += s.steady.periods;
                dropped += s.steady.dropped;
                low = low.min(s.omega_rad_s);
                high = high.max(s.omega_rad_s);
            }
            RunKind::ConstantVelocity => steady += 1,
            RunKind::General => general += 1,
        }
    }
    let sinusoidal = id.runs.len() - general - steady;
    if sinusoidal > 0 {
        let (low, high) = (trimmed(low, RANGES), trimmed(high, RANGES));
        let band = if low == high { format!("at {low}") } else { format!("from {low} to {high}") };
        let transients =
            if dropped > 0 { format!(", {dropped} left out as transients") } else { String::new() };
        line(&format!(
            "{} {band} rad/s: {kept} whole periods used{transients}",
            counted(sinusoidal, "sine run")
        ));
    }
    if steady > 0 {
        line(&format!("{} at constant velocities", counted(steady, "run")));
    }
    if general > 0 {
        line(&format!("{} of general motion (not one sine)", counted(general, "run")));
    }
    if let Some(r) = &id.regression {
        let how = if r.window_given { "given" } else { "chosen from the data" };
        line(&format!(
            "regression: {} (motion in one direction without a stop), residual torque {} % of the rms torque",
            counted(r.phases, "slip phase"),
            trimmed(100.0 * residual(id, r), RESIDUAL)
        ));
        line(&format!(
            "regression: windows of {} s ({how}), bandwidth {} Hz",
            trimmed(r.window_s, RANGES),
            trimmed(HALF_POWER / r.window_s, RANGES)
        ));
    }
}

/// Relative residual of the regression whose estimates are given: that with the friction law where one was chosen.
fn residual(id: &Identified, r: &MotorRegression) -> f64 {
    match (id.method, &id.friction_law) {
        (Some(Method::FrictionLaw), Some(law)) => law.relative_residual[1],
        _ => r.relative_residual,
    }
}
