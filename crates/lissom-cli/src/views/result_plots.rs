//! The plots of a result, as files.

use std::path::Path;

use lissom::identify::Identified;
use lissom::record::Channels;
use lissom_io::UnitNames;
use lissom_io::write::Batch;

use super::bode_plots::bode_plots;
use super::friction_curve;
use super::plot_file::add;
use super::velocity_friction::friction_plot;
use crate::shared::failure::Failure;
use crate::tasks::known_arm::Reference;

/// Adds every plot to the files to write, as SVG and PNG.
pub(crate) fn add_all(
    batch: &mut Batch,
    folder: &Path,
    channels: &Channels,
    names: UnitNames,
    id: &Identified,
    reference: Option<&Reference>,
) -> Result<(), Failure> {
    batch.folder(folder)?;
    for (name, plot) in bode_plots(channels, names, id, reference) {
        add(batch, folder, &name, &plot)?;
    }
    if let Some(plot) = friction_plot(channels, names, id) {
        add(batch, folder, "friction-velocity", &plot)?;
    }
    if let Some(plot) = friction_curve::plot(names, id) {
        add(batch, folder, "friction-curve", &plot)?;
    }
    Ok(())
}
