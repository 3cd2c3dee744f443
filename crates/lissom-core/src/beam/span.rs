//! The parts of a lumped beam, and the error of all beams.

use thiserror::Error;

/// One span of a beam and the mass at its outer end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Length \[m\].
    pub length_m: f64,
    /// Flexural rigidity EI, constant along the span \[N·m²\].
    pub flexural_rigidity_n_m2: f64,
    /// Mass at the outer end \[kg\].
    pub mass_kg: f64,
    /// Viscous damping of that mass against the fixed frame \[N·s/m\].
    pub damping_n_s_per_m: f64,
}

impl Span {
    /// A span of the given length \[m\] and flexural rigidity EI \[N·m²\], without mass at its outer end.
    ///
    /// [`LumpedBeam::new`](super::LumpedBeam::new) checks the numbers of all spans.
    ///
    /// ```
    /// use lissom::beam::{LumpedBeam, Span};
    /// let beam = LumpedBeam::new(&[Span::new(0.25, 0.02).mass_kg(0.05)])?;
    /// assert!((beam.inertia_kg_m2() - 0.05 * 0.25 * 0.25).abs() < 1e-12);
    /// # Ok::<(), lissom::beam::BeamError>(())
    /// ```
    pub fn new(length_m: f64, flexural_rigidity_n_m2: f64) -> Self {
        Self { length_m, flexural_rigidity_n_m2, mass_kg: 0.0, damping_n_s_per_m: 0.0 }
    }

    /// Returns this span with a mass at its outer end \[kg\].
    #[must_use]
    pub fn mass_kg(self, mass_kg: f64) -> Self {
        Self { mass_kg, ..self }
    }

    /// Returns this span with viscous damping of its mass against the fixed frame \[N·s/m\].
    #[must_use]
    pub fn damping_n_s_per_m(self, damping_n_s_per_m: f64) -> Self {
        Self { damping_n_s_per_m, ..self }
    }
}

/// A rigid body at the tip, in addition to the last mass.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Payload {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Rotary inertia about its own centre of mass \[kg·m²\], not negative.
    pub inertia_kg_m2: f64,
    /// Distance of its centre of mass beyond the tip, along the beam \[m\]; negative towards the motor.
    pub offset_m: f64,
}

impl Payload {
    /// Whether the payload resists turning, so that the slope of the tip is a degree of freedom.
    pub fn turns(&self) -> bool {
        self.inertia_kg_m2 > 0.0 || (self.mass_kg > 0.0 && self.offset_m != 0.0)
    }

    fn check(&self) -> Result<(), BeamError> {
        if !self.offset_m.is_finite() {
            return Err(BeamError::Payload { quantity: "offset_m", found: self.offset_m });
        }
        let parts = [("mass_kg", self.mass_kg), ("inertia_kg_m2", self.inertia_kg_m2)];
        for (quantity, found) in parts {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(BeamError::Payload { quantity, found });
            }
        }
        Ok(())
    }
}

/// Damping in addition to that of each mass.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub enum Damping {
    /// No further damping.
    #[default]
    None,
    /// Proportional to mass and stiffness (Rayleigh damping).
    ///
    /// Each mass, and the payload, has a damping force of `α·m_i` times its velocity in the fixed frame.
    /// Each elastic force has a damping force of `β` times its rate. An arm that turns as one body is not
    /// bent, so β does not damp that motion.
    Proportional {
        /// α \[1/s\].
        mass_per_s: f64,
        /// β \[s\].
        stiffness_s: f64,
    },
    /// A damping ratio for each mode of the beam with the motor clamped. It acts on the deflection from the motor's
    /// line. The last ratio holds for all further modes.
    Modal {
        /// ζ_k \[1\], at least one, not negative.
        ratios: Vec<f64>,
    },
}

impl Damping {
    fn check(&self) -> Result<(), BeamError> {
        let each: Vec<(&'static str, f64)> = match self {
            Self::None => Vec::new(),
            Self::Proportional { mass_per_s, stiffness_s } => {
                vec![("mass_per_s", *mass_per_s), ("stiffness_s", *stiffness_s)]
            }
            Self::Modal { ratios } if ratios.is_empty() => {
                return Err(BeamError::NoRatios);
            }
            Self::Modal { ratios } => ratios.iter().map(|r| ("ratios", *r)).collect(),
        };
        for (quantity, found) in each {
            if !(found >= 0.0 && found.is_finite()) {
                return Err(BeamError::DampingModel { quantity, found });
            }
        }
        Ok(())
    }

    /// ζ of mode `index`, counted from 0; `None` unless damping is modal.
    pub fn ratio(&self, index: usize) -> Option<f64> {
        match self {
            Self::Modal { ratios } => ratios.get(index).or(ratios.last()).copied(),
            _ => None,
        }
    }

    /// α \[1/s\] and β \[s\]; zero unless damping is proportional.
    pub fn proportional(&self) -> (f64, f64) {
        match self {
            Self::Proportional { mass_per_s, stiffness_s } => (*mass_per_s, *stiffness_s),
            _ => (0.0, 0.0),
        }
    }
}

