//! Kinds of damping that the poles of a fit may have.

/// Damping that the poles of a fit may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damping {
    /// No damping: only even powers of s, as in properties 1 and 2.
    None,
    /// A damping ratio for each pole.
    Small,
    /// A damping ratio for each pole, and a term in s in each residue: damping within the beam, or
    /// damping with a shape of its own.
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

    /// Estimates of a residue.
    pub(crate) fn terms(self) -> usize {
        match self {
            Self::None | Self::Small => 1,
            Self::Within => 2,
        }
    }
}
