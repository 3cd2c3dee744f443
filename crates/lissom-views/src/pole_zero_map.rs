//! Poles and zeros of the linear models of a result.

use lissom::identify::Identified;
use lissom::lti::TransferFunction;
use lissom::record::Channels;
use lissom_report::{Axis, LinePlot, Role, Trace, TraceStyle};
use num_complex::Complex64;

/// The maps of motor and tips, each with its name; those are missing whose model is not known.
pub(crate) fn maps(channels: &Channels, id: &Identified) -> Vec<(String, LinePlot)> {
    let motor = id.models.motor.as_ref().map(|model| ("motor", model));
    let tips = channels.tips.iter().zip(&id.models.tips);
    let tips = tips.map(|(tip, model)| (tip.name.as_str(), &model.function));
    let all = motor.into_iter().chain(tips);
    all.filter_map(|(name, model)| Some((name.to_owned(), map(name, model)?))).collect()
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
