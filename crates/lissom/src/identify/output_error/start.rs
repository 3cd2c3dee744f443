//! Where the output error starts: the figures of the regressions as an arm.

use crate::identify::{BeamFit, BeamRegression, MotorRegression};
use crate::record::{Campaign, Tip, TipQuantity};
use crate::replay::{DryTerms, MOST_MODES, ModalArm, Oscillator};

/// Smallest stiffness of a mode to start with, as a share of the coupling: its logarithm is moved.
const LEAST_SHARE: f64 = 0.02;

/// Share of every tip's motion below which a mode is none to start with.
const NEGLIGIBLE: f64 = 0.05;

/// Arms to start from, the likelier first: the motor's regression with the beam's own, with the modes of
/// the rational model, and as a rigid axis where there is no tip. Empty where the motor's figures lack
/// what it needs.
pub fn starts(
    campaign: &Campaign,
    motor: &MotorRegression,
    beam: Option<&BeamRegression>,
    rational: Option<&BeamFit>,
) -> Vec<ModalArm> {
    let Some(rigid) = rigid(campaign, motor) else { return Vec::new() };
    let coupling: Option<Vec<f64>> =
        motor.coupling.iter().map(|c| c.map(|e| e.value)).collect::<Option<_>>();
    let angles = campaign.channels.tips.iter().any(known);
    let Some(coupling) = coupling.filter(|_| angles) else {
        return if campaign.channels.tips.is_empty() { vec![rigid] } else { Vec::new() };
    };
    let by_regression = beam.and_then(|b| {
        let (omega, shapes) = ModalArm::modes_of(&b.stiffness)?;
        let ratios = b.modes.iter().map(|m| m.damping_ratio.value).collect();
        Some((omega, ratios, shapes))
    });
    let by_responses = rational.and_then(modes_of_responses);
    [by_regression, by_responses]
        .into_iter()
        .flatten()
        .map(shown)
        .filter(|(omega, ..)| omega.len() <= MOST_MODES)
        .map(|modes| with_modes(rigid.clone(), modes, &coupling))
        .collect()
}

/// Frequencies, damping ratios, and shapes by tip.
type Modes = (Vec<f64>, Vec<f64>, Vec<Vec<f64>>);

/// Without modes that no tip shows beside the others: noise makes them, and they stand in the place of
/// those that the fit adds where it needs them.
fn shown((mut omega, mut ratios, mut shapes): Modes) -> Modes {
    let share = |shapes: &[Vec<f64>], j: usize| {
        shapes.iter().map(|row: &Vec<f64>| row[j].abs()).fold(0.0, f64::max)
    };
    for j in (0..omega.len()).rev() {
        if omega.len() > 1 && share(&shapes, j) < NEGLIGIBLE {
            omega.remove(j);
            ratios.remove(j);
            for row in &mut shapes {
                let gone = row.remove(j);
                row.last_mut().into_iter().for_each(|r| *r += gone);
            }
        }
    }
    (omega, ratios, shapes)
}

fn known(tip: &Tip) -> bool {
    tip.calibrated && tip.quantity != TipQuantity::Acceleration
}

fn rigid(campaign: &Campaign, motor: &MotorRegression) -> Option<ModalArm> {
    let inertia = motor.inertia?.value;
    let back_emf = campaign.channels.command.back_emf_viscous;
    let coulomb = motor.coulomb?.value;
    (inertia > 0.0 && coulomb.is_finite()).then(|| ModalArm {
        inertia_kg_m2: inertia,
        viscous_nm_s_per_rad: [motor.viscous.map_or(0.0, |v| v.value) + back_emf; 2],
        coulomb_nm: coulomb,
        offset_nm: motor.offset.map_or(0.0, |o| o.value),
        modes: Vec::new(),
        shapes: vec![Vec::new(); campaign.channels.tips.len()],
        at_points_per_s: Vec::new(),
        dry_terms: DryTerms::default(),
        command_lag_s: 0.0,
    })
}

/// `r_ij = (residue of tip i in mode j)/ω_j²`, the rest of Σr = 1 given to the last mode.
fn modes_of_responses(fit: &BeamFit) -> Option<Modes> {
    let poles: Vec<_> = fit.mode_poles.iter().map(|&k| fit.poles[k]).collect();
    let square = |j: usize| poles[j].omega_rad_s * poles[j].omega_rad_s;
    let shapes = fit
        .residues
        .iter()
        .map(|tip| {
            let mut row: Vec<f64> =
                fit.mode_poles.iter().enumerate().map(|(j, &k)| tip[k].value / square(j)).collect();
            let sum: f64 = row.iter().sum();
            row.last_mut().into_iter().for_each(|r| *r += 1.0 - sum);
            row
        })
        .collect();
    let omega: Vec<f64> = poles.iter().map(|p| p.omega_rad_s).collect();
    let ratios = poles.iter().map(|p| p.damping_ratio).collect();
    (!omega.is_empty()).then_some((omega, ratios, shapes))
}

fn with_modes(mut arm: ModalArm, (omega, ratios, shapes): Modes, coupling: &[f64]) -> ModalArm {
    let total: f64 = coupling.iter().sum();
    for (j, &omega_rad_s) in omega.iter().enumerate() {
        let ratio = ratios.get(j).copied().unwrap_or(0.0);
        let stiffness: f64 = coupling.iter().zip(&shapes).map(|(k, r)| k * r[j]).sum();
        arm.modes.push(Oscillator {
            omega_rad_s,
            stiffness_nm_per_rad: stiffness.max(LEAST_SHARE * total.abs()),
            within_per_s: (2.0 * ratio * omega_rad_s).max(0.0),
            grounded_per_s: 0.0,
        });
    }
    arm.at_points_per_s =
        if omega.len() == shapes.len() { vec![0.0; omega.len()] } else { Vec::new() };
    arm.shapes = shapes;
    arm
}
