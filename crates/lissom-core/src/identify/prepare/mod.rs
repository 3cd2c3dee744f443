//! The runs as the methods use them: checked channels, measured noise, and the kind of each run.

pub(crate) mod channel_check;
pub(crate) mod channel_noise;
pub(crate) mod correlated_average;
pub(crate) mod frozen_sensor;
pub(crate) mod log_check;
pub(crate) mod phases;
pub(crate) mod prepared;
pub(crate) mod repeated_run;
pub(crate) mod run_analysis;
pub(crate) mod run_noise;
pub(crate) mod run_phasors;
pub(crate) mod sensor_check;
pub(crate) mod steady_points;
pub(crate) mod steady_stretches;
pub(crate) mod steady_thresholds;
pub(crate) mod thresholds;
pub(crate) mod tip_zero;
pub(crate) mod window;
