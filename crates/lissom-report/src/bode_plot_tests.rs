use roxmltree::Document;

use num_complex::Complex64;

use super::*;
use crate::Role;

fn lag(count: u32) -> (Vec<f64>, Vec<Complex64>) {
    let omega: Vec<f64> =
        (0..count).map(|k| 10f64.powf(f64::from(k) / f64::from(count - 1) * 3.0 - 1.0)).collect();
    let response =
        omega.iter().map(|w| Complex64::new(1.0, 0.0) / Complex64::new(-w * w, 0.4 * w)).collect();
    (omega, response)
}

fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap();
    document
        .descendants()
        .filter(|n| n.has_tag_name("text"))
        .filter_map(|n| n.text().map(str::to_owned))
        .collect()
}

fn has(svg: &str, label: &str) {
    assert!(texts(svg).iter().any(|t| t == label), "{label} in {:?}", texts(svg));
}

#[test]
fn labels_are_there_and_the_document_is_well_formed() {
    let (omega, response) = lag(50);
    let plot = BodePlot::new("Motor <θ/i> & \"friends\"", "rad/A")
        .subtitle("corrected")
        .frequency_axis(FrequencyAxis::Both)
        .series(Series::new("fit", Role::Fitted, Style::Line, omega.clone(), response.clone()))
        .series(
            Series::new("raw", Role::Raw, Style::PointsWithBars, omega, response)
                .with_std(vec![0.1; 50])
                .with_flags(vec![true; 50]),
        );
    let svg = plot.to_svg().unwrap();
    for label in [
        "Motor <θ/i> & \"friends\"",
        "corrected",
        "Magnitude (dB re 1 rad/A)",
        "Phase (°)",
        "Frequency (rad/s)",
        "Frequency (Hz)",
    ] {
        has(&svg, label);
    }
    for label in ["fit", "raw", "flagged", "−180", "−120", "100"] {
        has(&svg, label);
    }
    assert!(!svg.contains(" id=") && !svg.contains("href"), "nothing that could clash or load");
    let hertz = plot.frequency_axis(FrequencyAxis::Hertz).to_svg().unwrap();
    has(&hertz, "Frequency (Hz)");
    assert!(!texts(&hertz).contains(&"Frequency (rad/s)".to_owned()));
}

#[test]
fn raster_has_the_size_of_the_sheet() {
    let (omega, response) = lag(20);
    let plot = BodePlot::new("t", "").series(Series::new(
        "fit",
        Role::Fitted,
        Style::Line,
        omega,
        response,
    ));
    let svg = plot.to_svg().unwrap();
    let root = Document::parse(&svg).unwrap();
    let side = |name| root.root_element().attribute(name).unwrap().parse::<u32>().unwrap();
    let picture = tiny_skia::Pixmap::decode_png(&plot.to_png(2.0).unwrap()).unwrap();
    assert_eq!((picture.width(), picture.height()), (2 * side("width"), 2 * side("height")));
}

#[test]
fn bars_in_decibels_and_degrees() {
    let (low, high) = decibel_bar(1.0, 0.1);
    assert!(
        (low + 0.915_149_811).abs() < 1e-9 && (high - 0.827_853_703).abs() < 1e-9,
        "{low} {high}"
    );
    assert!((degree_bar(2.0, 1.0) - 30.0).abs() < 1e-12);
    assert!(decibel_bar(1.0, 2.0).0 < -1e300);
    assert!((degree_bar(1.0, 1.0) - 180.0).abs() < 1e-12);
}

#[test]
fn noise_about_minus_180_stays_on_one_branch() {
    let omega: Vec<f64> = (1..40).map(f64::from).collect();
    let around =
        |k: usize| Complex64::from_polar(1.0, if k.is_multiple_of(2) { 3.1 } else { -3.1 });
    let response = (0..omega.len()).map(around).collect();
    let plot = BodePlot::new("t", "").series(Series::new(
        "raw",
        Role::Raw,
        Style::Points,
        omega,
        response,
    ));
    let (prepared, _) = plot.prepare().unwrap();
    let (low, high) = extent(prepared[0].phase.iter().map(|m| m.y)).unwrap();
    assert!(low > -183.0 && high < -177.0, "{low} {high}");
}

#[test]
fn points_that_cannot_be_drawn_are_counted() {
    let omega = vec![1.0, 2.0, 3.0, 0.0, -1.0, f64::NAN, f64::INFINITY, 4.0];
    let one = Complex64::new(1.0, 0.0);
    let response = vec![
        one,
        Complex64::new(0.0, 0.0),
        Complex64::new(f64::NAN, 0.0),
        one,
        one,
        one,
        one,
        Complex64::new(f64::INFINITY, 1.0),
    ];
    let plot =
        BodePlot::new("t", "").series(Series::new("raw", Role::Raw, Style::Line, omega, response));
    has(&plot.to_svg().unwrap(), "7 points without a drawable value are left out");
    plot.to_png(1.0).unwrap();
}

#[test]
fn extreme_and_empty_input_is_no_panic() {
    let series = |omega: Vec<f64>, response: Vec<Complex64>| {
        Series::new("s", Role::Other(9), Style::PointsWithBars, omega, response)
    };
    let plot = |series: Series| BodePlot::new("t", "").series(series);
    assert!(matches!(
        BodePlot::new("t", "").to_svg(),
        Err(FigureError::NothingToDraw { skipped: 0, .. })
    ));
    let zero = plot(series(vec![1.0], vec![Complex64::new(0.0, 0.0)]));
    assert!(matches!(zero.to_svg(), Err(FigureError::NothingToDraw { skipped: 1, .. })));
    let short = plot(series(vec![1.0, 2.0], vec![Complex64::new(1.0, 0.0)]));
    assert!(matches!(
        short.to_svg(),
        Err(FigureError::Length { field: "response", expected: 2, found: 1, .. })
    ));
    for size in [1e-299, 1.0, 1e299] {
        for omega in [vec![1e-299], vec![5.0, 5.0], vec![1e-299, 1e299], vec![1.0, 1.0 + 1e-14]] {
            for std in [0.0, f64::NAN, 1e-3, 1e300] {
                let n = omega.len();
                let wide = series(omega.clone(), vec![Complex64::new(-size, 0.0); n])
                    .with_std(vec![std; n]);
                let plot = plot(wide);
                let svg = plot.to_svg().unwrap();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{size} {omega:?} {std}");
                plot.to_png(0.2).unwrap();
            }
        }
    }
}
