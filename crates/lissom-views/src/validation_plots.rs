//! Plots of a validation.

use lissom::identify::{ChannelResidual, LogPrediction, PredictedStretch, TorqueRun, Validation};
use lissom::record::Campaign;
use lissom_io::{UnitNames, channel_name_unit};
use lissom_report::{Axis, Band, LinePlot, Role, Trace, TraceStyle};

use crate::named_figure::NamedFigure;

/// Plots of torque, motion, residuals and correlations for the run with the largest residual, each with its name: `torque`, `motion-motor` and others.
pub fn validation_plots(campaign: &Campaign, validation: &Validation) -> Vec<NamedFigure> {
    let names = UnitNames::new(&campaign.channels);
    let mut plots = Vec::new();
    let mut add = |name: String, plot: LinePlot| plots.push(NamedFigure::new(name, plot));
    if let Some(run) = validation.torque.as_ref().and_then(|t| worst(&t.runs)) {
        let name = campaign.runs[run.run].name();
        add("torque".to_owned(), torque(names, name, run));
        add("torque-residual".to_owned(), torque_residual(names, name, run));
    }
    for (c, residual) in validation.residuals.iter().enumerate() {
        let file = if c == 0 { "motor".to_owned() } else { format!("tip-{c}") };
        if let Some(run) = worst_motion(campaign, validation, c) {
            let [motion, left] = motion(campaign, validation, run, c);
            add(format!("motion-{file}"), motion);
            add(format!("residual-{file}"), left);
        }
        let (name, _) = channel_name_unit(&campaign.channels, c);
        add(format!("autocorrelation-{file}"), autocorrelation(name, residual));
        add(format!("cross-correlation-{file}"), cross_correlation(name, residual));
    }
    plots
}

/// Autocorrelation and cross-correlation of the residual of each channel, each with its name.
pub(crate) fn correlation_figures(
    campaign: &Campaign,
    found: &LogPrediction,
) -> Vec<(String, LinePlot)> {
    let of_channel = |(c, residual): (usize, &ChannelResidual)| {
        let (name, _) = channel_name_unit(&campaign.channels, c);
        [
            (format!("{name}: autocorrelation"), autocorrelation(name, residual)),
            (format!("{name}: correlation with the command"), cross_correlation(name, residual)),
        ]
    };
    found.residuals.iter().enumerate().flat_map(of_channel).collect()
}

fn worst(runs: &[TorqueRun]) -> Option<&TorqueRun> {
    let known = runs.iter().filter(|r| r.relative_error.is_some());
    known.max_by(|a, b| a.relative_error.unwrap_or(0.0).total_cmp(&b.relative_error.unwrap_or(0.0)))
}

fn torque(names: UnitNames, name: &str, run: &TorqueRun) -> LinePlot {
    let (what, label) = torque_axis(names);
    let time = run.time_s.clone();
    LinePlot::new(format!("{what}, {name}"), Axis::linear("time (s)"), Axis::linear(label))
        .subtitle("both averaged with the same window; no prediction while the motor rests")
        .trace(Trace::line("logged", Role::Raw, time.clone(), run.logged_nm.clone()))
        .trace(predicted(time, run.predicted_nm.clone()))
}

fn torque_residual(names: UnitNames, name: &str, run: &TorqueRun) -> LinePlot {
    let (what, label) = torque_axis(names);
    let left = run.logged_nm.iter().zip(&run.predicted_nm).map(|(l, p)| l - p).collect();
    let title = format!("{what}, {name}: logged minus predicted");
    LinePlot::new(title, Axis::linear("time (s)"), Axis::linear(label)).trace(Trace::line(
        "",
        Role::Corrected,
        run.time_s.clone(),
        left,
    ))
}

fn torque_axis(names: UnitNames) -> (&'static str, String) {
    let unit = names.torque_unit();
    let (title, axis) = match unit {
        "N" => ("Force", "force"),
        "N·m" => ("Torque", "torque"),
        _ => ("Command", "command"),
    };
    (title, format!("{axis} ({unit})"))
}

