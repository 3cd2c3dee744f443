//! Starting arms of the output-error method, from the estimates of other methods.

use crate::identify::drive_estimates::DriveEstimates;
use crate::identify::estimate::Estimate;
use crate::identify::methods::regression::{BeamRegression, ModeShape};
use crate::identify::output_error::thresholds::{
    START_POLE_OUTSIDE, START_SHAPE_LEAST, START_STIFFNESS_LEAST,
};
use crate::identify::responses::correct::Response;
use crate::identify::responses::rational::{
    BeamFit, Damping, MotorData, MotorFit, Pole, fit_motor, fit_shared_poles,
};
use crate::identify::responses::thresholds::MODE_DAMPING_MOST;
use crate::identify::thresholds::MODE_DAMPING_LEAST;
use crate::record::Campaign;
use crate::replay::{DryTerms, MOST_MODES, ModalArm, Oscillator};

/// Starting arms if a tip's angle is known, the likelier first: the `drive`'s estimates with the modes of the beam
/// regression, and with the modes of the rational model `tips`. Empty if no tip's angle is known, or if an estimate
/// of the drive that an arm needs is missing.
pub fn starts(
    campaign: &Campaign,
    drive: &DriveEstimates,
    beam: Option<&BeamRegression>,
    tips: Option<&BeamFit>,
) -> Vec<ModalArm> {
    let coupling: Option<Vec<f64>> =
        drive.coupling_by_tip.iter().map(|c| c.map(|e| e.value)).collect();
    let (Some(rigid), Some(coupling)) = (rigid(campaign, drive), coupling) else {
        return Vec::new();
    };
    if coupling.is_empty() {
        return Vec::new();
    }
    let by_regression = beam.and_then(|b| {
        let sums: Vec<f64> = b.shares.iter().map(|share| share.value).collect();
        let (omega, shapes) = ModalArm::modes_of(&b.stiffness, &sums)?;
        let ratios = b.modes.iter().map(|m| m.damping_ratio.value).collect();
        Some((omega, ratios, shapes))
    });
    let by_responses = tips.and_then(modes_of_responses).map(|(omega, ratios, mut shapes)| {
        for row in &mut shapes {
            whole(row);
        }
        (omega, ratios, shapes)
    });
    [by_regression, by_responses]
        .into_iter()
        .flatten()
        .map(shown)
        .filter(|(omega, ..)| omega.len() <= MOST_MODES)
        .map(|modes| with_modes(rigid.clone(), modes, &coupling))
        .collect()
}

/// Starting arms if no tip's angle is known, the simpler first: a rigid axis if there is no tip at all, and the modes
/// of the motor's rational model `response`, if it has modes.
pub fn starts_by_motor(
    campaign: &Campaign,
    drive: &DriveEstimates,
    tips: Option<&BeamFit>,
    response: Option<&MotorFit>,
) -> Vec<ModalArm> {
    let Some(rigid) = rigid(campaign, drive) else { return Vec::new() };
    let flexible = response.and_then(|r| flexible(&rigid, campaign, r, tips));
    let rigid = campaign.channels.tips.is_empty().then_some(rigid);
    rigid.into_iter().chain(flexible).collect()
}

/// Starting arms from responses alone, with one mode, two, and so on up to the number of tips. The poles are those
/// that the `tips`' responses θ_i/θ_m at `omega_rad_s` share, and the coupling is that of the motor's response with
/// these poles. Other starts need more: slip phases need a tip sensor with fine resolution for the coupling, and the
/// beam's own equation needs motions in which every mode takes part.
pub fn starts_by_responses(
    campaign: &Campaign,
    drive: &DriveEstimates,
    omega_rad_s: &[f64],
    tips: &[Vec<Response>],
    response: &MotorData,
) -> Vec<ModalArm> {
    let Some(rigid) = rigid(campaign, drive) else { return Vec::new() };
    let found = |modes: usize| {
        let fit = fit_shared_poles(omega_rad_s, tips, modes, Damping::Small).ok()?;
        let (low, high) = fit.range_rad_s;
        let near = low / START_POLE_OUTSIDE..high * START_POLE_OUTSIDE;
        let is_mode = |p: &Pole| {
            near.contains(&p.omega_rad_s)
                && (MODE_DAMPING_LEAST..MODE_DAMPING_MOST).contains(&p.damping_ratio)
        };
        let kept: Vec<usize> = (0..modes).filter(|k| is_mode(&fit.poles[*k])).collect();
        let poles: Vec<Pole> = kept.iter().map(|k| fit.poles[*k]).collect();
        let of_kept = |row: &Vec<f64>| kept.iter().map(|k| row[*k]).collect();
        let shapes = fit.static_gains.iter().map(of_kept).collect();
        coupled(&rigid, &poles, shapes, response)
    };
    (1..=tips.len().min(MOST_MODES)).filter_map(found).collect()
}

