//! Names in a crowd of points as work against precision has it: six functions in f32 that take the same time and
//! nearly the same error, joined to the same in f64, at the corner of the front.

use resvg::tiny_skia::PathSegment;
use resvg::usvg::{Group, Node, Paint, Path, Rect};

use super::super::placement::{ONE, distance};
use super::*;

type Point = (f64, f64);

/// Run time and error in f32, and the run time in f64.
const METHODS: [(&str, f64, f64, f64); 8] = [
    ("hermite", 0.1731, 0.2259, 0.2916),
    ("three_point", 0.1730, 0.1056, 0.2914),
    ("tangent", 0.1728, 0.1100, 0.2913),
    ("minimax", 0.1728, 0.1424, 0.2913),
    ("quadratic", 0.1728, 0.2272, 0.2913),
    ("rational", 0.1941, 0.1752, 0.3479),
    ("composite", 0.2799, 0.1013, 0.4263),
    ("schlick", 0.1866, 0.2026, 0.3292),
];
const OTHERS: [(&str, f64, f64); 8] = [
    ("linear_256", 2.365, 0.0779),
    ("powers", 0.820, 5.0e-6),
    ("powers ↓ 6.0·10⁻¹⁵", 1.311, 1e-8),
    ("powf", 7.791, 3.0e-8),
    ("powf ↓ 5.6·10⁻¹⁷", 10.978, 1e-8),
    ("blooming", 2.915, 0.10559),
    ("paper", 5.798, 0.10133),
    ("compact", 2.889, 0.22592),
];

fn chart() -> Chart {
    let x_axis = Axis::log("run time").with_range(0.105, 18.0);
    let y_axis = Axis::log("greatest error").with_range(1.25e-9, 1.7);
    let mut chart = Chart::new("Error against run time", x_axis, y_axis);
    chart.size = Size::Page;
    chart.kinds = [(Shape::Circle, 1), (Shape::Diamond, 2)]
        .map(|(shape, colour)| Kind { name: format!("{shape:?}"), shape, colour })
        .to_vec();
    let corners = [0.1728, 0.1730, 0.2799, 0.820, 1.311, 18.0];
    let heights = [1.7, 0.1100, 0.1056, 0.1013, 5.0e-6, 1e-8];
    let mut front = vec![(corners[0], heights[0])];
    for step in 1..corners.len() {
        front.extend([(corners[step - 1], heights[step]), (corners[step], heights[step])]);
    }
    chart.series = vec![Series::new("front", front, Mark::Solid)];
    let spot = |at, kind, filled, label: &str| Spot {
        at,
        kind,
        filled,
        marked: false,
        label: label.to_owned(),
        told: String::new(),
    };
    for (name, single, error, double) in METHODS {
        chart.series.push(Series::new("", vec![(double, error), (single, error)], Mark::Thin));
        chart.spots.push(spot((double, error), 0, true, ""));
        chart.spots.push(spot((single, error), 0, false, name));
    }
    chart.spots.extend(OTHERS.map(|(name, time, error)| spot((time, error), 1, true, name)));
    chart
}

/// What is drawn, by what it is.
#[derive(Default)]
struct Drawn {
    markers: Vec<Rect>,
    leaders: Vec<[Point; 2]>,
    lines: Vec<[Point; 2]>,
}

impl Drawn {
    fn see(&mut self, group: &Group) {
        for node in group.children() {
            match node {
                Node::Group(group) => self.see(group),
                Node::Path(path) => self.see_path(path),
                _ => {}
            }
        }
    }

    /// Widths and colours tell points from samples of the legend, and curves from axes.
    fn see_path(&mut self, path: &Path) {
        let Some(stroke) = path.stroke() else { return };
        let Paint::Color(colour) = stroke.paint() else { return };
        let (width, grey) = (stroke.width().get(), (colour.red, colour.green));
        match path.fill() {
            // A line is no surface, whatever fill it inherits.
            _ if width == 0.8 && grey == (0x44, 0x44) => self.leaders.extend(segments(path)),
            Some(_) if width == 1.6 => self.markers.push(path.abs_bounding_box()),
            None if width == 2.2 || width == 0.9 => self.lines.extend(segments(path)),
            _ => {}
        }
    }
}

