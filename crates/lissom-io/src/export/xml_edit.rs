//! Changes of attributes in an XML text; all other characters stay as they are.

use roxmltree::{Document, Node};

use super::export_error::ExportError;
use super::number_text::plain;

/// A joint in an XML text.
pub(super) struct Joint<'a, 'input> {
    pub(super) node: Node<'a, 'input>,
}

/// Reads a text.
pub(super) fn parsed<'t>(file: &str, text: &'t str) -> Result<Document<'t>, ExportError> {
    Document::parse(text)
        .map_err(|error| ExportError::Xml { file: file.to_owned(), reason: error.to_string() })
}

/// The joint of this name.
pub(super) fn joint<'a, 'input>(
    file: &str,
    document: &'a Document<'input>,
    name: &str,
) -> Result<Joint<'a, 'input>, ExportError> {
    // Elements of defaults and of actuators have no name, or another meaning.
    let joints = || {
        document.descendants().filter(|n| n.has_tag_name("joint")).filter(|n| {
            !n.ancestors().any(|a| {
                ["default", "tendon", "actuator", "equality", "sensor", "transmission", "gazebo"]
                    .iter()
                    .any(|t| a.has_tag_name(*t))
            })
        })
    };
    let mut found = joints().filter(|n| n.attribute("name") == Some(name));
    let (file, joint) = (file.to_owned(), name.to_owned());
    match (found.next(), found.next()) {
        (Some(node), None) => Ok(Joint { node }),
        (Some(_), Some(_)) => Err(ExportError::Several { file, joint }),
        (None, _) => {
            let joints = joints().filter_map(|n| n.attribute("name")).map(str::to_owned).collect();
            Err(ExportError::NoJoint { file, joint, joints })
        }
    }
}

/// The text with these attributes of an element set.
pub(super) fn with_attributes(text: &str, node: Node<'_, '_>, set: &[(&str, String)]) -> String {
    let mut edits: Vec<(std::ops::Range<usize>, String)> = Vec::new();
    let mut new = String::new();
    for (name, value) in set {
        match node.attribute_node(*name) {
            Some(attribute) => edits.push((attribute.range(), format!("{name}=\"{value}\""))),
            None => new.push_str(&format_attribute(name, value)),
        }
    }
    if !new.is_empty() {
        let at = after_name(text, node);
        edits.push((at..at, new));
    }
    edited(text, edits)
}

fn format_attribute(name: &str, value: &str) -> String {
    format!(" {name}=\"{value}\"")
}

/// The text with a comment at a place.
pub(super) fn with_comment(text: &str, at: usize, lines: &[String]) -> String {
    let comment = format!("<!-- {} -->\n", plain(&lines.join(" ")));
    edited(text, vec![(at..at, comment)])
}

/// Refuses a joint of another type than the axis.
pub(super) fn of_type(
    file: &str,
    found: &Joint<'_, '_>,
    missing: &'static str,
    allowed: &[&'static str],
) -> Result<(), ExportError> {
    let kind = found.node.attribute("type").unwrap_or(missing);
    if allowed.contains(&kind) {
        return Ok(());
    }
    Err(ExportError::JointType {
        file: file.to_owned(),
        joint: found.node.attribute("name").unwrap_or_default().to_owned(),
        kind: kind.to_owned(),
        allowed: allowed.join(" or "),
    })
}

/// The place after the name of an element in its start tag.
fn after_name(text: &str, node: Node<'_, '_>) -> usize {
    let start = node.range().start + 1;
    let name = text[start..].find(|c: char| c.is_whitespace() || c == '/' || c == '>');
    start + name.unwrap_or(0)
}

/// The text with a child as the last one of an element.
pub(super) fn with_child(text: &str, node: Node<'_, '_>, child: &str) -> String {
    let range = node.range();
    let whole = &text[range.clone()];
    if let Some(bare) = whole.strip_suffix("/>") {
        let name = node.tag_name().name();
        let replaced = format!("{}>\n  {child}\n</{name}>", bare.trim_end());
        return edited(text, vec![(range, replaced)]);
    }
    let end = range.start + whole.rfind("</").unwrap_or(whole.len());
    edited(text, vec![(end..end, format!("  {child}\n"))])
}

fn edited(text: &str, mut edits: Vec<(std::ops::Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    let mut text = text.to_owned();
    for (range, new) in edits {
        text.replace_range(range, &new);
    }
    text
}
