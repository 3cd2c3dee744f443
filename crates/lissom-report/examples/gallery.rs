//! Draws a page with each kind of figure, and each figure as a file, into the folder given on the command line.

use std::error::Error;
use std::path::PathBuf;

use lissom_report::{
    Axis, Band, BodePlot, Figure, Finding, FrequencyAxis, KeyFigure, LinePlot, Page, Region, Role,
    Series, Severity, StackedPlot, Style, Trace, TraceStyle,
};
use num_complex::Complex64;

/// Numbers that look like noise.
fn noise(k: usize) -> f64 {
    0.06 * (12.9898 * k as f64).sin()
}

fn grid(count: u32) -> Vec<f64> {
    (0..count).map(|k| 10f64.powf(2.1 * f64::from(k) / f64::from(count - 1))).collect()
}

fn motor(w: f64) -> Complex64 {
    let s = Complex64::new(0.0, w);
    let mode = |w0: f64, z: f64| s * s / (w0 * w0) + s * (2.0 * z / w0) + 1.0;
    200.0 * mode(7.0, 0.01) * mode(48.0, 0.01)
        / (s * (s + 2.0) * mode(13.0, 0.01) * mode(71.0, 0.015))
}

fn bode() -> BodePlot {
    let (dense, sparse) = (grid(800), grid(34));
    let truth = dense.iter().map(|w| motor(*w)).collect();
    let fitted = dense.iter().map(|w| motor(w * 1.01)).collect();
    let wrong = |k| Complex64::new(1.0 + noise(k), noise(k + 7));
    let corrected: Vec<_> = sparse.iter().enumerate().map(|(k, w)| motor(*w) * wrong(k)).collect();
    let friction = |w: f64| Complex64::new(0.02, 0.1) / w.sqrt();
    let raw = sparse.iter().zip(&corrected).map(|(w, h)| h / (h * friction(*w) + 1.0)).collect();
    let std = corrected.iter().map(|h| 0.08 * h.norm() + 0.01).collect();
    let flags = (0..sparse.len()).map(|k| k == 3 || k == 16).collect();
    let measured =
        Series::new("corrected", Role::Corrected, Style::PointsWithBars, sparse.clone(), corrected);
    BodePlot::new("Motor angle per current", "rad/A")
        .subtitle("34 runs of a stepped sine; bars show one standard error")
        .frequency_axis(FrequencyAxis::Both)
        .series(Series::new("raw", Role::Raw, Style::Points, sparse, raw))
        .series(measured.with_std(std).with_flags(flags))
        .series(Series::new("fitted", Role::Fitted, Style::Line, dense.clone(), fitted))
        .series(Series::new("truth", Role::Truth, Style::Line, dense, truth))
}

fn friction() -> LinePlot {
    let omega = grid(34);
    let estimates = (0..34).map(|k| 0.132 + 0.03 * noise(k)).collect();
    let pairs = Trace::points_with_bars(
        "third harmonic",
        Role::Corrected,
        omega,
        estimates,
        vec![0.0012; 34],
    );
    let mean = Band::new("mean and 95 % interval", Role::Other(2), 0.132, (0.1312, 0.1328));
    LinePlot::new(
        "Coulomb friction by frequency",
        Axis::log("Frequency (rad/s)"),
        Axis::linear("Coulomb friction (A)"),
    )
    .band(mean)
    .trace(pairs)
}

fn run() -> LinePlot {
    let time: Vec<f64> = (0..40_000).map(|k| 1e-4 * f64::from(k)).collect();
    let angle = time.iter().map(|t| 0.4 * (6.0 * t).sin() + 0.01 * (311.0 * t).sin()).collect();
    let held: Vec<f64> = (0..=40).map(|k| 0.1 * f64::from(k)).collect();
    let command = held.iter().map(|t| 0.5 * (6.0 * t).sin()).collect();
    LinePlot::new("Run 7", Axis::linear("Time (s)"), Axis::linear("Angle (rad)"))
        .trace(Trace::line("measured", Role::Corrected, time, angle))
        .trace(Trace::new("command", Role::Raw, TraceStyle::Steps, held, command))
}

