//! The figures of a report page, one by one.

use lissom_report::Figure;

use crate::named_figure::NamedFigure;
use crate::report_page::PageContent;
use crate::result_figures::result_figures;
use crate::validation_plots::correlation_figures;
use crate::{own_logs, pole_zero_map, third_harmonic};

/// Names of figures that need logs; those that end in a hyphen have one figure for each channel.
pub const OF_LOGS: [&str; 5] =
    ["motion", "torque", "cycle", "autocorrelation-", "cross-correlation-"];

/// The figures of the page with this content, each with its name, and with its run if there is one for each run. Their order is
/// that of the page; the run with the largest residual torque comes first.
///
/// | name | figure |
/// |---|---|
/// | `bode-motor`, `bode-tip-1`, … | frequency responses |
/// | `poles-motor`, `poles-tip-1`, … | poles and zeros |
/// | `third-harmonic`, `third-harmonic-amplitude` | Coulomb friction of each pair of runs, over frequency and amplitude |
/// | `friction-velocity`, `friction-curve` | friction from constant velocities, and against speed |
/// | `harmonics` | harmonics of a run |
/// | `motion`, `torque`, `cycle` | prediction of a run |
/// | `autocorrelation-motor`, `cross-correlation-motor`, … | residual of a channel |
pub fn page_figures(content: PageContent<'_>) -> Vec<NamedFigure> {
    let PageContent { result, logs, reference, .. } = content;
    let names = result.names();
    let mut figures = result_figures(result, reference);
    for (name, _, plot) in pole_zero_map::maps(result) {
        figures.push(NamedFigure::new(name, plot));
    }
    if let Some(plot) = third_harmonic::pair_plot(names, result) {
        figures.push(NamedFigure::new("third-harmonic", plot));
    }
    if let Some(plot) = third_harmonic::pair_plot_over_amplitude(names, result) {
        figures.push(NamedFigure::new("third-harmonic-amplitude", plot));
    }
    figures.extend(of_runs("harmonics", own_logs::harmonic_figures(result)));
    if let Some((campaign, own)) = logs {
        figures.extend(of_runs("motion", own_logs::motion_figures(campaign, own)));
        figures.extend(of_runs("torque", own_logs::torque_figures(campaign, own)));
        figures.extend(of_runs("cycle", own_logs::cycle_figures(campaign, result, own)));
        for (k, (_, plot)) in correlation_figures(campaign, own).into_iter().enumerate() {
            let what = if k % 2 == 0 { "autocorrelation" } else { "cross-correlation" };
            let channel = match k / 2 {
                0 => "motor".to_owned(),
                tip => format!("tip-{tip}"),
            };
            figures.push(NamedFigure::new(format!("{what}-{channel}"), plot));
        }
    }
    figures
}

fn of_runs<F: Figure + 'static>(
    name: &str,
    figures: Vec<(String, F)>,
) -> impl Iterator<Item = NamedFigure> {
    figures.into_iter().map(move |(run, figure)| NamedFigure::of_run(name, run, figure))
}