/// A dashed trace, so that the trace below it stays visible. It has gaps where nothing is predicted.
fn predicted(time: Vec<f64>, values: Vec<f64>) -> Trace {
    Trace::new("predicted", Role::Fitted, TraceStyle::Dashes, time, values)
}

/// The run with the largest squared residual.
fn worst_motion(campaign: &Campaign, validation: &Validation, channel: usize) -> Option<usize> {
    let mut sums = vec![0.0; campaign.runs.len()];
    for s in &validation.stretches {
        let run = &campaign.runs[s.run];
        let logged = samples(run, channel).iter().skip(s.first);
        sums[s.run] += logged.zip(&s.channels[channel]).map(|(y, p)| (y - p).powi(2)).sum::<f64>();
    }
    (0..sums.len()).max_by(|a, b| sums[*a].total_cmp(&sums[*b]))
}

fn samples(run: &lissom::record::Run, channel: usize) -> &[f64] {
    match channel.checked_sub(1) {
        None => run.motor(),
        Some(tip) => &run.tips()[tip],
    }
}

/// Plots of the motion and of its residual.
fn motion(
    campaign: &Campaign,
    validation: &Validation,
    index: usize,
    channel: usize,
) -> [LinePlot; 2] {
    let stretches: &[PredictedStretch] = &validation.stretches;
    let over = match validation.horizons.get(validation.chosen) {
        Some(h) if !h.whole_runs => {
            format!(
                "predicted over {:.3} s at a time, each time from a new initial state",
                h.length_s
            )
        }
        _ => "predicted from one initial state".to_owned(),
    };
    let run = &campaign.runs[index];
    let (name, unit) = channel_name_unit(&campaign.channels, channel);
    let measured = samples(run, channel);
    let at = |k: usize| k as f64 * run.sample_time_s();
    let (mut time, mut shown, mut left) = (Vec::new(), Vec::new(), Vec::new());
    for s in stretches.iter().filter(|s| s.run == index) {
        for (i, p) in s.channels[channel].iter().enumerate() {
            time.push(at(s.first + i));
            shown.push(*p);
            left.push(measured[s.first + i] - p);
        }
    }
    let axis = || Axis::linear("time (s)");
    let all = (0..measured.len()).map(at).collect();
    let label = || Axis::linear(format!("{name} ({unit})"));
    let both = LinePlot::new(format!("{name}, {}", run.name()), axis(), label())
        .subtitle(over.clone())
        .trace(Trace::line("measured", Role::Raw, all, measured.to_vec()))
        .trace(predicted(time.clone(), shown));
    let title = format!("{name}, {}: measured minus predicted", run.name());
    let residual = LinePlot::new(title, axis(), label()).subtitle(over).trace(Trace::line(
        "",
        Role::Corrected,
        time,
        left,
    ));
    [both, residual]
}

fn autocorrelation(name: &str, r: &ChannelResidual) -> LinePlot {
    let lags = (0..r.autocorrelation.len()).map(|k| k as f64).collect();
    let band = r.autocorrelation_band;
    LinePlot::new(
        format!("{name}: autocorrelation of the residual"),
        Axis::linear("lag (samples)"),
        Axis::linear("autocorrelation"),
    )
    .trace(Trace::new(
        "residual",
        Role::Corrected,
        TraceStyle::Columns,
        lags,
        r.autocorrelation.clone(),
    ))
    .band(Band::new("95 % of white noise", Role::Truth, 0.0, (-band, band)))
}

fn cross_correlation(name: &str, r: &ChannelResidual) -> LinePlot {
    let lags = r.lags().into_iter().map(|lag| lag as f64).collect();
    let band = r.cross_correlation_band;
    LinePlot::new(
        format!("{name}: cross-correlation of residual and command"),
        Axis::linear("lag of the residual behind the command (samples)"),
        Axis::linear("cross-correlation"),
    )
    .trace(Trace::new(
        "residual",
        Role::Corrected,
        TraceStyle::Columns,
        lags,
        r.cross_correlation.clone(),
    ))
    .band(Band::new("95 % if independent", Role::Truth, 0.0, (-band, band)))
}
