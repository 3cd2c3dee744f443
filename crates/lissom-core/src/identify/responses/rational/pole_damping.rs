//! Which damping the poles of a fit may have.

/// What the poles may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damping {
    /// None: even powers of s only, as properties 1 and 2 have it.
    None,
    /// A ratio of each pole's own.
    Small,
    /// The same, and a term in s in each residue: damping within the beam, or of a shape of its own.
    Within,
}

impl Damping {
    /// Unknowns of a pole.
    pub(crate) fn unknowns(self) -> usize {
        match self {
            Self::None => 1,
            Self::Small | Self::Within => 2,
        }
    }

    /// Figures of a residue.
    pub(crate) fn terms(self) -> usize {
        match self {
            Self::None | Self::Small => 1,
            Self::Within => 2,
        }
    }
}
