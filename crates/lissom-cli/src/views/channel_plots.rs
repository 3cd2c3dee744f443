//! A plot of each channel of a log.

use std::path::Path;

use lissom_io::inspect::{InspectedChannel, Inspection, Role as LogRole};
use lissom_io::write::Batch;
use lissom_report::{Axis, LinePlot, Role, Trace};

use super::plot_file::add as add_plot;
use crate::shared::failure::Failure;

/// Stretches of a channel; of each the smallest and the largest value are drawn.
const STRETCHES: usize = 1500;

/// Adds a plot of each channel; `named` puts the name of the log into the names of the files.
pub(crate) fn add(
    batch: &mut Batch,
    folder: &Path,
    log: &Inspection,
    named: bool,
) -> Result<(), Failure> {
    batch.folder(folder)?;
    let stem = log.file.file_stem().unwrap_or_default().to_string_lossy();
    for (k, channel) in log.channels.iter().enumerate() {
        let Some(plot) = plot(log, k, channel) else { continue };
        let letters = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
        let name: String = channel.name.chars().take(40).map(letters).collect();
        let before = if named { format!("{stem}-") } else { String::new() };
        add_plot(batch, folder, &format!("{before}{:02}-{name}", channel.number), &plot)?;
    }
    Ok(())
}

fn plot(log: &Inspection, index: usize, channel: &InspectedChannel) -> Option<LinePlot> {
    let values = &log.data.channels[index].values;
    let time = channel.time.or_else(|| log.guess(LogRole::Time).map(|guess| guess.channel));
    let time = time.filter(|k| *k != index && log.data.channels[*k].values.len() == values.len());
    // Where the time starts again, runs would lie on each other.
    let goes_on = |k: &usize| log.data.channels[*k].values.is_sorted();
    let time = time.filter(goes_on);
    let stamps = time.map(|k| &log.data.channels[k].values[..]);
    let (x, y) = extremes(stamps, values)?;
    let with_unit = |c: &InspectedChannel| match &c.unit {
        Some(unit) => format!("{} ({})", c.label(), unit.text),
        None => c.label(),
    };
    let across = time.map_or_else(|| "sample".to_owned(), |k| with_unit(&log.channels[k]));
    let title = channel.label();
    let plot = LinePlot::new(title, Axis::linear(across), Axis::linear(with_unit(channel)));
    Some(plot.trace(Trace::line("logged", Role::Raw, x, y)))
}

/// The smallest and the largest value of each stretch, in their order.
fn extremes(stamps: Option<&[f64]>, values: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let stretch = values.len().div_ceil(STRETCHES).max(1);
    let mut kept = Vec::new();
    for first in (0..values.len()).step_by(stretch) {
        let part = first..(first + stretch).min(values.len());
        let known = || part.clone().filter(|k| values[*k].is_finite());
        let low = known().min_by(|a, b| values[*a].total_cmp(&values[*b]));
        let high = known().max_by(|a, b| values[*a].total_cmp(&values[*b]));
        let (Some(low), Some(high)) = (low, high) else { continue };
        kept.push(low.min(high));
        if low != high {
            kept.push(low.max(high));
        }
    }
    let at = |k: &usize| stamps.map_or(*k as f64, |t| t[*k]);
    kept.retain(|k| at(k).is_finite());
    let (x, y): (Vec<f64>, Vec<f64>) = kept.iter().map(|k| (at(k), values[*k])).unzip();
    (x.len() > 1).then_some((x, y))
}
