//! A rig made of parts that are given by name.

use std::f64::consts::TAU;

use super::{
    Amplifier, ControlLaw, Delay, Instruments, Noise, Quantiser, Rig, RigError, Scene, Sensor,
};
use crate::arm::Arm;

/// A [`Rig`] in the making: see [`Rig::builder`]. Numbers are checked by [`build`](Self::build), which gives the first
/// error.
#[derive(Debug, Clone)]
pub struct RigBuilder {
    arm: Arm,
    scene: Scene,
    instruments: Instruments,
    controller: Option<ControlLaw>,
    error: Option<RigError>,
}

impl Rig {
    /// A rig whose parts are given by name. What is not given is ideal: sensors without steps and noise, a current
    /// without limit, no delay, a free tip.
    ///
    /// ```
    /// use lissom::prelude::*;
    /// # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).coulomb_nm(0.02).build()?;
    /// let rig = Rig::builder(arm)
    ///     .sample_time_s(3e-3)
    ///     .encoder_bits(12)
    ///     .current_limit_a(4.12)
    ///     .controller(Pd::new(8.0, 0.25)?) // A/rad, A·s/rad
    ///     .build()?;
    /// assert_eq!(rig.instruments.sample_time_s, 3e-3);
    /// # Ok::<(), lissom::Error>(())
    /// ```
    pub fn builder(arm: Arm) -> RigBuilder {
        RigBuilder {
            arm,
            scene: Scene::default(),
            instruments: Instruments {
                sample_time_s: 0.0,
                motor: Sensor::IDEAL,
                tips: Vec::new(),
                amplifier: Amplifier::ideal(),
                current: None,
                stamps: None,
                delay: None,
                control_every: 1,
                log_every: 1,
            },
            controller: None,
            error: None,
        }
    }
}

impl RigBuilder {
    /// Sample time of sensors, controller and log \[s\]; it must be given.
    #[must_use]
    pub fn sample_time_s(mut self, sample_time_s: f64) -> Self {
        self.instruments.sample_time_s = sample_time_s;
        self
    }

    /// The controller of the motor's angle; it must be given.
    #[must_use]
    pub fn controller(mut self, controller: impl Into<ControlLaw>) -> Self {
        self.controller = Some(controller.into());
        self
    }

    /// Angles of motor and tips are read in steps of one turn over 2^`bits`, from −π to π.
    #[must_use]
    pub fn encoder_bits(self, bits: u32) -> Self {
        self.with(Quantiser::new(bits, TAU), |instruments, steps| {
            instruments.motor.quantiser = Some(steps);
            let first = instruments.tips.first().copied().unwrap_or(Sensor::IDEAL);
            instruments.tips = vec![Sensor { quantiser: Some(steps), ..first }];
        })
    }

    /// Angles of motor and tips are read with white Gaussian noise of this standard deviation \[rad\].
    #[must_use]
    pub fn noise_rad(self, std_rad: f64) -> Self {
        self.with(Noise::new(std_rad), |instruments, noise| {
            instruments.motor.noise = Some(noise);
            let first = instruments.tips.first().copied().unwrap_or(Sensor::IDEAL);
            instruments.tips = vec![Sensor { noise: Some(noise), ..first }];
        })
    }

    /// The amplifier's largest current \[A\].
    #[must_use]
    pub fn current_limit_a(self, limit_a: f64) -> Self {
        let limited = self.instruments.amplifier.with_limit(limit_a);
        self.with(limited, |instruments, amplifier| instruments.amplifier = amplifier)
    }

    /// Time from the sensors' instant to the current's acting \[s\].
    #[must_use]
    pub fn delay_s(self, delay_s: f64) -> Self {
        self.with(Delay::new(delay_s), |instruments, delay| instruments.delay = Some(delay))
    }

    /// All instruments at once, in place of those given before.
    #[must_use]
    pub fn instruments(mut self, instruments: Instruments) -> Self {
        self.instruments = instruments;
        self
    }

    /// Another law of friction, gravity, the world at the tip, payloads to come.
    #[must_use]
    pub fn scene(mut self, scene: Scene) -> Self {
        self.scene = scene;
        self
    }

    /// The rig.
    ///
    /// # Errors
    /// The first [`RigError`] of the numbers given; [`RigError::NotPositive`] without a sample time,
    /// [`RigError::NoController`] without a controller, [`RigError::TooStiff`] for an arm that changes too fast for
    /// the sample time.
    pub fn build(self) -> Result<Rig, RigError> {
        if let Some(error) = self.error {
            return Err(error);
        }
        let controller = self.controller.ok_or(RigError::NoController)?;
        let rig =
            Rig { arm: self.arm, scene: self.scene, instruments: self.instruments, controller };
        rig.check()?;
        Ok(rig)
    }

    fn with<T>(mut self, made: Result<T, RigError>, set: impl FnOnce(&mut Instruments, T)) -> Self {
        match made {
            Ok(made) => set(&mut self.instruments, made),
            Err(error) => self.error = self.error.or(Some(error)),
        }
        self
    }
}
