//! Mode shapes.

use lissom::beam::{DistributedBeam, LumpedBeam, Mode};

use super::any_beam::{Beam, MOST_DENSE};

/// Deflection of a mode over the distance from the axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModeShape {
    /// The beam: distance and deflection.
    pub(crate) line: Vec<(f64, f64)>,
    /// The masses; empty if there are too many to draw.
    pub(crate) points: Vec<(f64, f64)>,
}

/// Number of points on the line of a shape.
const LINE: usize = 300;
/// Largest number of masses that are drawn.
const MOST_POINTS: usize = 40;

/// The shapes of the lowest `count` modes, scaled to a largest deflection of 1.
pub(crate) fn shapes(beam: &Beam, count: usize) -> Vec<ModeShape> {
    let mut shapes = match beam {
        Beam::Lumped(beam) => beam.modes(count).iter().map(|m| lumped(beam, m)).collect(),
        Beam::Distributed(beam) => distributed(beam, count),
        // Points without positions have no line.
        Beam::Modal(_) => Vec::new(),
    };
    for shape in &mut shapes {
        // Between the masses the deflection may be larger than at the masses.
        let further = |m: f64, (_, y): &(f64, f64)| if y.abs() > m.abs() { *y } else { m };
        let largest = shape.line.iter().fold(0.0, further);
        let all = shape.line.iter_mut().chain(&mut shape.points);
        all.for_each(|(_, y)| *y /= largest);
    }
    shapes
}

fn distances(hub: f64, tip: f64) -> Vec<f64> {
    (1..=LINE).map(|k| hub + (tip - hub) * k as f64 / LINE as f64).collect()
}

fn lumped(beam: &LumpedBeam, mode: &Mode) -> ModeShape {
    let masses: Vec<(f64, f64)> =
        beam.position_m().iter().copied().zip(mode.shape.iter().copied()).collect();
    let hub = beam.hub_radius_m();
    let start = [(0.0, 0.0), (hub, 0.0)];
    let straight = || start.into_iter().chain(masses.iter().copied()).collect();
    let curve = if beam.len() > MOST_DENSE {
        None
    } else {
        let torque = tip_torque(beam, mode).unwrap_or(0.0);
        beam.shape_through(&mode.shape, torque).ok()
    };
    let line = curve.map_or_else(straight, |shape| {
        let tip = masses.last().map_or(hub, |m| m.0);
        let bent = distances(hub, tip).into_iter().map(|x| (x, shape.deflection_m(x)));
        start.into_iter().chain(bent).collect()
    });
    let points = if masses.len() > MOST_POINTS { Vec::new() } else { masses };
    ModeShape { line, points }
}

/// Torque of the moving payload on the tip, in the scale of the mode.
///
/// `T = ω²·((I + m·e²)·φ + m·e·y)` with the slope of the tip `φ = φ_y + φ_T·T`.
fn tip_torque(beam: &LumpedBeam, mode: &Mode) -> Option<f64> {
    let payload = beam.payload();
    if !payload.turns() {
        return None;
    }
    let tip = *beam.position_m().last()?;
    let by_shape = beam.shape_through(&mode.shape, 0.0).ok()?.slope(tip);
    let by_torque = beam.shape_through(&[], 1.0).ok()?.slope(tip);
    let square = mode.natural_frequency_rad_s.powi(2);
    let moment = payload.mass_kg * payload.offset_m;
    let inertia = payload.inertia_kg_m2 + moment * payload.offset_m;
    let deflection = mode.shape.last()?;
    let torque =
        square * (inertia * by_shape + moment * deflection) / (1.0 - square * inertia * by_torque);
    torque.is_finite().then_some(torque)
}

fn distributed(beam: &DistributedBeam, count: usize) -> Vec<ModeShape> {
    let hub = beam.hub_radius_m();
    let points = distances(hub, beam.length_m());
    let modes = beam.modes(count, &points);
    let shape = |mode: &Mode| {
        let bent = points.iter().copied().zip(mode.shape.iter().copied());
        let line = [(0.0, 0.0), (hub, 0.0)].into_iter().chain(bent).collect();
        ModeShape { line, points: Vec::new() }
    };
    modes.iter().map(shape).collect()
}

#[cfg(test)]
mod tests {
    use lissom::beam::{Payload, Span};

    use super::*;

    /// The torque must give the slope that the payload's rotary inertia needs. A short, stiff span with two point
    /// masses that have this inertia has the same mode.
    #[test]
    fn a_payloads_inertia_bends_the_tip() {
        let span = |length_m, flexural_rigidity_n_m2, mass_kg| Span {
            length_m,
            flexural_rigidity_n_m2,
            mass_kg,
            damping_n_s_per_m: 0.0,
        };
        let (mass_kg, offset_m) = (0.3, 0.05);
        let inertia_kg_m2 = 2e-4;
        let payload = Payload { mass_kg, inertia_kg_m2, offset_m };
        let beam = LumpedBeam::new(&[span(0.3, 2.0, 0.1), span(0.2, 2.0, 0.1)]).unwrap();
        let beam = beam.with_payload(payload).unwrap();
        // Masses a before and behind the payload's centre on a nearly rigid beam.
        let arm = (inertia_kg_m2 / mass_kg).sqrt();
        let stiff = 2e5;
        let pieces = [
            span(0.3, 2.0, 0.1),
            span(0.2, 2.0, 0.1),
            span(offset_m - arm, stiff, 0.5 * mass_kg),
            span(2.0 * arm, stiff, 0.5 * mass_kg),
        ];
        let same = LumpedBeam::new(&pieces).unwrap();
        for (one, other) in beam.modes(2).iter().zip(&same.modes(2)) {
            let ratio = one.natural_frequency_rad_s / other.natural_frequency_rad_s;
            assert!((ratio - 1.0).abs() < 1e-4, "{ratio}");
            let torque = tip_torque(&beam, one).unwrap();
            let slope = beam.shape_through(&one.shape, torque).unwrap().slope(0.5);
            let rigid = (other.shape[3] - other.shape[2]) / (2.0 * arm);
            let scale = one.shape[1] / other.shape[1];
            assert!((slope / (rigid * scale) - 1.0).abs() < 1e-3, "{slope} {}", rigid * scale);
        }
    }
}
