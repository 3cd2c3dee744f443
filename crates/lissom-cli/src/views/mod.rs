//! Output for people: text in the terminal, and plots of models and logs as files. The figures and the page of results are
//! made by `lissom-views`.

pub(crate) mod arm_check_words;
pub(crate) mod campaign_summary;
pub(crate) mod channel_plots;
pub(crate) mod check_table;
pub(crate) mod compare_table;
pub(crate) mod demo_table;
pub(crate) mod draft_lines;
pub(crate) mod equivalent_table;
pub(crate) mod figure_table;
pub(crate) mod finding_list;
#[cfg(feature = "fleet")]
pub(crate) mod fleet_run_lines;
#[cfg(feature = "fleet")]
pub(crate) mod fleet_summary_table;
pub(crate) mod friction_truth;
pub(crate) mod inspection_table;
pub(crate) mod load_table;
pub(crate) mod model_algebra;
pub(crate) mod model_plots;
pub(crate) mod model_table;
pub(crate) mod parameter_table;
pub(crate) mod payload_table;
pub(crate) mod plan_table;
pub(crate) mod plot_file;
pub(crate) mod printed_coulomb_table;
pub(crate) mod printer;
pub(crate) mod rig_table;
pub(crate) mod separability_words;
pub(crate) mod threshold_table;
pub(crate) mod validation_table;
