//! The folder of a fleet: Parquet parts that never change, and a manifest that lists those that count.

mod folder;
mod folder_lock;
mod manifest;
mod part;
mod part_columns;
mod table;

pub(crate) use folder::FleetFolder;
pub use manifest::{MANIFEST, Manifest, PartEntry};
pub use part_columns::Values;
pub(crate) use part_columns::{FAILURE, LOG, MACHINE, TIME, std_of};
pub use table::{FleetTable, open};
