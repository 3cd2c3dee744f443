//! Options of an identification.

use crate::identify::interrupt::Interrupt;

/// Harmonics fitted to a periodic run.
const HARMONICS: usize = 9;

/// Effort of the output-error method. It is limited by a number of evaluations instead of a time, so that
/// results do not depend on the speed of the machine. One evaluation is one replayed sample of a log, or
/// its derivative by one parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// No output-error method: the estimates are those of the other methods.
    Quick,
    /// Up to 1.5·10⁸ evaluations: about 10 s on two cores.
    #[default]
    Normal,
    /// Up to 2·10⁹ evaluations.
    Thorough,
}

impl Effort {
    /// Largest number of evaluations.
    pub fn most_evaluations(self) -> u64 {
        match self {
            Self::Quick => 0,
            Self::Normal => 150_000_000,
            Self::Thorough => 2_000_000_000,
        }
    }
}

/// Options of an identification.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Lengths of the regression's window \[s\], of which one is used; if empty, a length is chosen from the data.
    pub window_s: Vec<f64>,
    /// Highest harmonic that is fitted to a sinusoidal run; nine if `None`, and never above the Nyquist frequency.
    pub harmonics: Option<usize>,
    /// Effort of the output-error method.
    pub effort: Effort,
    /// Largest number of evaluations of the output-error method
    /// ([`OutputError::evaluations`](crate::identify::OutputError::evaluations)); if `None`, that of the effort.
    pub most_evaluations: Option<u64>,
    /// Ends the output-error method early, with the best result so far.
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
