//! `third-harmonic.svg`: harmonics of Coulomb friction in a sine.

use lissom::rig::Mode;
use lissom::spectrum::{Phasor, least_squares};
use lissom_report::{Axis, LinePlot, Role, StackedPlot, Trace, TraceStyle};
use num_complex::Complex64;

use crate::Drawn;
use crate::arms::smooth_rig;
use crate::experiments::{Motion, settled_sine};

const OMEGA_RAD_S: f64 = 15.3;
const AMPLITUDE_RAD: f64 = 1.0;
/// Periods of which harmonics are taken, and of which the figure shows some.
const PERIODS: f64 = 20.0;
const SHOWN: f64 = 2.0;
const HARMONICS: usize = 9;

/// Velocity, friction torque and its first and third harmonics.
pub(crate) fn figure() -> Drawn {
    let rig = smooth_rig()?;
    let period_s = std::f64::consts::TAU / OMEGA_RAD_S;
    let sine = settled_sine(OMEGA_RAD_S, AMPLITUDE_RAD, PERIODS * period_s)?;
    let motion = Motion::of(&rig, &sine)?;
    if !motion.intervals(Mode::Stick).is_empty() {
        return Err("the joint sticks: friction is no square wave".into());
    }
    let friction: Vec<f64> =
        motion.velocity_rad_s.iter().map(|v| rig.arm.coulomb.slipping(*v)).collect();
    let sample_time_s = rig.instruments.sample_time_s;
    let found =
        least_squares(&friction, OMEGA_RAD_S, sample_time_s, HARMONICS).ok_or("too short")?;
    let rows = (SHOWN * period_s / sample_time_s).round() as usize;
    let time = motion.time_s[..rows].to_vec();
    let axis = || Axis::linear("time (s)");
    let mut plot = LinePlot::new("", axis(), Axis::linear("torque (N·m)")).trace(Trace::new(
        "friction",
        Role::Fitted,
        TraceStyle::Steps,
        time.clone(),
        friction[..rows].to_vec(),
    ));
    for (harmonic, label, role) in
        [(1, "first harmonic", Role::Corrected), (3, "third harmonic", Role::Raw)]
    {
        let Phasor { value, .. } = found.get(harmonic).ok_or("too few harmonics")?;
        let rate = harmonic as f64 * OMEGA_RAD_S;
        let wave = time.iter().map(|t| (value * Complex64::cis(rate * t)).re).collect();
        plot = plot.trace(Trace::line(label, role, time.clone(), wave));
    }
    let velocity = LinePlot::new("", axis(), Axis::linear("velocity (rad/s)")).trace(Trace::line(
        "motor velocity",
        Role::Other(0),
        time,
        motion.velocity_rad_s[..rows].to_vec(),
    ));
    let figure = StackedPlot::new("Coulomb friction is a square wave in phase with the velocity")
        .subtitle(
            "Amplitudes of its first and third harmonic: 4/π and 4/(3π) times Coulomb friction.",
        )
        .plot(velocity)
        .plot(plot);
    Ok(Box::new(figure))
}
