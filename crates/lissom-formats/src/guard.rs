//! Runs the reader of another library so that a fault of it is an error of the file.

use std::thread;

use crate::format::Format;
use crate::format_error::FormatError;

/// Stack of the reader \[byte\]. Types may be nested as deep as a header of 64 kB allows, and each level takes about a kB.
const STACK_BYTES: usize = 128 << 20;

/// What `read` returns.
///
/// # Errors
/// Those of `read`, and [`FormatError::Content`] with the name of the format if `read` panics.
pub(crate) fn guarded<T: Send>(
    format: Format,
    read: impl FnOnce() -> Result<T, FormatError> + Send,
) -> Result<T, FormatError> {
    let failed =
        || FormatError::content(format.name(), "the file is damaged: its reader has failed");
    thread::scope(|scope| {
        let reader = thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, read)?;
        reader.join().unwrap_or_else(|_| Err(failed()))
    })
}
