//! Writes the JSON Schemas of the files into `docs/`: `cargo xtask schemas`.

use std::io;
use std::path::Path;

fn main() -> io::Result<()> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference/schemas");
    for (name, text) in lissom_io::schema_files() {
        std::fs::write(docs.join(name), text)?;
    }
    Ok(())
}