/// What makes numbers no beam.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BeamError {
    /// A beam without spans.
    #[error("the beam has no spans")]
    NoSpans,
    /// The beam has too many masses for dense matrices.
    #[error("the beam has {found} masses, but matrices are possible for at most {most}")]
    TooManyMasses {
        /// Masses given.
        found: usize,
        /// Masses supported.
        most: usize,
    },
    /// A dimension is not positive and finite.
    #[error("span {span}: {quantity} is {found}, but must be positive and finite")]
    NotPositive {
        /// Number of the span, from 1 at the base.
        span: usize,
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity of a span that may be zero is negative or not finite.
    #[error("span {span}: {quantity} is {found}, but must be finite and not negative")]
    Negative {
        /// Number of the span, from 1 at the base.
        span: usize,
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// The hub's radius is negative or not finite.
    #[error("hub_radius_m is {found}, but must be finite and not negative")]
    HubRadius {
        /// The number found.
        found: f64,
    },
    /// A quantity of the payload is negative or not finite.
    #[error("payload: {quantity} is {found}, but must be finite and not negative")]
    Payload {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// A quantity of the damping model is negative or not finite.
    #[error("damping: {quantity} is {found}, but must be finite and not negative")]
    DampingModel {
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// Modal damping without a ratio.
    #[error("modal damping needs at least one ratio")]
    NoRatios,
    /// Modal damping is not possible for a distributed beam.
    #[error("a distributed beam takes proportional damping, not a ratio for each mode")]
    ModalDistributed,
    /// The modes cannot be separated at the chosen points.
    #[error("the modes cannot be separated at these points (reciprocal condition {condition:.1e})")]
    PointsTooClose {
        /// Smallest over largest singular value of the modes' shares at the points.
        condition: f64,
    },
    /// A beam that is given by its modes has none.
    #[error("the beam has no modes")]
    NoModes,
    /// A beam that is given by its modes has another number of points than modes.
    #[error(
        "mode {mode} has {points} gains, but {modes} are needed: one for each point, and as many points as modes"
    )]
    ModesAndPoints {
        /// Number of the mode, from 1.
        mode: usize,
        /// Its gains.
        points: usize,
        /// Modes given.
        modes: usize,
    },
    /// A quantity of a mode is out of range.
    #[error("mode {mode}: {quantity} = {found} is out of range")]
    KnownMode {
        /// Number of the mode, from 1.
        mode: usize,
        /// Which quantity, with its unit.
        quantity: &'static str,
        /// The number found.
        found: f64,
    },
    /// The gains of a point do not add up to one.
    #[error(
        "the gains of point {point} add up to {sum}, but must add up to one: otherwise the beam would bend when it turns as one body"
    )]
    GainsSum {
        /// Number of the point, from 1.
        point: usize,
        /// Their sum.
        sum: f64,
    },
    /// A rigid joint, or a beam that is given by its modes, has no tip.
    #[error("a rigid joint or a beam given by its modes has no tip on which something could act")]
    NoTip,
    /// A point is not on the beam.
    #[error("points must lie on the beam, beyond {base_m} m and up to {tip_m} m from the axis")]
    Points {
        /// Distance of the base from the axis \[m\].
        base_m: f64,
        /// Distance of the tip from the axis \[m\].
        tip_m: f64,
    },
    /// Damping ratios by mode and dampers at masses are both given.
    #[error(
        "damping ratios by mode and dampers at masses are both given: no mode would keep its ratio"
    )]
    ModalWithDampers,
    /// The dimensions are so far apart that a number leaves the range of a double.
    #[error("the dimensions are so far apart that {quantity} leaves the range of a double")]
    OutOfRange {
        /// The quantity.
        quantity: &'static str,
    },
}

/// Checks everything that does not hang on the number of masses.
pub(super) fn check(
    spans: &[Span],
    hub_radius_m: f64,
    payload: &Payload,
    damping: &Damping,
) -> Result<(), BeamError> {
    if spans.is_empty() {
        return Err(BeamError::NoSpans);
    }
    for (index, span) in spans.iter().enumerate() {
        let positive = [
            ("length_m", span.length_m),
            ("flexural_rigidity_n_m2", span.flexural_rigidity_n_m2),
            ("mass_kg", span.mass_kg),
        ];
        for (quantity, found) in positive {
            if !(found > 0.0 && found.is_finite()) {
                return Err(BeamError::NotPositive { span: index + 1, quantity, found });
            }
        }
        let found = span.damping_n_s_per_m;
        if !(found >= 0.0 && found.is_finite()) {
            let quantity = "damping_n_s_per_m";
            return Err(BeamError::Negative { span: index + 1, quantity, found });
        }
    }
    check_rest(hub_radius_m, payload, damping)
}

/// Checks hub, payload and damping.
pub(super) fn check_rest(
    hub_radius_m: f64,
    payload: &Payload,
    damping: &Damping,
) -> Result<(), BeamError> {
    if !(hub_radius_m >= 0.0 && hub_radius_m.is_finite()) {
        return Err(BeamError::HubRadius { found: hub_radius_m });
    }
    payload.check()?;
    damping.check()
}
