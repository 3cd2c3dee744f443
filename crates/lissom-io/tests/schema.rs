//! `docs/result.schema.json` names every key that a result has, and a result has every key that it
//! names.
#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

use lissom::identify::{ByDirection, Estimate, Identified, Options, identify};
use lissom::record::{Axis, Campaign, Channels, Command, CommandQuantity, Hold, Tip, TipQuantity};
use lissom::rig::SteppedSine;
use lissom_io::result_json;
use serde_json::{Map, Value};

/// A campaign of three sines with one pair, and one of them as a motion of any shape.
fn campaign() -> Campaign {
    let rig = lissom_testmodels::report_rig(Some(12));
    let sine = |name: &str, omega_rad_s: f64| {
        let drive =
            SteppedSine { omega_rad_s, amplitude_rad: 0.7, settle_s: 120.0, record_s: 20.0 };
        rig.stepped_sine(name, &drive).unwrap()
    };
    let mut runs = vec![sine("low", 3.1), sine("triple", 9.3), sine("fast", 20.0)];
    // The last half turned about: no sinusoid any more.
    let low = runs[0].clone();
    let turned = |x: &[f64]| x.iter().chain(x.iter().rev()).copied().collect::<Vec<f64>>();
    let tips = vec![turned(&low.tips()[0])];
    let (command, motor) = (turned(low.command()), turned(low.motor()));
    runs.push(lissom::record::Run::new("other", low.time(), command, motor, tips).unwrap());
    Campaign::new(channels(Axis::Rotary, CommandQuantity::Current, Some(0.246_759)), runs).unwrap()
}

fn channels(axis: Axis, quantity: CommandQuantity, constant: Option<f64>) -> Channels {
    let command = Command {
        quantity,
        hold: Hold::Sampled,
        torque_per_command: constant,
        back_emf_viscous: 0.0,
        limit: Some(4.12),
    };
    let tip = Tip { name: "tip".to_owned(), quantity: TipQuantity::Angle, calibrated: true };
    Channels { axis, command, tips: vec![tip] }
}

/// Results of every axis and command, with every figure that may be absent.
fn results() -> Vec<Value> {
    let mut id = identify(&campaign(), &Options::default(), |_| ()).unwrap();
    let mut results = Vec::new();
    for axis in [Axis::Rotary, Axis::Linear] {
        for quantity in
            [CommandQuantity::Current, CommandQuantity::Voltage, CommandQuantity::Arbitrary]
        {
            for constant in [None, Some(0.246_759)] {
                id.torque_per_command = constant;
                results.push(result_json(&channels(axis, quantity, constant), &id));
                let split = with_directions(id.clone());
                results.push(result_json(&channels(axis, quantity, constant), &split));
            }
        }
    }
    results
}

fn with_directions(mut id: Identified) -> Identified {
    let figure = Estimate { value: 1.0, std: 0.1 };
    id.friction.viscous_by_direction = Some((figure, figure));
    if let Some(regression) = &mut id.regression {
        regression.viscous_by_direction = Some(ByDirection {
            forward: figure,
            backward: figure,
            mean: figure,
            offset: figure,
            relative_residual: 0.1,
        });
    }
    id
}

fn schema() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/result.schema.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn a_result_and_its_schema_name_the_same_keys() {
    let schema = schema();
    let mut check =
        Check { root: &schema, met: BTreeSet::new(), named: BTreeSet::new(), wrong: Vec::new() };
    for result in results() {
        check.value(&schema, &result, "result");
    }
    assert!(check.wrong.is_empty(), "{:#?}", check.wrong);
    let never: Vec<_> = check.named.difference(&check.met).collect();
    assert!(never.is_empty(), "no result has {never:#?}");
    // What may be null is not: its keys were looked at too.
    for key in [
        "methods.third_harmonic.fit.weighted_rms",
        "methods.regression.beam.modes",
        "methods.regression.viscous_by_direction.relative_residual",
        "models.motor.den",
        "models.state_space.outputs",
        "runs[].stuck_share",
        "findings[].code",
    ] {
        assert!(check.met.contains(&format!("result.{key}")), "no result has {key}");
    }
}

