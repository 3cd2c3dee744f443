//! What a result says about the logs that it is from: measured and predicted motion, the terms of the torque, harmonics.

use std::f64::consts::TAU;

use lissom::identify::{FoundArm, LogPrediction, TorqueRun, predict_logs};
use lissom::record::{Campaign, Run};
use lissom_io::result::{HarmonicsEntry, RunEntry};
use lissom_io::{ResultFile, UnitNames, channel_name_unit};
use lissom_report::{Axis, LinePlot, Role, StackedPlot, Trace, TraceStyle};

/// Periods of a cycle's plot.
const PERIODS: f64 = 1.25;
/// Sample times are the same within this share.
const SAME_TIME: f64 = 1e-9;
/// Colours of the terms of a torque; logs of an arm with a beam have no gravity.
const TERMS: [Role; 5] =
    [Role::Other(0), Role::Other(1), Role::Other(2), Role::Other(3), Role::Other(3)];

/// Figures of one kind, each with the name of its run.
pub(crate) type ByRun = Vec<(String, StackedPlot)>;

/// Predicts the logs that a result is from; `None` if its estimates do not make an arm, or if that cannot be simulated.
pub fn own_logs(campaign: &Campaign, arm: Option<&FoundArm>) -> Option<LogPrediction> {
    predict_logs(arm?, campaign).ok()
}

/// For each run: measured and predicted motion of each channel, its residual, and the terms of the torque. The run with the
/// largest residual torque comes first.
pub(crate) fn motion_figures(campaign: &Campaign, found: &LogPrediction) -> ByRun {
    let figure = |run: usize| {
        let name = campaign.runs[run].name().to_owned();
        let mut figure =
            StackedPlot::new(format!("{name}: measured and predicted")).linked(link(&name));
        for channel in 0..=campaign.channels.tips.len() {
            for plot in motion(campaign, found, run, channel)? {
                figure = figure.plot(plot);
            }
        }
        if let Some(torque) = torque_of(found, run) {
            let names = UnitNames::new(&campaign.channels);
            figure = figure.plot(balance(names, torque));
        }
        Some((name, figure))
    };
    by_residual(campaign, found).into_iter().filter_map(figure).collect()
}

/// Name of the link of all time axes of a run.
fn link(run: &str) -> String {
    format!("time of {run}")
}

/// The terms of the torque of each run; the run with the largest residual torque comes first.
pub(crate) fn torque_figures(
    campaign: &Campaign,
    found: &LogPrediction,
) -> Vec<(String, LinePlot)> {
    let names = UnitNames::new(&campaign.channels);
    let figure = |run: usize| {
        let name = campaign.runs[run].name().to_owned();
        let mut plot = balance(names, torque_of(found, run)?);
        plot.title = format!("{name}: terms of the {}", torque_word(names));
        Some((name, plot))
    };
    by_residual(campaign, found).into_iter().filter_map(figure).collect()
}

/// The runs, that with the largest residual torque first.
fn by_residual(campaign: &Campaign, found: &LogPrediction) -> Vec<usize> {
    let mut order: Vec<usize> = (0..campaign.runs.len()).collect();
    let error = |run: usize| torque_of(found, run).and_then(|t| t.relative_error).unwrap_or(0.0);
    order.sort_by(|a, b| error(*b).total_cmp(&error(*a)));
    order
}

fn torque_of(found: &LogPrediction, run: usize) -> Option<&TorqueRun> {
    found.torque.as_ref()?.runs.iter().find(|torque| torque.run == run)
}

/// Measured and predicted motion of a channel, and their difference; `None` if nothing is predicted.
fn motion(
    campaign: &Campaign,
    found: &LogPrediction,
    index: usize,
    channel: usize,
) -> Option<[LinePlot; 2]> {
    let run = &campaign.runs[index];
    let (name, unit) = channel_name_unit(&campaign.channels, channel);
    let measured = match channel.checked_sub(1) {
        None => run.motor(),
        Some(tip) => run.tips().get(tip)?,
    };
    let at = |k: usize| k as f64 * run.sample_time_s();
    let (mut time, mut predicted, mut residual) = (Vec::new(), Vec::new(), Vec::new());
    for stretch in found.stretches.iter().filter(|stretch| stretch.run == index) {
        for (k, value) in stretch.channels.get(channel)?.iter().enumerate() {
            time.push(at(stretch.first + k));
            predicted.push(*value);
            residual.push(measured.get(stretch.first + k)? - value);
        }
    }
    if time.is_empty() {
        return None;
    }
    let axis = || Axis::linear("time (s)");
    let all = (0..measured.len()).map(at).collect();
    let both = LinePlot::new("", axis(), Axis::linear(format!("{name} ({unit})")))
        .trace(Trace::line("measured", Role::Raw, all, measured.to_vec()))
        .trace(Trace::new("predicted", Role::Fitted, TraceStyle::Dashes, time.clone(), predicted));
    let label = Axis::linear(format!("{name}, residual ({unit})"));
    let left = Trace::line("measured − predicted", Role::Corrected, time, residual);
    Some([both, LinePlot::new("", axis(), label).trace(left)])
}

