//! Estimates compared with known values, as written by `lissom demo --json` and `lissom figures --json`.

mod demo_file;
mod figures_file;

pub use demo_file::{ComparedEstimateEntry, ComparisonEntry, DemoFile};
pub use figures_file::{ComparedCoulombEntry, FiguresFile};
