//! SVG to PNG with the compiled-in fonts.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree, fontdb};

use crate::error::FigureError;
use crate::text::FAMILY;

/// The longest side of a raster image in pixels.
const LIMIT: u16 = 16_384;

static FONTS: LazyLock<Arc<fontdb::Database>> = LazyLock::new(|| {
    let mut fonts = fontdb::Database::new();
    for face in [dejavu::sans::regular(), dejavu::sans::bold()] {
        fonts.load_font_source(fontdb::Source::Binary(Arc::new(face)));
    }
    fonts.set_sans_serif_family(FAMILY);
    Arc::new(fonts)
});

/// Rasterises an SVG document on white, `scale` pixels to one SVG unit, and returns the bytes of a PNG file.
///
/// Text is set in DejaVu Sans whatever fonts the machine has. References to images outside the document are not followed.
///
/// # Errors
///
/// [`FigureError::Svg`] when the text is no SVG document, [`FigureError::Size`] when the picture would have no pixel or a side
/// of more than 16384, [`FigureError::Png`] when the encoder fails.
pub fn svg_to_png(svg: &str, scale: f32) -> Result<Vec<u8>, FigureError> {
    let options = Options {
        font_family: FAMILY.to_owned(),
        fontdb: Arc::clone(&FONTS),
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    let tree = Tree::from_str(svg, &options)
        .map_err(|error| FigureError::Svg { source: Box::new(error) })?;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    let size = || FigureError::Size { scale, width, height, limit: LIMIT };
    let (columns, rows) = pixels(width).zip(pixels(height)).ok_or_else(size)?;
    let mut pixmap = Pixmap::new(columns, rows).ok_or_else(size)?;
    pixmap.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|error| FigureError::Png { source: Box::new(error) })
}

/// A side in whole pixels, where it lies between 1 and [`LIMIT`].
fn pixels(side: f32) -> Option<u32> {
    let side = side.round();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the range is checked before the cast"
    )]
    (1.0..=f32::from(LIMIT)).contains(&side).then_some(side as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="30" height="20"><text x="2" y="15">m</text></svg>"#;

    #[test]
    fn png_has_the_scaled_size_and_ink() {
        let picture = Pixmap::decode_png(&svg_to_png(SQUARE, 2.0).unwrap()).unwrap();
        assert_eq!((picture.width(), picture.height()), (60, 40));
        assert!(
            picture.pixels().iter().any(|p| p.red() < 64),
            "the compiled-in font draws the letter"
        );
        assert!(picture.pixels().iter().all(|p| p.alpha() == 255), "the ground is opaque");
    }

    #[test]
    fn impossible_pictures_are_errors() {
        for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e6] {
            assert!(matches!(svg_to_png(SQUARE, scale), Err(FigureError::Size { .. })), "{scale}");
        }
        assert!(matches!(svg_to_png("not svg", 1.0), Err(FigureError::Svg { .. })));
    }
}
