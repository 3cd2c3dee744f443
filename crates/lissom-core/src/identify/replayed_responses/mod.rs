//! Frequency responses without friction, as the arm of the output-error method moves.

pub(crate) mod friction_waveform;
pub(crate) mod replayed_bands;
pub(crate) mod response_step;
