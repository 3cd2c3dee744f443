//! Plots as files.

use std::path::{Path, PathBuf};

use lissom_io::write::Batch;
use lissom_report::{BodePlot, Figure};
use lissom_views::NamedFigure;

use crate::shared::failure::Failure;

/// Scale of the PNG.
pub(crate) const PNG_SCALE: f32 = 2.0;

/// Adds one plot to the files to write, as SVG and PNG.
pub(crate) fn add(
    batch: &mut Batch,
    folder: &Path,
    name: &str,
    plot: &dyn Figure,
) -> Result<(), Failure> {
    batch.file(&folder.join(format!("{name}.svg")), plot.to_svg()?.as_bytes())?;
    batch.file(&folder.join(format!("{name}.png")), &plot.to_png(PNG_SCALE)?)?;
    Ok(())
}

/// Adds the plots of a result or a validation, each under its name.
pub(crate) fn add_all(
    batch: &mut Batch,
    folder: &Path,
    plots: &[NamedFigure],
) -> Result<(), Failure> {
    batch.folder(folder)?;
    plots.iter().try_for_each(|plot| add(batch, folder, &plot.name, plot.figure.as_ref()))
}

/// The file of a plot, SVG or PNG.
pub(crate) struct Picture {
    path: PathBuf,
    png: bool,
}

impl Picture {
    /// The format follows from the ending of the name, .svg or .png.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let is = |kind: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(kind));
        if !is("png") && !is("svg") {
            let words = format!("{}: is neither .svg nor .png", path.display());
            return Err(Failure::Asked(words, "give the plot a name that ends in .svg or .png"));
        }
        Ok(Self { path: path.to_owned(), png: is("png") })
    }

    /// The path of the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Another file in the same folder with the same format, `NAME-what.svg` or `.png`.
    pub(crate) fn beside(&self, what: &str) -> Self {
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let kind = if self.png { "png" } else { "svg" };
        Self { path: self.path.with_file_name(format!("{stem}-{what}.{kind}")), png: self.png }
    }

    /// Adds a plot to the files to write.
    pub(crate) fn draw(&self, batch: &mut Batch, plot: &BodePlot) -> Result<(), Failure> {
        let file = if self.png { plot.to_png(PNG_SCALE)? } else { plot.to_svg()?.into_bytes() };
        batch.file(&self.path, &file)?;
        Ok(())
    }
}
