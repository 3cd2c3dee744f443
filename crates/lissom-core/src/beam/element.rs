//! Elements of a chain of spans and masses, and the points s² and s at which it is solved.

use crate::number::Number;

/// An element of a chain, base to tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Element {
    /// Elastic without mass: length \[m\], EI \[N·m²\].
    Span { length: f64, rigidity: f64 },
    /// Elastic with mass per length \[kg/m\].
    Heavy { length: f64, rigidity: f64, mass_per_length: f64 },
    /// Rigid, without mass: length \[m\].
    Rigid { length: f64 },
    /// Mass \[kg\], damped against the fixed frame \[N·s/m\].
    Mass { mass: f64, damping: f64 },
    /// Rotary inertia \[kg·m²\].
    Inertia { inertia: f64 },
}

/// Where the recursion runs: what multiplies masses, and what multiplies dampers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct At<N> {
    /// s², or its counterpart where damping is proportional \[1/s²\].
    pub(crate) z: N,
    /// s, likewise \[1/s\]; zero where there are no dampers.
    pub(crate) s: N,
}

impl<N: Number> At<N> {
    /// Without dampers.
    pub(crate) fn undamped(z: N) -> Self {
        Self { z, s: N::real(0.0) }
    }
}