fn segments(path: &Path) -> Vec<[Point; 2]> {
    let at = |segment| match segment {
        PathSegment::MoveTo(point) | PathSegment::LineTo(point) => Some((f64::from(point.x), f64::from(point.y))),
        _ => None,
    };
    let corners: Vec<Point> = path.data().segments().filter_map(at).collect();
    corners.windows(2).map(|ends| [ends[0], ends[1]]).collect()
}

fn centre(rect: &Rect) -> Point {
    (f64::from(rect.left() + rect.right()) / 2.0, f64::from(rect.top() + rect.bottom()) / 2.0)
}

fn apart(rect: &Rect, (x, y): Point) -> f64 {
    let across = x - x.clamp(rect.left().into(), rect.right().into());
    across.hypot(y - y.clamp(rect.top().into(), rect.bottom().into()))
}

fn meet(a: &Rect, b: &Rect) -> bool {
    a.left() < b.right() && b.left() < a.right() && a.top() < b.bottom() && b.top() < a.bottom()
}

fn runs_through(line: &[Point; 2], rect: &Rect) -> bool {
    let [from, to] = line;
    (0..=1000)
        .map(|step| f64::from(step) / 1000.0)
        .any(|part| apart(rect, (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))) == 0.0)
}

#[test]
fn every_name_is_plainly_that_of_its_own_point() {
    let chart = chart();
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let mut drawn = Drawn::default();
    drawn.see(tree.root());
    assert_eq!(drawn.markers.len(), chart.spots.len());
    assert_eq!(drawn.lines.len(), 10 + METHODS.len());
    let labels: Vec<(String, Rect)> = drawn_texts(&tree)
        .into_iter()
        .filter(|(text, _)| chart.spots.iter().any(|spot| text.split(", ").any(|part| part == spot.label)))
        .collect();
    let parts: usize = labels.iter().map(|(text, _)| text.split(", ").count()).sum();
    assert_eq!(parts, METHODS.len() + OTHERS.len(), "each name once");

    for (index, (text, label)) in labels.iter().enumerate() {
        let beside = &labels[index + 1..];
        assert!(!beside.iter().any(|(_, other)| meet(label, other)), "{text} covers a name");
        assert!(!drawn.markers.iter().any(|marker| meet(label, marker)), "{text} covers a point");
        let own = |name: &str| {
            let place = chart.spots.iter().position(|spot| spot.label == name).unwrap();
            centre(&drawn.markers[place])
        };
        let first = own(text.split(", ").next().unwrap());
        let of_others = drawn.leaders.iter().filter(|line| distance(line[0], first) > ONE);
        for line in drawn.lines.iter().chain(of_others) {
            assert!(!runs_through(line, label), "{text} at {label:?} covers the line {line:?}");
        }
        for name in text.split(", ") {
            let own = own(name);
            let nearby = |at: Point, by: f64| distance(at, own) <= by;
            let led = drawn.leaders.iter().any(|[start, end]| nearby(*start, ONE) && apart(label, *end) < 6.0);
            let nearest = drawn
                .markers
                .iter()
                .all(|marker| nearby(centre(marker), ONE) || apart(label, own) < apart(label, centre(marker)));
            assert!(led || nearest, "{text} at {label:?} could be of another point than {name} at {own:?}");
        }
    }
}

#[test]
fn the_title_of_a_logarithmic_axis_is_clear_of_its_ticks() {
    let mut chart = chart();
    chart.y_axis = Axis::log("greatest error on the epicentre, long").with_range(1.5e-3, 0.15);
    chart.spots.clear();
    chart.series = vec![Series::new("", vec![(0.2, 0.002), (9.0, 0.1)], Mark::Solid)];
    let tree = raster::parse(&chart.to_svg().unwrap()).unwrap();
    let found = drawn_texts(&tree);
    let title = found.iter().find(|(text, _)| *text == chart.y_axis.label).unwrap().1;
    for tick in ["5·10⁻³", "2·10⁻³"] {
        let (_, tick) = found.iter().find(|(text, _)| text == tick).unwrap();
        assert!(title.right() + 1.0 < tick.left(), "{title:?} {tick:?}");
    }
}
