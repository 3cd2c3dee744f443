//! The extension module `lissom._lissom`: what the Python package `lissom` calls. Arrays and texts in, arrays and JSON out;
//! the package makes its classes of them.

#![expect(
    clippy::needless_pass_by_value,
    reason = "arguments of Python functions are values of their own"
)]

mod campaign;
mod columns;
mod command;
mod comparing;
mod describing;
mod equivalent;
mod errors;
mod exporting;
mod fleet;
mod found;
mod identifying;
mod inspecting;
mod planning;
mod reading_results;
mod search;
mod simulating;
mod validating;
mod worker;

use pyo3::prelude::*;

/// The module. The interpreter lock is released while a function works.
#[pymodule]
mod _lissom {
    #[pymodule_export]
    use crate::campaign::NativeCampaign;
    #[pymodule_export]
    use crate::command::command;
    #[pymodule_export]
    use crate::comparing::compare;
    #[pymodule_export]
    use crate::describing::{describe, is_linear};
    #[pymodule_export]
    use crate::equivalent::{equivalent_of_arrays, equivalent_of_files};
    #[pymodule_export]
    use crate::exporting::export;
    #[pymodule_export]
    use crate::fleet::{
        FleetWorker, NativeFleetRun, fleet_columns, fleet_folders, fleet_logs, fleet_manifest,
        fleet_page_of, fleet_pattern, fleet_run_files, fleet_summary, fleet_time,
    };
    #[pymodule_export]
    use crate::found::NativeFound;
    #[pymodule_export]
    use crate::identifying::identify;
    #[pymodule_export]
    use crate::inspecting::{inspect, inspect_columns};
    #[pymodule_export]
    use crate::planning::plan;
    #[pymodule_export]
    use crate::reading_results::{parameters, result_text};
    #[pymodule_export]
    use crate::search::Pending;
    #[pymodule_export]
    use crate::simulating::simulate;
    #[pymodule_export]
    use crate::validating::{NativeValidation, validate};

    use super::{Bound, PyModule, PyModuleMethods as _, PyResult};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
