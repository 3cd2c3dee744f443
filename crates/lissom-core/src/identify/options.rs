//! What a user may ask of an identification.

use crate::identify::interrupt::Interrupt;

/// Harmonics fitted to a periodic run.
const HARMONICS: usize = 9;

/// How far the output-error method refines the estimates. The limit is one of evaluations, and not of time: a result does not
/// depend on how fast the machine is. One evaluation is one sample of a log replayed, or its derivative by one parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// Not at all: the estimates are those of the other methods.
    Quick,
    /// Up to 1.5·10⁸ evaluations: some 10 s on two cores.
    #[default]
    Normal,
    /// Up to 2·10⁹ evaluations.
    Thorough,
}

impl Effort {
    /// The most evaluations.
    pub fn most_evaluations(self) -> u64 {
        match self {
            Self::Quick => 0,
            Self::Normal => 150_000_000,
            Self::Thorough => 2_000_000_000,
        }
    }
}

/// What a user may ask for.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Lengths of the regression's window to take one of \[s\]; chosen from the data when empty.
    pub window_s: Vec<f64>,
    /// Highest harmonic fitted to a periodic run; nine when `None`, and never above the Nyquist
    /// frequency.
    pub harmonics: Option<usize>,
    /// How far the output-error method goes.
    pub effort: Effort,
    /// Most evaluations of the output-error method ([`OutputError::evaluations`](crate::identify::OutputError::evaluations)); that of the effort
    /// when `None`.
    pub most_evaluations: Option<u64>,
    /// Ends the output-error method before it is done: the result is the best so far.
    pub interrupt: Interrupt,
}

impl Options {
    /// Highest harmonic fitted to a periodic run.
    pub(crate) fn highest_harmonic(&self) -> usize {
        self.harmonics.unwrap_or(HARMONICS).max(1)
    }

    /// Most evaluations of the output-error method.
    pub(crate) fn evaluations(&self) -> u64 {
        self.most_evaluations.unwrap_or_else(|| self.effort.most_evaluations())
    }
}
