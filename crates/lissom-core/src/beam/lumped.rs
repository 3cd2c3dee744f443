//! Lumped-mass beam: massless spans between point masses.

use super::element::Element;
use super::matrices::BeamMatrices;
use super::span::{BeamError, Damping, Payload, Span, check};

/// A massless beam clamped to the motor with point masses along it.
///
/// In the angles θ_i of the radius to mass i, equation (13) without force and torque on the tip is
/// `m_i·θ̈_i = Σ_j EI·a_ij·θ_j + EI·b_i·θ_m − c_i·θ̇_i`, and (15) is `C_t = Σ h_i·θ_i + h_m·θ_m`.
/// [`matrices`](Self::matrices) gives the coefficients. Frequencies, zeros, modes and responses are computed by a
/// recursion along the beam. Its cost grows in proportion to the number of masses n, and its results are exact to
/// rounding for any n.
///
/// # Source
/// `[Feliu1989, eqs. (1)-(13), (15)]`
///
/// # Differences from the source
/// EI may differ between spans. Each mass may be damped. The beam may begin at the rim of a hub, and may have a payload
/// with rotary inertia beyond its tip.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedBeam {
    spans: Vec<Span>,
    hub_radius_m: f64,
    payload: Payload,
    damping: Damping,
    position_m: Vec<f64>,
    elements: Vec<Element>,
}

impl LumpedBeam {
    /// Builds a beam from its spans, from base to tip.
    ///
    /// ```
    /// use lissom::beam::{LumpedBeam, Span};
    /// let (l, ei) = (0.2, 0.004);
    /// let span = Span { length_m: l, flexural_rigidity_n_m2: ei, mass_kg: 0.05, damping_n_s_per_m: 0.0 };
    /// let beam = LumpedBeam::new(&[span])?;
    /// assert!((beam.matrices()?.h_motor - 3.0 * ei / l).abs() < 1e-12); // (32)
    /// # Ok::<(), lissom::beam::BeamError>(())
    /// ```
    ///
    /// # Errors
    /// [`BeamError`] without spans; if a dimension is not positive and finite; if damping is negative; if dimensions
    /// differ so much that numbers leave the range of a double.
    pub fn new(spans: &[Span]) -> Result<Self, BeamError> {
        Self::build(spans.to_vec(), 0.0, Payload::default(), Damping::None)
    }

    /// Returns this beam with its base at the distance `hub_radius_m` from the motor's axis: all L_i grow by it.
    ///
    /// # Errors
    /// [`BeamError::HubRadius`] if it is negative or not finite.
    pub fn with_hub_radius(self, hub_radius_m: f64) -> Result<Self, BeamError> {
        Self::build(self.spans, hub_radius_m, self.payload, self.damping)
    }

    /// Returns this beam with a payload at its tip, in addition to the last mass.
    ///
    /// # Errors
    /// [`BeamError::Payload`] if its mass or inertia is negative, or one of its quantities is not finite.
    pub fn with_payload(self, payload: Payload) -> Result<Self, BeamError> {
        Self::build(self.spans, self.hub_radius_m, payload, self.damping)
    }

    /// Returns this beam with the given damping, in addition to that of its masses.
    ///
    /// # Errors
    /// [`BeamError`] if a quantity is negative or not finite, if a list of ratios is empty, or if ratios by mode are
    /// combined with dampers at masses.
    pub fn with_damping(self, damping: Damping) -> Result<Self, BeamError> {
        Self::build(self.spans, self.hub_radius_m, self.payload, damping)
    }

    fn build(
        spans: Vec<Span>,
        hub_radius_m: f64,
        payload: Payload,
        damping: Damping,
    ) -> Result<Self, BeamError> {
        check(&spans, hub_radius_m, &payload, &damping)?;
        let modal = matches!(damping, Damping::Modal { .. });
        if modal && spans.iter().any(|s| s.damping_n_s_per_m > 0.0) {
            return Err(BeamError::ModalWithDampers);
        }
        let position_m = positions(spans.iter().map(|s| s.length_m), hub_radius_m);
        let elements = elements(&spans, hub_radius_m, &payload);
        let beam = Self { spans, hub_radius_m, payload, damping, position_m, elements };
        beam.check_range()?;
        Ok(beam)
    }

    /// The static compliance of the tip and the inertia about the axis must be doubles.
    fn check_range(&self) -> Result<(), BeamError> {
        let whole = super::frequencies::whole(&self.elements, super::element::At::undamped(0.0));
        let c = whole.compliance;
        let ok = |v: f64| v.is_finite() && v > 0.0;
        // A payload that lies far back may even have b < 0.
        if !(ok(c.a) && c.b.is_finite() && ok(c.c)) {
            return Err(BeamError::OutOfRange { quantity: "the tip's compliance" });
        }
        if !ok(self.inertia_kg_m2()) {
            return Err(BeamError::OutOfRange { quantity: "the inertia about the axis" });
        }
        Ok(())
    }

