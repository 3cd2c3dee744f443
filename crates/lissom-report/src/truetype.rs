//! The parts of a TrueType font that figures need: glyphs of characters, widths, kerning, outlines.
//!
//! It reads only the compiled-in fonts; a test compares every glyph of both with `skrifa`. Names of tables and fields
//! are those of the OpenType specification. A part that a font lacks or has wrong is `None`, an outline without points,
//! or a kerning of zero.

/// Composite glyphs are nested no deeper.
const DEEPEST: u8 = 6;
/// The bits of a simple glyph's flags.
mod simple {
    pub(super) const ON_CURVE: u8 = 0x01;
    pub(super) const X_SHORT: u8 = 0x02;
    pub(super) const Y_SHORT: u8 = 0x04;
    pub(super) const REPEAT: u8 = 0x08;
    pub(super) const X_SAME_OR_POSITIVE: u8 = 0x10;
    pub(super) const Y_SAME_OR_POSITIVE: u8 = 0x20;
}
/// The bits of a composite glyph's flags.
mod composite {
    pub(super) const WORDS: u16 = 0x0001;
    pub(super) const XY_VALUES: u16 = 0x0002;
    pub(super) const SCALE: u16 = 0x0008;
    pub(super) const MORE: u16 = 0x0020;
    pub(super) const X_AND_Y_SCALE: u16 = 0x0040;
    pub(super) const TWO_BY_TWO: u16 = 0x0080;
}

/// A glyph's number in its font.
pub(crate) type Glyph = u16;

/// A point of a contour in units of the font, y upward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GlyphPoint {
    pub(crate) x: f32,
    pub(crate) y: f32,
    /// On the curve; otherwise the control point of a quadratic curve.
    pub(crate) on: bool,
}

/// A font.
#[derive(Debug)]
pub(crate) struct TrueType {
    pub(crate) units_per_em: u16,
    /// The subtable of `cmap` in format 4: characters up to U+FFFF.
    characters: &'static [u8],
    glyf: &'static [u8],
    loca: &'static [u8],
    long_offsets: bool,
    hmtx: &'static [u8],
    /// Glyphs with a width of their own; the others have the last of these.
    widths: u16,
    /// Pairs of glyphs in order, six bytes each.
    pairs: &'static [u8],
}

impl TrueType {
    pub(crate) fn new(data: &'static [u8]) -> Option<Self> {
        let table = |tag: &[u8; 4]| {
            let record = data.get(12..)?.chunks_exact(16).find(|record| record.starts_with(tag))?;
            data.get(u32_at(record, 8)? as usize..)?.get(..u32_at(record, 12)? as usize)
        };
        let head = table(b"head")?;
        Some(Self {
            units_per_em: u16_at(head, 18)?,
            characters: characters(table(b"cmap")?)?,
            glyf: table(b"glyf")?,
            loca: table(b"loca")?,
            long_offsets: u16_at(head, 50)? != 0,
            hmtx: table(b"hmtx")?,
            widths: u16_at(table(b"hhea")?, 34)?,
            pairs: table(b"kern").and_then(pairs).unwrap_or(&[]),
        })
    }

    /// The glyph of a character, if the font has one.
    pub(crate) fn glyph(&self, c: char) -> Option<Glyph> {
        let (c, table) = (u16::try_from(u32::from(c)).ok()?, self.characters);
        let twice = u16_at(table, 6)? as usize;
        let (ends, starts) = (14, 16 + twice);
        let (deltas, offsets) = (starts + twice, starts + 2 * twice);
        let segment = (0..twice).step_by(2).find(|k| u16_at(table, ends + k) >= Some(c))?;
        let start = u16_at(table, starts + segment)?;
        let place = c.checked_sub(start)?;
        let delta = u16_at(table, deltas + segment)?;
        let glyph = match u16_at(table, offsets + segment)? {
            0 => c.wrapping_add(delta),
            offset => {
                let at = offsets + segment + offset as usize + 2 * place as usize;
                u16_at(table, at).filter(|glyph| *glyph != 0)?.wrapping_add(delta)
            }
        };
        Some(glyph).filter(|glyph| *glyph != 0)
    }

    /// How far the next glyph is from this one.
    pub(crate) fn advance(&self, glyph: Glyph) -> Option<u16> {
        u16_at(self.hmtx, 4 * glyph.min(self.widths.checked_sub(1)?) as usize)
    }

    /// What is added between two glyphs.
    pub(crate) fn kerning(&self, left: Glyph, right: Glyph) -> i16 {
        let pair = u32::from(left) << 16 | u32::from(right);
        let (pairs, _) = self.pairs.as_chunks::<6>();
        let found = pairs.binary_search_by_key(&pair, |p| u32_at(p, 0).unwrap_or(u32::MAX));
        found.ok().and_then(|k| i16_at(&pairs[k], 4)).unwrap_or(0)
    }

    /// The closed contours of a glyph.
    pub(crate) fn contours(&self, glyph: Glyph) -> Vec<Vec<GlyphPoint>> {
        self.nested(glyph, 0).unwrap_or_default()
    }

    fn nested(&self, glyph: Glyph, depth: u8) -> Option<Vec<Vec<GlyphPoint>>> {
        let offset = |index: usize| {
            if self.long_offsets {
                u32_at(self.loca, 4 * index).map(|offset| offset as usize)
            } else {
                u16_at(self.loca, 2 * index).map(|half| 2 * half as usize)
            }
        };
        let data = self.glyf.get(offset(glyph as usize)?..offset(glyph as usize + 1)?)?;
        match i16_at(data, 0)? {
            count @ 0.. => simple_contours(data, count as usize),
            _ if depth < DEEPEST => self.parts(data, depth),
            _ => None,
        }
    }

