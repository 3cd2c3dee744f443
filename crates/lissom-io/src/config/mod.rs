//! Files of keys and values (TOML), read so that every error names file, line and key.
//!
//! The values are walked by hand: a derived reader loses the place of a value that may be text
//! or a number, and with it the line that an error should name.

mod config_error;
mod config_table;

pub use config_error::{ConfigError, ConfigPlace, Rule};
pub(crate) use config_table::{MAGNITUDE, Source, Table, Value};
