//! Poles and zeros of the linear models of a result.

use lissom::lti::TransferFunction;
use lissom_io::ResultFile;
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};
use num_complex::Complex64;

use crate::bode_plots::function;

/// The maps of motor and tips, each with the name of its file and that of its channel; those are missing whose model is not
/// known.
pub(crate) fn maps(result: &ResultFile) -> Vec<(String, String, LinePlot)> {
    let models = &result.models;
    let motor = models.motor.as_ref();
    let motor = motor.map(|g| ("poles-motor".to_owned(), "motor", function(&g.num, &g.den)));
    let tips = models.tips.iter().enumerate().map(|(i, tip)| {
        (format!("poles-tip-{}", i + 1), tip.name.as_str(), function(&tip.num, &tip.den))
    });
    let all = motor.into_iter().chain(tips);
    all.filter_map(|(file, name, model)| Some((file, name.to_owned(), map(name, &model)?)))
        .collect()
}

fn map(name: &str, model: &TransferFunction) -> Option<LinePlot> {
    let trace = |label: &str, role, roots: Vec<Complex64>| {
        let (re, im) = roots.into_iter().map(|s| (s.re, s.im)).unzip();
        Trace::new(label, role, TraceStyle::Points, re, im)
    };
    let plot = LinePlot::new(
        format!("{name}: poles and zeros"),
        Axis::linear("real part (1/s)"),
        Axis::linear("imaginary part (rad/s)"),
    );
    let plot = plot.trace(trace("poles", Role::Raw, model.poles()?)).trace(trace(
        "zeros",
        Role::Corrected,
        model.zeros()?,
    ));
    plot.traces.iter().any(|trace| !trace.x.is_empty()).then_some(plot)
}
