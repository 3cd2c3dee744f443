//! The computations of the commands, from inputs that were read to results. Nothing here is printed or written.

pub(crate) mod any_beam;
pub(crate) mod demo_comparison;
pub(crate) mod described_logs;
pub(crate) mod equivalent_input;
pub(crate) mod identification;
pub(crate) mod load_study;
pub(crate) mod mode_shapes;
pub(crate) mod model_task;
pub(crate) mod page_logs;
pub(crate) mod printed_coulomb;
pub(crate) mod rig_campaign;
pub(crate) mod stored_result;
