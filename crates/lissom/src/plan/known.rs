//! A rig as a replay sees it: what is known beforehand of an arm, its channels and their noise.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::PlanError;
use crate::identify::free_parameters;
use crate::record::{
    Axis, Campaign, Channels, Command, CommandQuantity, Hold, Run, Tip, TipQuantity,
};
use crate::replay::{DryTerms, MOST_MODES, ModalArm, Oscillator, Parameter, SensorNoise, Window};
use crate::rig::{Logged, Rig, Sensor};

/// Modes of more than this many radians a sample are not followed: six samples a period.
const FASTEST: f64 = 1.0;
/// Modes that carry less than this share of the inertia turn with the motor.
const LEAST_SHARE: f64 = 1e-3;
/// Deviation of a sensor that has neither steps nor noise \[rad\].
const IDEAL_RAD: f64 = 1e-6;

/// An arm that is roughly known, with what its sensors add.
#[derive(Debug, Clone)]
pub(super) struct Known {
    /// As its motor feels it, modes that are too fast turning with the motor.
    pub(super) arm: ModalArm,
    pub(super) channels: Channels,
    /// What an identification has to find.
    pub(super) parameters: Vec<Parameter>,
    /// Motor first, then tips.
    pub(super) noise: Vec<SensorNoise>,
    /// Modes that are not followed \[rad/s\].
    pub(super) left_out_rad_s: Vec<f64>,
    /// Whether some sensor has neither steps nor noise.
    pub(super) ideal_sensor: bool,
    /// Masses whose sensors count.
    tips: Range<usize>,
    /// From q_i − θ_m to ψ_j − θ_m.
    to_modes: DMatrix<f64>,
}

impl Known {
    pub(super) fn of(rig: &Rig) -> Result<Self, PlanError> {
        let dynamics = rig.arm.dynamics();
        let (n, masses) = (dynamics.len(), rig.arm.beam().len());
        let (omega, shapes) =
            ModalArm::modes_of(&-&dynamics.elastic).ok_or(PlanError::Modes { masses })?;
        let r = DMatrix::from_fn(n, n, |i, j| shapes[i][j]);
        let inverse = r.clone().try_inverse().ok_or(PlanError::Modes { masses })?;
        let damping = |matrix: Option<&DMatrix<f64>>| {
            matrix.map_or_else(|| DVector::zeros(n), |m| -(&inverse * m * &r).diagonal())
        };
        let (within, grounded) =
            (damping(dynamics.relative.as_ref()), damping(dynamics.absolute.as_ref()));
        let stiffness = -(r.transpose() * &dynamics.coupling);
        let inertia = |j: usize| stiffness[j] / (omega[j] * omega[j]);
        let motor = rig.arm.motor.inertia_kg_m2;
        let followed = |j: &usize| {
            omega[*j] * rig.instruments.log_time_s() <= FASTEST && inertia(*j) > LEAST_SHARE * motor
        };
        let kept: Vec<usize> = (0..n).filter(followed).take(MOST_MODES).collect();
        let left_out: Vec<usize> = (0..n).filter(|j| !kept.contains(j)).collect();
        let mode = |&j: &usize| Oscillator {
            omega_rad_s: omega[j],
            stiffness_nm_per_rad: stiffness[j],
            within_per_s: within[j].max(0.0),
            grounded_per_s: grounded[j].max(0.0),
        };
        let tips = tips(masses, kept.len());
        let delay_s = rig.instruments.delay.map_or(0.0, |d| d.delay_s());
        let arm = ModalArm {
            inertia_kg_m2: motor + left_out.iter().map(|j| inertia(*j)).sum::<f64>(),
            viscous_nm_s_per_rad: [rig.arm.motor.viscous_nm_s_per_rad; 2],
            coulomb_nm: 0.5 * (rig.arm.coulomb.forward + rig.arm.coulomb.backward),
            offset_nm: 0.5 * (rig.arm.coulomb.forward - rig.arm.coulomb.backward),
            modes: kept.iter().map(mode).collect(),
            shapes: tips.clone().map(|i| kept.iter().map(|j| r[(i, *j)]).collect()).collect(),
            at_points_per_s: Vec::new(),
            dry_terms: DryTerms::default(),
            command_lag_s: delay_s,
        };
        let channels = channels(rig, tips.clone());
        let parameters = parameters(&channels, &arm);
        let sensors: Vec<Sensor> = std::iter::once(rig.instruments.motor)
            .chain(tips.clone().map(|i| rig.instruments.tip(i)))
            .collect();
        Ok(Self {
            parameters,
            noise: sensors.iter().map(noise_of).collect(),
            ideal_sensor: sensors.contains(&Sensor::IDEAL),
            left_out_rad_s: left_out.iter().map(|j| omega[*j]).collect(),
            tips,
            to_modes: inverse.select_rows(&kept),
            channels,
            arm,
        })
    }

