//! Messages in JSON.

use serde_json::{Map, Value};

use super::topic::Topic;
use crate::collected::{Collected, LeftOut};
use crate::format_error::FormatError;

/// Most places of an array that become channels.
const MOST_PLACES: usize = 256;

const DAMAGED: LeftOut = LeftOut {
    what: "messages that are no JSON objects",
    way_out: "record the topic again if the values matter",
};

/// Reads a message into the columns of its topic.
pub(super) fn read(
    bytes: &[u8],
    log_time_ns: u64,
    topic: &mut Topic,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let Ok(Value::Object(message)) = serde_json::from_slice(bytes) else {
        found.leave_out(&topic.name, &DAMAGED);
        return Ok(());
    };
    object("", &message, topic, found)?;
    topic.complete(log_time_ns, stamp_ns(&message), found)
}

/// The stamp in the header, as ROS 2 or ROS 1 writes it.
fn stamp_ns(message: &Map<String, Value>) -> Option<i64> {
    let stamp = message.get("header").map_or(message.get("stamp"), |header| header.get("stamp"))?;
    let part = |names: [&str; 3]| names.iter().find_map(|name| stamp.get(*name)?.as_i64());
    let sec = part(["sec", "secs", "seconds"])?;
    sec.checked_mul(1_000_000_000)?.checked_add(part(["nanosec", "nsec", "nsecs"])?)
}

fn object(
    path: &str,
    fields: &Map<String, Value>,
    topic: &mut Topic,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let mut names = Vec::new();
    for (name, field) in fields {
        let path = if path.is_empty() { name.clone() } else { format!("{path}/{name}") };
        if let Value::Array(texts) = field
            && (name == "name" || name.ends_with("names"))
        {
            names = texts.iter().filter_map(Value::as_str).collect();
        }
        if path != "header/stamp" && path != "stamp" {
            value(&path, field, &names, topic, found)?;
        }
    }
    Ok(())
}

fn value(
    path: &str,
    of: &Value,
    names: &[&str],
    topic: &mut Topic,
    found: &mut Collected,
) -> Result<(), FormatError> {
    let number = match of {
        Value::Number(number) => number.as_f64().unwrap_or(f64::NAN),
        Value::Bool(truth) => f64::from(u8::from(*truth)),
        Value::Object(fields) => return object(path, fields, topic, found),
        Value::Array(items) if items.len() <= MOST_PLACES => {
            for (k, item) in items.iter().enumerate() {
                let name = names.get(k).filter(|_| names.len() == items.len());
                let label = name.map_or_else(|| (k + 1).to_string(), |name| (*name).to_owned());
                value(&format!("{path}[{label}]"), item, names, topic, found)?;
            }
            return Ok(());
        }
        _ => return Ok(()),
    };
    if let Some(column) = topic.column(path, found)? {
        topic.set(column, number);
    }
    Ok(())
}
