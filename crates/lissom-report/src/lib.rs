//! Figures and one self-contained HTML page.
//!
//! The crate draws plain plotting structures and does not depend on the identification:
//!
//! - [`BodePlot`]: magnitude and phase over a shared logarithmic frequency axis;
//! - [`LinePlot`]: one pair of linear or logarithmic axes with points, lines, steps, columns, bands and regions;
//! - [`StackedPlot`]: line plots one above the other over one horizontal axis;
//! - [`Page`]: headings, tables, figures and findings as one HTML file that loads nothing else.
//!
//! All plots implement [`Figure`] and draw themselves as SVG, PNG and PDF. The text of PNG and PDF uses the compiled-in font
//! DejaVu Sans, so that a picture looks the same on every machine, whether it has fonts or not.
//!
//! ```
//! use lissom_report::{Axis, Figure, LinePlot, Page, Role, Trace};
//!
//! let plot = LinePlot::new("Motor angle", Axis::linear("time (s)"), Axis::linear("angle (rad)"))
//!     .trace(Trace::line("measured", Role::Raw, vec![0.0, 0.1, 0.2], vec![0.0, 0.3, 0.1]));
//! let png = plot.to_png(2.0)?;
//! let html = Page::new("Run 1").figure(&plot, "The first run.").to_html();
//! # assert!(png.starts_with(b"\x89PNG") && html.contains("<svg"));
//! # Ok::<(), lissom_report::FigureError>(())
//! ```
#![deny(missing_docs)]

mod axis;
mod bode_plot;
mod bode_series;
mod canvas;
mod figure_data;
mod figure_error;
mod figure_trait;
mod font;
mod forest;
mod html;
mod legend;
mod line_plot;
mod marks;
mod packed;
mod page;
mod page_parts;
mod palette;
mod panel;
mod pdf_writer;
mod phase;
mod png_writer;
mod scale;
mod stacked_plot;
mod svg_writer;
mod text_fit;
mod text_outline;
mod trace;
mod truetype;

pub use bode_plot::BodePlot;
pub use bode_series::{FrequencyAxis, Series, Style};
pub use figure_data::{AxisData, BandData, FigureData, PanelData, RegionData, TraceData};
pub use figure_error::FigureError;
pub use figure_trait::Figure;
pub use line_plot::LinePlot;
pub use lissom_text::{interval, significant, with_uncertainty};
pub use packed::Packed;
pub use page::{PAGE_STYLE, Page};
pub use page_parts::{Cells, Finding, KeyFigure, Severity, Table};
pub use palette::Role;
pub use scale::Scale;
pub use stacked_plot::StackedPlot;
pub use trace::{Axis, Band, Quantity, Region, Trace, TraceStyle};
