//! The schemas in the documents, and the pages made of them, are those of the types.

use std::path::Path;

#[test]
fn the_schemas_and_their_pages_are_generated_from_the_types() {
    let reference = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference");
    let schemas = lissom_io::schema_files().into_iter();
    let schemas = schemas.map(|(name, text)| (format!("schemas/{name}"), text));
    for (name, generated) in schemas.chain(lissom_io::schema_pages()) {
        let committed = std::fs::read_to_string(reference.join(&name)).unwrap_or_default();
        assert!(
            committed == generated,
            "docs/src/reference/{name} is not what the types say: run `cargo xtask schemas`"
        );
    }
}