/// Which term takes how much of the torque.
fn balance(names: UnitNames, torque: &TorqueRun) -> LinePlot {
    let time = || torque.time_s.clone();
    let mut plot = LinePlot::new("", Axis::linear("time (s)"), torque_axis(names))
        .trace(Trace::line(logged(names), Role::Raw, time(), torque.logged_nm.clone()));
    let terms = [
        ("inertia", &torque.terms.inertia_nm),
        ("viscous friction", &torque.terms.viscous_nm),
        ("other friction", &torque.terms.dry_nm),
        ("beam", &torque.terms.coupling_nm),
        ("gravity", &torque.terms.gravity_nm),
    ];
    for ((label, values), role) in terms.into_iter().zip(TERMS) {
        if values.iter().any(|value| *value != 0.0) {
            plot = plot.trace(Trace::line(label, role, time(), values.clone()));
        }
    }
    let residual = torque.logged_nm.iter().zip(&torque.predicted_nm).map(|(l, p)| l - p).collect();
    plot.trace(Trace::line("logged − predicted", Role::Corrected, time(), residual))
}

fn torque_axis(names: UnitNames) -> Axis {
    Axis::linear(format!("{} ({})", torque_word(names), names.torque_unit()))
}

/// Name of the trace of the torque that the command gives.
fn logged(names: UnitNames) -> String {
    format!("logged {}", torque_word(names))
}

fn torque_word(names: UnitNames) -> &'static str {
    match names.torque_unit() {
        "N" => "force",
        "N·m" => "torque",
        _ => "command",
    }
}

/// One cycle of each sinusoidal run in its middle: the motion, and the friction with the torque.
pub(crate) fn cycle_figures(
    campaign: &Campaign,
    result: &ResultFile,
    found: &LogPrediction,
) -> ByRun {
    let names = UnitNames::new(&campaign.channels);
    let figure = |(index, run): (usize, &lissom::record::Run)| {
        let sine = own_run(result, run)?.sinusoid.as_ref()?;
        let torque = torque_of(found, index)?;
        let middle = 0.5 * run.len() as f64 * run.sample_time_s();
        let period = TAU / sine.omega_rad_s;
        let within = |time: f64| (time - middle).abs() <= 0.5 * PERIODS * period;
        let part = |values: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let rows = (0..torque.time_s.len()).filter(|k| within(torque.time_s[*k]));
            rows.map(values).collect()
        };
        let time = || part(&|k| torque.time_s[k]);
        let samples = || (0..run.len()).filter(|k| within(*k as f64 * run.sample_time_s()));
        let angle = Trace::line(
            "motor",
            Role::Raw,
            samples().map(|k| k as f64 * run.sample_time_s()).collect(),
            samples().map(|k| run.motor()[k]).collect(),
        );
        let (name, unit) = channel_name_unit(&campaign.channels, 0);
        let friction = part(&|k| torque.terms.viscous_nm[k] + torque.terms.dry_nm[k]);
        let axis = || Axis::linear("time (s)");
        let figure = StackedPlot::new(format!("{}: one cycle", run.name()))
            .linked(link(run.name()))
            .plot(LinePlot::new("", axis(), Axis::linear(format!("{name} ({unit})"))).trace(angle))
            .plot(
                LinePlot::new("", axis(), torque_axis(names))
                    .trace(Trace::line(
                        logged(names),
                        Role::Raw,
                        time(),
                        part(&|k| torque.logged_nm[k]),
                    ))
                    .trace(Trace::line("friction", Role::Corrected, time(), friction)),
            );
        Some((run.name().to_owned(), figure))
    };
    campaign.runs.iter().enumerate().filter_map(figure).collect()
}

/// The entry of a run of the logs that a result is from; `None` for a run of other logs.
fn own_run<'a>(result: &'a ResultFile, run: &Run) -> Option<&'a RunEntry> {
    let same_time = |entry: &RunEntry| {
        (entry.sample_time_s - run.sample_time_s()).abs() < SAME_TIME * run.sample_time_s()
    };
    let same = |entry: &&RunEntry| {
        entry.name == run.name() && entry.samples == run.len() && same_time(entry)
    };
    result.runs.iter().find(same)
}

/// Names of the runs that are not those of the result.
pub(crate) fn other_runs<'a>(campaign: &'a Campaign, result: &ResultFile) -> Vec<&'a str> {
    let others = campaign.runs.iter().filter(|run| own_run(result, run).is_none());
    others.map(Run::name).collect()
}

/// Amplitudes of the harmonics of each sinusoidal run, relative to the first one.
pub(crate) fn harmonic_figures(result: &ResultFile) -> Vec<(String, LinePlot)> {
    let figure = |run: &RunEntry| {
        let sine = run.sinusoid.as_ref()?;
        let trace = |label: &str, role, harmonics: &HarmonicsEntry, shift: f64| {
            let (y, std) = (harmonics.relative_amplitude.clone(), harmonics.relative_std.clone());
            if y.is_empty() || y.len() != std.len() {
                return None;
            }
            let x = (1..=y.len()).map(|k| k as f64 + shift).collect();
            Some(Trace::points_with_bars(label, role, x, y, std))
        };
        let plot = LinePlot::new(
            format!("{}: harmonics", run.name),
            Axis::linear("harmonic"),
            Axis::log("amplitude over that of the first harmonic"),
        )
        .trace(trace("command", Role::Raw, &sine.command_harmonics, -0.1)?)
        .trace(trace("motor", Role::Corrected, &sine.motor_harmonics, 0.1)?);
        Some((run.name.clone(), plot))
    };
    result.runs.iter().filter_map(figure).collect()
}