    /// A simulated run as the replay takes it: the current that acted, and the true start.
    pub(super) fn record(&self, rig: &Rig, logged: &Logged) -> Option<(Campaign, Window)> {
        let run = &logged.run;
        // What the amplifier's dead zone swallows does not act.
        let acted = run.command().iter().map(|u| rig.instruments.amplifier.current_a(*u)).collect();
        let tips = run.tips()[self.tips.clone()].to_vec();
        let run = Run::new(run.name(), run.time(), acted, run.motor().to_vec(), tips).ok()?;
        let window = Window {
            run: 0,
            samples: 0..=run.len() - 1,
            start: self.state(&logged.start),
            zeros: vec![0.0; self.channels.tips.len()],
        };
        Some((Campaign::new(self.channels.clone(), vec![run]).ok()?, window))
    }

    /// `[θ, θ̇, ψ_1, ψ̇_1, …]` of a state of the arm.
    fn state(&self, x: &[f64]) -> Vec<f64> {
        let n = self.to_modes.ncols();
        let modal = |x: &[f64], from: f64| {
            &self.to_modes * DVector::from_iterator(n, x.iter().map(|q| q - from))
        };
        let (angles, rates) = (modal(&x[2..2 + n], x[0]), modal(&x[2 + n..2 + 2 * n], x[1]));
        let mut state = vec![x[0], x[1]];
        for (angle, rate) in angles.iter().zip(&rates) {
            state.extend([x[0] + angle, x[1] + rate]);
        }
        state
    }
}

/// All masses' sensors; of more masses than modes that are followed the tip's alone, as the others of a
/// lumped beam are in no laboratory.
fn tips(masses: usize, modes: usize) -> Range<usize> {
    match modes {
        0 => 0..0,
        _ if masses > MOST_MODES => masses - 1..masses,
        _ => 0..masses,
    }
}

fn channels(rig: &Rig, tips: Range<usize>) -> Channels {
    let instruments = &rig.instruments;
    let held = instruments.control_every.is_multiple_of(instruments.log_every);
    let tip = |i: usize| Tip {
        name: format!("theta_{}", i + 1),
        quantity: TipQuantity::Angle,
        calibrated: true,
    };
    Channels {
        axis: Axis::Rotary,
        command: Command {
            quantity: CommandQuantity::Current,
            hold: if held { Hold::Sampled } else { Hold::Measured },
            torque_per_command: Some(rig.arm.motor.torque_constant_nm_per_a),
            back_emf_viscous: 0.0,
            limit: instruments.amplifier.limit_a(),
        },
        tips: tips.map(tip).collect(),
    }
}

/// What the output error frees of such an arm, with what it adds where the residual calls for it.
fn parameters(channels: &Channels, arm: &ModalArm) -> Vec<Parameter> {
    let campaign = Campaign { channels: channels.clone(), runs: Vec::new() };
    let mut free = free_parameters(&campaign, arm);
    let grounded = arm.modes.iter().enumerate().filter(|(_, m)| m.grounded_per_s > 0.0);
    free.extend(grounded.map(|(j, _)| Parameter::DampingGrounded(j)));
    if arm.command_lag_s > 0.0 {
        free.push(Parameter::CommandLag);
    }
    free
}

/// Noise and steps as one deviation: a reading's error is taken to be spread evenly over a step.
fn noise_of(sensor: &Sensor) -> SensorNoise {
    let sigma = sensor.noise.map_or(0.0, |n| n.std());
    let step = sensor.quantiser.map_or(0.0, |q| q.step());
    SensorNoise::gaussian(SensorNoise { sigma, step }.deviation().max(IDEAL_RAD))
}
