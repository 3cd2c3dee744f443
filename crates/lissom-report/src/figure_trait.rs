//! The trait of all figures.

use crate::figure_data::FigureData;
use crate::figure_error::FigureError;

/// Keeps [`Figure`] to this crate, whose SVG has no ids that could clash on a page.
pub trait Sealed {}

/// A figure that can be drawn as SVG, PNG or PDF and put on a [`Page`](crate::Page).
///
/// The SVG is complete in itself: no ids, no style sheet, no script, no reference to anything outside.
pub trait Figure: Sealed {
    /// Draws the figure as a complete SVG document.
    ///
    /// # Errors
    ///
    /// [`FigureError::Length`] when the vectors of a series differ in length, [`FigureError::NothingToDraw`] when no
    /// point is drawable, [`FigureError::Range`] when an axis is given a range it cannot have.
    fn to_svg(&self) -> Result<String, FigureError>;

    /// What an interactive drawing of the figure needs. Lines have at most about `points` points.
    ///
    /// # Errors
    ///
    /// [`FigureError::Length`] and [`FigureError::NothingToDraw`] as [`to_svg`](Self::to_svg).
    fn data(&self, points: usize) -> Result<FigureData, FigureError>;

    /// Draws the figure on white, `scale` pixels to one SVG unit, and returns the bytes of a PNG file.
    ///
    /// Text is set in the compiled-in DejaVu Sans, so that the picture is the same on every machine.
    ///
    /// # Errors
    ///
    /// Those of [`to_svg`](Self::to_svg), [`FigureError::Size`] when the picture would have no pixel or a side of more
    /// than 16384, [`FigureError::Png`] when the encoder fails.
    fn to_png(&self, scale: f32) -> Result<Vec<u8>, FigureError>;

    /// Draws the figure as a PDF of one page with vector graphics, 0.75 pt to one SVG unit, and returns the bytes of the file.
    ///
    /// Text is drawn as outlines of DejaVu Sans, so that no font is needed.
    ///
    /// # Errors
    ///
    /// Those of [`to_svg`](Self::to_svg).
    fn to_pdf(&self) -> Result<Vec<u8>, FigureError>;
}
