//! What line and model leave of torque that was not used for their fit, in words.

use lissom_io::ResultFile;

/// One sentence; `None` if the result does not say it.
pub fn unused_torque_words(result: &ResultFile) -> Option<String> {
    let unused = result.unused_torque.as_ref()?;
    let [line, model] = [unused.line, unused.model].map(|share| format!("{:.2} %", 100.0 * share));
    let remains = if line == model {
        format!("{model} remains")
    } else {
        format!("Coulomb and viscous friction leave {line}, this model {model}")
    };
    Some(format!("torque in slip phases that were left out of the fit: {remains}"))
}
