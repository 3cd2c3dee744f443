//! Builder of an arm: its parts are set one by one, by name.

use thiserror::Error;

use super::coupled_arm::Arm;
use crate::beam::{Beam, BeamError, Damping, LumpedBeam, Payload, Span};
use crate::drive::{Coulomb, DriveError, Motor, MotorBuilder};

/// Error of [`ArmBuilder::build`].
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ArmBuildError {
    /// Invalid parameters of the beam.
    #[error(transparent)]
    Beam(#[from] BeamError),
    /// Invalid parameters of the motor or of friction.
    #[error(transparent)]
    Drive(#[from] DriveError),
}

impl Arm {
    /// Starts a builder, which sets the parts of an arm one by one.
    ///
    /// ```
    /// use lissom::arm::Arm;
    /// use lissom::beam::Span;
    /// use lissom::drive::Motor;
    /// let arm = Arm::builder()
    ///     .span(Span::new(0.25, 0.02).mass_kg(0.05)) // m, N·m²
    ///     .motor(Motor::builder().inertia_kg_m2(2e-3).torque_constant_nm_per_a(0.2))
    ///     .coulomb_nm(0.02)
    ///     .build()?;
    /// let first = arm.beam().natural_frequencies_rad_s()[0];
    /// assert!((first - (3.0_f64 * 0.02 / (0.05 * 0.25_f64.powi(3))).sqrt()).abs() < 1e-9);
    /// # Ok::<(), lissom::Error>(())
    /// ```
    pub fn builder() -> ArmBuilder {
        ArmBuilder {
            beam: None,
            spans: Vec::new(),
            hub_radius_m: 0.0,
            payload: Payload::default(),
            damping: Damping::None,
            motor: Motor::builder().build(),
            coulomb: Ok(Coulomb::NONE),
        }
    }
}

/// Builder of an [`Arm`]: see [`Arm::builder`]. The numbers are checked by [`build`](Self::build).
#[derive(Debug, Clone)]
pub struct ArmBuilder {
    beam: Option<Beam>,
    spans: Vec<Span>,
    hub_radius_m: f64,
    payload: Payload,
    damping: Damping,
    motor: Result<Motor, DriveError>,
    coulomb: Result<Coulomb, DriveError>,
}

impl ArmBuilder {
    /// Adds a span with the mass at its outer end. Spans are added from base to tip. Without spans the joint drives no
    /// beam (a rigid axis).
    #[must_use]
    pub fn span(mut self, span: Span) -> Self {
        self.spans.push(span);
        self
    }

    /// Sets the distance of the beam's base from the motor's axis \[m\], not negative; 0 by default.
    #[must_use]
    pub fn hub_radius_m(mut self, hub_radius_m: f64) -> Self {
        self.hub_radius_m = hub_radius_m;
        self
    }

    /// Sets the rigid body at the tip, in addition to the last mass; none by default.
    #[must_use]
    pub fn payload(mut self, payload: Payload) -> Self {
        self.payload = payload;
        self
    }

    /// Sets damping in addition to that of each mass; none by default.
    #[must_use]
    pub fn damping(mut self, damping: Damping) -> Self {
        self.damping = damping;
        self
    }

    /// Sets a complete beam. Spans, hub radius, payload and damping of this builder are then ignored.
    #[must_use]
    pub fn beam(mut self, beam: impl Into<Beam>) -> Self {
        self.beam = Some(beam.into());
        self
    }

    /// Sets the motor. It is required, and its inertia must be set.
    #[must_use]
    pub fn motor(mut self, motor: impl Into<MotorBuilder>) -> Self {
        self.motor = motor.into().build();
        self
    }

    /// Sets Coulomb friction, the same in both directions \[N·m\], not negative; 0 by default.
    #[must_use]
    pub fn coulomb_nm(mut self, coulomb_nm: f64) -> Self {
        self.coulomb = Coulomb::symmetric(coulomb_nm);
        self
    }

    /// Sets Coulomb friction for each direction \[N·m\], both not negative.
    #[must_use]
    pub fn coulomb_by_direction_nm(mut self, forward_nm: f64, backward_nm: f64) -> Self {
        self.coulomb = Coulomb::by_direction(forward_nm, backward_nm);
        self
    }

    /// Builds the arm.
    ///
    /// # Errors
    /// [`ArmBuildError`] for invalid parameters of the beam, the motor or friction.
    pub fn build(self) -> Result<Arm, ArmBuildError> {
        let beam = match self.beam {
            Some(beam) => beam,
            None if self.spans.is_empty() => Beam::Rigid,
            None => LumpedBeam::new(&self.spans)?
                .with_hub_radius(self.hub_radius_m)?
                .with_payload(self.payload)?
                .with_damping(self.damping)?
                .into(),
        };
        Ok(Arm::new(beam, self.motor?, self.coulomb?)?)
    }
}
