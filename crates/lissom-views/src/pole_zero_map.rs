//! Poles and zeros of the linear models of a result.

use lissom::identify::NORMAL_95;
use lissom::lti::{CoefficientCovariance, RootError, TransferFunction};
use lissom_io::ResultFile;
use lissom_report::{Axis, LinePlot, Role, Trace};
use num_complex::Complex64;

use crate::bode_plots::{function, motor_model};

/// The maps of motor and tips, each with the name of its file and that of its channel; those are missing whose model is not
/// known.
pub(crate) fn maps(result: &ResultFile) -> Vec<(String, String, LinePlot)> {
    let models = &result.models;
    let motor = motor_model(result);
    let motor = motor.map(|g| {
        let covariance = models.motor_covariance.as_ref();
        ("poles-motor".to_owned(), "motor", function(&g.num, &g.den), covariance)
    });
    let tips = models.tips.iter().enumerate().map(|(i, tip)| {
        let model = function(&tip.num, &tip.den);
        (format!("poles-tip-{}", i + 1), tip.name.as_str(), model, tip.covariance.as_ref())
    });
    let map = |(file, name, model, covariance): (_, &str, _, Option<&Vec<_>>)| {
        let covariance = covariance.and_then(|rows| CoefficientCovariance::of_rows(rows));
        Some((file, name.to_owned(), map(name, &model, covariance.as_ref())?))
    };
    motor.into_iter().chain(tips).filter_map(map).collect()
}

fn map(
    name: &str,
    model: &TransferFunction,
    covariance: Option<&CoefficientCovariance>,
) -> Option<LinePlot> {
    type ErrorOf = fn(&CoefficientCovariance, &TransferFunction, Complex64) -> Option<RootError>;
    let trace = |label: &str, role, roots: Vec<Complex64>, of: ErrorOf| {
        let error = |root: &Complex64| of(covariance?, model, *root);
        let errors: Vec<_> = roots.iter().map(error).collect();
        // A root that is not single has no bar.
        let bars = |part: fn(&RootError) -> f64| {
            errors.iter().map(|e| e.as_ref().map_or(0.0, part) * NORMAL_95).collect()
        };
        let (re, im) = roots.into_iter().map(|s| (s.re, s.im)).unzip();
        Trace::points_with_bars(label, role, re, im, bars(|e| e.imaginary_rad_s))
            .with_x_std(bars(|e| e.real_per_s))
    };
    let plot = LinePlot::new(
        format!("{name}: poles and zeros"),
        Axis::linear("real part (1/s)"),
        Axis::linear("imaginary part (rad/s)"),
    );
    let plot = plot
        .trace(trace("poles", Role::Pole, model.poles()?, CoefficientCovariance::of_pole))
        .trace(trace("zeros", Role::Zero, model.zeros()?, CoefficientCovariance::of_zero));
    let plot = match covariance {
        Some(_) => plot.subtitle("bars: 95 % interval"),
        None => plot,
    };
    plot.traces.iter().any(|trace| !trace.x.is_empty()).then_some(plot)
}
