//! Text files that are read at once.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest file that is read at once \[bytes\], far larger than files that people or lissom write.
const MOST: u64 = 256 << 20;

/// Reads the text of a file.
///
/// # Errors
/// If it cannot be read, is not UTF-8, or is too large, as a device without an end is.
pub fn read_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    let read = File::open(path)?.take(MOST + 1).read_to_string(&mut text)?;
    if read as u64 > MOST {
        let told = format!("it has more than {} MiB", MOST >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, told));
    }
    Ok(text)
}
