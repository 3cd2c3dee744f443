//! Bode plots of a result.

use lissom::identify::{Identified, Response};
use lissom::record::{Channels, TipQuantity};
use lissom_io::UnitNames;
use lissom_report::{BodePlot, Role, Series, Style};
use num_complex::Complex64;

use crate::known_arm::Reference;

/// Number of points on the line of a model.
const LINE: i32 = 1200;

/// The plots of motor and tips, each with its file name. `reference` adds a line for a known arm.
pub fn bode_plots(
    channels: &Channels,
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Vec<(String, BodePlot)> {
    if id.responses.is_empty() {
        return Vec::new();
    }
    let mut plots = vec![("bode-motor".to_owned(), motor(names, id, reference))];
    for (i, tip) in channels.tips.iter().enumerate() {
        if id.responses.iter().any(|p| p.tips.get(i).is_some_and(Option::is_some)) {
            let file = format!("bode-tip-{}", i + 1);
            plots.push((file, tip_plot(i, &tip.name, tip.quantity, id, reference)));
        }
    }
    plots
}

fn motor(names: UnitNames, id: &Identified, reference: Option<&Reference>) -> BodePlot {
    let points = &id.responses;
    let omega: Vec<f64> = points.iter().map(|p| p.omega_rad_s).collect();
    let unit = format!("{}/{}", names.angle(), names.command_unit());
    let title = format!("Motor: {} per {}", names.motion(), names.command_name());
    let raw: Vec<Complex64> = points.iter().map(|p| p.motor_raw.value).collect();
    let mut plot = BodePlot::new(title, unit).series(Series::new(
        "as measured",
        Role::Raw,
        Style::Points,
        omega,
        raw,
    ));
    let sound: Vec<(f64, Response, bool)> = points
        .iter()
        .filter_map(|p| Some((p.omega_rad_s, p.motor_corrected?, p.flagged)))
        .collect();
    if !sound.is_empty() {
        let flagged = sound.iter().any(|p| p.2);
        let note = if flagged { "flagged: a finding affects the point; " } else { "" };
        plot = plot.subtitle(format!("{note}bars: one standard error"));
        let series = Series::new(
            "friction removed",
            Role::Corrected,
            Style::PointsWithBars,
            sound.iter().map(|p| p.0).collect(),
            sound.iter().map(|p| p.1.value).collect(),
        );
        plot = plot.series(
            series
                .with_std(sound.iter().map(|p| p.1.std).collect())
                .with_flags(sound.iter().map(|p| p.2).collect()),
        );
    }
    let grid = grid(id);
    let response: Option<Vec<Complex64>> =
        grid.iter().map(|w| id.models.motor_response(*w)).collect();
    if let Some(response) = response {
        let fitted = Series::new("fitted model", Role::Fitted, Style::Line, grid.clone(), response);
        plot = plot.series(fitted);
    }
    if let Some((label, arm)) = reference.and_then(|r| Some((r.label, r.arm.as_ref()?))) {
        let exact: Vec<(f64, Complex64)> =
            grid.iter().map(|w| (*w, arm.motor_response(*w))).collect();
        plot = plot.series(known(label, &exact));
    }
    plot
}

fn tip_plot(
    i: usize,
    name: &str,
    quantity: TipQuantity,
    id: &Identified,
    reference: Option<&Reference>,
) -> BodePlot {
    let what = match quantity {
        TipQuantity::Angle => "angle",
        TipQuantity::Deflection => "deflection",
        TipQuantity::Acceleration => "acceleration",
    };
    let points: Vec<(f64, Response)> = id
        .responses
        .iter()
        .filter_map(|p| Some((p.omega_rad_s, p.tips.get(i).copied().flatten()?)))
        .collect();
    let measured = Series::new(
        "as measured",
        Role::Corrected,
        Style::PointsWithBars,
        points.iter().map(|p| p.0).collect(),
        points.iter().map(|p| p.1.value).collect(),
    )
    .with_std(points.iter().map(|p| p.1.std).collect());
    let mut plot =
        BodePlot::new(format!("Beam: {what} of {name} per motor angle"), "").series(measured);
    let grid = grid(id);
    let response: Option<Vec<Complex64>> =
        grid.iter().map(|w| id.models.tip_response(i, *w)).collect();
    // The model of a calibrated deflection is that of its angle.
    if let Some(response) = response.filter(|_| quantity != TipQuantity::Deflection) {
        let fitted = Series::new("fitted model", Role::Fitted, Style::Line, grid.clone(), response);
        plot = plot.series(fitted);
    }
    let known_arm = reference.and_then(|r| Some((r.label, r.arm.as_ref()?)));
    if let Some((label, arm)) = known_arm.filter(|_| quantity == TipQuantity::Angle) {
        let exact: Vec<(f64, Complex64)> =
            grid.iter().filter_map(|w| Some((*w, arm.tip_response(*w).get(i).copied()?))).collect();
        plot = plot.series(known(label, &exact));
    }
    plot
}

/// Frequencies of a model's line, over the range of the data.
fn grid(id: &Identified) -> Vec<f64> {
    let low = id.responses.iter().map(|p| p.omega_rad_s).fold(f64::INFINITY, f64::min);
    let high = id.responses.iter().map(|p| p.omega_rad_s).fold(0.0, f64::max);
    let (low, high) = (low / 1.1, high * 1.1);
    (0..=LINE).map(|k| low * (high / low).powf(f64::from(k) / f64::from(LINE))).collect()
}

fn known(label: &str, exact: &[(f64, Complex64)]) -> Series {
    let (omega, response) = exact.iter().copied().unzip();
    Series::new(label, Role::Truth, Style::Line, omega, response)
}
