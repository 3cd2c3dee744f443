//! `rig.json`: what is known about a virtual campaign in addition to its logs.
//!
//! Its schema is `docs/src/reference/schemas/rig.schema.json`, generated from [`RigFile`].

mod rig_file;
mod rig_run_entry;

pub use rig_file::{RigFile, RigGravityEntry, RigTruthEntry};
pub use rig_run_entry::{RigFindingEntry, RigRunEntry};
