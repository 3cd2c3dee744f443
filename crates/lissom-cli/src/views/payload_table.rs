//! Table of a prediction with other payloads.

use lissom_io::PayloadPrediction;
use lissom_report::{interval, with_uncertainty};
use lissom_views::digits::trimmed;
use lissom_views::payload_plot::MASS_DIGITS;

use super::printer;

pub(crate) fn table(found: &PayloadPrediction) {
    let at = found.distance_m.map_or_else(String::new, |r| format!(", {r:.4} m from the axis"));
    printer::line(&format!(
        "{}: identified with {} kg{at}",
        found.tip,
        trimmed(found.mass_kg, MASS_DIGITS)
    ));
    for payload in &found.payloads {
        let mass = trimmed(payload.mass_kg, MASS_DIGITS);
        printer::line(&format!("\nwith {mass} kg, motor clamped:"));
        printer::line("                          value             95 % interval");
        for (k, mode) in payload.loaded.modes.iter().enumerate() {
            let (f, ratio) = (mode.natural_frequency_rad_s, mode.damping_ratio);
            for (name, e) in [("frequency", f), ("damping ratio", ratio)] {
                let unit = if name == "frequency" { " rad/s" } else { "" };
                printer::line(&format!(
                    "  {:<20} {:>18}{unit:<6}  {}",
                    format!("{name} {}", k + 1),
                    with_uncertainty(e.value, e.std),
                    interval(e.ci95(), e.value, e.std),
                ));
            }
        }
    }
}
