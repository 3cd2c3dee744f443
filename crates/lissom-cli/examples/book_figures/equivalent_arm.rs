//! `equivalent-arm.svg`: a distributed beam and its equivalent lumped arm.

use lissom::beam::{Base, Damping, DistributedBeam, Piece};
use lissom::identify::{EquivalentData, MotorData, Response, StdSource, equivalent};
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};
use num_complex::Complex64;

use crate::Drawn;
use crate::arms::demo_rig;
use crate::experiments::{merged, ratios};

/// A steel strip with a load at its tip.
const BEAM: Piece = Piece {
    length_m: 0.6,
    flexural_rigidity_n_m2: 0.5,
    mass_per_length_kg_per_m: 0.2,
    end_mass_kg: 0.05,
    end_damping_n_s_per_m: 0.0,
};
/// Damping per mass \[1/s\].
const DAMPING_PER_S: f64 = 0.3;
/// Points measured, distances from the axis \[m\].
const POINTS_M: [f64; 3] = [0.2, 0.4, 0.6];
/// Frequencies measured, and points of a line.
const MEASURED: usize = 40;
const LINE: usize = 1000;
/// Relative standard deviation of the responses.
const STD: f64 = 1e-3;

/// Magnitude of the tip's response.
pub(crate) fn figure() -> Drawn {
    let damping = Damping::Proportional { mass_per_s: DAMPING_PER_S, stiffness_s: 0.0 };
    let beam = DistributedBeam::new(&[BEAM])?.with_damping(damping)?;
    let omega = beam.frequencies_rad_s(Base::Clamped, 5);
    let last = (omega[2] * omega[3]).sqrt();
    let measured = ratios(omega[0] / 5.0, last, MEASURED);
    let arm = equivalent(&data(&beam, &measured)?, None)?;
    let lumped = arm.arm.as_ref().ok_or("no arm")?.modal_beam()?;
    let line = merged(ratios(omega[0] / 5.0, 1.3 * omega[4], LINE), omega);
    let s = |w: &f64| Complex64::new(0.0, *w);
    let decibels = |r: Complex64| 20.0 * r.norm().log10();
    let exact = |w: &f64| decibels(beam.response_at(s(w), &POINTS_M).angles[2]);
    let found = |w: &f64| decibels(lumped.response(s(w)).angles[2]);
    let plot = LinePlot::new(
        "Tip of a distributed beam, and of its equivalent lumped arm",
        Axis::log("frequency (rad/s)"),
        Axis::linear("|θ_t/θ_m| (dB)"),
    )
    .subtitle(format!(
        "{} modes found in responses at {} points, measured below {last:.0} rad/s",
        arm.modes.len(),
        POINTS_M.len()
    ))
    .trace(Trace::line(
        "distributed beam",
        Role::Truth,
        line.clone(),
        line.iter().map(exact).collect(),
    ))
    .trace(Trace::line(
        "equivalent lumped arm",
        Role::Corrected,
        line.clone(),
        line.iter().map(found).collect(),
    ))
    .trace(Trace::new(
        "responses measured",
        Role::Raw,
        TraceStyle::Points,
        measured.clone(),
        measured.iter().map(exact).collect(),
    ));
    Ok(Box::new(plot))
}

fn data(
    beam: &DistributedBeam,
    omega: &[f64],
) -> Result<EquivalentData, Box<dyn std::error::Error>> {
    let motor = demo_rig()?.arm.motor;
    let with_std = |value: Complex64| Response { value, std: STD * value.norm() };
    let (mut outputs, mut response) = (vec![Vec::new(); POINTS_M.len()], Vec::new());
    for w in omega {
        let s = Complex64::new(0.0, *w);
        let seen = beam.response_at(s, &POINTS_M);
        for (output, angle) in outputs.iter_mut().zip(seen.angles) {
            output.push(with_std(angle));
        }
        let torque = motor.impedance(s) + seen.coupling_nm_per_rad;
        response.push(with_std(motor.torque_constant_nm_per_a() / torque));
    }
    Ok(EquivalentData {
        names: POINTS_M.map(|x| format!("{x} m")).to_vec(),
        omega_rad_s: omega.to_vec(),
        outputs,
        motor: Some(MotorData {
            omega_rad_s: omega.to_vec(),
            response,
            torque_per_command: motor.torque_constant_nm_per_a(),
        }),
        std_source: StdSource::Measured,
    })
}
