//! The version that all workers of a fleet have.

/// Version of this program: all workers of a fleet have the same.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
