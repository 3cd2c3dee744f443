//! Where the output error starts: the figures of the regressions as an arm.

use nalgebra::DMatrix;

use crate::identify::{BeamRegression, MotorRegression};
use crate::record::{Campaign, TipQuantity};
use crate::replay::{ModalArm, Oscillator, Parameter};

/// Smallest stiffness of a mode to start with, as a share of the coupling: its logarithm is moved.
const LEAST_SHARE: f64 = 0.02;

/// The arm that the regressions describe; `None` where they lack what it needs.
pub fn start_of_regressions(
    campaign: &Campaign,
    motor: &MotorRegression,
    beam: Option<&BeamRegression>,
) -> Option<ModalArm> {
    let inertia = motor.inertia?.value;
    let viscous =
        motor.viscous.map_or(0.0, |v| v.value) + campaign.channels.command.back_emf_viscous;
    let coulomb = motor.coulomb?.value;
    if !(inertia > 0.0) || !coulomb.is_finite() {
        return None;
    }
    let mut arm = ModalArm {
        inertia_kg_m2: inertia,
        viscous_nm_s_per_rad: [viscous; 2],
        coulomb_nm: coulomb,
        offset_nm: motor.offset.map_or(0.0, |o| o.value),
        modes: Vec::new(),
        shapes: vec![Vec::new(); campaign.channels.tips.len()],
        at_points_per_s: Vec::new(),
        command_lag_s: 0.0,
    };
    if let Some(beam) = beam {
        let (omega, shapes) = ModalArm::modes_of(&beam.stiffness)?;
        let coupling: Vec<f64> =
            motor.coupling.iter().map(|c| c.map(|e| e.value)).collect::<Option<_>>()?;
        let total: f64 = coupling.iter().sum();
        let r = DMatrix::from_fn(shapes.len(), omega.len(), |i, j| shapes[i][j]);
        let stiffness = r.tr_mul(&nalgebra::DVector::from_vec(coupling));
        for (j, &omega_rad_s) in omega.iter().enumerate() {
            let ratio = beam.modes.get(j).map_or(0.0, |m| m.damping_ratio.value);
            arm.modes.push(Oscillator {
                omega_rad_s,
                stiffness_nm_per_rad: stiffness[j].max(LEAST_SHARE * total.abs()),
                within_per_s: (2.0 * ratio * omega_rad_s).max(0.0),
                grounded_per_s: 0.0,
            });
        }
        arm.at_points_per_s = vec![0.0; omega.len()];
        arm.shapes = shapes;
    } else if campaign
        .channels
        .tips
        .iter()
        .any(|t| t.calibrated && t.quantity != TipQuantity::Acceleration)
    {
        return None;
    }
    Some(arm)
}

/// The parameters of an arm that a campaign's channels can show, with Coulomb friction, one viscous
/// constant and damping within the beam.
pub fn free_parameters(campaign: &Campaign, arm: &ModalArm) -> Vec<Parameter> {
    let mut free =
        vec![Parameter::Inertia, Parameter::Viscous, Parameter::Coulomb, Parameter::Offset];
    let modes = arm.modes.len();
    for j in 0..modes {
        free.extend([
            Parameter::Frequency(j),
            Parameter::Stiffness(j),
            Parameter::DampingWithin(j),
        ]);
    }
    for (i, tip) in campaign.channels.tips.iter().enumerate() {
        if tip.calibrated {
            free.extend((0..modes.saturating_sub(1)).map(|j| Parameter::ShapeShare(i, j)));
        } else {
            free.extend((0..modes).map(|j| Parameter::Shape(i, j)));
        }
    }
    free
}
