//! Times on the command line.

use lissom_io::units::{Dimension, parse_quantity};

/// Parses a time greater than zero; gives seconds.
pub(crate) fn positive_time(text: &str) -> Result<f64, String> {
    let hint = "hint: write a time with its unit, such as \"0.3 s\"";
    match parse_quantity(text, Dimension::TIME) {
        Ok(time_s) if time_s > 0.0 => Ok(time_s),
        Ok(_) => Err(format!("it must be greater than zero\n{hint}")),
        Err(error) => Err(format!("{error}\n{hint}")),
    }
}
