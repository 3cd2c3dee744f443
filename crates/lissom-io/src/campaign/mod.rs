//! `campaign.toml`: the logs of a campaign, their columns, and what is known about the drive.
//!
//! ```toml
//! [signals]
//! time    = { column = "t", unit = "s" }    # or sample_time = "1 ms" for logs without stamps
//! current = { column = "i", unit = "A", hold = "sampled" }
//! motor   = { column = "theta_m", unit = "rad" }
//! speed   = { column = "omega_m", unit = "rpm" }   # optional: is compared with the angle
//! tips    = [{ name = "tip", column = "theta_t", unit = "rad" }]
//! decimal = ","                             # absent: a point
//! run     = "trial"                         # optional: column with the number or name of the run, if a log has several
//! [drive]
//! torque_constant = "2.184 lbf*in/A"
//! current_limit = "4.12 A"
//! gear_ratio = 100                          # of the motor's constants; gear_efficiency = 0.8
//! arm = "arm.toml"                          # an arm to compare with
//! [load]
//! gravity = true                            # a torque g_s·sin θ + g_c·cos θ acts; to be identified
//! mgl = "2.1 N*m"                            # m·g·l if it is known: gives the torque constant
//! [analysis]
//! window = "0.3 s"                          # or a list
//! harmonics = 9
//! skip = "1 s"                              # beginning of every run to leave out
//! [[runs]]
//! file = "run-01.csv"                       # or "log.h5::run1", a group in a file; "log.h5::run*" for all groups
//! frequency = "0.5 Hz"                      # or omega_rad_s = 3.1416; found when absent
//! ```
//!
//! **Columns** are given by name, or by number from 1. A reading is `(scale·raw + offset)` in `unit`;
//! `scale` is 1 and `offset` 0 when absent.
//!
//! **The input of the drive** is `current`, `voltage` or `command`. The unit of `command` may be a unit of current, of
//! voltage, of torque (force on a linear axis), or `"1"` for a command of unknown unit. With `quantity = "goal"` it is
//! the position goal of a servo: the input is then the goal minus the angle, and `[drive] position_gain` the torque per
//! radian. `hold` is `"sampled"` (held between samples), `"measured"` or `"unknown"`. For a voltage the torque constant is per volt,
//! or per ampere with `resistance` and `back_emf`; a `back_emf` with a constant per volt adds its damping. `limit` is
//! the limit of any command; `current_limit` and `voltage_limit` are the same for a current and a voltage.
//!
//! **The axis** is rotary if the motor's unit is an angle, linear if it is a length. With `quantity = "speed"` and a
//! unit of speed, the angle is integrated from 0. A `speed` in addition to an angle is compared with it and not used.
//! Jumps of one turn of an absolute encoder are removed.
//!
//! **Tips** have a `quantity`: `"angle"` (of the radius to the point; when absent), `"deflection"`
//! (from the motor's line) or `"acceleration"`. A length or acceleration in metres on a rotary
//! axis needs `radius`. `unit = "1"` is a sensor of unknown scale. A camera has the columns `x` and `y`
//! instead of `column` and, if the joint is not at (0, 0), `origin = [x, y]` in the numbers of these
//! columns; its angle is unwrapped at ±π and multiplied by `scale` (−1 if y points down).

#[cfg(test)]
mod campaign_channel_tests;
mod campaign_drive;
mod campaign_file;
mod campaign_load;
mod campaign_signals;
#[cfg(test)]
mod campaign_tests;
mod conversions;
mod derived_channels;
mod load_runs;
mod memory_logs;
mod own_logs;
mod read_campaign;
mod run_spec;
#[cfg(test)]
mod run_spec_tests;
#[cfg(test)]
mod several_logs_tests;
mod several_runs;
mod speed_check;
mod whole_turns;

pub use campaign_file::{AnalysisOptions, CampaignFile, DriveConstants, ReadOptions};
pub(crate) use campaign_signals::column;
pub use memory_logs::MemoryLogs;
pub use read_campaign::{CampaignReader, read_campaign, read_campaign_like};
