//! Natural frequencies by counting: none missed, each exact to rounding.

use super::chain::{BaseSide, TipSide};
use super::counted::counted_roots;
use super::element::{At, Element};
use crate::number::{Number, Scaled};

/// Boundary condition at the base of the beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Base {
    /// Clamped: natural frequencies are the poles of θ_i/θ_m.
    Clamped,
    /// Free to turn, without inertia: natural frequencies are the zeros of C_t/θ_m other than s = 0.
    Pinned,
    /// Turns with a rotor of this inertia \[kg·m²\]: natural frequencies are the poles of θ_m/i without viscous
    /// friction, other than s = 0.
    Rotor(f64),
}

/// Everything from the base to the tip.
pub(crate) fn whole<N: Number>(elements: &[Element], at: At<N>) -> BaseSide<N> {
    let mut side = BaseSide::clamped();
    for element in elements {
        side.pass(at, element);
    }
    side
}

/// Everything from the tip to the base. The torque per turn of the motor, C_t/θ_m, is the
/// stiffness against slope there; it is no sum that could cancel, as that kept from the base is.
pub(crate) fn from_tip<N: Number>(elements: &[Element], at: At<N>) -> TipSide<N> {
    let mut side = TipSide::free();
    for element in elements.iter().rev() {
        side.pass(at, element);
    }
    side
}

/// The function of z whose negative roots are −ω², and how many of those lie below.
fn characteristic(elements: &[Element], base: Base, z: f64) -> (Scaled<f64>, usize) {
    let free = |inertia: f64| {
        let side = from_tip(elements, At::undamped(z));
        // Divided by z: the rigid turn is no oscillation. It is one negative pivot at any z < 0.
        let pivot = side.stiffness.c / z + inertia;
        let below = (side.below + usize::from(pivot > 0.0)).saturating_sub(1);
        (side.det.times(pivot), below)
    };
    match base {
        Base::Clamped => {
            let side = whole(elements, At::undamped(z));
            (side.det, side.below)
        }
        Base::Pinned => free(0.0),
        Base::Rotor(inertia) => free(inertia),
    }
}

/// How many natural frequencies lie below `omega_rad_s`.
pub(crate) fn below(elements: &[Element], base: Base, omega_rad_s: f64) -> usize {
    if omega_rad_s <= 0.0 {
        return 0;
    }
    characteristic(elements, base, -omega_rad_s * omega_rad_s).1
}

/// The lowest `count` natural frequencies, ascending \[rad/s\]; fewer where the chain has fewer or
/// they are beyond the range of a double.
///
/// # Source
/// `[WittrickWilliams1971]` for the count; between two points whose counts differ by one the
/// characteristic function changes its sign once.
pub(crate) fn lowest(elements: &[Element], base: Base, count: usize) -> Vec<f64> {
    let degrees = degrees(elements).saturating_sub(usize::from(base == Base::Pinned));
    let at = |omega: f64| characteristic(elements, base, -omega * omega);
    counted_roots(at, count.min(degrees), below_first(elements))
}

/// A power of two below the first natural frequency with the motor clamped \[rad/s\]: all mass
/// at the tip, as it were. A search that began at some fixed frequency could meet a beam that has
/// millions of waves there.
///
/// # Source
/// Dunkerley: 1/ω₁² ≤ Σ m_i·F_ii, and no F_ii is above that of the tip.
pub(crate) fn below_first(elements: &[Element]) -> f64 {
    let compliance = whole(elements, At::undamped(0.0)).compliance;
    let (mut mass, mut inertia) = (0.0, 0.0);
    for element in elements {
        match *element {
            Element::Mass { mass: m, .. } => mass += m,
            Element::Heavy { length, mass_per_length, .. } => mass += mass_per_length * length,
            Element::Inertia { inertia: i } => inertia += i,
            Element::Span { .. } | Element::Rigid { .. } => {}
        }
    }
    let low = (0.5 / (mass * compliance.a + inertia * compliance.c)).sqrt();
    if low.is_normal() { 2f64.powi(low.log2().floor() as i32) } else { 1.0 }
}

/// Degrees of freedom: two at most at a joint, which moves and turns; `usize::MAX` with mass along
/// a piece.
pub(crate) fn degrees(elements: &[Element]) -> usize {
    let (mut total, mut here, mut flexible) = (0_usize, 0_usize, false);
    for element in elements {
        match element {
            Element::Heavy { .. } => return usize::MAX,
            Element::Span { .. } => {
                total += here.min(2);
                (here, flexible) = (0, true);
            }
            Element::Mass { .. } | Element::Inertia { .. } => here += usize::from(flexible),
            Element::Rigid { .. } => {}
        }
    }
    total + here.min(2)
}
