//! `slip-windows.svg`: slip phases of one period, and the regression's windows in them.

use lissom::identify::{Options, Prepared, motor_regression};
use lissom::rig::Mode;
use lissom_report::{Axis, LinePlot, Region, Role, StackedPlot, Trace};

use crate::Drawn;
use crate::arms::{demo_rig, smooth_rig};
use crate::experiments::{Motion, campaign, even, settled_sine};

const OMEGA_RAD_S: f64 = 3.1;
const AMPLITUDE_RAD: f64 = 0.5;
/// Periods logged for the regression, which chooses the windows' length.
const PERIODS: f64 = 12.0;
/// Distance from one window to the next, as a share of its length.
const STEP: f64 = 0.25;
/// Points of a window's line.
const LINE: usize = 40;

/// Velocity with slip phases, and sin⁴ windows in each of them.
pub(crate) fn figure() -> Drawn {
    let period_s = std::f64::consts::TAU / OMEGA_RAD_S;
    let two =
        Motion::of(&smooth_rig()?, &settled_sine(OMEGA_RAD_S, AMPLITUDE_RAD, 2.0 * period_s)?)?;
    let (first, _) = *two.intervals(Mode::Stick).first().ok_or("the joint never sticks")?;
    let motion = two.part(first, first + period_s);
    let logged = settled_sine(OMEGA_RAD_S, AMPLITUDE_RAD, PERIODS * period_s)?;
    let logs = campaign(&demo_rig()?, &[logged], 0)?;
    let found = motor_regression(&Prepared::of(&logs), &Options::default());
    let window_s = found.ok_or("no regression")?.window_s;
    let time = || Axis::linear("time (s)");
    let mut velocity =
        LinePlot::new("", time(), Axis::linear("velocity (rad/s)")).trace(Trace::line(
            "motor velocity",
            Role::Fitted,
            motion.time_s.clone(),
            motion.velocity_rad_s.clone(),
        ));
    let mut windows = LinePlot::new("", time(), Axis::linear("window w"));
    let directions = [
        ("slip forward", Mode::Forward, Role::Corrected),
        ("slip backward", Mode::Backward, Role::Raw),
    ];
    for (label, mode, role) in directions {
        for (from, to) in motion.intervals(mode) {
            let region = Region::new(label, role, (from, to));
            velocity.regions.push(region.clone());
            windows.regions.push(region);
            windows.traces.extend(windows_within((from, to), window_s, role));
        }
    }
    let plot = StackedPlot::new("Slip phases of one period, and the windows of the regression")
        .subtitle(format!("Windows sin⁴(πx) of {window_s:.2} s, each a quarter of its length after the one before; none contains a reversal"))
        .plot(velocity)
        .plot(windows);
    Ok(Box::new(plot))
}

/// Windows within a slip phase, from its begin on.
fn windows_within((from, to): (f64, f64), window_s: f64, role: Role) -> Vec<Trace> {
    let starts = (0..).map(|k| from + STEP * window_s * f64::from(k));
    let window = |start: f64| {
        let x = even(0.0, 1.0, LINE);
        let w = x.iter().map(|x| (std::f64::consts::PI * x).sin().powi(4)).collect();
        Trace::line("", role, x.iter().map(|x| start + x * window_s).collect(), w)
    };
    starts.take_while(|start| start + window_s <= to).map(window).collect()
}