fn residual() -> LinePlot {
    let index: Vec<f64> = (1..=12).map(f64::from).collect();
    let size = index.iter().map(|k| 3e-5 * (1.3 * k).sin()).collect();
    let mut columns = Trace::new("residual", Role::Other(1), TraceStyle::Columns, index, size);
    columns.std = Some(vec![5e-6; 12]);
    LinePlot::new("Residual torque by run", Axis::linear("Run"), Axis::linear("Torque (N·m)"))
        .trace(columns)
}

fn stacked() -> StackedPlot {
    let time: Vec<f64> = (0..600).map(|k| 0.01 * f64::from(k)).collect();
    let angle = time.iter().map(|t| 0.4 * (2.0 * t).sin()).collect();
    let velocity = time.iter().map(|t| 0.8 * (2.0 * t).cos()).collect();
    let panel = |label: &str, axis: &str, role: Role, y: Vec<f64>| {
        LinePlot::new("", Axis::linear("Time (s)"), Axis::linear(axis))
            .trace(Trace::line(label, role, time.clone(), y))
            .region(Region::new("backward", Role::Other(1), (0.785, 2.356)))
    };
    StackedPlot::new("Angle and velocity")
        .plot(panel("angle", "Angle (rad)", Role::Corrected, angle))
        .plot(panel("velocity", "Velocity (rad/s)", Role::Raw, velocity))
}

fn key_figures() -> Vec<KeyFigure> {
    let estimate = |name: &str, value: f64, std: f64, unit: &str| KeyFigure {
        name: name.into(),
        value: Some(value),
        std: Some(std),
        ci95: Some([value - 1.96 * std, value + 1.96 * std]),
        unit: unit.into(),
        ..KeyFigure::default()
    };
    let refused = KeyFigure {
        name: "Viscous friction".into(),
        unit: "N·m·s/rad".into(),
        note: "These data cannot separate it from Coulomb friction.".into(),
        ..KeyFigure::default()
    };
    vec![
        estimate("Coulomb friction", 0.131_97, 4.1e-4, "A"),
        estimate("Motor inertia", 6.247e-4, 1.1e-6, "kg·m²"),
        refused,
    ]
}

fn findings() -> Vec<Finding> {
    let one_amplitude = "One amplitude cannot separate viscous and Coulomb friction.";
    vec![
        Finding::new(
            Severity::Warning,
            "saturated",
            "The current of run 4 is at its limit for 12 percent of the cycle.",
        )
        .hint("Repeat it with half the amplitude."),
        Finding::new(Severity::Refusal, "viscous_unresolved", one_amplitude)
            .hint("Add a run at 5 rad/s."),
        Finding::new(
            Severity::Info,
            "held_current",
            "The current is a command that is held between samples.",
        ),
    ]
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("give a folder")?);
    std::fs::create_dir_all(&folder)?;
    let page = Page::new("Friction and dynamics of a flexible arm")
        .summary("Coulomb friction is 0.1320 A (± 0.0004 A). The corrected response fits a model with two modes.")
        .key_figures("Estimates", &key_figures())
        .heading("Findings")
        .findings(&findings())
        .heading("Figures")
        .figure(&bode(), "The motor before and after the friction correction, with the fitted model.")
        .figure(&friction(), "Each pair of harmonics gives one estimate.")
        .figure(&run(), "The first seconds of a run.")
        .figure(&residual(), "The residual of the model.")
        .figure(&stacked(), "Two quantities over one axis.")
        .details("Raw result", "{\n  \"coulomb_a\": 0.13197\n}")
        .footer("Made by lissom.");
    std::fs::write(folder.join("page.html"), page.to_html())?;
    let figures: [(&str, &dyn Figure); 5] = [
        ("bode", &bode()),
        ("friction", &friction()),
        ("run", &run()),
        ("residual", &residual()),
        ("stacked", &stacked()),
    ];
    for (name, figure) in figures {
        std::fs::write(folder.join(name).with_extension("png"), figure.to_png(2.0)?)?;
        std::fs::write(folder.join(name).with_extension("svg"), figure.to_svg()?)?;
    }
    Ok(())
}
