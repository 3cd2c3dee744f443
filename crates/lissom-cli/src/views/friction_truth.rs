//! The true friction of a virtual rig, drawn over its estimates.

use lissom::identify::Identified;
use lissom::rig::Rig;
use lissom_report::{LinePlot, Role, Trace};

use crate::tasks::printed_coulomb::law;

/// Fastest velocity of the curve in Figure 8 \[rad/s\].
const FASTEST_RAD_S: f64 = 40.0;
/// Number of points on the curve.
const POINTS: u32 = 400;

/// Adds the true friction of the joint and the spectral estimate to Figure 8.
pub(crate) fn with_truth(mut plot: LinePlot, rig: &Rig, id: &Identified) -> LinePlot {
    let (motor, beam, law) = (&rig.arm.motor, rig.arm.beam(), law(rig));
    // At a constant velocity the dampers of the masses against the fixed frame act as viscous friction.
    let dampers = beam.spans().iter().zip(beam.position_m());
    let drag: f64 = dampers.map(|(s, at)| s.damping_n_s_per_m * at * at).sum();
    let viscous = motor.viscous_nm_s_per_rad() + drag;
    let speeds: Vec<f64> =
        (0..=POINTS).map(|k| FASTEST_RAD_S * f64::from(k) / f64::from(POINTS)).collect();
    for (label, forward) in [("truth", true), ("", false)] {
        let current = |v: &f64| {
            let dry = law.at(*v, 0.0);
            let dry = if forward { dry.forward() } else { dry.backward() };
            (dry + viscous * v) / motor.torque_constant_nm_per_a()
        };
        let currents = speeds.iter().map(current).collect();
        plot.traces.push(Trace::line(label, Role::Truth, speeds.clone(), currents));
    }
    if let Some(third) = &id.third_harmonic {
        let spectral = third.coulomb_command;
        plot.traces.push(Trace::points_with_bars(
            "spectral, (29)",
            Role::Fitted,
            vec![0.0],
            vec![spectral.value],
            vec![spectral.std],
        ));
    }
    "Friction from constant velocities and from sines".clone_into(&mut plot.title);
    plot
}
