//! `stick-slip.svg`: one period of a slow sine.

use lissom::rig::Mode;
use lissom_report::{Axis, LinePlot, Region, Role, StackedPlot, Trace};

use crate::Drawn;
use crate::arms::smooth_rig;
use crate::experiments::{Motion, settled_sine};

const OMEGA_RAD_S: f64 = 1.0;
const AMPLITUDE_RAD: f64 = 0.15;

/// Reference, motor angle and velocity, with the intervals in which the joint sticks.
pub(crate) fn figure() -> Drawn {
    let rig = smooth_rig()?;
    let period_s = std::f64::consts::TAU / OMEGA_RAD_S;
    let motion = Motion::of(&rig, &settled_sine(OMEGA_RAD_S, AMPLITUDE_RAD, period_s)?)?;
    let time = || Axis::linear("time (s)");
    let mut panels = [
        LinePlot::new("", time(), Axis::linear("angle (rad)"))
            .trace(Trace::line(
                "reference",
                Role::Raw,
                motion.time_s.clone(),
                motion.reference_rad.clone(),
            ))
            .trace(Trace::line(
                "motor angle",
                Role::Corrected,
                motion.time_s.clone(),
                motion.angle_rad.clone(),
            )),
        LinePlot::new("", time(), Axis::linear("velocity (rad/s)")).trace(Trace::line(
            "motor velocity",
            Role::Fitted,
            motion.time_s.clone(),
            motion.velocity_rad_s.clone(),
        )),
    ];
    let stuck = motion.intervals(Mode::Stick);
    for panel in &mut panels {
        panel.regions =
            stuck.iter().map(|ends| Region::new("joint sticks", Role::Other(1), *ends)).collect();
    }
    let [angle, velocity] = panels;
    let plot = StackedPlot::new("A slow sine: the joint sticks where the motion reverses")
        .subtitle(format!(
            "Rig of lissom demo, ideal motor sensor; sine of {AMPLITUDE_RAD} rad at {OMEGA_RAD_S} rad/s; {:.0} % of the time it sticks",
            100.0 * stuck.iter().map(|(from, to)| to - from).sum::<f64>() / period_s
        ))
        .plot(angle)
        .plot(velocity);
    Ok(Box::new(plot))
}