#[test]
fn patterns_are_read_as_they_are_meant() {
    assert_eq!(expand("^a_(b|c_(d|e)|f)_g$"), ["a_b_g", "a_c_d_g", "a_c_e_g", "a_f_g"]);
}

/// As much of JSON Schema as the file uses.
struct Check<'a> {
    root: &'a Value,
    /// Keys and patterns of the schema that a result had, with the object they belong to.
    met: BTreeSet<String>,
    /// All those of the objects that were met.
    named: BTreeSet<String>,
    wrong: Vec<String>,
}

impl Check<'_> {
    fn value(&mut self, schema: &Value, value: &Value, at: &str) {
        if let Some(reference) = schema["$ref"].as_str() {
            let target = self.root.pointer(reference.trim_start_matches('#')).unwrap().clone();
            self.value(&target, value, at);
        }
        if let Some(options) = schema["anyOf"].as_array() {
            let fits = options.iter().find(|o| value.is_null() == (o["type"] == "null"));
            match fits {
                Some(option) => self.value(option, value, at),
                None => self.wrong.push(format!("{at} fits nothing")),
            }
        }
        if let Some(choices) = schema["enum"].as_array()
            && !choices.contains(value)
        {
            self.wrong.push(format!("{at} is {value}"));
        }
        if !schema["type"].is_null() && !has_type(&schema["type"], value) {
            self.wrong.push(format!("{at} is {value} and not {}", schema["type"]));
        }
        if let Some(items) = value.as_array() {
            for item in items {
                self.value(&schema["items"], item, &format!("{at}[]"));
            }
        }
        if let Some(object) = value.as_object()
            && schema["type"] == "object"
        {
            self.object(schema, object, at);
        }
    }

    fn object(&mut self, schema: &Value, object: &Map<String, Value>, at: &str) {
        let none = Map::new();
        let properties = schema["properties"].as_object().unwrap_or(&none);
        let patterns = schema["patternProperties"].as_object().unwrap_or(&none);
        self.named.extend(properties.keys().chain(patterns.keys()).map(|k| format!("{at}.{k}")));
        for required in schema["required"].as_array().into_iter().flatten() {
            if !object.contains_key(required.as_str().unwrap()) {
                self.wrong.push(format!("{at} has no {required}"));
            }
        }
        let limit = |key: &str| schema[key].as_u64().map(|n| usize::try_from(n).unwrap());
        if limit("minProperties").is_some_and(|n| object.len() < n)
            || limit("maxProperties").is_some_and(|n| object.len() > n)
        {
            self.wrong.push(format!("{at} has {} keys", object.len()));
        }
        for (key, value) in object {
            let by_pattern = || patterns.iter().find(|(pattern, _)| expand(pattern).contains(key));
            match properties.get_key_value(key).or_else(by_pattern) {
                Some((name, schema)) => {
                    self.met.insert(format!("{at}.{name}"));
                    self.value(schema, value, &format!("{at}.{name}"));
                }
                None => self.wrong.push(format!("{at}.{key} is not in the schema")),
            }
        }
    }
}

fn has_type(wanted: &Value, value: &Value) -> bool {
    if let Some(several) = wanted.as_array() {
        return several.iter().any(|one| has_type(one, value));
    }
    match wanted.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        _ => false,
    }
}

/// All texts that a pattern of literals and groups of choices, `^a_(b|c)$`, stands for.
fn expand(pattern: &str) -> Vec<String> {
    let text = pattern.trim_start_matches('^').trim_end_matches('$');
    let Some(open) = text.find('(') else { return vec![text.to_owned()] };
    let mut depth = 0;
    let mut cuts = vec![open];
    for (at, c) in text.char_indices().skip(open) {
        depth += i32::from(c == '(') - i32::from(c == ')');
        if c == '|' && depth == 1 || c == ')' && depth == 0 {
            cuts.push(at);
        }
        if depth == 0 {
            break;
        }
    }
    let rest = expand(&text[cuts[cuts.len() - 1] + 1..]);
    let choices = cuts.windows(2).flat_map(|cut| expand(&text[cut[0] + 1..cut[1]]));
    let joined = |choice: String| {
        rest.iter().map(|end| format!("{}{choice}{end}", &text[..open])).collect::<Vec<_>>()
    };
    choices.flat_map(joined).collect()
}
