//! JSON Schemas of the files that this crate writes, generated from their types.

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema};
use serde_json::Value;

use crate::fleet::FleetSummary;
use crate::inspect::InspectionFile;
use crate::limits::CheckFile;
use crate::model::ModelFile;
use crate::planned::PlannedFile;
use crate::result::{
    ComparedFile, EquivalentFile, PayloadFile, ResultFile, ThresholdsFile, ValidationFile,
};
use crate::rig::RigFile;

/// The schemas in `docs/`: file names and texts.
pub fn schema_files() -> Vec<(&'static str, String)> {
    vec![
        ("result.schema.json", text::<ResultFile>("result.json of lissom identify")),
        ("check.schema.json", text::<CheckFile>("Output of lissom check --json")),
        ("inspect.schema.json", text::<InspectionFile>("Output of lissom inspect --json")),
        ("model.schema.json", text::<ModelFile>("model.json of lissom model")),
        ("equivalent.schema.json", text::<EquivalentFile>("Output of lissom equivalent --json")),
        ("compare.schema.json", text::<ComparedFile>("Output of lissom compare --json")),
        (
            "fleet-summary.schema.json",
            text::<FleetSummary>("Output of lissom fleet summary --json"),
        ),
        ("payload.schema.json", text::<PayloadFile>("Output of lissom payload --json")),
        ("planned.schema.json", text::<PlannedFile>("Output of lissom plan --json")),
        ("rig.schema.json", text::<RigFile>("rig.json of lissom rig")),
        ("thresholds.schema.json", text::<ThresholdsFile>("Output of lissom thresholds --json")),
        ("validate.schema.json", text::<ValidationFile>("Output of lissom validate --json")),
    ]
}

fn text<File: JsonSchema>(title: &str) -> String {
    let settings = SchemaSettings::draft2020_12().for_serialize().with_transform(ClosedTables);
    let mut schema = settings.into_generator().into_root_schema_for::<File>();
    schema.insert("title".to_owned(), title.into());
    format!("{:#}\n", schema.to_value())
}

/// Declares that tables have no other keys, and removes details of numbers that a reader of the file does not need.
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
        // Sizes of number types in Rust are not part of the file format.
        schema.remove("format");
        for key in ["description", "title"] {
            if let Some(Value::String(text)) = schema.get_mut(key) {
                // Brackets of units are escaped for rustdoc.
                *text = text.replace('\n', " ").replace("\\[", "[").replace("\\]", "]");
            }
        }
    }
}
