//! A local web application for lissom.
//!
//! [`Studio::open`] locks a folder with the state and listens on the loopback interface; [`Studio::run`] serves the page
//! until the program ends. The page shows the logs, describes their channels, identifies, and shows results. It computes
//! nothing itself: everything comes from the same library as the command's output.
//!
//! | file | task |
//! |---|---|
//! | `access.rs`, `guard.rs` | who may ask: one-time token and key; host and origin |
//! | `state_folder.rs`, `session.rs` | what is kept: plain files in a folder that only the user can read |
//! | `setup.rs` | what the user says about the logs, as the description of a campaign |
//! | `uploads.rs` | logs that the browser sends |
//! | `log_cache.rs`, `thinned.rs` | logs in memory, and their samples for a screen |
//! | `job.rs`, `identification.rs` | one identification at a time, with progress |
//! | `planning.rs` | the next experiment, planned and simulated |
//! | `exports.rs`, `sample.rs` | files made of a result; logs to try it with |
//! | `routes.rs` | addresses of the application, each a few lines |
#![deny(missing_docs)]

mod access;
mod app;
mod exports;
mod guard;
mod identification;
mod job;
mod log_cache;
mod opener;
mod planning;
mod problem;
mod routes;
mod runs;
mod said;
mod sample;
mod session;
mod setup;
mod state_folder;
mod state_view;
mod studio;
mod studio_error;
mod thinned;
mod uploads;

pub use studio::{Studio, StudioOptions};
pub use studio_error::StudioError;
