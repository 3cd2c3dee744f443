//! Identifies the logs of many machines, and summarises the results.
//!
//! A fleet is a list of logs ([`FleetLog`]) that one `campaign.toml` describes ([`FleetSettings`]). Each log is identified by
//! itself, and gets one row: its estimates with standard errors and findings, or why there are none. Logs go in batches
//! through worker processes, so that a log that brings a process to its end costs no other log.
//!
//! ```text
//! logs ──► FleetRun ──► Batch ──► LogWorker ──► worker process (serve)
//!             ▲                       │
//!             └────── BatchRows ◄─────┘
//!             └──► folder: parts in Parquet, manifest.json ──► FleetTable ──► FleetSummary
//! ```
//!
//! [`run_here`] uses processes of this machine. Another engine, such as a cluster, calls [`FleetRun::next_batch`], has a
//! [`LogWorker`] somewhere make rows of the batch, and gives them to [`FleetRun::take`].

mod batch_size;
mod checksum;
mod existing_rows;
mod fleet_error;
mod fleet_log;
mod fleet_run;
mod list_logs;
mod log_time;
mod row;
mod run_here;
mod settings;
mod store;
mod summary;
mod version;
mod work;

pub use existing_rows::ExistingRows;
pub use fleet_error::FleetError;
pub use fleet_log::FleetLog;
pub use fleet_run::{FleetRun, Progress};
pub use lissom_io::EffortName;
pub use lissom_io::fleet::{
    Distribution, Drift, DriftValue, FailureCount, FindingCount, FleetSummary, Histogram,
    LogOutlier, MachineOutlier, ParameterSummary,
};
pub use list_logs::{ListedLogs, LogPattern, folders_with, logs_of_paths, logs_of_table};
pub use log_time::{date, time_us};
pub use row::{Failure, FleetRow, RowEstimate, RowOutcome, RowResult};
pub use run_here::run_here;
pub use settings::{FleetSettings, RETRIES, Refinement, TIME_LIMIT_S};
pub use store::{FleetTable, MANIFEST, Manifest, PartEntry, Values, open};
pub use summary::{SummaryOptions, summarise};
pub use version::VERSION;
pub use work::{Batch, BatchRows, LogWorker, WorkerProgram, serve};
