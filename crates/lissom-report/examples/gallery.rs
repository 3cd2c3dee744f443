//! Draws every kind of figure and a page into the folder named on the command line.

use std::error::Error;
use std::path::PathBuf;

use lissom_report::{
    Axis, Band, BodePlot, Cells, Figure, Finding, FrequencyAxis, KeyFigure, LinePlot, Page, Role,
    Series, Severity, Style, Table, Trace, TraceStyle, svg_to_png,
};
use num_complex::Complex64;

fn motor(w: f64) -> Complex64 {
    let s = Complex64::new(0.0, w);
    let mode = |w0: f64, z: f64| s * s / (w0 * w0) + s * (2.0 * z / w0) + 1.0;
    200.0 * mode(7.0, 0.01) * mode(48.0, 0.01)
        / (s * (s + 2.0) * mode(13.0, 0.01) * mode(71.0, 0.015))
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("name a folder")?);
    let dense: Vec<f64> = (0..800).map(|k| 10f64.powf(-0.1 + 2.3 * f64::from(k) / 799.0)).collect();
    let sparse: Vec<f64> = (0..34).map(|k| 10f64.powf(2.1 * f64::from(k) / 33.0)).collect();
    let truth: Vec<Complex64> = dense.iter().map(|w| motor(*w)).collect();
    let fitted: Vec<Complex64> = dense.iter().map(|w| motor(w * 1.01)).collect();
    let noise = |k: usize| 0.06 * (12.9898 * k as f64).sin();
    let corrected: Vec<Complex64> = sparse
        .iter()
        .enumerate()
        .map(|(k, w)| motor(*w) * Complex64::new(1.0 + noise(k), noise(k + 7)))
        .collect();
    let raw = sparse
        .iter()
        .zip(&corrected)
        .map(|(w, h)| h / (h * Complex64::new(0.02, 0.1) / w.sqrt() + 1.0))
        .collect();
    let std = corrected
        .iter()
        .enumerate()
        .map(|(k, h)| h.norm() * (0.05 + 0.1 * noise(k).abs()) + 0.01)
        .collect();
    let flags: Vec<bool> = (0..34).map(|k| k == 3 || k == 16).collect();
    let bode = BodePlot::new("Motor angle per current", "rad/A")
        .subtitle("34 runs of a stepped sine; bars show one standard deviation")
        .frequency_axis(FrequencyAxis::Both)
        .series(Series::new("raw", Role::Raw, Style::Points, sparse.clone(), raw))
        .series(
            Series::new(
                "corrected",
                Role::Corrected,
                Style::PointsWithBars,
                sparse.clone(),
                corrected,
            )
            .with_std(std)
            .with_flags(flags),
        )
        .series(Series::new("fitted", Role::Fitted, Style::Line, dense.clone(), fitted))
        .series(Series::new("truth", Role::Truth, Style::Line, dense, truth));
    let estimates: Vec<f64> = (0..34).map(|k| 0.132 + 0.03 * noise(k)).collect();
    let friction = LinePlot::new(
        "Coulomb friction by frequency",
        Axis::log("frequency (rad/s)"),
        Axis::linear("Coulomb friction (A)"),
    )
    .band(Band::new("mean and 95 % interval", Role::Other(2), 0.132, (0.1312, 0.1328)))
    .trace(Trace::points_with_bars(
        "third harmonic",
        Role::Corrected,
        sparse.clone(),
        estimates,
        vec![0.0012; 34],
    ));
    let time: Vec<f64> = (0..40_000).map(|k| 2e-4 * f64::from(k)).collect();
    let angle = time.iter().map(|t| 0.4 * (6.0 * t).sin() + 0.01 * (311.0 * t).sin()).collect();
    let held: Vec<f64> = (0..81).map(|k| 0.1 * f64::from(k)).collect();
    let command = held.iter().map(|t| 0.5 * (6.0 * t).sin()).collect();
    let trace = LinePlot::new(
        "Run 7",
        Axis::linear("time (s)").range(0.0, 4.0),
        Axis::linear("angle (rad)"),
    )
    .trace(Trace::line("measured", Role::Corrected, time, angle))
    .trace(Trace::new("command", Role::Raw, TraceStyle::Steps, held, command));
    let index: Vec<f64> = (1..=12).map(f64::from).collect();
    let size = index.iter().map(|k| 3e-5 * (1.3 * k).sin()).collect();
    let residual = Trace {
        std: Some(vec![5e-6; 12]),
        ..Trace::new("residual", Role::Other(1), TraceStyle::Columns, index, size)
    };
    let residual =
        LinePlot::new("Residual torque by run", Axis::linear("run"), Axis::linear("torque (N·m)"))
            .trace(residual);

    let figure = |name: &str, value, std, unit: &str, note: &str| {
        let ci95 = Option::zip(value, std).map(|(v, s): (f64, f64)| [v - 1.96 * s, v + 1.96 * s]);
        KeyFigure { name: name.into(), value, std, ci95, unit: unit.into(), note: note.into() }
    };
    let figures = [
        figure("Coulomb friction", Some(0.131_97), Some(0.000_41), "A", ""),
        figure("motor inertia", Some(6.247e-4), Some(1.1e-6), "kg·m²", ""),
        figure(
            "viscous friction",
            None,
            None,
            "N·m·s/rad",
            "not told apart from Coulomb friction by this data",
        ),
    ];
    let findings = [
        Finding::new(Severity::Warning, "saturated", "Run 4 saturates for 12 % of the cycle.")
            .hint("Repeat it with half the amplitude."),
        Finding::new(
            Severity::Refusal,
            "viscous_unresolved",
            "One amplitude cannot separate the terms.",
        )
        .hint("Add a run at 5 rad/s."),
        Finding::new(
            Severity::Info,
            "held_current",
            "The current is a command held between samples.",
        ),
    ];
    let methods = Table::new(
        "Three estimators",
        &[
            ("method", Cells::Text),
            ("Coulomb (A)", Cells::Numbers),
            ("inertia (kg·m²)", Cells::Numbers),
        ],
    )
    .row(["third harmonic", "0.1342", "—"])
    .row(["regression", "0.13197", "6.247×10⁻⁴"])
    .row(["output error", "0.1319", "6.25×10⁻⁴"]);
    let page = Page::new("Friction and dynamics of a single-link flexible arm")
        .summary("Coulomb friction is 0.1320 A (± 0.0004 A). The corrected response fits a model with two modes.")
        .key_figures("Estimated figures", &figures)
        .heading("Findings")
        .findings(&findings)
        .heading("Frequency response")
        .figure(&bode, "Response of the motor before and after the friction correction, with the fitted model.")
        .heading("Friction")
        .figure(&friction, "Each pair of harmonics gives one estimate.")
        .table(&methods)
        .figure(&trace, "The first seconds of a run.")
        .figure(&residual, "What is left.")
        .details("Raw result", "{\n  \"coulomb_a\": 0.13197\n}")
        .footer("lissom 0.1.0");
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join("page.html"), page.to_html())?;
    for (name, svg) in [
        ("bode", bode.to_svg()?),
        ("friction", friction.to_svg()?),
        ("trace", trace.to_svg()?),
        ("residual", residual.to_svg()?),
    ] {
        std::fs::write(folder.join(name).with_extension("svg"), &svg)?;
        std::fs::write(folder.join(name).with_extension("png"), svg_to_png(&svg, 2.0)?)?;
    }
    Ok(())
}