    /// Number of masses n.
    pub fn len(&self) -> usize {
        self.spans.len()
    }
    /// Never true: a beam has at least one span.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }
    /// Spans, from base to tip.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }
    /// Distance of the clamp from the motor's axis \[m\].
    pub fn hub_radius_m(&self) -> f64 {
        self.hub_radius_m
    }
    /// Payload at the tip, in addition to the last mass.
    pub fn payload(&self) -> &Payload {
        &self.payload
    }
    /// Damping in addition to that of each mass.
    pub fn damping(&self) -> &Damping {
        &self.damping
    }
    /// Distance L_i of each mass from the motor's axis \[m\].
    pub fn position_m(&self) -> &[f64] {
        &self.position_m
    }

    /// Inertia about the motor's axis when the beam turns as one rigid body, `Σ m_i·L_i²` plus
    /// that of the payload \[kg·m²\].
    pub fn inertia_kg_m2(&self) -> f64 {
        let masses = self.spans.iter().zip(&self.position_m).map(|(s, l)| s.mass_kg * l * l);
        let tip = self.position_m[self.len() - 1] + self.payload.offset_m;
        masses.sum::<f64>() + self.payload.mass_kg * tip * tip + self.payload.inertia_kg_m2
    }

    /// The matrices of (10), (13) and (15).
    ///
    /// # Errors
    /// [`BeamError::TooManyMasses`] above [`MOST_MASSES`](super::MOST_MASSES), [`BeamError::OutOfRange`] if an element
    /// leaves the range of a double.
    pub fn matrices(&self) -> Result<BeamMatrices, BeamError> {
        BeamMatrices::of(self)
    }

    /// The chain that the recursions run along.
    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The indices in [`elements`](Self::elements) of the joints where the masses sit.
    pub(crate) fn joints(&self) -> impl DoubleEndedIterator<Item = usize> + ExactSizeIterator {
        let first = usize::from(self.hub_radius_m > 0.0);
        (0..self.len()).map(move |i| first + 2 * i + 1)
    }
}

/// L_i, summed with the rounding carried along: a million spans add no error of their own.
pub(super) fn positions(lengths: impl Iterator<Item = f64>, start: f64) -> Vec<f64> {
    let (mut at, mut lost) = (start, 0.0);
    lengths
        .map(|length| {
            let term = length - lost;
            let next = at + term;
            lost = (next - at) - term;
            at = next;
            at
        })
        .collect()
}

fn elements(spans: &[Span], hub_radius: f64, payload: &Payload) -> Vec<Element> {
    let mut elements = Vec::with_capacity(2 * spans.len() + 4);
    if hub_radius > 0.0 {
        elements.push(Element::Rigid { length: hub_radius });
    }
    for span in spans {
        elements
            .push(Element::Span { length: span.length_m, rigidity: span.flexural_rigidity_n_m2 });
        elements.push(Element::Mass { mass: span.mass_kg, damping: span.damping_n_s_per_m });
    }
    attach(&mut elements, payload);
    elements
}

/// Adds a payload to a chain that ends with a mass.
pub(super) fn attach(elements: &mut Vec<Element>, payload: &Payload) {
    if payload.mass_kg > 0.0 && payload.offset_m != 0.0 {
        elements.push(Element::Rigid { length: payload.offset_m });
        elements.push(Element::Mass { mass: payload.mass_kg, damping: 0.0 });
    } else if let Some(Element::Mass { mass, .. }) = elements.last_mut() {
        *mass += payload.mass_kg;
    }
    if payload.inertia_kg_m2 > 0.0 {
        elements.push(Element::Inertia { inertia: payload.inertia_kg_m2 });
    }
}

/// Lowest first; see [`Base`](super::Base).
impl LumpedBeam {
    /// The lowest `count` natural frequencies, ascending \[rad/s\], without damping; fewer if the beam has fewer.
    ///
    /// They are found by counting, so that none is missed, and are exact to rounding: a few 1e-15, relatively, at 200
    /// masses (`tests/beam_reference.rs`).
    ///
    /// # Source
    /// `[WittrickWilliams1971]`; the poles of `[Feliu1989, eq. (16)]`.
    pub fn frequencies_rad_s(&self, base: super::Base, count: usize) -> Vec<f64> {
        super::frequencies::lowest(&self.elements, base, count)
    }

    /// Number of natural frequencies below `omega_rad_s`.
    pub fn frequencies_below(&self, base: super::Base, omega_rad_s: f64) -> usize {
        super::frequencies::below(&self.elements, base, omega_rad_s)
    }

    /// All natural frequencies with the motor clamped, ascending \[rad/s\], without damping.
    pub fn natural_frequencies_rad_s(&self) -> Vec<f64> {
        self.frequencies_rad_s(super::Base::Clamped, usize::MAX)
    }
}
