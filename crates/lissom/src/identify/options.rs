//! What a user may ask of an identification.

/// Harmonics fitted to a periodic run.
const HARMONICS: usize = 9;

/// What a user may ask for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// Lengths of the regression's window to take one of \[s\]; chosen from the data when empty.
    pub window_s: Vec<f64>,
    /// Highest harmonic fitted to a periodic run; nine when `None`, and never above the Nyquist
    /// frequency.
    pub harmonics: Option<usize>,
    /// Leaves out the replay of the runs through the arm: the estimates are those of the other methods.
    pub without_output_error: bool,
    /// Most evaluations of the output-error method ([`OutputError::evaluations`](crate::identify::OutputError::evaluations)); a number that campaigns rarely reach
    /// when `None`. A result depends on this number and not on how fast the machine is.
    pub most_evaluations: Option<u64>,
}

impl Options {
    /// Highest harmonic fitted to a periodic run.
    pub(crate) fn highest_harmonic(&self) -> usize {
        self.harmonics.unwrap_or(HARMONICS).max(1)
    }
}
