//! Files of keys and values (TOML), read so that every error names file, line and key.
//!
//! The values are read by hand: a derived reader loses the place of a value that may be text or a number, and so
//! the line number for an error.

mod config_error;
mod config_table;

pub use config_error::{ConfigError, ConfigPlace};
pub(crate) use config_table::{MAGNITUDE, Source, Table, Value};
