//! Modes with the motor clamped: their shapes and their contributions.

use super::chain::{BaseSide, TipSide};
use super::element::{At, Element};
use super::piece::{Sym, cut_up};
use super::{Base, LumpedBeam};
use crate::number::Dual;

/// A mode of the beam with the motor clamped.
///
/// The responses are sums over the modes, `θ_i/θ_m = Σ_k r_ik·ω_k²/(s² + ω_k²)` and
/// `C_t/θ_m = Σ_k Γ_k²·ω_k²·s²/(s² + ω_k²) + (I − Σ_k Γ_k²)·s²`, with the inertia I of the
/// beam about the axis \[kg·m²\].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Mode {
    /// ω_k, undamped natural frequency \[rad/s\].
    pub natural_frequency_rad_s: f64,
    /// Mode shape: deflection from the motor's line at each point, scaled so that the largest is 1 \[1\].
    pub shape: Vec<f64>,
    /// r_ik, share of the mode in θ_i/θ_m at each point \[1\]; the shares of all modes add up to one.
    pub share: Vec<f64>,
    /// Γ_k², part of the inertia about the axis that belongs to the mode \[kg·m²\].
    pub inertia_kg_m2: f64,
}

/// What a mode does, any scale.
struct ModeMotion {
    /// Deflection at each joint asked for.
    deflection: Vec<f64>,
    /// ∫ w² dm and its like for slopes.
    mass: f64,
    /// ∫ x·w dm: what turning the base at a unit rate drives it with.
    lever: f64,
}

/// The motion in a mode of z = −ω² at the inner end of each element of `joints`.
///
/// The two sides are joined where the beam moves most, and the motion is carried from there
/// inwards by the base side's compliance and outwards by the tip side's stiffness: high modes keep
/// to a few masses, and further out a part of the beam resonates at the very same frequency.
///
/// # Source
/// The twisted factorisation of `[DhillonParlett2004]`, with 2×2 blocks.
fn motion(elements: &[Element], joints: &[usize], z: f64) -> ModeMotion {
    let (elements, place) = cut_up(elements, At::undamped(z));
    let at = At::undamped(z);
    let mut base = BaseSide::clamped();
    let mut inner = vec![base];
    for element in &elements {
        base.pass(at, element);
        inner.push(base);
    }
    let mut tip = TipSide::free();
    let mut outer = vec![tip];
    for element in elements.iter().rev() {
        tip.pass(at, element);
        outer.push(tip);
    }
    outer.reverse();
    // Boundary k lies inside element k; its compliance against the element's own mass.
    let moving = |k: usize| {
        let mass = match elements[k] {
            Element::Mass { mass, .. } => mass,
            Element::Heavy { length, mass_per_length, .. } => mass_per_length * length,
            _ => return 0.0,
        };
        let det = inner[k].compliance.meeting(outer[k].stiffness);
        (mass * inner[k].compliance.loaded(outer[k].stiffness, det).a).abs()
    };
    let cut = (1..elements.len()).max_by(|a, b| moving(*a).total_cmp(&moving(*b))).unwrap_or(0);
    let (c, y) = (inner[cut].compliance, outer[cut].stiffness);
    let mut moves = vec![(0.0, 0.0); elements.len() + 1];
    // A column of (I + C·Y)⁻¹·C, where it has its pole.
    let (w, phi) = (c.a + c.det * y.c, c.b - c.det * y.b);
    moves[cut] = (w, phi);
    for k in cut..elements.len() {
        moves[k + 1] = outer[k + 1].carried(at, &elements[k], moves[k]);
    }
    let load = (-y.a * w - y.b * phi, -y.b * w - y.c * phi);
    let mut inward = load;
    for k in (0..cut).rev() {
        (inward, moves[k]) = inner[k].carried(at, &elements[k], inward, moves[k + 1]);
    }
    let (mass, lever) = modal_mass(&elements, cut, z, (w, phi), load);
    ModeMotion { deflection: joints.iter().map(|k| moves[place[*k]].0).collect(), mass, lever }
}

/// Modal mass and lever from both sides of a cut: the mass is the derivative by z of the dynamic
/// stiffness C⁻¹ + Y, the lever that of the torque at the base.
fn modal_mass(
    elements: &[Element],
    cut: usize,
    z: f64,
    (w, phi): (f64, f64),
    (force, torque): (f64, f64),
) -> (f64, f64) {
    let at = At::undamped(Dual::variable(z));
    let mut base = BaseSide::clamped();
    elements[..cut].iter().for_each(|e| base.pass(at, e));
    let mut tip = TipSide::free();
    elements[cut..].iter().rev().for_each(|e| tip.pass(at, e));
    let (c, y) = (base.compliance, tip.stiffness);
    let form = |s: Sym<Dual<f64>>, x: f64, y: f64| {
        s.a.slope * x * x + 2.0 * s.b.slope * x * y + s.c.slope * y * y
    };
    let lever = -(base.motion.0.value * force + base.motion.1.value * torque) / z;
    (form(y, w, phi) - form(c, force, torque), lever)
}

/// The mode at ω, at the joints with these distances from the axis.
pub(crate) fn mode(elements: &[Element], joints: &[usize], position: &[f64], omega: f64) -> Mode {
    let ModeMotion { deflection, mass, lever } = motion(elements, joints, -omega * omega);
    let largest = deflection.iter().fold(0.0, |m: f64, v| if v.abs() > m.abs() { *v } else { m });
    let share = deflection.iter().zip(position).map(|(w, l)| w * lever / (mass * l)).collect();
    Mode {
        natural_frequency_rad_s: omega,
        share,
        shape: deflection.iter().map(|w| w / largest).collect(),
        inertia_kg_m2: lever * lever / mass,
    }
}

impl LumpedBeam {
    /// The lowest `count` modes with the motor clamped, without damping.
    ///
    /// # Source
    /// `[Feliu1989, eq. (16)]` as partial fractions.
    pub fn modes(&self, count: usize) -> Vec<Mode> {
        let joints: Vec<usize> = self.joints().collect();
        let frequencies = self.frequencies_rad_s(Base::Clamped, count);
        let one = |omega| mode(self.elements(), &joints, self.position_m(), omega);
        frequencies.into_iter().map(one).collect()
    }
}
