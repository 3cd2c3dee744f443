//! Effect of another payload: the poles move, the zeros of the tip stay.

use super::{BeamError, LumpedBeam, Payload, Zeros};

impl LumpedBeam {
    /// Mass of the load at the tip \[kg\]: the payload's mass if there is a payload, otherwise the last mass.
    pub fn tip_load_kg(&self) -> f64 {
        let payload = self.payload();
        if payload.mass_kg > 0.0 { payload.mass_kg } else { self.spans()[self.len() - 1].mass_kg }
    }

    /// Returns this beam with `factor` times the load: the mass and inertia of the payload if there is one, otherwise
    /// the last mass.
    ///
    /// # Errors
    /// [`BeamError`] if the new mass is not possible, for example negative.
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

/// Largest relative distance \[1\] between the zeros of two beams, each zero of `zeros` compared with the nearest of
/// `other`; infinite if they differ in number or if some were not found.
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
