//! The key `settle`.

use lissom_core::rig::Settle;

use crate::config::{ConfigError, Table, Value};
use crate::units::Dimension;

/// Reads how long a run waits for the transient to decay before its log begins.
pub(super) fn settle(value: &Value<'_>) -> Result<Settle, ConfigError> {
    if let Some(table) = value.as_table() {
        return detected(&table);
    }
    Ok(match value.as_text() {
        Some("detected") => Settle::DETECTED,
        Some("none") => Settle::AtOnce,
        _ => Settle::Wait { wait_s: value.not_negative(Dimension::TIME)? },
    })
}

fn detected(table: &Table<'_>) -> Result<Settle, ConfigError> {
    table.only("tolerance longest")?;
    let Settle::Detected { tolerance, longest_s } = Settle::DETECTED else {
        return Ok(Settle::DETECTED);
    };
    Ok(Settle::Detected {
        tolerance: table.positive("tolerance", Dimension::NUMBER)?.unwrap_or(tolerance),
        longest_s: table.positive("longest", Dimension::TIME)?.unwrap_or(longest_s),
    })
}
