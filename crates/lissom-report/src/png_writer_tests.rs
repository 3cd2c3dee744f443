use super::*;
use crate::canvas::Canvas;
use crate::font::Weight;
use crate::palette::INK;

const RED: Colour = Colour::rgb(0xff, 0x00, 0x00);
const WIDTH: f64 = 60.0;
const HEIGHT: f64 = 40.0;

fn picture(scale: f32, draw: impl FnOnce(&mut Canvas)) -> Pixmap {
    let mut canvas = Canvas::default();
    draw(&mut canvas);
    Pixmap::decode_png(&png(&canvas.finish(WIDTH, HEIGHT, "t"), scale).unwrap()).unwrap()
}

/// Left, top, right and bottom of all pixels that are not white.
fn ink(picture: &Pixmap) -> [u32; 4] {
    let mut found = [u32::MAX, u32::MAX, 0, 0];
    for (k, pixel) in (0u32..).zip(picture.pixels()) {
        let (x, y) = (k % picture.width(), k / picture.width());
        if (pixel.red(), pixel.green(), pixel.blue()) != (255, 255, 255) {
            found = [found[0].min(x), found[1].min(y), found[2].max(x), found[3].max(y)];
        }
    }
    found
}

fn line(width: f64, dash: Option<&'static [u8]>) -> Stroke {
    Stroke { colour: RED, width, dash }
}

#[test]
fn png_has_the_scaled_size_and_ink() {
    let letter = |canvas: &mut Canvas| {
        canvas.text((2.0, 15.0), "m", TextStyle::new(16.0, Anchor::Start));
    };
    let picture = picture(2.0, letter);
    assert_eq!((picture.width(), picture.height()), (120, 80));
    assert!(picture.pixels().iter().any(|p| p.red() < 64), "the compiled-in font draws the letter");
    assert!(picture.pixels().iter().all(|p| p.alpha() == 255), "the ground is opaque");
}

#[test]
fn impossible_pictures_are_errors() {
    let drawing = Canvas::default().finish(WIDTH, HEIGHT, "t");
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e6] {
        assert!(matches!(png(&drawing, scale), Err(FigureError::Size { .. })), "{scale}");
    }
}

#[test]
fn a_frame_cuts_off_what_is_outside() {
    let picture = picture(1.0, |canvas| {
        let frame = Rect { left: 10.0, top: 5.0, width: 20.0, height: 10.0 };
        canvas.clipped(frame, |canvas| {
            canvas.polyline(&[(-1e9, -1e9), (1e9, 1e9)], line(400.0, None));
        });
    });
    assert_eq!(ink(&picture), [10, 5, 29, 14]);
}

#[test]
fn opacity_lets_the_ground_through() {
    let picture = picture(1.0, |canvas| {
        canvas.rect(Rect { left: 0.0, top: 0.0, width: 9.0, height: 9.0 }, RED, 0.4);
        canvas.rect(Rect { left: 20.0, top: 0.0, width: 0.0, height: 9.0 }, RED, 1.0);
    });
    let pixel = picture.pixel(4, 4).unwrap();
    assert_eq!((pixel.red(), pixel.green()), (255, 153));
    assert_eq!(ink(&picture), [0, 0, 8, 8], "a rectangle without area leaves no ink");
}

#[test]
fn dashes_leave_gaps() {
    let picture = picture(1.0, |canvas| {
        canvas.lines([[(0.0, 20.0), (60.0, 20.0)]], line(2.0, Some(&[6, 4])));
    });
    let red = |x| picture.pixel(x, 20).unwrap().green() == 0;
    assert_eq!((0..20).map(red).filter(|red| *red).count(), 12);
    assert!(red(0) && red(5) && !red(6) && !red(9) && red(10));
}

#[test]
fn text_is_anchored_and_turned() {
    let text = |anchor, upward| {
        ink(&picture(4.0, |canvas| {
            let style = TextStyle { upward, ..TextStyle::new(8.0, anchor) };
            canvas.text((30.0, 20.0), "mm", style);
        }))
    };
    let (start, middle, end) =
        (text(Anchor::Start, false), text(Anchor::Middle, false), text(Anchor::End, false));
    assert!(start[0] >= 120 && end[2] <= 120, "{start:?} {end:?}");
    assert!((middle[0] + middle[2]).abs_diff(240) <= 2, "{middle:?}");
    assert!(start[3] <= 81 && start[1] > 40, "the baseline is at y = 20: {start:?}");
    let up = text(Anchor::Start, true);
    assert!(up[3] <= 80 && up[2] <= 121, "it runs upward, to the left of its baseline: {up:?}");
    assert!((up[3] - up[1]).abs_diff(start[2] - start[0]) <= 1, "{up:?} {start:?}");
}

#[test]
fn every_marker_is_centred_and_filled() {
    for marker in [Marker::Circle, Marker::Square, Marker::Diamond, Marker::Up, Marker::Down] {
        let picture = picture(4.0, |canvas| {
            canvas.markers(marker, [(30.0, 20.0)], RED, Stroke { colour: INK, ..line(0.8, None) });
        });
        let [left, top, right, bottom] = ink(&picture);
        assert!((left + right + 1).abs_diff(240) <= 1, "{marker:?} {left} {right}");
        assert!((80 - top).max(bottom - 80) <= 24 && bottom - top > 24, "{marker:?}");
        assert_eq!(picture.pixel(120, 80).unwrap().green(), 0, "{marker:?}");
    }
}

#[test]
fn bold_is_heavier() {
    let dark = |weight| {
        let style = TextStyle { weight, ..TextStyle::new(20.0, Anchor::Start) };
        let picture = picture(1.0, |canvas| canvas.text((2.0, 30.0), "lll", style));
        picture.pixels().iter().map(|p| 255 - u32::from(p.red())).sum::<u32>()
    };
    assert!(dark(Weight::Bold) > dark(Weight::Regular));
}
