//! State space model of the identified drive and beam.

use nalgebra::DMatrix;

use crate::identify::responses::rational::{BeamFit, MotorFit, Pole};
use crate::lti::StateSpace;

/// A mode that follows the motor, and pulls it back with `c(θ_m − q)`.
pub(crate) struct CoupledMode {
    pub(crate) pole: Pole,
    /// c.
    pub(crate) coupling: f64,
}

/// The state space of [`modal`], of rational fits. `tips` holds the residues r_ik of tips that are angles,
/// with their names; the modes' poles must be those of `motor`. Poles of the beam that are no modes are left
/// out.
pub(crate) fn state_space(
    motor: &MotorFit,
    torque_per_command: f64,
    beam: Option<&BeamFit>,
    tips: &[(usize, String)],
    unit: &str,
) -> StateSpace {
    let coupled = motor.poles.iter().zip(&motor.coupling);
    let modes: Vec<CoupledMode> =
        coupled.map(|(pole, c)| CoupledMode { pole: *pole, coupling: c.value }).collect();
    let gains = |tip: usize| -> Vec<f64> {
        let Some(residues) = beam.and_then(|b| b.residues.get(tip)) else { return Vec::new() };
        let modal = beam.map_or(&[][..], |b| &b.mode_poles);
        let each = modal.iter().zip(&motor.poles);
        each.map(|(&at, pole)| {
            let w2 = pole.omega_rad_s * pole.omega_rad_s;
            residues[at].value / w2
        })
        .collect()
    };
    let tips: Vec<(String, Vec<f64>)> =
        tips.iter().map(|(tip, name)| (name.clone(), gains(*tip))).collect();
    modal([motor.inertia.value, motor.viscous.value], torque_per_command, &modes, &tips, unit)
}

/// `ẋ = A·x + B·u` with `x = [θ_m, θ̇_m, q_1, q̇_1, …]`, u the command, y = θ_m and each tip.
///
/// Each mode follows the motor, `q̈_k = ω_k²(θ_m − q_k) − 2ζ_kω_k·q̇_k`, and pulls it back with
/// `c_k(θ_m − q_k)`; a tip is `Σ ρ_ik·q_k`, by its name and gains. `unit` is the angles' (`rad`, `m`).
pub(crate) fn modal(
    [j, v]: [f64; 2],
    torque_per_command: f64,
    modes: &[CoupledMode],
    tips: &[(String, Vec<f64>)],
    unit: &str,
) -> StateSpace {
    let n = 2 + 2 * modes.len();
    let mut a = DMatrix::zeros(n, n);
    a[(0, 1)] = 1.0;
    a[(1, 1)] = -v / j;
    let mut states = vec![format!("motor_{unit}"), format!("motor_{unit}_per_s")];
    for (k, CoupledMode { pole, coupling }) in modes.iter().enumerate() {
        let (q, w2) = (2 + 2 * k, pole.omega_rad_s * pole.omega_rad_s);
        // The damping acts on the mode's own velocity, so that C_t is c(θ_m − q).
        a[(1, 0)] -= coupling / j;
        a[(1, q)] += coupling / j;
        a[(q, q + 1)] = 1.0;
        a[(q + 1, 0)] = w2;
        a[(q + 1, q)] = -w2;
        a[(q + 1, q + 1)] = -2.0 * pole.damping_ratio * pole.omega_rad_s;
        states.push(format!("mode_{}_{unit}", k + 1));
        states.push(format!("mode_{}_{unit}_per_s", k + 1));
    }
    let mut b = DMatrix::zeros(n, 1);
    b[(1, 0)] = torque_per_command / j;
    let mut c = DMatrix::zeros(1 + tips.len(), n);
    c[(0, 0)] = 1.0;
    let mut outputs = vec![format!("motor_{unit}")];
    for (row, (name, gains)) in tips.iter().enumerate() {
        for (k, gain) in gains.iter().enumerate() {
            c[(1 + row, 2 + 2 * k)] = *gain;
        }
        outputs.push(format!("{name}_{unit}"));
    }
    let d = DMatrix::zeros(1 + tips.len(), 1);
    let inputs = vec!["command".to_owned()];
    StateSpace { a, b, c, d, states, inputs, outputs }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::responses::correct::Response;
    use crate::identify::responses::rational::{MotorData, fit_motor};
    use crate::lti::TransferFunction;

    #[test]
    fn responds_as_the_transfer_function_it_comes_from() {
        let g = TransferFunction {
            num: vec![394.94, 394.94 * 0.06, 394.94 * 43.75],
            den: vec![1.0, 2.26, 165.7, 103.56, 0.0],
        };
        let omega_rad_s: Vec<f64> = (0..30).map(|k| 1.12_f64.powi(k)).collect();
        let response =
            omega_rad_s.iter().map(|&w| Response { value: g.response(w), std: 1e-3 }).collect();
        let data = MotorData { omega_rad_s, response, torque_per_command: 2.184 };
        let pole = Pole { omega_rad_s: 43.75_f64.sqrt(), damping_ratio: 0.0045 };
        let fit = fit_motor(&data, Some(&[pole])).unwrap();
        let space = state_space(&fit, 2.184, None, &[], "rad");
        for w in [0.5, 3.0, 6.0, 13.0, 40.0] {
            let (a, b) = (space.response(w).unwrap()[0], fit.transfer_function.response(w));
            assert!((a / b - 1.0).norm() < 1e-10, "{w}: {a} {b}");
        }
    }
}
