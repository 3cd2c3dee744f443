//! Builds a rig from an `arm.toml`: instruments, controller and the arm's scene.

use std::path::Path;

use lissom_core::arm::Arm;
use lissom_core::beam::BeamError;
use lissom_core::drive::DriveError;
use lissom_core::rig::{
    Amplifier, ControlLaw, Delay, Harmonic, Instruments, IntegerPd, JointFriction, Noise, Pd, Pid,
    Quantiser, Rig, RigError, Scene, Sensor, Signal, TipWorld,
};

use super::arm_error::{absent, load_on_beam};
use super::arm_spec::ArmFile;
use super::beam_spec::BeamKind;
use super::rig_spec::{ControllerSpec, RigSpec, SensorSpec, SensorSteps};
use super::tip_spec::{SignalSpec, TipSpec};
use crate::config::ConfigError;

/// Largest number of simulated masses. More masses add nothing useful, and a run takes hours.
const COORDINATES_MOST: usize = 150;
/// Number of point masses for a beam with mass along it, if the file does not give one.
const MASSES: usize = 10;

impl ArmFile {
    /// Builds the arm with its loop and its scene. Without sensors of the tips, these are as the motor's.
    ///
    /// A beam with mass along it is lumped into the `masses` of `[rig]`, or into ten.
    ///
    /// # Errors
    /// As [`arm`](Self::arm), and if `[rig]` is missing.
    pub fn rig(&self, path: &Path) -> Result<Rig, ConfigError> {
        let spec = self.rig.as_ref().ok_or_else(|| absent(path, "rig"))?;
        let arm = self.simulated_arm(path)?;
        if arm.dynamics().len() > COORDINATES_MOST {
            let source = RigError::Unsupported { what: "more than 150 masses" };
            return Err(ConfigError::of_arm(path, source));
        }
        let failed = |source: RigError| ConfigError::of_arm(path, source);
        let instruments = instruments(spec).map_err(failed)?;
        let controller = match &spec.controller {
            Some(controller) => law(controller, &instruments).map_err(failed)?,
            // A zero controller for an open drive, which does not use it.
            None => Pd::new(0.0, 0.0).map_err(failed)?.into(),
        };
        let mut rig = Rig::new(arm, instruments, controller);
        rig.scene = self.scene(path, &rig.arm)?;
        Ok(rig)
    }

    /// Whether `[rig]` has a controller.
    pub fn has_controller(&self) -> bool {
        self.rig.as_ref().is_some_and(|rig| rig.controller.is_some())
    }

    /// Builds the arm with point masses; a beam with mass along it is lumped as in [`rig`](Self::rig).
    ///
    /// # Errors
    /// As [`arm`](Self::arm).
    pub fn simulated_arm(&self, path: &Path) -> Result<Arm, ConfigError> {
        if self.rigid || self.beam_kind(path)? != BeamKind::Distributed {
            return self.arm(path);
        }
        let count = self.rig.as_ref().and_then(|rig| rig.masses).unwrap_or(MASSES);
        let (motor, coulomb) = self.motor(path)?.ok_or_else(|| absent(path, "drive"))?;
        let failed = |source: BeamError| ConfigError::of_arm(path, source);
        let beam = self.distributed_beam(path)?.lumped(count).map_err(failed)?;
        Arm::new(beam, motor, coulomb).map_err(failed)
    }

    fn scene(&self, path: &Path, arm: &Arm) -> Result<Scene, ConfigError> {
        let drive_failed = |source: DriveError| ConfigError::of_arm(path, source);
        let rig_failed = |source: RigError| ConfigError::of_arm(path, source);
        let beam_failed = |source: BeamError| ConfigError::of_arm(path, source);
        let friction = match &self.drive {
            Some(drive) => drive.friction.joint(arm.coulomb).map_err(drive_failed)?,
            None => JointFriction::Arm,
        };
        if self.load.is_some() && !self.rigid {
            return Err(load_on_beam(path));
        }
        let gravity = self.load.map(|load| load.gravity());
        let torque_ripples =
            self.drive.as_ref().map_or_else(Vec::new, |d| d.torque_ripples.clone());
        let joint = Scene { friction, gravity, torque_ripples, ..Scene::default() };
        let Some(tip) = &self.tip else { return Ok(joint) };
        if arm.beam().lumped().is_none() {
            return Err(beam_failed(BeamError::NoTip));
        }
        let mut later = Vec::with_capacity(tip.payloads.len());
        for (at_s, payload) in &tip.payloads {
            let beam = arm.beam().clone().with_payload(*payload).map_err(beam_failed)?;
            later.push((*at_s, Arm::new(beam, arm.motor, arm.coulomb).map_err(beam_failed)?));
        }
        let scene = Scene { tip: world(tip).map_err(rig_failed)?, later, ..joint };
        scene.check().map_err(rig_failed)?;
        Ok(scene)
    }
}

