//! Builder of a rig: its parts are set one by one, by name.

use std::f64::consts::TAU;

use super::{
    ControlLaw, Delay, Instruments, JointFriction, Noise, Quantiser, Rig, RigError, Scene, Sensor,
};
use crate::arm::Arm;
use crate::load::{GravityLoad, TorqueRipple};

/// Builder of a [`Rig`]: see [`Rig::builder`]. The numbers are checked by [`build`](Self::build),
/// which returns the first error.
#[derive(Debug, Clone)]
pub struct RigBuilder {
    arm: Arm,
    scene: Scene,
    instruments: Instruments,
    controller: Option<ControlLaw>,
    error: Option<RigError>,
}

impl Rig {
    /// Starts a builder, which sets the parts of a rig one by one. Parts that are not set are ideal: sensors without
    /// steps and noise, a current without limit, no delay, nothing at the tip.
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
            // `build` refuses that no sample time is given.
            instruments: Instruments::unchecked(f64::NAN),
            controller: None,
            error: None,
        }
    }
}

impl RigBuilder {
    /// Sets the sample time of sensors, controller and log \[s\]. It is required.
    #[must_use]
    pub fn sample_time_s(mut self, sample_time_s: f64) -> Self {
        self.instruments.sample_time_s = sample_time_s;
        self
    }

    /// Sets the controller of the motor's angle. It is required.
    #[must_use]
    pub fn controller(mut self, controller: impl Into<ControlLaw>) -> Self {
        self.controller = Some(controller.into());
        self
    }

    /// Rounds the angles of motor and tips to steps of one turn over 2^`bits`, as an A/D converter does whose range is
    /// −π to π: readings end there. For an encoder that counts over many turns use
    /// [`encoder_counts`](Self::encoder_counts).
    #[must_use]
    pub fn encoder_bits(self, bits: u32) -> Self {
        self.with_steps(Quantiser::new(bits, TAU))
    }

    /// Rounds the angles of motor and tips to this number of counts per turn, over any number of turns.
    #[must_use]
    pub fn encoder_counts(self, counts_per_turn: u32) -> Self {
        self.with_steps(Quantiser::encoder(counts_per_turn))
    }

    /// Adds white Gaussian noise to the angles of motor and tips, with this standard deviation \[rad\].
    #[must_use]
    pub fn noise_rad(self, std_rad: f64) -> Self {
        self.with(Noise::new(std_rad), |instruments, noise| {
            instruments.motor.noise = Some(noise);
            instruments.tips = vec![Sensor { noise: Some(noise), ..instruments.tip(0) }];
        })
    }

    /// Limits the current of the amplifier \[A\].
    #[must_use]
    pub fn current_limit_a(self, limit_a: f64) -> Self {
        let limited = self.instruments.amplifier.with_limit(limit_a);
        self.with(limited, |instruments, amplifier| instruments.amplifier = amplifier)
    }

    /// Delays the current \[s\]: the time from the instant of the sensors until it acts.
    #[must_use]
    pub fn delay_s(self, delay_s: f64) -> Self {
        self.with(Delay::new(delay_s), |instruments, delay| instruments.delay = Some(delay))
    }

    /// Logs the measured current in place of the command, with white Gaussian noise of this standard deviation \[A\]. A
    /// row contains the mean current of one row time, centred at the time of the row
    /// ([`CurrentReading::Centred`](super::CurrentReading::Centred)).
    #[must_use]
    pub fn current_noise_a(self, std_a: f64) -> Self {
        self.with(Noise::new(std_a), |instruments, noise| instruments.current = Some(noise.into()))
    }

    /// Sets all instruments at once, in place of those set before.
    #[must_use]
    pub fn instruments(mut self, instruments: Instruments) -> Self {
        self.instruments = instruments;
        self
    }

    /// Sets another friction law than the Coulomb friction of the arm.
    ///
    /// ```
    /// use lissom::prelude::*;
    /// # let arm = Arm::builder().motor(Motor::builder().inertia_kg_m2(2e-3)).build()?;
    /// let sliding = DryFriction::from(Coulomb::symmetric(0.02)?); // N·m
    /// let stribeck = sliding.with_rest(Coulomb::symmetric(0.03)?, 0.3, Falloff::Gaussian)?; // N·m, rad/s
    /// let rig = Rig::builder(arm)
    ///     .sample_time_s(1e-3)
    ///     .encoder_counts(20_000)
    ///     .friction(stribeck)
    ///     .gravity(GravityLoad::of_amplitude(0.1, 0.0)) // m·g·l in N·m, hanging at θ = 0
    ///     .controller(Pd::new(8.0, 0.25)?)
    ///     .build()?;
    /// # Ok::<(), lissom::Error>(())
    /// ```
    #[must_use]
    pub fn friction(mut self, friction: impl Into<JointFriction>) -> Self {
        self.scene.friction = friction.into();
        self
    }

    /// Sets gravity of an unbalanced load on the motor.
    #[must_use]
    pub fn gravity(mut self, load: GravityLoad) -> Self {
        self.scene.gravity = Some(load);
        self
    }

    /// Sets torque ripples (cogging) of the motor.
    #[must_use]
    pub fn torque_ripples(mut self, ripples: impl IntoIterator<Item = TorqueRipple>) -> Self {
        self.scene.torque_ripples = ripples.into_iter().collect();
        self
    }

    /// Sets all of it at once: friction law, gravity, torque ripples, what acts on the tip, and later payloads.
    #[must_use]
    pub fn scene(mut self, scene: Scene) -> Self {
        self.scene = scene;
        self
    }

    /// Builds the rig.
    ///
    /// # Errors
    /// The first [`RigError`] of the numbers given; [`RigError::NoSampleTime`] without a sample time;
    /// [`RigError::NoController`] without a controller; [`RigError::TooStiff`] for an arm that
    /// changes too fast for the sample time.
    pub fn build(self) -> Result<Rig, RigError> {
        if let Some(error) = self.error {
            return Err(error);
        }
        if self.instruments.sample_time_s.is_nan() {
            return Err(RigError::NoSampleTime);
        }
        let controller = self.controller.ok_or(RigError::NoController)?;
        let rig =
            Rig { arm: self.arm, scene: self.scene, instruments: self.instruments, controller };
        rig.check()?;
        Ok(rig)
    }

    fn with_steps(self, steps: Result<Quantiser, RigError>) -> Self {
        self.with(steps, |instruments, steps| {
            instruments.motor.quantiser = Some(steps);
            instruments.tips = vec![Sensor { quantiser: Some(steps), ..instruments.tip(0) }];
        })
    }

    fn with<T>(mut self, made: Result<T, RigError>, set: impl FnOnce(&mut Instruments, T)) -> Self {
        match made {
            Ok(made) => set(&mut self.instruments, made),
            Err(error) => self.error = self.error.or(Some(error)),
        }
        self
    }
}
