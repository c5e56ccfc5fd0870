use resvg::tiny_skia::Pixmap;
use resvg::usvg::{Group, Node, Rect, Tree};

use super::*;

mod names;

/// A rising curve, an odd one above it, and a bound.
fn chart() -> Chart {
    let exponents = || (1..=256_i32).map(f64::from);
    error_versus_exponent(
        "Error on the epicentre",
        Scale::Linear,
        vec![
            Curve::new("absolute", exponents().map(|n| (n, 0.5 - 0.5 / n)).collect()),
            Curve::new("relative", exponents().map(|n| (n, 0.7 - 0.7 / n)).collect()),
        ],
        vec![ReferenceLine::new(0.67, "bound 0.67 %")],
    )
}

fn texts(group: &Group, found: &mut Vec<(String, Rect)>) {
    for node in group.children() {
        match node {
            Node::Group(group) => texts(group, found),
            Node::Text(text) => {
                let words = text.chunks().iter().map(|chunk| chunk.text()).collect();
                found.push((words, text.abs_bounding_box()));
            }
            _ => {}
        }
    }
}

fn drawn_texts(tree: &Tree) -> Vec<(String, Rect)> {
    let mut found = Vec::new();
    texts(tree.root(), &mut found);
    found
}

fn assert_nothing_is_clipped(chart: &Chart) {
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let size = tree.size();
    let found = drawn_texts(&tree);
    assert!(found.len() > 8, "only {} texts in {}", found.len(), chart.title);
    for (index, (text, place)) in found.iter().enumerate() {
        assert!(
            place.left() >= 0.0
                && place.top() >= 0.0
                && place.right() <= size.width()
                && place.bottom() <= size.height(),
            "{text:?} at {place:?} leaves the picture of {size:?}"
        );
        for (other, elsewhere) in &found[index + 1..] {
            assert!(
                place.right() <= elsewhere.left()
                    || elsewhere.right() <= place.left()
                    || place.bottom() <= elsewhere.top() + 1.0
                    || elsewhere.bottom() <= place.top() + 1.0,
                "{text:?} at {place:?} covers {other:?} at {elsewhere:?}"
            );
        }
    }
}

#[test]
fn every_name_and_label_is_in_the_picture() {
    let mut chart = chart();
    chart.subtitle = Some("hermite, Q = 1/2".to_owned());
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let found = drawn_texts(&tree);
    for expected in [
        "Error on the epicentre",
        "hermite, Q = 1/2",
        "exponent n",
        "error, %",
        "absolute",
        "relative",
        "bound 0.67 %",
        "1",
        "100",
        "0.4",
    ] {
        let times = found.iter().filter(|(text, _)| text == expected).count();
        assert_eq!(times, 1, "{expected:?} in {found:?}");
    }
}

#[test]
fn the_same_chart_gives_the_same_bytes() {
    let (first, second) = (chart().to_svg().unwrap(), chart().to_svg().unwrap());
    assert!(first == second, "the SVG differs from one call to the next");
    assert_eq!(svg_to_png(&first, 1.5), svg_to_png(&second, 1.5));
}

#[test]
fn a_png_has_the_scaled_size_and_is_not_blank() {
    let svg = chart().to_svg().unwrap();
    let size = raster::parse(&svg).unwrap().size();
    let pixels = Pixmap::decode_png(&svg_to_png(&svg, 2.0).unwrap()).unwrap();
    assert_eq!(pixels.width(), 960);
    assert_eq!(pixels.height() as f32, 2.0 * size.height());
    let dark = pixels.pixels().iter().filter(|pixel| pixel.green() < 128);
    assert!(dark.count() > 5_000);
}

#[test]
fn data_that_cannot_be_drawn_is_refused() {
    let empty = Chart::new("empty", Axis::linear("x"), Axis::linear("y"));
    assert!(matches!(empty.to_svg(), Err(PlotError::NoSeries { .. })));

    let with = |points: Vec<(f64, f64)>| {
        let mut chart = empty.clone();
        chart.series = vec![Series::new("s", points, Mark::Solid)];
        chart
    };
    let refused = with(Vec::new()).to_svg();
    assert!(matches!(refused, Err(PlotError::NoPoints { .. })));
    for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for point in [(odd, 1.0), (1.0, odd)] {
            let refused = with(vec![(0.0, 0.0), point]).to_svg();
            assert!(matches!(refused, Err(PlotError::NotFinite { .. })));
        }
        let mut chart = with(vec![(0.0, 0.0), (1.0, 1.0)]);
        chart.reference_lines = vec![ReferenceLine::new(odd, "bound")];
        assert!(matches!(chart.to_svg(), Err(PlotError::NotFinite { .. })));
    }
    let refused = with(vec![(0.0, -f64::MAX), (1.0, f64::MAX)]).to_svg();
    assert!(matches!(refused, Err(PlotError::Range { .. })));

    let mut chart = with(vec![(0.0, 0.0), (1.0, 1.0)]);
    chart.y_axis.scale = Scale::Log;
    assert!(matches!(chart.to_svg(), Err(PlotError::BelowLogarithmic { .. })));
}

#[test]
fn what_is_no_picture_makes_no_png() {
    assert!(matches!(svg_to_png("", 1.0), Err(PlotError::Svg(_))));
    let svg = chart().to_svg().unwrap();
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e3] {
        assert!(matches!(svg_to_png(&svg, scale), Err(PlotError::Size { .. })));
    }
}

