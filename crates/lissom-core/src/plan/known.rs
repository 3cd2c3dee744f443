//! A rig in the form that the replay needs: the roughly known arm, its channels and their noise.

use std::ops::Range;

use nalgebra::DMatrix;

use super::loaded_information::LoadedJoint;
use super::{PlanError, PlannedParameter, PlannedUnknown, Precision};
use crate::information::ArmParameter;
use crate::load::GravityLoad;
use crate::plan::thresholds::MODE_FOLLOWED;
use crate::record::{Campaign, Channels, Run};
use crate::replay::{
    ArmModes, Body, MOST_MODES, ModalArm, Parameter, SensorNoise, Window, free_parameters,
};
use crate::rig::{Logged, Rig, Sensor};

/// Standard deviation that is assumed for a sensor with neither steps nor noise \[rad\].
const IDEAL_RAD: f64 = 1e-6;

/// A roughly known arm with its sensors.
#[derive(Debug, Clone)]
pub(super) struct KnownRig<'a> {
    /// The arm; modes that are too fast for the log are assumed to turn with the motor.
    pub(super) arm: ModalArm,
    pub(super) channels: Channels,
    /// Parameters of the arm that the identification has to find.
    pub(super) parameters: Vec<Parameter>,
    /// Gravity on a rigid joint, with two further unknowns.
    pub(super) gravity: Option<GravityLoad>,
    /// Noise of each sensor, motor first, then tips.
    pub(super) noise: Vec<SensorNoise>,
    /// Frequencies of the modes that are left out \[rad/s\].
    pub(super) left_out_rad_s: Vec<f64>,
    /// Whether a sensor has neither steps nor noise.
    pub(super) ideal_sensor: bool,
    /// Masses whose sensors count.
    tips: Range<usize>,
    modes: ArmModes<'a>,
    /// Modes that are followed.
    kept: Vec<usize>,
}

impl<'a> KnownRig<'a> {
    pub(super) fn of(rig: &'a Rig) -> Result<Self, PlanError> {
        let masses = rig.arm.beam().len();
        let modes = ArmModes::of(&rig.arm).ok_or(PlanError::Modes { masses })?;
        let omega = modes.omega_rad_s();
        let followed = |j: &usize| omega[*j] * rig.instruments.log_time_s() <= MODE_FOLLOWED;
        let kept: Vec<usize> = (0..omega.len()).filter(followed).take(MOST_MODES).collect();
        let left_out = (0..omega.len()).filter(|j| !kept.contains(j));
        let left_out_rad_s = left_out.map(|j| omega[j]).collect();
        let tips = tips(masses, kept.len());
        let arm = ModalArm {
            gravity: None,
            command_lag_s: rig.instruments.delay.map_or(0.0, |d| d.delay_s()),
            ..modes.cut(&kept, tips.clone())
        };
        let channels = rig.channels_of(tips.clone());
        let sensors: Vec<Sensor> = std::iter::once(rig.instruments.motor)
            .chain(tips.clone().map(|i| rig.instruments.tip(i)))
            .collect();
        let noise = |s: &Sensor| SensorNoise::gaussian(s.deviation().max(IDEAL_RAD));
        Ok(Self {
            parameters: parameters(&channels, &arm),
            noise: sensors.iter().map(noise).collect(),
            ideal_sensor: sensors.contains(&Sensor::IDEAL),
            gravity: rig.scene.gravity,
            left_out_rad_s,
            tips,
            kept,
            modes,
            channels,
            arm,
        })
    }

