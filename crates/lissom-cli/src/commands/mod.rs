//! One module for each subcommand: it reads the inputs, calls the library, and passes the result to the views.

pub(crate) mod check_command;
pub(crate) mod compare_command;
pub(crate) mod completions_command;
pub(crate) mod demo;
pub(crate) mod equivalent;
pub(crate) mod export_command;
#[cfg(feature = "fleet")]
pub(crate) mod fleet_command;
#[cfg(feature = "fleet")]
mod fleet_summary_command;
pub(crate) mod identify_command;
pub(crate) mod init_command;
pub(crate) mod inspect_command;
pub(crate) mod man_command;
pub(crate) mod model_command;
pub(crate) mod payload_command;
pub(crate) mod plan;
pub(crate) mod plot_command;
pub(crate) mod report_command;
pub(crate) mod report_figures;
pub(crate) mod rig;
#[cfg(feature = "studio")]
pub(crate) mod studio_command;
pub(crate) mod thresholds_command;
pub(crate) mod validate_command;
