//! A drawing as a PDF of one page: lines and outlines that can be scaled, without fonts.

use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::writers::ExtGraphicsState;
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Ref, TextStr};
use tiny_skia::{Path, PathSegment, Point, Transform};

use crate::canvas::{Anchor, Drawing, Rect, Shape, Stroke, TextStyle};
use crate::palette::{Colour, MARKER_RADIUS, Marker};
use crate::text_outline::outline;

/// Points of a PDF (1/72 inch) for one SVG unit (1/96 inch).
const POINTS: f32 = 0.75;
/// Places after the decimal point, as a power of ten.
const PLACES: f32 = 100.0;
/// Level of compression, 0 to 10.
const LEVEL: u8 = 6;
/// Length of the handles of a quarter of a circle, relative to its radius.
const QUARTER: f64 = 0.552_284_75;
/// Opacity in percent of a shape that hides what is below.
const OPAQUE: u8 = 100;

/// The complete document.
pub(crate) fn pdf(drawing: &Drawing) -> Vec<u8> {
    let [catalog, pages, page, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let (width, height) = (drawing.width as f32 * POINTS, drawing.height as f32 * POINTS);
    let mut sheet = Sheet { content: Content::new(), opacities: Vec::new() };
    // The sheet of the shapes begins at the top left, that of a PDF at the bottom left.
    sheet.content.transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
    sheet.content.set_line_cap(LineCapStyle::ButtCap);
    sheet.draw(&drawing.shapes);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut writer = pdf.page(page);
    writer
        .media_box(pdf_writer::Rect::new(0.0, 0.0, width, height))
        .parent(pages)
        .contents(content);
    let mut resources = writer.resources();
    let mut states = resources.ext_g_states();
    for percent in &sheet.opacities {
        let name = state_name(*percent);
        let mut state: ExtGraphicsState<'_> = states.insert(Name(name.as_bytes())).start();
        state.non_stroking_alpha(f32::from(*percent) / f32::from(OPAQUE));
    }
    states.finish();
    resources.finish();
    writer.finish();
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&sheet.content.finish(), LEVEL);
    pdf.stream(content, &packed).filter(Filter::FlateDecode);
    pdf.document_info(info).title(TextStr(&drawing.title)).producer(TextStr("lissom"));
    pdf.finish()
}

/// Name of the graphics state with an opacity.
fn state_name(percent: u8) -> String {
    format!("A{percent}")
}

/// A page under way.
struct Sheet {
    content: Content,
    /// Opacities in use, in percent.
    opacities: Vec<u8>,
}

impl Sheet {
    fn draw(&mut self, shapes: &[Shape]) {
        for shape in shapes {
            match shape {
                Shape::Rect { rect, fill, opacity } => self.rectangle(*rect, *fill, *opacity),
                Shape::Lines { lines, stroke } => {
                    self.pen(*stroke, LineJoinStyle::RoundJoin);
                    for ends in lines {
                        self.broken_line(ends);
                    }
                    self.content.stroke();
                }
                Shape::Polyline { points, stroke } => {
                    self.pen(*stroke, LineJoinStyle::RoundJoin);
                    self.broken_line(points);
                    self.content.stroke();
                }
                Shape::Area { corners, fill, opacity } => {
                    self.see_through(*fill, *opacity);
                    self.broken_line(corners);
                    self.content.close_path().fill_nonzero().restore_state();
                }
                Shape::Markers { marker, places, fill, stroke } => {
                    self.pen(*stroke, LineJoinStyle::MiterJoin);
                    self.ink(*fill);
                    for place in places {
                        self.marker(*marker, *place);
                    }
                    self.content.fill_nonzero_and_stroke();
                }
                Shape::Text { at, text, style } => self.text(*at, text, *style),
                Shape::Clipped { frame, shapes } => {
                    self.content.save_state();
                    self.corners(*frame);
                    self.content.clip_nonzero().end_path();
                    self.draw(shapes);
                    self.content.restore_state();
                }
            }
        }
    }

    fn rectangle(&mut self, rect: Rect, fill: Colour, opacity: f64) {
        self.see_through(fill, opacity);
        self.corners(rect);
        self.content.fill_nonzero().restore_state();
    }

