//! The figures of a result for files of their own.

use lissom_io::ResultFile;

use crate::bode_plots::bode_plots;
use crate::friction_curve;
use crate::known_arm::Reference;
use crate::named_figure::NamedFigure;
use crate::velocity_friction::friction_plot;

/// The figures, each with its name: `bode-motor`, `bode-tip-1` and so on, `friction-velocity`, `friction-curve`. Those are
/// missing that the runs do not give. `reference` adds a line for a known arm to the Bode plots.
pub fn result_figures(result: &ResultFile, reference: Option<&Reference>) -> Vec<NamedFigure> {
    let names = result.names();
    let bode = bode_plots(names, result, reference).into_iter();
    let velocity = friction_plot(names, result);
    let curve = friction_curve::plot(names, result);
    bode.map(|(name, plot)| NamedFigure::new(name, plot))
        .chain(velocity.map(|plot| NamedFigure::new("friction-velocity", plot)))
        .chain(curve.map(|plot| NamedFigure::new("friction-curve", plot)))
        .collect()
}
