//! `beam-modes.svg` and `payload-modes.svg`: the beam of two equal masses.

use lissom::beam::{Base, BeamError, LumpedBeam};
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle, significant};

use crate::Drawn;
use crate::arms::two_masses;
use crate::experiments::{even, ratios};

/// Points of a line.
const LINE: usize = 200;
/// Colours of the modes.
const ROLES: [Role; 2] = [Role::Corrected, Role::Raw];

/// Mode shapes with the motor clamped.
pub(crate) fn modes() -> Drawn {
    let beam = two_masses()?;
    let (tip_m, span) = (beam.position_m()[1], beam.spans()[0]);
    let mut plot = LinePlot::new(
        "Modes of a beam with two equal masses, motor clamped",
        Axis::linear("distance from the motor's axis (m)").range(0.0, 1.04 * tip_m),
        Axis::linear("deflection (largest of a mass = 1)"),
    )
    .subtitle(format!(
        "EI {} N·m², length {} m, {} kg in the middle and at the tip",
        significant(span.flexural_rigidity_n_m2, 5),
        significant(tip_m, 4),
        significant(span.mass_kg, 5)
    ))
    .trace(Trace::line("undeflected beam", Role::Fitted, vec![0.0, tip_m], vec![0.0; 2]));
    for ((k, mode), role) in beam.modes(2).iter().enumerate().zip(ROLES) {
        let shape = beam.shape_through(&mode.shape, 0.0)?;
        let x = even(0.0, tip_m, LINE);
        let y = x.iter().map(|x| shape.deflection_m(*x)).collect();
        let label = format!("mode {}: {:.2} rad/s", k + 1, mode.natural_frequency_rad_s);
        let masses = beam.position_m().to_vec();
        plot = plot.trace(Trace::line(label, role, x, y)).trace(Trace::new(
            "",
            role,
            TraceStyle::Points,
            masses,
            mode.shape.clone(),
        ));
    }
    Ok(Box::new(plot))
}

/// Range of the mass at the tip \[kg\].
const LOADS_KG: (f64, f64) = (1e-3, 10.0);

/// Frequencies over the mass at the tip.
pub(crate) fn payload_modes() -> Drawn {
    let beam = two_masses()?;
    let own_kg = beam.spans()[1].mass_kg;
    let masses = ratios(LOADS_KG.0, LOADS_KG.1, LINE);
    let loaded = masses.iter().map(|m| with_tip_mass(&beam, *m)).collect::<Result<Vec<_>, _>>()?;
    let mut plot = LinePlot::new(
        "Natural frequencies against the payload's mass",
        Axis::log("mass at the tip (kg)").range(LOADS_KG.0, LOADS_KG.1),
        Axis::log("frequency (rad/s)"),
    )
    .subtitle(
        "Beam of two masses, motor clamped. The payload does not change the zero of the tip.",
    );
    let own = beam.frequencies_rad_s(Base::Clamped, 2);
    for (k, role) in ROLES.into_iter().enumerate() {
        let y = loaded.iter().map(|b| b.frequencies_rad_s(Base::Clamped, 2)[k]).collect();
        plot = plot.trace(Trace::line(format!("mode {}", k + 1), role, masses.clone(), y));
    }
    let zero = |b: &LumpedBeam| b.zeros(1).and_then(|z| Some(z.z.first()?.sqrt().re.abs()));
    let zeros: Option<Vec<f64>> = loaded.iter().map(zero).collect();
    let zeros = zeros.ok_or("the tip's response has no zero")?;
    plot = plot.trace(Trace::line("zero ±σ of the tip's response", Role::Truth, masses, zeros));
    let points = Trace::new("equal masses", Role::Fitted, TraceStyle::Points, vec![own_kg; 2], own);
    Ok(Box::new(plot.trace(points)))
}

fn with_tip_mass(beam: &LumpedBeam, mass_kg: f64) -> Result<LumpedBeam, BeamError> {
    let mut spans = beam.spans().to_vec();
    spans.iter_mut().last().into_iter().for_each(|span| span.mass_kg = mass_kg);
    LumpedBeam::new(&spans)
}
