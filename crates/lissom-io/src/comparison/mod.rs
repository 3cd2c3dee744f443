//! Estimates compared with known values: what `lissom demo` and `lissom figures` write with `--json`.

mod demo_file;
mod figures_file;

pub use demo_file::{ComparedEstimateEntry, ComparisonEntry, DemoFile};
pub use figures_file::{ComparedCoulombEntry, FiguresFile};
