//! A worker process: settings, then log after log.

use std::io::{self, BufRead, Write};

use super::identify_log::identify_log;
use super::message::{Answer, send};
use crate::fleet_log::FleetLog;
use crate::settings::FleetSettings;
use crate::version::VERSION;

/// Reads settings and logs as lines, and answers each with a line, until the input ends.
///
/// # Errors
/// If a line is not a message, or an answer cannot be written: the process that asked is gone.
pub fn serve(input: impl BufRead, mut output: impl Write) -> io::Result<()> {
    let mut lines = input.lines();
    let Some(settings) = lines.next() else { return Ok(()) };
    let settings: FleetSettings = serde_json::from_str(&settings?)?;
    send(&mut output, &Answer::Ready { version: VERSION.to_owned() })?;
    for line in lines {
        let log: FleetLog = serde_json::from_str(&line?)?;
        send(&mut output, &Answer::Row(Box::new(identify_log(&settings, &log))))?;
    }
    Ok(())
}