fn world(tip: &TipSpec) -> Result<TipWorld, RigError> {
    let given = |spec: Option<&SignalSpec>| spec.map_or(Ok(Signal::default()), signal);
    Ok(TipWorld {
        force: given(tip.force.as_ref())?,
        torque: given(tip.torque.as_ref())?,
        viscous_n_s_per_m: tip.viscous_n_s_per_m,
        coulomb_n: tip.coulomb_n,
        walls: tip.walls.clone(),
    })
}

fn signal(spec: &SignalSpec) -> Result<Signal, RigError> {
    match spec {
        SignalSpec::Constant(value) => Signal::constant(*value),
        SignalSpec::Table { rows, lines: false } => Signal::steps(rows),
        SignalSpec::Table { rows, lines: true } => Signal::lines(rows),
        SignalSpec::Sine { offset, amplitude, omega_rad_s, phase_rad } => {
            let swing = Harmonic {
                amplitude: *amplitude,
                omega_rad_s: *omega_rad_s,
                phase_rad: *phase_rad,
            };
            // A cosine of frequency zero.
            let mean = Harmonic {
                amplitude: *offset,
                omega_rad_s: 0.0,
                phase_rad: std::f64::consts::FRAC_PI_2,
            };
            Signal::harmonics(&[swing, mean])
        }
    }
}

fn instruments(spec: &RigSpec) -> Result<Instruments, RigError> {
    let mut made = Instruments::ideal(spec.sample_time_s)?;
    made.control_every = spec.control_every;
    made.log_every = spec.log_every;
    made.motor = spec.motor_sensor.as_ref().map_or(Ok(Sensor::IDEAL), sensor)?;
    made.tips = match &spec.tip_sensors {
        Some(tips) => tips.iter().map(sensor).collect::<Result<_, _>>()?,
        None => vec![made.motor],
    };
    let mut amplifier = Amplifier::ideal();
    if let Some(limit_a) = spec.current_limit_a {
        amplifier = amplifier.with_limit(limit_a)?;
    }
    if let Some(dead_band_a) = spec.dead_band_a {
        amplifier = amplifier.with_dead_band(dead_band_a)?;
    }
    if let Some(converter) = &spec.current_converter {
        amplifier = amplifier.with_converter(Quantiser::new(converter.bits, converter.range_a)?);
    }
    made.amplifier = amplifier;
    made.delay = spec.delay_s.map(Delay::new).transpose()?;
    Ok(made)
}

fn sensor(spec: &SensorSpec) -> Result<Sensor, RigError> {
    let quantiser = match spec.steps {
        Some(SensorSteps::Bits { bits, range_rad }) => Some(Quantiser::new(bits, range_rad)?),
        Some(SensorSteps::CountsPerTurn(counts)) => Some(Quantiser::encoder(counts)?),
        None => None,
    };
    Ok(Sensor { noise: spec.noise_rad.map(Noise::new).transpose()?, quantiser })
}

fn law(spec: &ControllerSpec, instruments: &Instruments) -> Result<ControlLaw, RigError> {
    let mut pd = Pd::new(spec.proportional_a_per_rad, spec.derivative_a_s_per_rad)?;
    if let Some(filter_s) = spec.filter_s {
        pd = pd.with_filter(filter_s)?;
    }
    if let Some(integers) = spec.integers {
        let input =
            instruments.motor.quantiser.ok_or(RigError::NeedsSteps { what: "motor_sensor" })?;
        let output = instruments.amplifier.converter();
        let output = output.ok_or(RigError::NeedsSteps { what: "current_converter" })?;
        let period_s = instruments.control_time_s();
        let (word, point) = (integers.word, integers.binary_point);
        return Ok(IntegerPd::new(&pd, period_s, input, output, word, point)?.into());
    }
    Ok(match spec.integral_a_per_rad_s {
        Some(integral) => Pid::new(pd, integral)?.into(),
        None => pd.into(),
    })
}
