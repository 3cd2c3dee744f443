//! Title, subtitle and legend. They are above the axes, so that none of them covers data.

use crate::canvas::{Anchor, Canvas, Rect, Stroke, TextStyle};
use crate::font::Weight;
use crate::palette::{DASHES, FAINT_INK, FLAGGED, Marker, Role, SHADE, WHITE};
use crate::panel::{LABEL_SIZE, LINE_WIDTH};
use crate::text_fit::{shorten, width, wrap};

const TITLE_SIZE: f64 = 19.0;
const SUBTITLE_SIZE: f64 = 14.0;
/// The width of a sample in the legend.
const SAMPLE: f64 = 30.0;
/// Between sample and label.
const SAMPLE_GAP: f64 = 8.0;
/// Between entries.
const ENTRY_GAP: f64 = 24.0;
const ROW: f64 = 23.0;

/// What a legend shows next to a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sample {
    Line(Role),
    Dashes(Role),
    Points(Role),
    PointsWithBars(Role),
    Column(Role),
    Band(Role),
    Region(Role),
    Flagged,
}

/// A line of the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) sample: Sample,
    pub(crate) label: String,
}

/// Writes title, subtitle and legend from the top of the sheet between `left` and `right`; returns where they end.
pub(crate) fn header(
    canvas: &mut Canvas,
    (left, right): (f64, f64),
    title: &str,
    subtitle: Option<&str>,
    entries: &[Entry],
) -> f64 {
    let mut y = 12.0;
    let bold = TextStyle { weight: Weight::Bold, ..TextStyle::new(TITLE_SIZE, Anchor::Start) };
    for line in wrap(title, TITLE_SIZE, Weight::Bold, right - left, 2) {
        y += TITLE_SIZE * 1.25;
        canvas.text((left, y - 0.3 * TITLE_SIZE), &line, bold);
    }
    let faint = TextStyle { colour: FAINT_INK, ..TextStyle::new(SUBTITLE_SIZE, Anchor::Start) };
    for line in wrap(subtitle.unwrap_or(""), SUBTITLE_SIZE, Weight::Regular, right - left, 3) {
        y += SUBTITLE_SIZE * 1.4;
        canvas.text((left, y - 0.3 * SUBTITLE_SIZE), &line, faint);
    }
    let entries: Vec<&Entry> = entries.iter().filter(|e| !e.label.is_empty()).collect();
    if entries.is_empty() {
        return y + 10.0;
    }
    y += 4.0;
    let (mut x, mut baseline) = (left, y + ROW - 6.0);
    for entry in entries {
        let label =
            shorten(&entry.label, LABEL_SIZE, Weight::Regular, right - left - SAMPLE - SAMPLE_GAP);
        let needed = SAMPLE + SAMPLE_GAP + width(&label, LABEL_SIZE, Weight::Regular);
        if x > left && x + needed > right {
            (x, baseline) = (left, baseline + ROW);
        }
        entry.sample.draw(canvas, x, baseline - 0.35 * LABEL_SIZE);
        canvas.text(
            (x + SAMPLE + SAMPLE_GAP, baseline),
            &label,
            TextStyle::new(LABEL_SIZE, Anchor::Start),
        );
        x += needed + ENTRY_GAP;
    }
    baseline + 16.0
}

impl Sample {
    fn draw(self, canvas: &mut Canvas, x: f64, y: f64) {
        let middle = x + SAMPLE / 2.0;
        let marker = |canvas: &mut Canvas, role: Role| {
            let [fill, colour] = role.marker_colours();
            let width = if fill == WHITE { 1.6 } else { 0.8 };
            let stroke = Stroke { colour, width, dash: None };
            canvas.markers(role.marker(), [(middle, y)], fill, stroke);
        };
        let box_of = |height: f64| Rect {
            left: x + 4.0,
            top: y - height / 2.0,
            width: SAMPLE - 8.0,
            height,
        };
        match self {
            Self::Line(role) | Self::Dashes(role) => {
                let dash = if self == Self::Dashes(role) { Some(DASHES) } else { role.dash() };
                let stroke = Stroke { colour: role.colour(), width: LINE_WIDTH, dash };
                canvas.lines([[(x, y), (x + SAMPLE, y)]], stroke);
            }
            Self::Points(role) => marker(canvas, role),
            Self::PointsWithBars(role) => {
                let stroke = Stroke { colour: role.colour(), width: 1.3, dash: None };
                let (top, bottom, cap) = (y - 8.5, y + 8.5, 3.5);
                let caps = [top, bottom].map(|y| [(middle - cap, y), (middle + cap, y)]);
                canvas.lines([[(middle, top), (middle, bottom)], caps[0], caps[1]], stroke);
                marker(canvas, role);
            }
            Self::Column(role) => canvas.rect(box_of(12.0), role.colour(), 0.75),
            Self::Band(role) => {
                canvas.rect(box_of(14.0), role.colour(), SHADE);
                canvas.lines(
                    [[(x + 4.0, y), (x + SAMPLE - 4.0, y)]],
                    Stroke { colour: role.colour(), width: 1.5, dash: None },
                );
            }
            Self::Region(role) => canvas.rect(box_of(14.0), role.colour(), SHADE),
            Self::Flagged => canvas.markers(
                Marker::Circle,
                [(middle, y)],
                WHITE,
                Stroke { colour: FLAGGED, width: 1.5, dash: None },
            ),
        }
    }
}

/// The line at the foot of a figure that counts the points it does not show.
pub(crate) fn skipped_note(skipped: usize) -> Option<String> {
    match skipped {
        0 => None,
        1 => Some("1 point without a drawable value is left out".to_owned()),
        n => Some(format!("{n} points without a drawable value are left out")),
    }
}
