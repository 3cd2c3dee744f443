//! `campaign.toml`: which logs belong together, what their columns are and what is known of the
//! drive.
//!
//! ```toml
//! [signals]
//! time    = { column = "t", unit = "s" }    # or sample_time = "1 ms" for logs without stamps
//! current = { column = "i", unit = "A", hold = "sampled" }
//! motor   = { column = "theta_m", unit = "rad" }
//! speed   = { column = "omega_m", unit = "rpm" }   # checked against the angle where it is logged, too
//! tips    = [{ name = "tip", column = "theta_t", unit = "rad" }]
//! decimal = ","                             # absent: a point
//! [drive]
//! torque_constant = "2.184 lbf*in/A"
//! current_limit = "4.12 A"
//! gear_ratio = 100                          # of the motor's constants; gear_efficiency = 0.8
//! arm = "arm.toml"                          # an arm to compare with
//! [load]
//! gravity = true                            # a torque g_s·sin θ + g_c·cos θ acts; to be identified
//! mgl = "2.1 N*m"                            # m·g·l where it is known: it gives the torque constant
//! [analysis]
//! window = "0.3 s"                          # or a list
//! harmonics = 9
//! skip = "1 s"                              # head of every run to leave out
//! [[runs]]
//! file = "run-01.csv"
//! frequency = "0.5 Hz"                      # or omega_rad_s = 3.1416; found when absent
//! ```
//!
//! **Columns** go by name or, from 1, by number. A reading is `(scale·raw + offset)` in `unit`;
//! `scale` is 1 and `offset` 0 when absent.
//!
//! **The drive's input** is `current`, `voltage` or `command`; the unit of `command` may be one of
//! current, of voltage, of torque (force on a linear axis) or `"1"`, a command of unknown unit. With `quantity = "goal"`
//! it is a servo's position goal: the input is then the goal less the angle, and `[drive] position_gain` its torque per
//! radian. `hold` is `"sampled"`
//! (a held command) or `"measured"`. For a voltage the torque constant is per volt, or per ampere
//! with `resistance` and `back_emf`; a `back_emf` beside a constant per volt adds its damping.
//! `limit` is the command's limit in any case; `current_limit` and `voltage_limit` say which.
//!
//! **The axis** is rotary where the motor's unit is an angle, linear where it is a length. With `quantity = "speed"` and a
//! unit of speed, the angle is integrated from 0. A `speed` beside an angle is checked against it and not used. Jumps of one turn of an absolute encoder are removed.
//!
//! **Tips** have a `quantity`: `"angle"` (of the radius to the point; when absent), `"deflection"`
//! (from the motor's line) or `"acceleration"`. A length or acceleration in metres on a rotary
//! axis needs `radius`. `unit = "1"` is a sensor of unknown scale. A camera has `x` and `y`
//! columns in place of `column` and, where the joint is not at (0, 0), `origin = [x, y]` in the
//! columns' own numbers; its angle is continued across ±π and multiplied by `scale` (−1 where y
//! points down).

#[cfg(test)]
mod campaign_channel_tests;
mod campaign_drive;
pub(crate) mod campaign_error;
mod campaign_file;
mod campaign_load;
mod campaign_signals;
#[cfg(test)]
mod campaign_tests;
mod derived_channels;
mod load_runs;
mod read_campaign;
mod run_spec;
mod speed_check;
mod whole_turns;

pub use campaign_error::CampaignError;
pub use campaign_file::{AnalysisOptions, CampaignFile, DriveConstants, ReadOptions};
pub(crate) use campaign_signals::column;
pub use read_campaign::{read_campaign, read_campaign_like, read_campaign_with};
