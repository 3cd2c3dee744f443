//! Colours, dashes and markers by the role of a series.

/// What a series stands for; it decides colour, dash and marker.
///
/// The colours are those of Okabe and Ito, which people with any colour vision tell apart; marker and dash differ too, so
/// that a print in black and white stays readable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// As measured: vermilion squares.
    Raw,
    /// Measured and corrected: blue circles.
    Corrected,
    /// A fitted model: black.
    Fitted,
    /// What is known to be true: green, dashed.
    Truth,
    /// Anything else: the colours left over, in turn.
    Other(u8),
}

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Diamond,
    Up,
    Down,
}

/// What flagged points are drawn in.
pub(crate) const FLAGGED: &str = "#8a8a8a";
/// Lines beyond what was measured, whatever their role.
pub(crate) const DASHES: &str = "6 4";
/// Frames and text.
pub(crate) const INK: &str = "#1a1a1a";
/// Text of less weight.
pub(crate) const FAINT_INK: &str = "#595959";
/// Grid lines at labelled ticks.
pub(crate) const GRID: &str = "#cfcfcf";
/// Grid lines between them.
pub(crate) const MINOR_GRID: &str = "#ebebeb";

impl Role {
    pub(crate) fn colour(self) -> &'static str {
        match self {
            Self::Raw => "#d55e00",
            Self::Corrected => "#0072b2",
            Self::Fitted => "#1a1a1a",
            Self::Truth => "#009e73",
            Self::Other(k) => ["#aa3f86", "#c98a00", "#3a9bd9", "#7a5c3e"][usize::from(k) % 4],
        }
    }

    pub(crate) fn dash(self) -> Option<&'static str> {
        match self {
            Self::Truth => Some("8 4"),
            Self::Other(k) => {
                [None, Some("2 3"), Some("10 3 2 3"), Some("5 3")][usize::from(k) % 4]
            }
            _ => None,
        }
    }

    pub(crate) fn marker(self) -> Marker {
        match self {
            Self::Raw => Marker::Square,
            Self::Corrected => Marker::Circle,
            Self::Fitted => Marker::Diamond,
            Self::Truth => Marker::Up,
            Self::Other(k) => {
                [Marker::Down, Marker::Diamond, Marker::Up, Marker::Circle][usize::from(k) % 4]
            }
        }
    }
}
