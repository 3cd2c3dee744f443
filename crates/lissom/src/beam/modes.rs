//! Modes with the motor clamped: shapes, and what each contributes.

use num_complex::Complex64;

use super::chain::{At, BaseSide, Element, TipSide};
use super::response::BeamResponse;
use super::{Base, LumpedBeam};

/// A mode of the beam with the motor clamped.
///
/// With these, `θ_i/θ_m = Σ_k r_ik·ω_k²/(s² + ω_k²)` and
/// `C_t/θ_m = Σ_k Γ_k²·ω_k²·s²/(s² + ω_k²) + (I − Σ_k Γ_k²)·s²`, I the inertia about the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// ω_k \[rad/s\], undamped.
    pub natural_frequency_rad_s: f64,
    /// Deflection from the motor's line at each point, the largest being 1 \[1\].
    pub shape: Vec<f64>,
    /// r_ik, the mode's share in θ_i/θ_m at each point \[1\]; they sum to one over all modes.
    pub share: Vec<f64>,
    /// Γ_k², the mode's part of the inertia about the axis \[kg·m²\].
    pub inertia_kg_m2: f64,
}

/// Motion (deflection, slope) at the outer end of every element in a mode of z, any scale.
///
/// The two sides are joined at the mass that moves most, and the motion is carried from there
/// inwards by the base side's compliance and outwards by the tip side's stiffness: high modes keep
/// to a few masses, and further out a part of the beam resonates at the very same frequency.
///
/// # Source
/// The twisted factorisation of `[DhillonParlett2004]`, with 2×2 blocks.
fn motions(elements: &[Element], z: f64) -> Vec<(f64, f64)> {
    let at = At::undamped(z);
    let mut base = BaseSide::clamped();
    let inner: Vec<BaseSide<f64>> = elements
        .iter()
        .map(|e| {
            base.pass(at, e);
            base
        })
        .collect();
    let mut tip = TipSide::free();
    let mut outer: Vec<TipSide<f64>> = elements
        .iter()
        .rev()
        .map(|e| {
            let beyond = tip;
            tip.pass(at, e);
            beyond
        })
        .collect();
    outer.reverse();
    // Cut just inside each mass, where its deflection's compliance peaks.
    let moving = |k: usize| match elements[k] {
        Element::Mass { mass, .. } if k > 0 => {
            let stiffness = outer[k - 1].stiffness;
            let det = inner[k - 1].compliance.meeting(stiffness);
            (mass * inner[k - 1].compliance.loaded(stiffness, det).a).abs()
        }
        _ => 0.0,
    };
    let cut = (0..elements.len()).max_by(|a, b| moving(*a).total_cmp(&moving(*b))).unwrap_or(1);
    let cut = cut.max(1) - 1;
    let (c, y) = (inner[cut].compliance, outer[cut].stiffness);
    let mut motion = vec![(0.0, 0.0); elements.len()];
    motion[cut] = (c.a + c.det * y.c, c.b - c.det * y.b);
    for k in cut + 1..elements.len() {
        motion[k] = outer[k].carried(&elements[k], motion[k - 1]);
    }
    let (w, phi) = motion[cut];
    let (mut force, mut torque) = (-y.a * w - y.b * phi, -y.b * w - y.c * phi);
    for k in (0..cut).rev() {
        // Across element k + 1 to the outer end of element k.
        match elements[k + 1] {
            Element::Span { length, .. } | Element::Rigid { length } => torque += force * length,
            Element::Mass { mass, .. } => force -= mass * z * motion[k + 1].0,
            Element::Inertia { inertia } => torque -= inertia * z * motion[k + 1].1,
            Element::Heavy { .. } => {}
        }
        let c = inner[k].compliance;
        motion[k] = (c.a * force + c.b * torque, c.b * force + c.c * torque);
    }
    motion
}

impl LumpedBeam {
    /// The lowest `count` modes with the motor clamped, damping left out.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]` in partial fractions.
    pub fn modes(&self, count: usize) -> Vec<Mode> {
        let frequencies = self.frequencies_rad_s(Base::Clamped, count);
        frequencies.into_iter().map(|omega| self.mode(omega)).collect()
    }

    /// The mode at a natural frequency.
    fn mode(&self, omega: f64) -> Mode {
        let motion = motions(self.elements(), -omega * omega);
        let mut distance = 0.0;
        // Σ m·w² + I·φ², and Σ m·x·w + I·φ.
        let (mut mass_all, mut lever) = (0.0, 0.0);
        for (element, &(w, phi)) in self.elements().iter().zip(&motion) {
            match *element {
                Element::Span { length, .. }
                | Element::Rigid { length }
                | Element::Heavy { length, .. } => distance += length,
                Element::Mass { mass, .. } => {
                    mass_all += mass * w * w;
                    lever += mass * distance * w;
                }
                Element::Inertia { inertia } => {
                    mass_all += inertia * phi * phi;
                    lever += inertia * phi;
                }
            }
        }
        let deflection: Vec<f64> = self.joints().map(|k| motion[k].0).collect();
        let largest =
            deflection.iter().fold(0.0, |m: f64, v| if v.abs() > m.abs() { *v } else { m });
        Mode {
            natural_frequency_rad_s: omega,
            share: deflection
                .iter()
                .zip(self.position_m())
                .map(|(w, l)| w * lever / (mass_all * l))
                .collect(),
            shape: deflection.iter().map(|w| w / largest).collect(),
            inertia_kg_m2: lever * lever / mass_all,
        }
    }
}

/// Response with a damping ratio for each mode: every mode is summed.
pub(super) fn modal_response(beam: &LumpedBeam, s: Complex64) -> BeamResponse {
    let modes = beam.modes(usize::MAX);
    let mut angles = vec![Complex64::new(1.0, 0.0); beam.len()];
    let mut inertia = Complex64::from(beam.inertia_kg_m2());
    for (k, mode) in modes.iter().enumerate() {
        let omega = mode.natural_frequency_rad_s;
        let zeta = beam.damping().ratio(k).unwrap_or(0.0);
        // θ_i = θ_m + deflection: the deflection's denominator is damped, its drive is −θ̈_m.
        let driven = s * s / (s * s + s * (2.0 * zeta * omega) + omega * omega);
        angles.iter_mut().zip(&mode.share).for_each(|(a, r)| *a -= driven * r);
        inertia -= driven * mode.inertia_kg_m2;
    }
    BeamResponse { angles, coupling_nm_per_rad: s * s * inertia }
}