/// An arm with these poles and shapes, with the coupling from the motor's response.
fn coupled(
    rigid: &ModalArm,
    poles: &[Pole],
    mut shapes: Vec<Vec<f64>>,
    response: &MotorData,
) -> Option<ModalArm> {
    if poles.is_empty() {
        return None;
    }
    let fit = fit_motor(response, Some(poles))?;
    let total: f64 = fit.coupling.iter().map(|c| c.value.max(0.0)).sum();
    let least = START_STIFFNESS_LEAST * total;
    let modes = poles.iter().zip(&fit.coupling).map(|(p, c)| oscillator(p, c.value.max(least)));
    for row in &mut shapes {
        whole(row);
    }
    let all = if poles.len() == shapes.len() { poles.len() } else { 0 };
    let inertia = Some(fit.inertia.value).filter(|j| *j > 0.0);
    (total > 0.0).then(|| ModalArm {
        inertia_kg_m2: inertia.unwrap_or(rigid.inertia_kg_m2),
        modes: modes.collect(),
        at_points_per_s: vec![0.0; all],
        shapes,
        ..rigid.clone()
    })
}

/// An arm with the modes of the motor's response, and with each tip's share in them from `tips`, which has the same
/// modes. The inertia is that of the response: slip phases alone count the beam's inertia with the motor's.
fn flexible(
    rigid: &ModalArm,
    campaign: &Campaign,
    response: &MotorFit,
    tips: Option<&BeamFit>,
) -> Option<ModalArm> {
    let channels = &campaign.channels.tips;
    let count = response.poles.len();
    let total: f64 = response.coupling.iter().map(|c| c.value.max(0.0)).sum();
    if count == 0 || count > MOST_MODES || total.is_nan() || total <= 0.0 {
        return None;
    }
    let shapes = if channels.is_empty() {
        Vec::new()
    } else {
        let (omega, _, mut shapes) = modes_of_responses(tips?)?;
        if omega.len() != count {
            return None;
        }
        for (_, row) in channels.iter().zip(&mut shapes).filter(|(tip, _)| tip.calibrated) {
            whole(row);
        }
        shapes
    };
    let modes = response.poles.iter().zip(&response.coupling);
    let least = START_STIFFNESS_LEAST * total;
    let modes = modes.map(|(pole, coupling)| oscillator(pole, coupling.value.max(least)));
    let inertia = Some(response.inertia.value).filter(|j| *j > 0.0);
    Some(ModalArm {
        inertia_kg_m2: inertia.unwrap_or(rigid.inertia_kg_m2),
        viscous_nm_s_per_rad: [response.viscous.value.max(0.0); 2],
        modes: modes.collect(),
        at_points_per_s: if count == shapes.len() { vec![0.0; count] } else { Vec::new() },
        shapes,
        ..rigid.clone()
    })
}

/// Frequencies, damping ratios, and shapes by tip.
type Modes = (Vec<f64>, Vec<f64>, Vec<Vec<f64>>);

