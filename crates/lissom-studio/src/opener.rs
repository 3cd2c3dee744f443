//! Opens the page through a file that only the user can read: arguments of programs are public.

use std::io;
use std::path::{Path, PathBuf};

use crate::state_folder::write_private;

/// Name of the file.
const NAME: &str = "open.html";

/// The address of the page, with a token that can be used once.
pub(crate) fn address(port: u16, token: &str) -> String {
    format!("http://127.0.0.1:{port}/#{token}")
}

/// Writes the file that leads a browser to the address.
pub(crate) fn write(folder: &Path, address: &str) -> io::Result<PathBuf> {
    let file = folder.join(NAME);
    let text = format!(
        "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<meta name=\"referrer\" content=\"no-referrer\">\n\
         <meta http-equiv=\"refresh\" content=\"0; url={address}\">\n<title>lissom studio</title>\n\
         <a href=\"{address}\">lissom studio</a>\n"
    );
    write_private(&file, text.as_bytes())?;
    Ok(file)
}
