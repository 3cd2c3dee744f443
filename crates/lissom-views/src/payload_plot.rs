//! Plot of the tip's response with each payload.

use lissom::identify::Response;
use lissom_io::{PayloadPrediction, PredictedPayload};
use lissom_report::{BodePlot, FrequencyAxis, Role, Series, Style};

use crate::digits::trimmed;

/// Largest number of digits of a mass.
pub const MASS_DIGITS: usize = 6;

/// The Bode plot, with one line for each payload.
pub fn tip(found: &PayloadPrediction) -> BodePlot {
    let title = format!("{}, per motor angle", found.tip);
    let plot = BodePlot::new(title, "")
        .subtitle(format!(
            "identified with {} kg, predicted with others",
            trimmed(found.mass_kg, MASS_DIGITS)
        ))
        .frequency_axis(FrequencyAxis::Both);
    found.payloads.iter().enumerate().fold(plot, |plot, (i, payload)| {
        plot.series(line(
            &found.omega_rad_s,
            payload,
            Role::Other(u8::try_from(i % 100).unwrap_or(0)),
        ))
    })
}

fn line(omega_rad_s: &[f64], payload: &PredictedPayload, role: Role) -> Series {
    let values = payload.tip.iter().map(|r: &Response| r.value).collect();
    let name = format!("{} kg", trimmed(payload.mass_kg, MASS_DIGITS));
    Series::new(name, role, Style::Line, omega_rad_s.to_vec(), values)
}
