//! A line of text as the outlines of its glyphs.

use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::raw::TableProvider as _;
use skrifa::raw::tables::kern::{Subtable0, SubtableKind};
use skrifa::{FontRef, GlyphId, MetadataProvider as _};
use tiny_skia::{Path, PathBuilder};

use crate::font::{Weight, font};

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
    let size = size as f32;
    let mut pen = Pen { path: PathBuilder::new(), x: 0.0 };
    let Some(face) = Face::new(weight, size) else { return TextOutline { path: None, width: 0.0 } };
    let fallback = Face::new(Weight::Regular, size);
    let mut last = None;
    for c in shown(text).chars() {
        let glyph = face.glyph(c);
        let (face, glyph) = match (glyph, &fallback) {
            (None, Some(other)) => (other, other.glyph(c)),
            _ => (&face, glyph),
        };
        // Glyph 0 is the box that stands for what the font lacks.
        let glyph = glyph.unwrap_or(GlyphId::NOTDEF);
        pen.x += last.map_or(0.0, |before| face.kerning(before, glyph));
        face.draw(glyph, &mut pen);
        pen.x += face.advance(glyph);
        last = Some(glyph);
    }
    TextOutline { width: pen.x, path: pen.path.finish() }
}

/// `text` with its blanks as SVG shows them, and U+FFFD in place of control characters, as in the SVG.
fn shown(text: &str) -> String {
    let words = text.split([' ', '\t', '\n', '\r']).filter(|word| !word.is_empty());
    let text = words.collect::<Vec<_>>().join(" ");
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// A font at a size.
struct Face {
    font: &'static FontRef<'static>,
    size: f32,
    kerning: Option<Subtable0<'static>>,
    units_per_em: f32,
}

impl Face {
    fn new(weight: Weight, size: f32) -> Option<Self> {
        let font = font(weight)?;
        let units_per_em = f32::from(font.head().ok()?.units_per_em());
        Some(Self { font, size, kerning: pairs(font), units_per_em })
    }

    fn glyph(&self, c: char) -> Option<GlyphId> {
        self.font.charmap().map(c)
    }

    fn advance(&self, glyph: GlyphId) -> f32 {
        let metrics = self.font.glyph_metrics(Size::new(self.size), LocationRef::default());
        metrics.advance_width(glyph).unwrap_or(0.0)
    }

    /// What the font adds between two glyphs.
    fn kerning(&self, left: GlyphId, right: GlyphId) -> f32 {
        let units = self.kerning.as_ref().and_then(|pairs| pairs.kerning(left, right)).unwrap_or(0);
        self.size * units as f32 / self.units_per_em
    }

    fn draw(&self, glyph: GlyphId, pen: &mut Pen) {
        if let Some(outline) = self.font.outline_glyphs().get(glyph) {
            let settings = DrawSettings::unhinted(Size::new(self.size), LocationRef::default());
            // A glyph that cannot be drawn leaves its place blank.
            let _ = outline.draw(settings, pen);
        }
    }
}

/// The kerning pairs for text from left to right.
fn pairs(font: &FontRef<'static>) -> Option<Subtable0<'static>> {
    let table = font.kern().ok()?;
    table.subtables().flatten().filter(|t| t.is_horizontal() && !t.is_cross_stream()).find_map(
        |table| match table.kind() {
            Ok(SubtableKind::Format0(pairs)) => Some(pairs),
            _ => None,
        },
    )
}

/// Collects outlines to the right of `x`, y turned downward.
struct Pen {
    path: PathBuilder,
    x: f32,
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.x + x, -y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.x + x, -y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.path.quad_to(self.x + cx, -cy, self.x + x, -y);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.path.cubic_to(self.x + cx0, -cy0, self.x + cx1, -cy1, self.x + x, -y);
    }

    fn close(&mut self) {
        self.path.close();
    }
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
