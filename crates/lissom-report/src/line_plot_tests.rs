use roxmltree::Document;

use super::*;

fn texts(svg: &str) -> Vec<String> {
    let document = Document::parse(svg).unwrap();
    document
        .descendants()
        .filter(|n| n.has_tag_name("text"))
        .filter_map(|n| n.text().map(str::to_owned))
        .collect()
}

fn plot(trace: Trace) -> LinePlot {
    LinePlot::new("t", Axis::linear("time (s)"), Axis::linear("angle (rad)")).trace(trace)
}

#[test]
fn labels_bands_and_flags_are_there() {
    let trace = Trace::points_with_bars(
        "pairs",
        Role::Corrected,
        vec![1.0, 2.0, 5.0],
        vec![0.13, 0.14, 0.2],
        vec![0.01; 3],
    );
    let figure = LinePlot::new(
        "Friction",
        Axis::log("frequency (rad/s)"),
        Axis::linear("Coulomb friction (A)"),
    )
    .trace(trace.with_flags(vec![false, false, true]))
    .band(Band::new("mean", Role::Fitted, 0.135, (0.13, 0.14)))
    .band(Band::new("broken", Role::Fitted, 0.135, (f64::NAN, 0.14)));
    let found = texts(&figure.to_svg().unwrap());
    for label in [
        "Friction",
        "frequency (rad/s)",
        "Coulomb friction (A)",
        "pairs",
        "mean",
        "flagged",
        "0.14",
        "2",
    ] {
        assert!(found.iter().any(|t| t == label), "{label} in {found:?}");
    }
    assert!(!found.contains(&"broken".to_owned()));
}

#[test]
fn regions_are_as_high_as_the_frame() {
    let shades = |region: Region| {
        let figure = plot(Trace::line("", Role::Raw, vec![0.0, 10.0], vec![0.0, 1.0]));
        let svg = figure.region(region).to_svg().unwrap();
        let document = Document::parse(&svg).unwrap();
        let shade = |n: &roxmltree::Node<'_, '_>| n.attribute("fill-opacity") == Some("0.16");
        let heights = document.descendants().filter(shade).filter_map(|n| n.attribute("height"));
        heights.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(shades(Region::new("", Role::Truth, (2.0, 4.0))), ["300.00"]);
    // Without a length or a place there is none, in the figure or in the legend.
    for ends in [(4.0, 2.0), (f64::NAN, 4.0)] {
        assert!(shades(Region::new("broken", Role::Truth, ends)).is_empty());
    }
}

#[test]
fn small_numbers_say_their_power() {
    let found =
        texts(&plot(Trace::line("", Role::Raw, vec![0.0, 1.0], vec![0.0, 4e-7])).to_svg().unwrap());
    assert!(found.contains(&"×10⁻⁷".to_owned()), "{found:?}");
}

#[test]
fn every_style_takes_degenerate_data() {
    let values = [
        vec![0.0],
        vec![1e300, -1e300],
        vec![5.0; 3],
        vec![f64::NAN, 1.0, f64::INFINITY, -2.0],
        vec![1e-300, 1e300],
    ];
    for style in [
        TraceStyle::Line,
        TraceStyle::Steps,
        TraceStyle::Points,
        TraceStyle::PointsWithBars,
        TraceStyle::Columns,
    ] {
        for (x_scale, y_scale) in [(Scale::Linear, Scale::Linear), (Scale::Log, Scale::Log)] {
            for y in &values {
                let x: Vec<f64> = (0..y.len()).map(|k| k as f64).collect();
                let mut figure = plot(Trace {
                    std: Some(y.clone()),
                    ..Trace::new("s", Role::Raw, style, x, y.clone())
                });
                (figure.x.scale, figure.y.scale) = (x_scale, y_scale);
                match figure.to_svg() {
                    Ok(svg) => {
                        assert!(
                            !svg.contains("NaN") && !svg.contains("inf"),
                            "{style:?} {x_scale:?} {y:?}"
                        );
                        figure.to_png(0.2).unwrap();
                    }
                    Err(error) => {
                        assert!(matches!(error, FigureError::NothingToDraw { .. }), "{error}");
                    }
                }
            }
        }
    }
}

#[test]
fn faults_have_names() {
    let uneven = plot(Trace::line("s", Role::Raw, vec![1.0], vec![]));
    assert!(matches!(
        uneven.to_svg(),
        Err(FigureError::Length { field: "y", expected: 1, found: 0, .. })
    ));
    let mut backwards = plot(Trace::line("s", Role::Raw, vec![1.0], vec![1.0]));
    backwards.x = Axis::linear("x").range(2.0, 1.0);
    assert!(matches!(backwards.to_svg(), Err(FigureError::Range { .. })));
    assert!(matches!(LinePlot::default().to_svg(), Err(FigureError::NothingToDraw { .. })));
}

#[test]
fn a_long_trace_makes_a_small_picture() {
    let x: Vec<f64> = (0..200_000).map(f64::from).collect();
    let y = x.iter().map(|x| (x / 40.0).sin()).collect();
    let svg = plot(Trace::line("s", Role::Raw, x, y)).to_svg().unwrap();
    assert!(svg.len() < 100_000, "{}", svg.len());
}