    /// Sets colour and opacity of areas, until the state is restored.
    fn see_through(&mut self, fill: Colour, opacity: f64) {
        let percent = (f64::from(OPAQUE) * opacity).round() as u8;
        self.content.save_state();
        if percent < OPAQUE {
            if !self.opacities.contains(&percent) {
                self.opacities.push(percent);
            }
            self.content.set_parameters(Name(state_name(percent).as_bytes()));
        }
        self.ink(fill);
    }

    /// Sets the look of lines, which must not change within a path.
    fn pen(&mut self, stroke: Stroke, join: LineJoinStyle) {
        let [red, green, blue] = shares(stroke.colour);
        let dash = stroke.dash.unwrap_or_default().iter().map(|length| f32::from(*length));
        self.content
            .set_stroke_rgb(red, green, blue)
            .set_line_width(stroke.width as f32)
            .set_line_join(join)
            .set_dash_pattern(dash, 0.0);
    }

    /// Sets the colour of areas.
    fn ink(&mut self, fill: Colour) {
        let [red, green, blue] = shares(fill);
        self.content.set_fill_rgb(red, green, blue);
    }

    fn corners(&mut self, r: Rect) {
        let [left, top, width, height] = [r.left, r.top, r.width, r.height].map(rounded);
        self.content.rect(left, top, width, height);
    }

    fn broken_line(&mut self, points: &[(f64, f64)]) {
        for (k, (x, y)) in points.iter().enumerate() {
            let (x, y) = (rounded(*x), rounded(*y));
            if k == 0 {
                self.content.move_to(x, y)
            } else {
                self.content.line_to(x, y)
            };
        }
    }

    fn marker(&mut self, marker: Marker, (x, y): (f64, f64)) {
        let corners: Vec<_> = marker.corners().iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
        if corners.is_empty() {
            self.circle((x, y), MARKER_RADIUS);
        } else {
            self.broken_line(&corners);
        }
        self.content.close_path();
    }

    fn circle(&mut self, (x, y): (f64, f64), radius: f64) {
        let at = |(dx, dy): (f64, f64)| (rounded(x + radius * dx), rounded(y + radius * dy));
        let (start_x, start_y) = at((1.0, 0.0));
        self.content.move_to(start_x, start_y);
        // Directions of the ends of the quarters.
        for ((ax, ay), (bx, by)) in [
            ((1.0, 0.0), (0.0, 1.0)),
            ((0.0, 1.0), (-1.0, 0.0)),
            ((-1.0, 0.0), (0.0, -1.0)),
            ((0.0, -1.0), (1.0, 0.0)),
        ] {
            let (x1, y1) = at((ax + QUARTER * bx, ay + QUARTER * by));
            let (x2, y2) = at((bx + QUARTER * ax, by + QUARTER * ay));
            let (x3, y3) = at((bx, by));
            self.content.cubic_to(x1, y1, x2, y2, x3, y3);
        }
    }

    /// Adds a text as outlines: no reader needs its font.
    fn text(&mut self, (x, y): (f64, f64), text: &str, style: TextStyle) {
        let line = outline(text, style.size, style.weight);
        let Some(path) = line.path else { return };
        let back = match style.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => line.width / 2.0,
            Anchor::End => line.width,
        };
        let mut place = Transform::from_translate(x as f32, y as f32);
        if style.upward {
            place = place.pre_rotate(-90.0);
        }
        let Some(path) = path.transform(place.pre_translate(-back, 0.0)) else { return };
        self.ink(style.colour);
        self.outline(&path);
        self.content.fill_nonzero();
    }

    fn outline(&mut self, path: &Path) {
        let round = |p: Point| (rounded(f64::from(p.x)), rounded(f64::from(p.y)));
        let mut last = Point::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    let (x, y) = round(p);
                    self.content.move_to(x, y);
                    last = p;
                }
                PathSegment::LineTo(p) => {
                    let (x, y) = round(p);
                    self.content.line_to(x, y);
                    last = p;
                }
                PathSegment::QuadTo(control, p) => {
                    // The same curve with two control points.
                    let toward = |end: Point| {
                        let part = |a: f32, b: f32| a + 2.0 / 3.0 * (b - a);
                        round(Point::from_xy(part(end.x, control.x), part(end.y, control.y)))
                    };
                    let ((x1, y1), (x2, y2), (x3, y3)) = (toward(last), toward(p), round(p));
                    self.content.cubic_to(x1, y1, x2, y2, x3, y3);
                    last = p;
                }
                PathSegment::CubicTo(first, second, p) => {
                    let ((x1, y1), (x2, y2), (x3, y3)) = (round(first), round(second), round(p));
                    self.content.cubic_to(x1, y1, x2, y2, x3, y3);
                    last = p;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }
}

