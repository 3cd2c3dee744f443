//! The width of text, and text that fits a width.

use crate::font::{Weight, font};

/// The advance of characters that the font lacks, in units of the font size.
const UNKNOWN_ADVANCE: f64 = 0.8;

/// The width of `text` at a font size of `size`, in the same unit.
pub(crate) fn width(text: &str, size: f64, weight: Weight) -> f64 {
    let Some(font) = font(weight) else {
        return UNKNOWN_ADVANCE * size * text.chars().count() as f64;
    };
    let advance = |c| {
        let units = font.glyph(c).and_then(|glyph| font.advance(glyph));
        units.map_or(UNKNOWN_ADVANCE, |units| f64::from(units) / f64::from(font.units_per_em))
    };
    size * text.chars().map(advance).sum::<f64>()
}

/// `text` cut with an ellipsis if it is wider than `limit`.
pub(crate) fn shorten(text: &str, size: f64, weight: Weight, limit: f64) -> String {
    if width(text, size, weight) <= limit {
        return text.to_owned();
    }
    let mut kept: Vec<char> = text.chars().collect();
    loop {
        // Long text is cut by halves first, so that its length costs little.
        let whole: String = kept.iter().collect();
        let excess = width(&whole, size, weight) / limit.max(size);
        let keep = if excess > 2.0 { kept.len() / 2 } else { kept.len().saturating_sub(1) };
        kept.truncate(keep);
        let short: String = kept.iter().collect::<String>().trim_end().to_owned() + "…";
        if keep == 0 || width(&short, size, weight) <= limit {
            return short;
        }
    }
}

/// `text` broken at spaces into at most `lines` lines no wider than `limit`; if it is longer, it ends in an ellipsis.
pub(crate) fn wrap(text: &str, size: f64, weight: Weight, limit: f64, lines: usize) -> Vec<String> {
    let mut broken: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let full = broken.len() >= lines;
        match broken.last_mut() {
            Some(line) if broken_fits(line, word, size, weight, limit) => {
                line.push(' ');
                line.push_str(word);
            }
            Some(line) if full => {
                line.push(' ');
                line.push_str(word);
                break;
            }
            _ => broken.push(word.to_owned()),
        }
    }
    broken.iter().map(|line| shorten(line, size, weight, limit)).collect()
}

fn broken_fits(line: &str, word: &str, size: f64, weight: Weight, limit: f64) -> bool {
    width(line, size, weight) + width(" ", size, weight) + width(word, size, weight) <= limit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_follow_the_font() {
        let (thin, wide) =
            (width("iiii", 10.0, Weight::Regular), width("mmmm", 10.0, Weight::Regular));
        assert!(thin > 5.0 && thin * 2.0 < wide && wide < 50.0, "{thin} {wide}");
        assert!(width("abc", 10.0, Weight::Bold) > width("abc", 10.0, Weight::Regular));
    }

    #[test]
    fn long_text_is_shortened_and_wrapped() {
        let long = "word ".repeat(500);
        let short = shorten(&long, 10.0, Weight::Regular, 100.0);
        assert!(short.ends_with('…') && width(&short, 10.0, Weight::Regular) <= 100.0);
        let lines = wrap(&long, 10.0, Weight::Regular, 100.0, 3);
        assert_eq!(lines.len(), 3);
        assert!(lines.iter().all(|line| width(line, 10.0, Weight::Regular) <= 100.0));
        assert!(lines[2].ends_with('…'));
        assert_eq!(shorten("abc", 10.0, Weight::Regular, 0.0), "…");
    }
}
