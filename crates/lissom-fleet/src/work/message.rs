//! Messages between a worker process and the process that started it: lines of JSON.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use crate::row::FleetRow;

/// What a worker process answers.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Answer {
    /// To the settings: it is ready, with its version.
    Ready {
        /// Version of lissom.
        version: String,
    },
    /// To a log.
    Row(Box<FleetRow>),
}

/// Writes a message as a line.
pub(super) fn send(out: &mut impl Write, message: &impl Serialize) -> io::Result<()> {
    let mut line = serde_json::to_vec(message)?;
    line.push(b'\n');
    out.write_all(&line)?;
    out.flush()
}