/// Removes modes that no tip shows: noise makes them, and they would replace modes that the fit adds where it needs
/// them.
fn shown((mut omega, mut ratios, mut shapes): Modes) -> Modes {
    let share = |shapes: &[Vec<f64>], j: usize| {
        shapes.iter().map(|row: &Vec<f64>| row[j].abs()).fold(0.0, f64::max)
    };
    for j in (0..omega.len()).rev() {
        if omega.len() > 1 && share(&shapes, j) < START_SHAPE_LEAST {
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

/// A rigid axis with a part of its inertia behind a spring.
pub(crate) fn with_hidden_mode(mut rigid: ModalArm, mode: ModeShape) -> ModalArm {
    let ModeShape { omega_rad_s, damping_s, inertia_share } = mode;
    let stiffness = (1.0 - inertia_share) * rigid.inertia_kg_m2 * omega_rad_s * omega_rad_s;
    rigid.inertia_kg_m2 *= inertia_share;
    rigid.modes.push(Oscillator {
        omega_rad_s,
        stiffness_nm_per_rad: stiffness,
        // c·k is the damper between the inertias, over the one behind.
        within_per_s: damping_s.max(0.0) * omega_rad_s * omega_rad_s,
        grounded_per_s: 0.0,
    });
    rigid
}

/// A rigid axis with the inertia and friction of some estimates.
pub(crate) fn rigid(campaign: &Campaign, drive: &DriveEstimates) -> Option<ModalArm> {
    let inertia = drive.inertia?.value;
    let back_emf = campaign.channels.command.back_emf_viscous;
    let friction = &drive.friction;
    let coulomb = friction.coulomb?.value;
    let damped = |v: Option<Estimate>| v.map_or(0.0, |v| v.value) + back_emf;
    let viscous = [damped(friction.viscous); 2];
    (inertia > 0.0 && coulomb.is_finite()).then(|| ModalArm {
        inertia_kg_m2: inertia,
        viscous_nm_s_per_rad: viscous,
        coulomb_nm: coulomb,
        offset_nm: friction.offset.map_or(0.0, |o| o.value),
        modes: Vec::new(),
        shapes: vec![Vec::new(); campaign.channels.tips.len()],
        at_points_per_s: Vec::new(),
        dry_terms: DryTerms::default(),
        gravity: drive.gravity.map(|g| g.load()),
        torque_ripples: Vec::new(),
        command_lag_s: 0.0,
        tip_lags_s: Vec::new(),
    })
}

/// `r_ij = (residue of tip i in mode j)/ω_j²`.
fn modes_of_responses(fit: &BeamFit) -> Option<Modes> {
    let poles: Vec<_> = fit.mode_poles.iter().map(|&k| fit.poles[k]).collect();
    let square = |j: usize| poles[j].omega_rad_s * poles[j].omega_rad_s;
    let of_tip = |tip: &Vec<Estimate>| {
        fit.mode_poles.iter().enumerate().map(|(j, &k)| tip[k].value / square(j)).collect()
    };
    let shapes = fit.residues.iter().map(of_tip).collect();
    let omega: Vec<f64> = poles.iter().map(|p| p.omega_rad_s).collect();
    let ratios = poles.iter().map(|p| p.damping_ratio).collect();
    (!omega.is_empty()).then_some((omega, ratios, shapes))
}

/// A mode with damping within the beam.
fn oscillator(pole: &Pole, stiffness_nm_per_rad: f64) -> Oscillator {
    Oscillator {
        omega_rad_s: pole.omega_rad_s,
        stiffness_nm_per_rad,
        within_per_s: (2.0 * pole.damping_ratio * pole.omega_rad_s).max(0.0),
        grounded_per_s: 0.0,
    }
}

/// Adds to the last mode what is missing for Σr = 1.
fn whole(row: &mut [f64]) {
    let sum: f64 = row.iter().sum();
    row.last_mut().into_iter().for_each(|r| *r += 1.0 - sum);
}

fn with_modes(mut arm: ModalArm, (omega, ratios, shapes): Modes, coupling: &[f64]) -> ModalArm {
    let total: f64 = coupling.iter().sum();
    for (j, &omega_rad_s) in omega.iter().enumerate() {
        let damping_ratio = ratios.get(j).copied().unwrap_or(0.0);
        let stiffness: f64 = coupling.iter().zip(&shapes).map(|(k, r)| k * r[j]).sum();
        let pole = Pole { omega_rad_s, damping_ratio };
        arm.modes.push(oscillator(&pole, stiffness.max(START_STIFFNESS_LEAST * total.abs())));
    }
    arm.at_points_per_s =
        if omega.len() == shapes.len() { vec![0.0; omega.len()] } else { Vec::new() };
    arm.shapes = shapes;
    arm
}
