//! The frequency responses of a [`BodePlot`](crate::BodePlot).

use num_complex::Complex64;

use crate::figure_error::FigureError;
use crate::palette::Role;

/// What the frequency axis shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FrequencyAxis {
    /// rad/s below.
    #[default]
    RadPerSecond,
    /// Hz below.
    Hertz,
    /// rad/s below and Hz above.
    Both,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Style {
    /// A line, for models.
    #[default]
    Line,
    /// Markers, for measurements.
    Points,
    /// Markers with error bars of one standard error on both sides.
    PointsWithBars,
}

/// One frequency response.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The label in the legend; empty keeps the series out of it.
    pub label: String,
    /// What it shows; it decides colour and marker.
    pub role: Role,
    /// How it is drawn.
    pub style: Style,
    /// The frequencies in rad/s, in any order.
    pub omega_rad_s: Vec<f64>,
    /// The response at each frequency.
    pub response: Vec<Complex64>,
    /// The standard error of each response as a distance in the complex plane; a value that is not positive draws no
    /// bar.
    pub std: Option<Vec<f64>>,
    /// The half width of the band of a line at each frequency: relative for the magnitude, in rad for the phase.
    pub band: Option<Vec<[f64; 2]>>,
    /// Points to draw grey and hollow, because something is wrong with them.
    pub flagged: Option<Vec<bool>>,
}

impl Series {
    /// A series without error bars or flags.
    pub fn new(
        label: impl Into<String>,
        role: Role,
        style: Style,
        omega_rad_s: Vec<f64>,
        response: Vec<Complex64>,
    ) -> Self {
        Self {
            label: label.into(),
            role,
            style,
            omega_rad_s,
            response,
            std: None,
            band: None,
            flagged: None,
        }
    }

    /// Adds standard errors.
    #[must_use]
    pub fn with_std(mut self, std: Vec<f64>) -> Self {
        self.std = Some(std);
        self
    }

    /// Adds the half widths of a band around a line: relative for the magnitude, in rad for the phase.
    #[must_use]
    pub fn with_band(mut self, half_widths: Vec<[f64; 2]>) -> Self {
        self.band = Some(half_widths);
        self
    }

    /// Adds flags.
    #[must_use]
    pub fn with_flags(mut self, flagged: Vec<bool>) -> Self {
        self.flagged = Some(flagged);
        self
    }

    /// Whether all vectors are as long as the frequencies.
    pub(crate) fn check(&self) -> Result<(), FigureError> {
        let lengths = [
            ("response", Some(self.response.len())),
            ("std", self.std.as_ref().map(Vec::len)),
            ("band", self.band.as_ref().map(Vec::len)),
            ("flagged", self.flagged.as_ref().map(Vec::len)),
        ];
        let expected = self.omega_rad_s.len();
        match lengths
            .into_iter()
            .find_map(|(field, n)| n.filter(|n| *n != expected).map(|n| (field, n)))
        {
            Some((field, found)) => {
                Err(FigureError::Length { series: self.label.clone(), field, expected, found })
            }
            None => Ok(()),
        }
    }
}
