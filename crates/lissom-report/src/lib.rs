//! Figures and one self-contained HTML page.
//!
//! The crate takes plain plotting structures and knows nothing of how their numbers came about:
//!
//! - [`BodePlot`]: magnitude and phase over a shared logarithmic frequency axis;
//! - [`LinePlot`]: one pair of linear or logarithmic axes with points, lines, steps, columns and bands;
//! - [`Page`]: headings, tables, figures and findings as one HTML file that needs nothing from outside.
//!
//! Both figures are [`Figure`]s and draw themselves as SVG. [`svg_to_png`] rasterises that SVG with the DejaVu Sans that is
//! compiled in, so a picture looks the same on every machine, whether it has fonts or not.
//!
//! ```
//! use lissom_report::{Axis, Figure, LinePlot, Page, Role, Trace, svg_to_png};
//!
//! let plot = LinePlot::new("Motor angle", Axis::linear("time (s)"), Axis::linear("angle (rad)"))
//!     .trace(Trace::line("measured", Role::Raw, vec![0.0, 0.1, 0.2], vec![0.0, 0.3, 0.1]));
//! let png = svg_to_png(&plot.to_svg()?, 2.0)?;
//! let html = Page::new("Run 1").figure(&plot, "The first run.").to_html();
//! # assert!(png.starts_with(b"\x89PNG") && html.contains("<svg"));
//! # Ok::<(), lissom_report::FigureError>(())
//! ```
#![deny(missing_docs)]

mod axis;
mod bode;
mod canvas;
mod error;
mod html;
mod legend;
mod line;
mod marks;
mod number;
mod page;
mod page_parts;
mod palette;
mod panel;
mod phase;
mod png;
mod scale;
mod series;
mod text;
mod trace;

pub use bode::BodePlot;
pub use error::FigureError;
pub use line::LinePlot;
pub use number::{interval, significant, with_uncertainty};
pub use page::Page;
pub use page_parts::{Cells, Finding, KeyFigure, Severity, Table};
pub use palette::Role;
pub use png::svg_to_png;
pub use scale::Scale;
pub use series::{FrequencyAxis, Series, Style};
pub use trace::{Axis, Band, Trace, TraceStyle};

mod sealed {
    /// Keeps [`Figure`](crate::Figure) to this crate, whose SVG carries no ids that could clash on a page.
    pub trait Sealed {}
    impl Sealed for crate::BodePlot {}
    impl Sealed for crate::LinePlot {}
}

/// A figure that can be drawn as SVG and put on a [`Page`].
///
/// The SVG is complete in itself: no ids, no style sheet, no script, no reference to anything outside.
pub trait Figure: sealed::Sealed {
    /// Draws the figure as a complete SVG document.
    ///
    /// # Errors
    ///
    /// [`FigureError::Length`] when the vectors of a series differ in length, [`FigureError::NothingToDraw`] when no point
    /// is drawable, [`FigureError::Range`] when an axis is given a range it cannot have.
    fn to_svg(&self) -> Result<String, FigureError>;
}