    /// A glyph that is made of others.
    fn parts(&self, data: &[u8], depth: u8) -> Option<Vec<Vec<GlyphPoint>>> {
        let (mut contours, mut at) = (Vec::new(), 10);
        loop {
            let (flags, part) = (u16_at(data, at)?, u16_at(data, at + 2)?);
            // Parts that are joined at points, which the compiled-in fonts do not have.
            if flags & composite::XY_VALUES == 0 {
                return None;
            }
            let (dx, dy);
            if flags & composite::WORDS != 0 {
                (dx, dy) = (i16_at(data, at + 4)?, i16_at(data, at + 6)?);
                at += 8;
            } else {
                let byte = |at: usize| data.get(at).map(|b| i16::from(b.cast_signed()));
                (dx, dy) = (byte(at + 4)?, byte(at + 5)?);
                at += 6;
            }
            let factor = |k: usize| i16_at(data, at + 2 * k).map(|f| f32::from(f) / 16_384.0);
            let (matrix, size) = if flags & composite::SCALE != 0 {
                ([factor(0)?, 0.0, 0.0, factor(0)?], 2)
            } else if flags & composite::X_AND_Y_SCALE != 0 {
                ([factor(0)?, 0.0, 0.0, factor(1)?], 4)
            } else if flags & composite::TWO_BY_TWO != 0 {
                ([factor(0)?, factor(1)?, factor(2)?, factor(3)?], 8)
            } else {
                ([1.0, 0.0, 0.0, 1.0], 0)
            };
            at += size;
            let [xx, xy, yx, yy] = matrix;
            let placed = |p: GlyphPoint| GlyphPoint {
                x: xx * p.x + yx * p.y + f32::from(dx),
                y: xy * p.x + yy * p.y + f32::from(dy),
                on: p.on,
            };
            let part = self.nested(part, depth + 1).unwrap_or_default();
            contours.extend(part.into_iter().map(|c| c.into_iter().map(placed).collect()));
            if flags & composite::MORE == 0 {
                return Some(contours);
            }
        }
    }
}

/// The contours of a glyph that has its own points.
fn simple_contours(data: &[u8], count: usize) -> Option<Vec<Vec<GlyphPoint>>> {
    let ends = (0..count).map(|k| u16_at(data, 10 + 2 * k).map(usize::from));
    let ends = ends.collect::<Option<Vec<_>>>()?;
    let points = ends.last().map_or(0, |last| last + 1);
    let mut at = 10 + 2 * count;
    at += 2 + u16_at(data, at)? as usize;
    let mut flags = Vec::with_capacity(points);
    while flags.len() < points {
        let flag = *data.get(at)?;
        at += 1;
        let mut times = 1;
        if flag & simple::REPEAT != 0 {
            times += *data.get(at)? as usize;
            at += 1;
        }
        flags.extend(std::iter::repeat_n(flag, times));
    }
    flags.truncate(points);
    let x = coordinates(data, &mut at, &flags, simple::X_SHORT, simple::X_SAME_OR_POSITIVE)?;
    let y = coordinates(data, &mut at, &flags, simple::Y_SHORT, simple::Y_SAME_OR_POSITIVE)?;
    let point = |k: usize| GlyphPoint { x: x[k], y: y[k], on: flags[k] & simple::ON_CURVE != 0 };
    let starts = std::iter::once(0).chain(ends.iter().map(|end| end + 1));
    Some(starts.zip(&ends).map(|(start, end)| (start..=*end).map(point).collect()).collect())
}

/// Coordinates from their differences.
fn coordinates(
    data: &[u8],
    at: &mut usize,
    flags: &[u8],
    short: u8,
    same_or_positive: u8,
) -> Option<Vec<f32>> {
    let mut value = 0_i16;
    let mut next = |flag: &u8| {
        let step = match (flag & short != 0, flag & same_or_positive != 0) {
            (true, positive) => {
                let size = i16::from(*data.get(*at)?);
                *at += 1;
                if positive { size } else { -size }
            }
            (false, true) => 0,
            (false, false) => {
                *at += 2;
                i16_at(data, *at - 2)?
            }
        };
        value = value.wrapping_add(step);
        Some(f32::from(value))
    };
    flags.iter().map(&mut next).collect()
}

/// The Unicode subtable of `cmap` in format 4.
fn characters(cmap: &'static [u8]) -> Option<&'static [u8]> {
    let records = cmap.get(4..)?.chunks_exact(8).take(u16_at(cmap, 2)? as usize);
    let mut tables = records.filter_map(|record| cmap.get(u32_at(record, 4)? as usize..));
    tables.find(|table| u16_at(table, 0) == Some(4))
}

/// The pairs of `kern`, if its first subtable is one of horizontal pairs.
fn pairs(kern: &'static [u8]) -> Option<&'static [u8]> {
    const HORIZONTAL_FORMAT_0: u16 = 1;
    if u16_at(kern, 0)? != 0 || u16_at(kern, 8)? != HORIZONTAL_FORMAT_0 {
        return None;
    }
    kern.get(18..)?.get(..6 * u16_at(kern, 10)? as usize)
}

fn u16_at(data: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(*data.get(at..)?.first_chunk()?))
}

fn i16_at(data: &[u8], at: usize) -> Option<i16> {
    Some(i16::from_be_bytes(*data.get(at..)?.first_chunk()?))
}

fn u32_at(data: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(*data.get(at..)?.first_chunk()?))
}

#[cfg(test)]
#[path = "truetype_tests.rs"]
mod tests;
