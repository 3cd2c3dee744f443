//! Bode plots of an equivalent arm: the responses, and the fit.

use lissom::identify::{Equivalent, EquivalentData, Response, StdSource};
use lissom_io::UnitNames;
use lissom_report::{BodePlot, FrequencyAxis, Role, Series, Style};
use num_complex::Complex64;

/// Number of points on the line of a model.
const LINE: i32 = 1500;

fn grid(omega_rad_s: &[f64]) -> Vec<f64> {
    let low = omega_rad_s.iter().copied().fold(f64::INFINITY, f64::min);
    let high = omega_rad_s.iter().copied().fold(0.0, f64::max);
    (0..=LINE).map(|k| low * (high / low).powf(f64::from(k) / f64::from(LINE))).collect()
}

fn measured(label: &str, role: Role, omega_rad_s: &[f64], all: &[Response], bars: bool) -> Series {
    let style = if bars { Style::PointsWithBars } else { Style::Points };
    let values = all.iter().map(|r| r.value).collect();
    let series = Series::new(label, role, style, omega_rad_s.to_vec(), values);
    if bars { series.with_std(all.iter().map(|r| r.std).collect()) } else { series }
}

fn with_bars(data: &EquivalentData) -> bool {
    data.std_source != StdSource::FromResidual
}

/// Plot of the points of the beam per motor angle, with the fit.
pub fn points(data: &EquivalentData, found: &Equivalent) -> BodePlot {
    let roles = [Role::Corrected, Role::Raw];
    let role = |i: usize| match roles.get(i) {
        Some(role) => *role,
        None => Role::Other(u8::try_from(i % 100).unwrap_or(0)),
    };
    let mut plot = BodePlot::new("Points of the beam, per motor angle", "")
        .subtitle(format!("lines: a fit with {} common poles", found.fit.poles.len()))
        .frequency_axis(FrequencyAxis::Both);
    let grid = grid(&data.omega_rad_s);
    for (i, name) in data.names.iter().enumerate() {
        let bars = with_bars(data);
        plot = plot.series(measured(name, role(i), &data.omega_rad_s, &data.outputs[i], bars));
    }
    for i in 0..data.names.len() {
        let line: Vec<Complex64> = grid.iter().map(|w| found.fit.response(i, *w)).collect();
        plot = plot.series(Series::new("", role(i), Style::Line, grid.clone(), line));
    }
    plot
}

/// Plot of the motor's response, with that of the equivalent arm; `None` if the motor's response is not given.
pub fn motor(data: &EquivalentData, names: UnitNames, found: &Equivalent) -> Option<BodePlot> {
    let (motor, arm) = (data.motor.as_ref()?, found.arm.as_ref()?);
    let unit = format!("{}/{}", names.angle(), names.command_unit());
    let grid = grid(&motor.omega_rad_s);
    let line = grid.iter().map(|w| arm.motor_response(*w)).collect();
    let bars = with_bars(data);
    let title = format!("Motor: {} per {}", names.motion(), names.command_name());
    Some(
        BodePlot::new(title, unit)
            .frequency_axis(FrequencyAxis::Both)
            .series(measured(
                "friction removed",
                Role::Corrected,
                &motor.omega_rad_s,
                &motor.response,
                bars,
            ))
            .series(Series::new("equivalent arm", Role::Fitted, Style::Line, grid, line)),
    )
}
