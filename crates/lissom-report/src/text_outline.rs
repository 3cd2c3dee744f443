//! A line of text as the outlines of its glyphs.

use tiny_skia::{Path, PathBuilder};

use crate::font::{Weight, font};
use crate::truetype::{Glyph, GlyphPoint};

/// The box for a character that the font lacks.
const MISSING: Glyph = 0;

/// A line of text as one shape.
pub(crate) struct TextOutline {
    /// The outlines, the start of the baseline at the origin, y downward; `None` without ink.
    pub(crate) path: Option<Path>,
    /// The width.
    pub(crate) width: f32,
}

/// The outline of `text` at a font size of `size`, set from left to right with the kerning of the font.
///
/// Blanks are those that SVG shows: runs of them count as one, and none is at either end.
pub(crate) fn outline(text: &str, size: f64, weight: Weight) -> TextOutline {
    let (Some(font), Some(fallback)) = (font(weight), font(Weight::Regular)) else {
        return TextOutline { path: None, width: 0.0 };
    };
    let scale = size as f32 / f32::from(font.units_per_em);
    let mut pen = Pen { path: PathBuilder::new(), x: 0.0, scale };
    let mut last = None;
    for c in shown(text).chars() {
        let (font, glyph) = match (font.glyph(c), fallback.glyph(c)) {
            (Some(glyph), _) => (font, glyph),
            (None, Some(glyph)) => (fallback, glyph),
            (None, None) => (font, MISSING),
        };
        pen.x += scale * last.map_or(0.0, |before| f32::from(font.kerning(before, glyph)));
        for contour in font.contours(glyph) {
            pen.contour(&contour);
        }
        pen.x += scale * font.advance(glyph).map_or(0.0, f32::from);
        last = Some(glyph);
    }
    TextOutline { width: pen.x, path: pen.path.finish() }
}

/// `text` with its blanks as SVG shows them, and U+FFFD instead of control characters, as in the SVG.
fn shown(text: &str) -> String {
    let words = text.split([' ', '\t', '\n', '\r']).filter(|word| !word.is_empty());
    let text = words.collect::<Vec<_>>().join(" ");
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// Collects outlines to the right of `x`, scaled and with y turned downward.
pub(crate) struct Pen {
    pub(crate) path: PathBuilder,
    pub(crate) x: f32,
    pub(crate) scale: f32,
}

impl Pen {
    /// Adds a closed contour. Between two control points there is a point of the curve in the middle.
    pub(crate) fn contour(&mut self, points: &[GlyphPoint]) {
        let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
        let (start, rest) = match (first.on, last.on) {
            (true, _) => (*first, &points[1..]),
            (false, true) => (*last, &points[..points.len() - 1]),
            (false, false) => (middle(*first, *last), points),
        };
        let (x, y) = self.at(start);
        self.path.move_to(x, y);
        let mut control = None;
        for point in rest {
            match (control, point.on) {
                (None, true) => {
                    let (x, y) = self.at(*point);
                    self.path.line_to(x, y);
                }
                (Some(before), true) => self.curve(before, *point),
                (Some(before), false) => self.curve(before, middle(before, *point)),
                (None, false) => {}
            }
            control = Some(*point).filter(|point| !point.on);
        }
        if let Some(before) = control {
            self.curve(before, start);
        }
        self.path.close();
    }

    fn curve(&mut self, control: GlyphPoint, end: GlyphPoint) {
        let ((cx, cy), (x, y)) = (self.at(control), self.at(end));
        self.path.quad_to(cx, cy, x, y);
    }

    fn at(&self, point: GlyphPoint) -> (f32, f32) {
        (self.x + self.scale * point.x, -self.scale * point.y)
    }
}

fn middle(a: GlyphPoint, b: GlyphPoint) -> GlyphPoint {
    GlyphPoint { x: 0.5 * (a.x + b.x), y: 0.5 * (a.y + b.y), on: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width_of(text: &str) -> f32 {
        outline(text, 100.0, Weight::Regular).width
    }

    #[test]
    fn letters_stand_on_the_baseline_and_advance() {
        let x = outline("x", 100.0, Weight::Regular).path.unwrap().bounds();
        assert!(x.left() >= 0.0 && x.top() < -50.0 && x.bottom().abs() < 1.0, "{x:?}");
        let two = outline("xx", 100.0, Weight::Regular).path.unwrap().bounds();
        assert!((two.right() - x.right() - width_of("x")).abs() < 0.1, "{two:?}");
    }

    #[test]
    fn pairs_are_kerned() {
        assert!(width_of("AV") < width_of("A") + width_of("V") - 2.0);
        assert!((width_of("nn") - 2.0 * width_of("n")).abs() < 1e-3);
    }

    #[test]
    fn blanks_are_those_of_svg_and_missing_letters_are_boxes() {
        assert!((width_of(" a \t\n b ") - width_of("a b")).abs() < 1e-3);
        assert!(outline(" ", 100.0, Weight::Regular).path.is_none());
        assert!(outline("\u{4e2d}", 100.0, Weight::Bold).path.is_some());
    }
}
