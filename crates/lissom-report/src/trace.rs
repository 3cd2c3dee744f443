//! Axes, traces, bands and regions of a [`LinePlot`](crate::LinePlot).

use crate::figure_error::FigureError;
use crate::legend::Sample;
use crate::marks::Mark;
use crate::palette::Role;
use crate::scale::Scale;

/// What an axis shows, where a reader may want other units.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// As it is.
    #[default]
    Plain,
    /// A frequency in rad/s, which is also shown in Hz.
    FrequencyRadPerSecond,
    /// A magnitude in dB, which is also shown as a ratio.
    Decibels,
    /// A phase in degrees, which is also shown within half a turn.
    Degrees,
}

/// One axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The quantity with its unit.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// What it shows.
    pub quantity: Quantity,
    /// The ends of the axis; without them it shows all data.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis over all data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// A logarithmic axis over all positive data.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, ..Self::default() }
    }

    /// Says what the axis shows.
    #[must_use]
    pub fn quantity(mut self, quantity: Quantity) -> Self {
        self.quantity = quantity;
        self
    }

    /// Fixes the ends of the axis.
    #[must_use]
    pub fn range(mut self, low: f64, high: f64) -> Self {
        self.range = Some((low, high));
        self
    }

    /// The given range, if it is valid.
    pub(crate) fn fixed_range(&self) -> Result<Option<(f64, f64)>, FigureError> {
        match self.range {
            Some((low, high))
                if !(self.scale.admits(low) && self.scale.admits(high) && low < high) =>
            {
                Err(FigureError::Range { axis: self.label.clone(), low, high })
            }
            Some((low, high)) => Ok(Some(self.scale.widened((low, high), 0.0))),
            None => Ok(None),
        }
    }
}

/// How a trace is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TraceStyle {
    /// Straight lines from point to point, in the order given.
    #[default]
    Line,
    /// The same, dashed: beyond what was measured.
    Dashes,
    /// Each value held until the next: a sampled command.
    Steps,
    /// Markers.
    Points,
    /// Markers with error bars of one standard error on both sides.
    PointsWithBars,
    /// Columns from zero (on a logarithmic axis, from the bottom), with error bars if there are standard errors.
    Columns,
}

/// One trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The label in the legend; empty keeps the trace out of it.
    pub label: String,
    /// What it shows; it decides colour and marker.
    pub role: Role,
    /// How it is drawn.
    pub style: TraceStyle,
    /// The abscissae.
    pub x: Vec<f64>,
    /// The ordinates.
    pub y: Vec<f64>,
    /// The standard error of each ordinate; a value that is not positive draws no bar.
    pub std: Option<Vec<f64>>,
    /// The standard error of each abscissa of points with bars.
    pub x_std: Option<Vec<f64>>,
    /// Points to draw grey and hollow, because something is wrong with them.
    pub flagged: Option<Vec<bool>>,
}

impl Trace {
    /// A trace without error bars or flags.
    pub fn new(
        label: impl Into<String>,
        role: Role,
        style: TraceStyle,
        x: Vec<f64>,
        y: Vec<f64>,
    ) -> Self {
        Self { label: label.into(), role, style, x, y, std: None, x_std: None, flagged: None }
    }

    /// A line without error bars or flags.
    pub fn line(label: impl Into<String>, role: Role, x: Vec<f64>, y: Vec<f64>) -> Self {
        Self::new(label, role, TraceStyle::Line, x, y)
    }

    /// Markers with error bars.
    pub fn points_with_bars(
        label: impl Into<String>,
        role: Role,
        x: Vec<f64>,
        y: Vec<f64>,
        std: Vec<f64>,
    ) -> Self {
        Self { std: Some(std), ..Self::new(label, role, TraceStyle::PointsWithBars, x, y) }
    }

    /// Adds standard errors of the abscissae.
    #[must_use]
    pub fn with_x_std(mut self, std: Vec<f64>) -> Self {
        self.x_std = Some(std);
        self
    }

    /// Adds flags.
    #[must_use]
    pub fn with_flags(mut self, flagged: Vec<bool>) -> Self {
        self.flagged = Some(flagged);
        self
    }

    /// The drawable points in the order given, and the count of the others.
    pub(crate) fn marks(&self, axes: [Scale; 2]) -> Result<(Vec<Mark>, usize), FigureError> {
        let lengths = [
            ("y", Some(self.y.len())),
            ("std", self.std.as_ref().map(Vec::len)),
            ("x_std", self.x_std.as_ref().map(Vec::len)),
            ("flagged", self.flagged.as_ref().map(Vec::len)),
        ];
        let expected = self.x.len();
        if let Some((field, found)) = lengths
            .into_iter()
            .find_map(|(field, n)| n.filter(|n| *n != expected).map(|n| (field, n)))
        {
            return Err(FigureError::Length { series: self.label.clone(), field, expected, found });
        }
        let barred = matches!(self.style, TraceStyle::PointsWithBars | TraceStyle::Columns);
        let (mut marks, mut after_gap) = (Vec::with_capacity(expected), false);
        for (k, (x, y)) in self.x.iter().copied().zip(self.y.iter().copied()).enumerate() {
            if axes[0].admits(x) && axes[1].admits(y) {
                let of = |list: &Option<Vec<f64>>| {
                    let std = list.as_ref().map(|s| s[k]);
                    std.filter(|s| barred && *s > 0.0 && Scale::Linear.admits(*s))
                };
                let bar = of(&self.std).map(|s| (y - s, y + s));
                let across = of(&self.x_std).map(|s| (x - s, x + s));
                let flagged = self.flagged.as_ref().is_some_and(|f| f[k]);
                marks.push(Mark { x, y, bar, across, flagged, after_gap });
                after_gap = false;
            } else {
                after_gap = true;
            }
        }
        let skipped = expected - marks.len();
        Ok((marks, skipped))
    }

    pub(crate) fn sample(&self) -> Sample {
        match self.style {
            TraceStyle::Line | TraceStyle::Steps => Sample::Line(self.role),
            TraceStyle::Dashes => Sample::Dashes(self.role),
            TraceStyle::Points => Sample::Points(self.role),
            TraceStyle::PointsWithBars => Sample::PointsWithBars(self.role),
            TraceStyle::Columns => Sample::Column(self.role),
        }
    }
}

/// A horizontal band with a line at its middle value: an estimate and its interval.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// The label in the legend; empty keeps the band out of it.
    pub label: String,
    /// What it shows; it decides the colour.
    pub role: Role,
    /// The value.
    pub middle: f64,
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Band {
    /// A band from `low` to `high` with its line at `middle`.
    pub fn new(label: impl Into<String>, role: Role, middle: f64, (low, high): (f64, f64)) -> Self {
        Self { label: label.into(), role, middle, low, high }
    }
}

/// A shaded interval of the horizontal axis, as high as the frame. It marks a part of a time trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The label in the legend; empty keeps the region out of it.
    pub label: String,
    /// What it shows; it decides the colour.
    pub role: Role,
    /// The left end.
    pub from: f64,
    /// The right end.
    pub to: f64,
}

impl Region {
    /// A region from `from` to `to`.
    pub fn new(label: impl Into<String>, role: Role, (from, to): (f64, f64)) -> Self {
        Self { label: label.into(), role, from, to }
    }
}
