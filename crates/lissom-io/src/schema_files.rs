//! JSON Schemas of the files that this crate writes, generated from their types.

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema};
use serde_json::Value;

use crate::model::ModelFile;
use crate::planned::PlannedFile;
use crate::result::{
    ComparedFile, EquivalentFile, PayloadFile, ResultFile, ThresholdsFile, ValidationFile,
};
use crate::rig::RigFile;

/// File names of the schemas in `docs/`, and their text.
pub fn schema_files() -> Vec<(&'static str, String)> {
    vec![
        ("result.schema.json", text::<ResultFile>("result.json of lissom identify")),
        ("model.schema.json", text::<ModelFile>("model.json of lissom model")),
        (
            "equivalent.schema.json",
            text::<EquivalentFile>("What lissom equivalent writes with --json"),
        ),
        ("compare.schema.json", text::<ComparedFile>("What lissom compare writes with --json")),
        ("payload.schema.json", text::<PayloadFile>("What lissom payload writes with --json")),
        ("planned.schema.json", text::<PlannedFile>("What lissom plan writes with --json")),
        ("rig.schema.json", text::<RigFile>("rig.json of lissom rig")),
        (
            "thresholds.schema.json",
            text::<ThresholdsFile>("What lissom thresholds writes with --json"),
        ),
        ("validate.schema.json", text::<ValidationFile>("What lissom validate writes with --json")),
    ]
}

fn text<File: JsonSchema>(title: &str) -> String {
    let settings = SchemaSettings::draft2020_12().for_serialize().with_transform(ClosedTables);
    let mut schema = settings.into_generator().into_root_schema_for::<File>();
    schema.insert("title".to_owned(), title.into());
    format!("{:#}\n", schema.to_value())
}

/// Says of every table that it has no other keys, and of every number only what a reader of the file needs.
#[derive(Debug, Clone)]
struct ClosedTables;

impl Transform for ClosedTables {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let table =
            ["properties", "patternProperties"].into_iter().any(|key| schema.get(key).is_some());
        if table {
            schema.insert("additionalProperties".to_owned(), false.into());
        }
        // Sizes of Rust's numbers say nothing about a file.
        schema.remove("format");
        for key in ["description", "title"] {
            if let Some(Value::String(text)) = schema.get_mut(key) {
                *text = text.replace('\n', " ");
            }
        }
    }
}
