//! The friction of a virtual rig, drawn over what was found of it.

use lissom::identify::Identified;
use lissom::rig::Rig;
use lissom_report::{LinePlot, Role, Trace};

use crate::tasks::printed_coulomb::law;

/// Fastest velocity of the curve in Figure 8 \[rad/s\], and its points.
const FASTEST_RAD_S: f64 = 40.0;
const POINTS: u32 = 400;

/// Figure 8 with the joint's own friction and the spectral figure.
pub(crate) fn with_truth(mut plot: LinePlot, rig: &Rig, id: &Identified) -> LinePlot {
    let (motor, beam, law) = (&rig.arm.motor, rig.arm.beam(), law(rig));
    // Turning steadily, the masses' dampers against the fixed frame take their part.
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
    "Friction by steady velocities, and by sines".clone_into(&mut plot.title);
    plot
}
