//! The schemas in `docs/` are those of the types.

use std::path::Path;

#[test]
fn the_schemas_in_the_documents_are_generated_from_the_types() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference/schemas");
    for (name, generated) in lissom_io::schema_files() {
        let committed = std::fs::read_to_string(docs.join(name)).unwrap_or_default();
        assert!(
            committed == generated,
            "docs/src/reference/schemas/{name} is not what the types say: run `cargo xtask schemas`"
        );
    }
}
