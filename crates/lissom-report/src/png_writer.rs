//! A drawing as PNG.

use tiny_skia::{
    Color, FillRule, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

use crate::canvas::{Anchor, Drawing, Rect, Shape, Stroke, TextStyle};
use crate::figure_error::FigureError;
use crate::palette::{Colour, MARKER_RADIUS, Marker};
use crate::text_outline::outline;

/// The longest side of a raster image in pixels.
const LIMIT: u16 = 16_384;

/// Rasterises a drawing on white, `scale` pixels to one SVG unit, and returns the bytes of a PNG file.
pub(crate) fn png(drawing: &Drawing, scale: f32) -> Result<Vec<u8>, FigureError> {
    let (width, height) = (drawing.width as f32 * scale, drawing.height as f32 * scale);
    let size = || FigureError::Size { scale, width, height, limit: LIMIT };
    let (columns, rows) = pixels(width).zip(pixels(height)).ok_or_else(size)?;
    let mut pixmap = Pixmap::new(columns, rows).ok_or_else(size)?;
    pixmap.fill(Color::WHITE);
    let to_pixels = Transform::from_scale(scale, scale);
    Sheet { pixmap: &mut pixmap, mask: None, to_pixels }.draw(&drawing.shapes);
    pixmap.encode_png().map_err(|error| FigureError::Png { source: Box::new(error) })
}

/// A side in whole pixels, if it lies between 1 and [`LIMIT`].
fn pixels(side: f32) -> Option<u32> {
    let side = side.round();
    (1.0..=f32::from(LIMIT)).contains(&side).then_some(side as u32)
}

/// Pixels under way, and the part of them that may change.
struct Sheet<'a> {
    pixmap: &'a mut Pixmap,
    mask: Option<Mask>,
    to_pixels: Transform,
}

impl Sheet<'_> {
    fn draw(&mut self, shapes: &[Shape]) {
        for shape in shapes {
            match shape {
                Shape::Rect { rect, fill, opacity } => {
                    self.fill(rectangle(*rect), *fill, *opacity, self.to_pixels);
                }
                Shape::Lines { lines, stroke } => {
                    let mut path = PathBuilder::new();
                    for ends in lines {
                        broken_line(&mut path, ends);
                    }
                    self.stroke(path.finish(), *stroke, LineJoin::Round);
                }
                Shape::Polyline { points, stroke } => {
                    let mut path = PathBuilder::new();
                    broken_line(&mut path, points);
                    self.stroke(path.finish(), *stroke, LineJoin::Round);
                }
                Shape::Area { corners, fill, opacity } => {
                    let mut path = PathBuilder::new();
                    broken_line(&mut path, corners);
                    path.close();
                    self.fill(path.finish(), *fill, *opacity, self.to_pixels);
                }
                Shape::Markers { marker, places, fill, stroke } => {
                    let path = markers(*marker, places);
                    self.fill(path.clone(), *fill, 1.0, self.to_pixels);
                    self.stroke(path, *stroke, LineJoin::Miter);
                }
                Shape::Text { at, text, style } => self.text(*at, text, *style),
                Shape::Clipped { frame, shapes } => self.clipped(*frame, shapes),
            }
        }
    }

    fn fill(&mut self, path: Option<Path>, fill: Colour, opacity: f64, transform: Transform) {
        if let Some(path) = path {
            let (paint, mask) = (paint(fill, opacity), self.mask.as_ref());
            self.pixmap.fill_path(&path, &paint, FillRule::Winding, transform, mask);
        }
    }

    fn stroke(&mut self, path: Option<Path>, stroke: Stroke, line_join: LineJoin) {
        let Some(path) = path else { return };
        let dash = stroke.dash.map(|lengths| lengths.iter().copied().map(f32::from).collect());
        let pen = tiny_skia::Stroke {
            width: stroke.width as f32,
            dash: dash.and_then(|lengths| StrokeDash::new(lengths, 0.0)),
            line_join,
            ..tiny_skia::Stroke::default()
        };
        let (paint, mask) = (paint(stroke.colour, 1.0), self.mask.as_ref());
        self.pixmap.stroke_path(&path, &paint, &pen, self.to_pixels, mask);
    }

    fn text(&mut self, (x, y): (f64, f64), text: &str, style: TextStyle) {
        let line = outline(text, style.size, style.weight);
        let back = match style.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => line.width / 2.0,
            Anchor::End => line.width,
        };
        let mut place = self.to_pixels.pre_translate(x as f32, y as f32);
        if style.upward {
            place = place.pre_rotate(-90.0);
        }
        self.fill(line.path, style.colour, 1.0, place.pre_translate(-back, 0.0));
    }

    fn clipped(&mut self, frame: Rect, shapes: &[Shape]) {
        let outside = self.mask.clone();
        if let Some(frame) = rectangle(frame) {
            let (winding, smooth) = (FillRule::Winding, true);
            if let Some(mask) = &mut self.mask {
                mask.intersect_path(&frame, winding, smooth, self.to_pixels);
            } else if let Some(mut mask) = Mask::new(self.pixmap.width(), self.pixmap.height()) {
                mask.fill_path(&frame, winding, smooth, self.to_pixels);
                self.mask = Some(mask);
            }
            self.draw(shapes);
        }
        self.mask = outside;
    }
}

fn paint(colour: Colour, opacity: f64) -> Paint<'static> {
    let Colour { red, green, blue } = colour;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

/// A rectangle with a positive area.
fn rectangle(r: Rect) -> Option<Path> {
    let (left, top, width, height) = (r.left as f32, r.top as f32, r.width as f32, r.height as f32);
    (width > 0.0 && height > 0.0)
        .then(|| tiny_skia::Rect::from_xywh(left, top, width, height))
        .flatten()
        .map(PathBuilder::from_rect)
}

fn broken_line(path: &mut PathBuilder, points: &[(f64, f64)]) {
    for (k, (x, y)) in points.iter().enumerate() {
        let (x, y) = (*x as f32, *y as f32);
        if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
}

fn markers(marker: Marker, places: &[(f64, f64)]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (x, y) in places {
        let corners: Vec<_> = marker.corners().iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
        if corners.is_empty() {
            path.push_circle(*x as f32, *y as f32, MARKER_RADIUS as f32);
        } else {
            broken_line(&mut path, &corners);
            path.close();
        }
    }
    path.finish()
}

#[cfg(test)]
#[path = "png_writer_tests.rs"]
mod tests;
