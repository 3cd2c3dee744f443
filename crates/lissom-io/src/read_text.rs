//! Files of text that are read whole.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Largest file that is read whole \[bytes\], far beyond what a person or lissom writes.
const MOST: u64 = 256 << 20;

/// The text of a file.
///
/// # Errors
/// Where it cannot be read, is no UTF-8, or is larger than any such file is: a device may have no end.
pub fn read_text(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    let read = File::open(path)?.take(MOST + 1).read_to_string(&mut text)?;
    if read as u64 > MOST {
        let told = format!("it has more than {} MiB", MOST >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, told));
    }
    Ok(text)
}
