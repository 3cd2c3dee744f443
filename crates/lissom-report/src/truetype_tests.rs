use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::raw::TableProvider as _;
use skrifa::raw::tables::kern::SubtableKind;
use skrifa::{FontRef, GlyphId, MetadataProvider as _};
use tiny_skia::PathBuilder;

use super::*;
use crate::text_outline::Pen;

struct Reference(PathBuilder);

impl OutlinePen for Reference {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, -y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, -y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.0.quad_to(cx, -cy, x, -y);
    }

    fn curve_to(&mut self, _: f32, _: f32, _: f32, _: f32, _: f32, _: f32) {
        panic!("TrueType has no cubic curves");
    }

    fn close(&mut self) {
        self.0.close();
    }
}

fn fonts() -> [(TrueType, FontRef<'static>); 2] {
    [dejavu::sans::regular(), dejavu::sans::bold()]
        .map(|data| (TrueType::new(data).unwrap(), FontRef::new(data).unwrap()))
}

#[test]
fn every_outline_is_that_of_skrifa() {
    for (own, reference) in fonts() {
        let outlines = reference.outline_glyphs();
        let count = reference.maxp().unwrap().num_glyphs();
        assert!(count > 5000, "{count}");
        for glyph in 0..count {
            let mut expected = Reference(PathBuilder::new());
            let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
            outlines.get(GlyphId::from(glyph)).unwrap().draw(settings, &mut expected).unwrap();
            let mut found = Pen { path: PathBuilder::new(), x: 0.0, scale: 1.0 };
            own.contours(glyph).iter().for_each(|contour| found.contour(contour));
            let (found, expected) = (found.path.finish(), expected.0.finish());
            match (&found, &expected) {
                (Some(found), Some(expected)) => {
                    assert_eq!(found.verbs(), expected.verbs(), "{glyph}");
                    for (a, b) in found.points().iter().zip(expected.points()) {
                        // Rounded to whole units there, where a part of a glyph is scaled.
                        assert!((a.x - b.x).abs() <= 1.0 && (a.y - b.y).abs() <= 1.0, "{glyph}");
                    }
                }
                _ => assert_eq!(found, expected, "{glyph}"),
            }
        }
    }
}

#[test]
fn every_character_and_width_is_that_of_skrifa() {
    for (own, reference) in fonts() {
        let (map, metrics) = (
            reference.charmap(),
            reference.glyph_metrics(Size::unscaled(), LocationRef::default()),
        );
        for c in '\0'..='\u{ffff}' {
            let glyph = own.glyph(c);
            assert_eq!(glyph.map(GlyphId::from), map.map(c), "{c:?}");
            let advance = glyph.and_then(|glyph| own.advance(glyph)).map(f32::from);
            assert_eq!(advance, map.map(c).and_then(|g| metrics.advance_width(g)), "{c:?}");
        }
        assert_eq!(own.units_per_em, reference.head().unwrap().units_per_em());
    }
}

#[test]
fn every_pair_is_kerned_as_by_skrifa() {
    for (own, reference) in fonts() {
        let table = reference.kern().unwrap().subtables().next().unwrap().unwrap();
        let Ok(SubtableKind::Format0(pairs)) = table.kind() else { panic!("pairs") };
        let letters: Vec<Glyph> = (' '..'\u{250}').filter_map(|c| own.glyph(c)).collect();
        let mut kerned = 0;
        for left in &letters {
            for right in &letters {
                let expected = pairs.kerning(GlyphId::from(*left), GlyphId::from(*right));
                assert_eq!(i32::from(own.kerning(*left, *right)), expected.unwrap_or(0));
                kerned += usize::from(expected.is_some());
            }
        }
        assert!(kerned > 500, "{kerned}");
    }
}

#[test]
fn a_file_that_is_cut_off_is_no_panic() {
    let data = dejavu::sans::regular();
    for length in (0..400).chain((400..data.len()).step_by(20_011)) {
        if let Some(font) = TrueType::new(&data[..length]) {
            for glyph in (0..u16::MAX).step_by(997) {
                let _ = (font.contours(glyph), font.advance(glyph), font.kerning(glyph, glyph));
            }
        }
    }
}