/// Shares of red, green and blue, 0 to 1.
fn shares(colour: Colour) -> [f32; 3] {
    [colour.red, colour.green, colour.blue].map(|share| f32::from(share) / 255.0)
}

/// A coordinate with few digits.
fn rounded(value: f64) -> f32 {
    (value as f32 * PLACES).round() / PLACES
}

#[cfg(test)]
mod tests {
    use crate::{Axis, Band, Figure as _, LinePlot, Role, Trace};

    fn plot() -> LinePlot {
        let x = vec![0.0, 1.0, 2.0];
        LinePlot::new("Angle & torque", Axis::linear("time (s)"), Axis::linear("angle (rad)"))
            .trace(Trace::line("measured", Role::Truth, x.clone(), vec![0.0, 1.0, 0.5]))
            .trace(Trace::points_with_bars(
                "pairs",
                Role::Corrected,
                x,
                vec![0.1, 0.9, 0.4],
                vec![0.1; 3],
            ))
            .band(Band::new("95 %", Role::Fitted, 0.5, (0.4, 0.6)))
    }

    /// The operators of the page.
    fn content(pdf: &[u8]) -> String {
        let find = |mark: &[u8]| pdf.windows(mark.len()).position(|part| part == mark).unwrap();
        let (begin, end) = (
            find(
                b"stream
",
            ) + 7,
            find(
                b"
endstream",
            ),
        );
        let plain = miniz_oxide::inflate::decompress_to_vec_zlib(&pdf[begin..end]).unwrap();
        String::from_utf8(plain).unwrap()
    }

    #[test]
    fn a_pdf_has_one_page_whose_table_of_objects_is_right() {
        let pdf = plot().to_pdf().unwrap();
        assert!(pdf.starts_with(b"%PDF-1.7") && pdf.ends_with(b"%%EOF"));
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.contains("/Count 1") && text.contains("/Title (Angle & torque)"), "{text}");
        // The last number is the place of the table, in which each entry is the place of an object.
        let number = |text: &str| text.trim().parse::<usize>().unwrap();
        let table = number(text.rsplit("startxref").next().unwrap().trim_end_matches("%%EOF"));
        let rest = String::from_utf8_lossy(&pdf[table..]);
        assert!(rest.starts_with("xref"));
        for (k, entry) in rest.lines().skip(3).take_while(|line| line.contains(" n")).enumerate() {
            let place = number(&entry[..10]);
            assert!(pdf[place..].starts_with(format!("{} 0 obj", k + 1).as_bytes()), "{entry}");
        }
    }

    #[test]
    fn lines_areas_and_text_are_drawn_and_states_are_closed() {
        let content = content(&plot().to_pdf().unwrap());
        let count =
            |operator: &str| content.lines().filter(|line| line.ends_with(operator)).count();
        assert_eq!(count("q"), count("Q"));
        assert!(count(" d") > 0 && content.contains("[8 4] 0 d"), "dashes");
        assert!(content.contains("/A16 gs"), "shade of the band");
        // No operator of the state stands within a path.
        let mut open = false;
        for line in content.lines() {
            let operator = line.rsplit(' ').next().unwrap();
            match operator {
                "m" | "l" | "c" | "h" | "re" => open = true,
                "S" | "f" | "B" | "n" => open = false,
                "W" => {}
                _ => assert!(!open, "{line}"),
            }
        }
    }
}
