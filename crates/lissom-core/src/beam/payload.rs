//! What another payload does: poles move, zeros stand.

use super::{BeamError, LumpedBeam, Payload, Zeros};

impl LumpedBeam {
    /// What counts as the arm's load: the payload's mass where there is one, else the last mass
    /// \[kg\].
    pub fn tip_load_kg(&self) -> f64 {
        let payload = self.payload();
        if payload.mass_kg > 0.0 { payload.mass_kg } else { self.spans()[self.len() - 1].mass_kg }
    }

    /// The same beam with its load `factor` times as heavy: the payload with its rotary inertia
    /// where there is one, else the last mass.
    ///
    /// # Errors
    /// [`BeamError`] where `factor` makes no mass of it.
    pub fn with_load_times(&self, factor: f64) -> Result<Self, BeamError> {
        let payload = *self.payload();
        if payload.mass_kg > 0.0 || payload.inertia_kg_m2 > 0.0 {
            return self.clone().with_payload(Payload {
                mass_kg: payload.mass_kg * factor,
                inertia_kg_m2: payload.inertia_kg_m2 * factor,
                ..payload
            });
        }
        let mut spans = self.spans().to_vec();
        if let Some(last) = spans.last_mut() {
            last.mass_kg *= factor;
        }
        Self::new(&spans)?
            .with_hub_radius(self.hub_radius_m())?
            .with_payload(payload)?
            .with_damping(self.damping().clone())
    }
}

/// Largest relative distance of a zero in `other` from its counterpart in `zeros`; infinite where
/// their numbers differ.
pub fn zero_shift(zeros: &Zeros, other: &Zeros) -> f64 {
    if zeros.z.len() != other.z.len() || zeros.missing + other.missing > 0 {
        return f64::INFINITY;
    }
    let shift = zeros.z.iter().map(|z| {
        let nearest = other.z.iter().map(|o| (o - z).norm()).fold(f64::INFINITY, f64::min);
        nearest / z.norm()
    });
    shift.fold(0.0, f64::max)
}
