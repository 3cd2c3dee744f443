//! Writes the JSON Schemas of the files, and the pages of the book made of them: `cargo xtask schemas`.

use std::io;
use std::path::Path;

fn main() -> io::Result<()> {
    let reference = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference");
    std::fs::create_dir_all(reference.join("keys"))?;
    for (name, text) in lissom_io::schema_files() {
        std::fs::write(reference.join("schemas").join(name), text)?;
    }
    for (name, text) in lissom_io::schema_pages() {
        std::fs::write(reference.join(name), text)?;
    }
    Ok(())
}
