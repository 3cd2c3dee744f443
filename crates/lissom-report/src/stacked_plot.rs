//! Plots one above the other over one horizontal axis: an angle and its velocity, an angle and its residual.

use crate::canvas::Drawing;
use crate::figure_data::FigureData;
use crate::figure_error::FigureError;
use crate::figure_trait::{Figure, Sealed};
use crate::line_plot::{LinePlot, sheet, sheet_data};
use crate::pdf_writer::pdf;
use crate::png_writer::png;
use crate::svg_writer::svg;

/// The height of each frame.
const HEIGHT: f64 = 210.0;

/// Line plots one above the other over one horizontal axis.
///
/// The axis is that of the last plot, and covers the data of all; each plot's own title and subtitle are not drawn. The legend
/// above the first frame has the entries of all plots, those that are alike once.
///
/// ```
/// use lissom_report::{Axis, Figure, LinePlot, Role, StackedPlot, Trace};
///
/// let time = vec![0.0, 0.1, 0.2];
/// let panel = |label: &str, y| {
///     LinePlot::new("", Axis::linear("time (s)"), Axis::linear(label))
///         .trace(Trace::line("measured", Role::Raw, time.clone(), y))
/// };
/// let plot = StackedPlot::new("Run 1")
///     .plot(panel("angle (rad)", vec![0.0, 0.3, 0.4]))
///     .plot(panel("velocity (rad/s)", vec![4.0, 2.0, 0.0]));
/// assert_eq!(plot.to_svg()?.matches("time (s)").count(), 1);
/// # Ok::<(), lissom_report::FigureError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StackedPlot {
    /// The title.
    pub title: String,
    /// A line below the title.
    pub subtitle: Option<String>,
    /// Interactive figures with the same name here show the same part of the horizontal axis.
    pub linked: Option<String>,
    /// The plots, from the top; their horizontal axes have one scale.
    pub plots: Vec<LinePlot>,
}

impl StackedPlot {
    /// A figure without plots.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), ..Self::default() }
    }

    /// Links the horizontal axis with that of all figures that are linked by the same name.
    #[must_use]
    pub fn linked(mut self, name: impl Into<String>) -> Self {
        self.linked = Some(name.into());
        self
    }

    /// Adds a line below the title.
    #[must_use]
    pub fn subtitle(mut self, subtitle: impl Into<String>) -> Self {
        self.subtitle = Some(subtitle.into());
        self
    }

    /// Adds a plot below the others.
    #[must_use]
    pub fn plot(mut self, plot: LinePlot) -> Self {
        self.plots.push(plot);
        self
    }

    fn drawing(&self) -> Result<Drawing, FigureError> {
        let plots: Vec<&LinePlot> = self.plots.iter().collect();
        sheet(&self.title, self.subtitle.as_deref(), &plots, HEIGHT)
    }
}

impl Sealed for StackedPlot {}

impl Figure for StackedPlot {
    fn data(&self, points: usize) -> Result<FigureData, FigureError> {
        let plots: Vec<&LinePlot> = self.plots.iter().collect();
        let data = sheet_data(&self.title, self.subtitle.as_deref(), &plots, points)?;
        Ok(FigureData { linked: self.linked.clone(), ..data })
    }

    fn to_svg(&self) -> Result<String, FigureError> {
        Ok(svg(&self.drawing()?))
    }

    fn to_png(&self, scale: f32) -> Result<Vec<u8>, FigureError> {
        png(&self.drawing()?, scale)
    }

    fn to_pdf(&self) -> Result<Vec<u8>, FigureError> {
        Ok(pdf(&self.drawing()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Region, Role, Trace};

    fn plot(label: &str, y: Vec<f64>) -> LinePlot {
        let x = (0..y.len()).map(|k| k as f64).collect();
        LinePlot::new("own title", Axis::linear("time (s)"), Axis::linear(label))
            .trace(Trace::line("measured", Role::Raw, x, y))
            .region(Region::new("at rest", Role::Truth, (0.2, 0.6)))
    }

    #[test]
    fn frames_share_one_axis_and_one_legend() {
        let figure = StackedPlot::new("Run 1")
            .plot(plot("angle (rad)", vec![0.0, 1.0]))
            .plot(plot("velocity (rad/s)", vec![10.0, 20.0, 30.0]));
        let svg = figure.to_svg().unwrap();
        for (text, times) in [
            (">time (s)<", 1),
            (">measured<", 1),
            (">at rest<", 1),
            (">own title<", 0),
            (">angle (rad)<", 1),
            (">velocity (rad/s)<", 1),
            // A tick of the horizontal axis, which covers the longer trace.
            (">1.5<", 1),
        ] {
            assert_eq!(svg.matches(text).count(), times, "{text} in {svg}");
        }
        assert!(figure.to_png(0.5).is_ok());
    }

    #[test]
    fn a_figure_without_data_is_refused() {
        let empty = StackedPlot::new("none");
        assert!(matches!(empty.to_svg(), Err(FigureError::NothingToDraw { .. })));
        let half = empty.plot(plot("angle (rad)", vec![0.0, 1.0])).plot(plot("velocity", vec![]));
        assert!(matches!(half.to_svg(), Err(FigureError::NothingToDraw { .. })));
    }
}