#[test]
fn long_words_are_wrapped_and_not_clipped() {
    let mut long = chart();
    long.title = "A title that goes on and on, with and without a reason, ".repeat(3);
    long.subtitle = Some("w".repeat(150));
    long.x_axis.label = "a horizontal label that is longer than its axis ".repeat(2);
    long.y_axis.label = "a vertical label that is longer than its axis".to_owned();
    long.series[0].name = "a curve whose name has far too many words ".repeat(3);
    long.reference_lines[0].label = "a bound that says where it comes from ".repeat(3);
    assert_nothing_is_clipped(&long);
}

#[test]
fn nothing_is_clipped_at_any_size_of_the_numbers() {
    assert_nothing_is_clipped(&chart());
    for magnitude in [1e-9, 1e-4, 1.0, 1e5, 1e12] {
        for scale in [Scale::Linear, Scale::Log] {
            for last in [2.0, 256.0, 1e9] {
                let curve = vec![(1.0, magnitude), (last, 700.0 * magnitude)];
                let curves = vec![Curve::new("curve", curve)];
                let chart = error_versus_exponent("title", scale, curves, Vec::new());
                assert_nothing_is_clipped(&chart);
            }
        }
    }
}

#[test]
fn words_that_mean_something_to_svg_or_the_backend_stay_words() {
    let mut chart = chart();
    chart.title = "a < b & \"c\" costs $2 or $3".to_owned();
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let found = drawn_texts(&tree);
    assert!(found.iter().any(|(text, _)| *text == chart.title), "{found:?}");
}

#[test]
fn a_label_stands_on_its_line_only_where_no_curve_runs() {
    let on_line = |chart: &Chart| {
        let bounds = chart.bounds().unwrap();
        reference::fits_on_line(chart, bounds, &chart.reference_lines[0])
    };
    let mut chart = chart();
    assert!(!on_line(&chart), "the relative curve runs through it");
    chart.series.truncate(1);
    assert!(on_line(&chart));
    // Two points only, both far from the label; the line between them runs through it.
    chart.series[0].points = vec![(1.0, 0.6), (256.0, 0.70)];
    assert!(!on_line(&chart));
}

#[test]
fn a_lone_point_is_seen() {
    let curves = vec![Curve::new("one", vec![(32.0, 0.5)])];
    let chart = error_versus_exponent("One exponent", Scale::Linear, curves, Vec::new());
    assert!(chart.to_svg().unwrap().contains("<circle"));
    assert_nothing_is_clipped(&chart);
}

#[test]
fn the_highlight_fills_its_angles() {
    let grid = angle_grid(1.0, 91);
    assert_eq!((grid[0], grid[90]), ((0.0, 1.0), (90.0, 0.0)));
    let grid = angle_grid(32.0, 200);
    let last = grid[199].1.powf(32.0);
    assert!((5e-4..1e-3).contains(&last), "{last}");

    let phong = |&(angle, cosine): &(f64, f64)| (angle, cosine.powf(32.0));
    let curves = vec![
        Curve::new("Phong, cosⁿ γ", grid.iter().map(phong).collect()),
        Curve::new("hardware output", grid.iter().map(phong).collect()),
    ];
    let chart = intensity_versus_angle(32.0, curves);
    assert_eq!(chart.title, "Highlight for n = 32");
    assert_nothing_is_clipped(&chart);
}

/// A crowd of named points about a line of steps, as in work against precision.
fn crowd() -> Chart {
    let mut chart = Chart::new("Crowd", Axis::log("cost"), Axis::log("error"));
    chart.size = Size::Page;
    chart.kinds = [(Shape::Circle, 1), (Shape::Diamond, 2), (Shape::Triangle, 3), (Shape::Square, 4)]
        .map(|(shape, colour)| Kind { name: format!("{shape:?}"), shape, colour })
        .to_vec();
    let steps = vec![(1.0, 1.0), (1.0, 0.1), (4.0, 0.1), (4.0, 0.01), (20.0, 0.01)];
    chart.series =
        vec![Series::new("front", steps, Mark::Solid), Series::new("", vec![(1.0, 0.1), (2.0, 0.1)], Mark::Thin)];
    chart.spots = (0..20)
        .map(|index| {
            let (column, row) = (f64::from(index % 5), f64::from(index / 5));
            Spot {
                at: (1.0 + 0.3 * column, 0.1 * 0.93_f64.powf(row)),
                kind: index as usize % 4,
                filled: index % 2 == 0,
                marked: index % 3 == 0,
                label: format!("point_{index}"),
                told: String::new(),
            }
        })
        .collect();
    chart
}

#[test]
fn names_of_points_neither_meet_nor_leave_the_picture() {
    let chart = crowd();
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let found = drawn_texts(&tree);
    for spot in &chart.spots {
        assert!(found.iter().any(|(text, _)| *text == spot.label), "{} is missing", spot.label);
    }
    assert_nothing_is_clipped(&chart);
    assert_eq!(chart.to_svg(), chart.to_svg());
}

#[test]
fn a_named_point_that_is_none_is_refused() {
    let mut chart = crowd();
    chart.spots[3].at.1 = f64::NAN;
    assert!(matches!(chart.to_svg(), Err(PlotError::NotFinite { .. })));
}