    /// The joint with its load, if it has one.
    pub(super) fn loaded(&self) -> Option<LoadedJoint<'_>> {
        self.gravity?;
        Some(LoadedJoint {
            arm: &self.arm,
            parameters: &self.parameters,
            torque_per_command: self.channels.command.torque_per_unit(),
            noise: *self.noise.first()?,
        })
    }

    /// Each unknown in the order of the information, with its value.
    pub(super) fn unknowns(&self) -> Vec<(PlannedUnknown, f64)> {
        let of_arm = |p: &Parameter| (PlannedUnknown::Arm(*p), p.of(&self.arm));
        let mut all: Vec<_> = self.parameters.iter().map(of_arm).collect();
        if let Some(load) = self.gravity {
            all.push((PlannedUnknown::GravitySine, load.sine_nm));
            all.push((PlannedUnknown::GravityCosine, load.cosine_nm));
        }
        all
    }

    /// Derivative of each unknown by each coordinate that the identification varies, times the coordinate's size: point masses at
    /// the tips, where the beam has these, are fewer than the unknowns.
    pub(super) fn directions(&self) -> DMatrix<f64> {
        let body = Body::of_masses(&self.channels, self.arm.clone());
        let coordinates = body.coordinates(&self.parameters);
        let mut sizes: Vec<f64> = coordinates.iter().map(|c| body.size(*c)).collect();
        let (n, own) = (self.parameters.len(), sizes.len());
        let loads = if self.gravity.is_some() { 2 } else { 0 };
        sizes.extend(vec![self.gravity.map_or(0.0, |load| load.amplitude_nm()); loads]);
        let mut all = DMatrix::identity(n + loads, own + loads);
        if let Some(jacobian) = body.jacobian(&self.parameters) {
            all.fill(0.0);
            all.view_mut((0, 0), (n, own)).copy_from(&jacobian);
            all.view_mut((n, own), (loads, loads)).fill_with_identity();
        }
        for (mut column, size) in all.column_iter_mut().zip(sizes) {
            column *= size;
        }
        all
    }

    /// All parameters whose precision can be requested.
    pub(super) fn parameters(&self) -> Vec<PlannedParameter> {
        let of_arm = ArmParameter::of(&self.arm).into_iter().map(PlannedParameter::Arm);
        of_arm.chain(self.gravity.map(|_| PlannedParameter::Gravity)).collect()
    }

    /// Value of a parameter in SI.
    pub(super) fn value(&self, parameter: PlannedParameter) -> f64 {
        match parameter {
            PlannedParameter::Arm(parameter) => parameter.value(&self.arm),
            PlannedParameter::Gravity => self.gravity.map_or(0.0, |load| load.amplitude_nm()),
        }
    }

    /// Derivative of a parameter with respect to an unknown.
    pub(super) fn slope(&self, parameter: PlannedParameter, unknown: PlannedUnknown) -> f64 {
        let share = |of: fn(&GravityLoad) -> f64| {
            self.gravity.map_or(0.0, |load| of(&load) / load.amplitude_nm())
        };
        match (parameter, unknown) {
            (PlannedParameter::Arm(parameter), PlannedUnknown::Arm(p)) => {
                parameter.slope(&self.arm, p)
            }
            (PlannedParameter::Gravity, PlannedUnknown::GravitySine) => share(|load| load.sine_nm),
            (PlannedParameter::Gravity, PlannedUnknown::GravityCosine) => {
                share(|load| load.cosine_nm)
            }
            _ => 0.0,
        }
    }

    /// A simulated run in the form that the replay needs: the current that acted, and the true initial state.
    pub(super) fn record(&self, rig: &Rig, logged: &Logged) -> Option<(Campaign, Window)> {
        let run = &logged.run;
        // What the amplifier's dead zone swallows does not act.
        let acted = run.command().iter().map(|u| rig.instruments.amplifier.current_a(*u)).collect();
        let tips = run.tips()[self.tips.clone()].to_vec();
        let run = Run::new(run.name(), run.time(), acted, run.motor().to_vec(), tips).ok()?;
        let window = Window {
            run: 0,
            samples: 0..=run.len() - 1,
            start: self.modes.state(&self.kept, &logged.start),
            zeros: vec![0.0; self.channels.tips.len()],
        };
        Some((Campaign::new(self.channels.clone(), vec![run]).ok()?, window))
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

/// Parameters of such an arm that the output-error method varies, including those that it adds only if the residual
/// requires them.
fn parameters(channels: &Channels, arm: &ModalArm) -> Vec<Parameter> {
    let mut free = free_parameters(channels, arm);
    let grounded = arm.modes.iter().enumerate().filter(|(_, m)| m.grounded_per_s > 0.0);
    free.extend(grounded.map(|(j, _)| Parameter::DampingGrounded(j)));
    if arm.command_lag_s > 0.0 {
        free.push(Parameter::CommandLag);
    }
    free
}

impl Precision {
    /// Requested precision of a parameter.
    pub(super) fn of_planned(&self, parameter: PlannedParameter) -> f64 {
        match parameter {
            PlannedParameter::Arm(parameter) => self.of(parameter),
            PlannedParameter::Gravity => self.gravity,
        }
    }
}
