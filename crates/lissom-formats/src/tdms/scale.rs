//! Scales of TDMS channels: how raw values become values in the channel's unit.

use std::collections::HashMap;

use super::metadata::Property;

/// Scales in the order in which they are applied, or the type of one that is unknown.
pub(super) type Scales = Result<Vec<Scale>, String>;

/// The input of a scale that takes the raw values.
const RAW_VALUES: f64 = 4_294_967_295.0;
/// Most scales of a channel, and most coefficients of a polynomial.
const MOST: usize = 64;
/// Number of coefficients, if it is not stated.
const USUAL_COEFFICIENTS: f64 = 4.0;

/// A scale: a polynomial with the constant first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    coefficients: Vec<f64>,
}

impl Scale {
    pub(super) fn apply(&self, values: &mut [f64]) {
        let polynomial = |x: f64| self.coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
        for value in values {
            *value = polynomial(*value);
        }
    }
}

/// The scales that properties state; `None` if there are none, or if they are applied already.
pub(super) fn of(properties: &HashMap<String, Property>) -> Option<Scales> {
    let text = |key: &str| match properties.get(key) {
        Some(Property::Text(text)) => Some(text.as_str()),
        _ => None,
    };
    let number = |key: &str| properties.get(key).and_then(Property::number);
    if text("NI_Scaling_Status") == Some("scaled") {
        return None;
    }
    let count = match number("NI_Number_Of_Scales") {
        Some(count) => count as usize,
        None => (0..MOST).rev().find(|k| text(&format!("NI_Scale[{k}]_Scale_Type")).is_some())? + 1,
    };
    if count == 0 || count > MOST {
        return None;
    }
    // From the last scale back to the raw values.
    let mut scales = Vec::new();
    let mut place = count - 1;
    for _ in 0..count {
        // A scale without a type is that of a scaler of NI-DAQmx: its values are the raw values.
        let Some(kind) = text(&format!("NI_Scale[{place}]_Scale_Type")) else {
            scales.reverse();
            return Some(Ok(scales));
        };
        let key = |end: &str| format!("NI_Scale[{place}]_{kind}_{end}");
        let coefficients = match kind {
            "Linear" => [number(&key("Y_Intercept")), number(&key("Slope"))].into_iter().collect(),
            "Polynomial" => {
                let size = number(&key("Coefficients_Size")).unwrap_or(USUAL_COEFFICIENTS);
                let size = (size as usize).min(MOST);
                (0..size).map(|k| number(&key(&format!("Coefficients[{k}]")))).collect()
            }
            "AdvancedAPI" => Some(vec![0.0, 1.0]),
            _ => None,
        };
        let Some(coefficients) = coefficients else { return Some(Err(kind.to_owned())) };
        scales.push(Scale { coefficients });
        let input = number(&key("Input_Source")).unwrap_or(RAW_VALUES);
        if input >= MOST as f64 {
            scales.reverse();
            return Some(Ok(scales));
        }
        place = input as usize;
    }
    Some(Err("in a circle".to_owned()))
}
