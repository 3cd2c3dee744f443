//! The arguments of each subcommand, and nothing else.

pub(crate) mod check_args;
pub(crate) mod command_line;
pub(crate) mod compare_args;
pub(crate) mod completions_args;
pub(crate) mod demo_args;
pub(crate) mod equivalent_args;
pub(crate) mod export_args;
pub(crate) mod figures_args;
#[cfg(feature = "fleet")]
pub(crate) mod fleet_args;
pub(crate) mod identify_args;
pub(crate) mod init_args;
pub(crate) mod inspect_args;
pub(crate) mod log_args;
pub(crate) mod man_args;
pub(crate) mod model_args;
pub(crate) mod payload_args;
pub(crate) mod plan_args;
pub(crate) mod plot_args;
pub(crate) mod positive_time;
pub(crate) mod report_args;
pub(crate) mod rig_args;
pub(crate) mod stdout_name;
pub(crate) mod stored_args;
pub(crate) mod thresholds_args;
pub(crate) mod validate_args;
