//! Colours, dashes and markers by the role of a series.

use std::fmt;

/// What a series shows; it decides colour, dash and marker.
///
/// The colours are those of Okabe and Ito, which people with any colour vision tell apart; marker and dash differ too,
/// so that a print in black and white stays readable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// As measured: vermilion squares.
    Raw,
    /// Measured and corrected: blue circles.
    Corrected,
    /// A fitted model: black.
    Fitted,
    /// The true values, where they are known: green, dashed.
    Truth,
    /// Poles of a model: vermilion crosses.
    Pole,
    /// Zeros of a model: blue rings.
    Zero,
    /// Anything else: the colours left over, in turn.
    Other(u8),
}

/// A colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Colour {
    pub(crate) red: u8,
    pub(crate) green: u8,
    pub(crate) blue: u8,
}

impl Colour {
    /// A colour by its shares, 0 to 255.
    pub(crate) const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }
}

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }
}

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Circle,
    Square,
    Diamond,
    Up,
    Down,
    /// ×.
    Cross,
    /// ○, hollow.
    Ring,
}

/// Half the size of a marker.
pub(crate) const MARKER_RADIUS: f64 = 4.0;
/// Half the side of a square.
const SIDE: f64 = 0.88 * MARKER_RADIUS;
/// From the centre to the tips of a diamond and of a triangle.
const TIP: f64 = 1.2 * MARKER_RADIUS;
/// Half the base of a triangle.
const HALF_BASE: f64 = 1.1 * MARKER_RADIUS;
/// From the centre to the base of a triangle.
const BASE: f64 = 2.0 * MARKER_RADIUS - TIP;

/// Half the length of the arms of a cross, along the axes.
const ARM: f64 = 1.1 * MARKER_RADIUS;
/// Half the width of its arms, along the axes.
const WIDTH: f64 = 0.42 * MARKER_RADIUS;
/// The corners of a cross.
const CROSS: [(f64, f64); 12] = [
    (-ARM, WIDTH - ARM),
    (WIDTH - ARM, -ARM),
    (0.0, -WIDTH),
    (ARM - WIDTH, -ARM),
    (ARM, WIDTH - ARM),
    (WIDTH, 0.0),
    (ARM, ARM - WIDTH),
    (ARM - WIDTH, ARM),
    (0.0, WIDTH),
    (WIDTH - ARM, ARM),
    (-ARM, ARM - WIDTH),
    (-WIDTH, 0.0),
];

impl Marker {
    /// The corners relative to the centre, y downward; none for a circle of [`MARKER_RADIUS`].
    pub(crate) fn corners(self) -> &'static [(f64, f64)] {
        match self {
            Self::Circle | Self::Ring => &[],
            Self::Cross => &CROSS,
            Self::Square => &[(-SIDE, -SIDE), (SIDE, -SIDE), (SIDE, SIDE), (-SIDE, SIDE)],
            Self::Diamond => &[(0.0, -TIP), (TIP, 0.0), (0.0, TIP), (-TIP, 0.0)],
            Self::Up => &[(0.0, -TIP), (HALF_BASE, BASE), (-HALF_BASE, BASE)],
            Self::Down => &[(0.0, TIP), (HALF_BASE, -BASE), (-HALF_BASE, -BASE)],
        }
    }
}

/// The background of every figure.
pub(crate) const WHITE: Colour = Colour::rgb(0xff, 0xff, 0xff);
/// The colour of flagged points.
pub(crate) const FLAGGED: Colour = Colour::rgb(0x8a, 0x8a, 0x8a);
/// Lines outside the measured range, whatever their role.
pub(crate) const DASHES: &[u8] = &[6, 4];
/// The opacity of bands and regions: grid and data show through.
pub(crate) const SHADE: f64 = 0.16;
/// Frames and text.
pub(crate) const INK: Colour = Colour::rgb(0x1a, 0x1a, 0x1a);
/// Text of less weight.
pub(crate) const FAINT_INK: Colour = Colour::rgb(0x59, 0x59, 0x59);
/// Grid lines at labelled ticks.
pub(crate) const GRID: Colour = Colour::rgb(0xcf, 0xcf, 0xcf);
/// Grid lines between them.
pub(crate) const MINOR_GRID: Colour = Colour::rgb(0xeb, 0xeb, 0xeb);

impl Role {
    pub(crate) fn colour(self) -> Colour {
        match self {
            Self::Raw => Colour::rgb(0xd5, 0x5e, 0x00),
            Self::Corrected => Colour::rgb(0x00, 0x72, 0xb2),
            Self::Fitted => Colour::rgb(0x1a, 0x1a, 0x1a),
            Self::Pole => Self::Raw.colour(),
            Self::Zero => Self::Corrected.colour(),
            Self::Truth => Colour::rgb(0x00, 0x9e, 0x73),
            Self::Other(k) => [
                Colour::rgb(0xaa, 0x3f, 0x86),
                Colour::rgb(0xc9, 0x8a, 0x00),
                Colour::rgb(0x3a, 0x9b, 0xd9),
                Colour::rgb(0x7a, 0x5c, 0x3e),
            ][usize::from(k) % 4],
        }
    }

    pub(crate) fn dash(self) -> Option<&'static [u8]> {
        match self {
            Self::Truth => Some(&[8, 4]),
            Self::Other(k) => match k % 4 {
                0 => None,
                1 => Some(&[2, 3]),
                2 => Some(&[10, 3, 2, 3]),
                _ => Some(&[5, 3]),
            },
            _ => None,
        }
    }

    /// Colours of the area and of the outline of its markers.
    pub(crate) fn marker_colours(self) -> [Colour; 2] {
        match self.marker() {
            Marker::Ring => [WHITE, self.colour()],
            _ => [self.colour(), WHITE],
        }
    }

    pub(crate) fn marker(self) -> Marker {
        match self {
            Self::Raw => Marker::Square,
            Self::Corrected => Marker::Circle,
            Self::Fitted => Marker::Diamond,
            Self::Truth => Marker::Up,
            Self::Pole => Marker::Cross,
            Self::Zero => Marker::Ring,
            Self::Other(k) => {
                [Marker::Down, Marker::Diamond, Marker::Up, Marker::Circle][usize::from(k) % 4]
            }
        }
    }
}
