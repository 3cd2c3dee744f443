//! Errors of drawing a figure.

/// Why a figure could not be drawn or rasterised.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// A vector of a series is not as long as its abscissa.
    #[error("series \"{series}\": {field} has {found} values where {expected} are needed")]
    Length {
        /// The label of the series.
        series: String,
        /// The vector at fault.
        field: &'static str,
        /// The length of the abscissa.
        expected: usize,
        /// The length found.
        found: usize,
    },
    /// There is no point with finite coordinates (positive ones on logarithmic axes).
    #[error("figure \"{title}\" has no point to draw ({skipped} without a drawable value)")]
    NothingToDraw {
        /// The title of the figure.
        title: String,
        /// How many points were given and could not be drawn.
        skipped: usize,
    },
    /// The range given for an axis is empty, not finite, or not positive on a logarithmic axis.
    #[error("axis \"{axis}\" cannot run from {low} to {high}")]
    Range {
        /// The label of the axis.
        axis: String,
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
    /// The raster image would have no pixel or too many.
    #[error(
        "a scale of {scale} makes a picture of {width} by {height} pixels; each side must lie between 1 and {limit}"
    )]
    Size {
        /// The requested scale.
        scale: f32,
        /// Pixels across.
        width: f32,
        /// Pixels down.
        height: f32,
        /// The largest side allowed.
        limit: u16,
    },
    /// The PNG encoder failed.
    #[error("the picture could not be encoded as PNG")]
    Png {
        /// The error of the encoder.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}
