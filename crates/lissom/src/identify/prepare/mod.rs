//! The runs as the methods use them: checked channels, noise, and what each run is.

pub(crate) mod channel_check;
pub(crate) mod channel_noise;
pub(crate) mod repeated_run;
pub(crate) mod run_analysis;
pub(crate) mod sensor_check;
pub(crate) mod thresholds;
