//! Draws points with names: with `draw.rs` and `legend.rs` the only file that knows the plotting crate.

use kuva::plot::{LegendEntry, LegendShape, MarkerShape};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::chart::Chart;
use super::legend::wrapped_entry;
use super::placement::{Frame, ONE, Place, Wanted, distance, place};
use super::spot::{Kind, Shape, Spot};
use super::{style, words};

/// Half the side of a point.
const HALF: f64 = 4.2;
/// The colour of lines from a name to its point.
const LEADER: &str = "#444444";
/// Half the dot at its end.
const DOT: f64 = 1.2;

/// The legend's entries for the kinds of points.
pub(super) fn entries(chart: &Chart) -> Vec<LegendEntry> {
    let entry = |kind: &Kind| {
        let shape = LegendShape::Marker(match kind.shape {
            Shape::Circle => MarkerShape::Circle,
            Shape::Square => MarkerShape::Square,
            Shape::Diamond => MarkerShape::Diamond,
            Shape::Triangle => MarkerShape::Triangle,
        });
        wrapped_entry(chart, &kind.name, style::colour(kind.colour), shape, None)
    };
    chart.kinds.iter().flat_map(entry).collect()
}

/// Adds the points and their names to what is drawn.
pub(super) fn draw(chart: &Chart, computed: &ComputedLayout, scene: &mut Scene) {
    if chart.spots.is_empty() {
        return;
    }
    let to_place = |(x, y): (f64, f64)| (computed.map_x(x), computed.map_y(y));
    let points: Vec<Place> = chart.spots.iter().map(|spot| to_place(spot.at)).collect();
    let lines: Vec<Vec<Place>> =
        chart.series.iter().map(|series| series.points.iter().map(|&point| to_place(point)).collect()).collect();
    let named = named(chart, &points);
    let wanted: Vec<Wanted> = named
        .iter()
        .map(|name| {
            let size = style::SMALL_SIZE;
            Wanted { at: name.at, size: (words::width(&name.text, size), f64::from(size) + 2.0) }
        })
        .collect();
    let low = (computed.margin_left + 3.0, computed.margin_top + 3.0);
    let high = (low.0 + computed.plot_width() - 6.0, low.1 + computed.plot_height() - 6.0);
    let placed = place(&wanted, &points, &lines, &Frame { low, high });
    for (spot, &at) in chart.spots.iter().zip(&points) {
        marker(chart, spot, at, scene);
    }
    // Over the points, so that it is seen in a crowd of them at which a line ends.
    for (placed, name) in placed.iter().zip(&named).filter(|(placed, _)| placed.leader) {
        leader(&placed.frame, name.at, scene);
    }
    for (placed, name) in placed.iter().zip(&named) {
        write(&placed.frame, name, scene);
    }
}

/// What is written beside a point.
struct Name {
    at: Place,
    kind: usize,
    text: String,
}

/// The names of the points. Points of a kind that cannot be told apart by eye have one name in common.
fn named(chart: &Chart, points: &[Place]) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    for (spot, &at) in chart.spots.iter().zip(points) {
        if spot.label.is_empty() {
            continue;
        }
        let one = |name: &&mut Name| name.kind == spot.kind && distance(name.at, at) <= ONE;
        match names.iter_mut().find(one) {
            Some(name) => name.text = format!("{}, {}", name.text, spot.label),
            None => names.push(Name { at, kind: spot.kind, text: spot.label.clone() }),
        }
    }
    names
}

fn leader(frame: &Frame, at: Place, scene: &mut Scene) {
    let end = frame.end(at);
    scene.add(Primitive::Line {
        x1: rounded(at.0),
        y1: rounded(at.1),
        x2: rounded(end.0),
        y2: rounded(end.1),
        stroke: Color::from(LEADER),
        stroke_width: 0.8,
        stroke_dasharray: None,
    });
    let dot: Vec<String> = corners(Shape::Circle, DOT)
        .iter()
        .map(|(dx, dy)| format!("{} {}", rounded(at.0 + dx), rounded(at.1 + dy)))
        .collect();
    scene.add(outline(&dot, LEADER, LEADER, 0.4));
}

/// The widths of words are upper bounds: a name stands at the end of its frame that faces its point.
fn write(frame: &Frame, name: &Name, scene: &mut Scene) {
    let middle = (frame.low.0 + frame.high.0) / 2.0;
    let (x, anchor) = if frame.low.0 > name.at.0 {
        (frame.low.0, TextAnchor::Start)
    } else if frame.high.0 < name.at.0 {
        (frame.high.0, TextAnchor::End)
    } else {
        (middle, TextAnchor::Middle)
    };
    scene.add(Primitive::Text {
        x: rounded(x),
        y: rounded(frame.high.1 - 3.0),
        content: name.text.clone(),
        size: style::SMALL_SIZE,
        anchor,
        rotate: None,
        bold: false,
        color: None,
    });
}

fn marker(chart: &Chart, spot: &Spot, (x, y): Place, scene: &mut Scene) {
    let Some(kind) = chart.kinds.get(spot.kind) else { return };
    let colour = style::colour(kind.colour);
    let steps: Vec<String> =
        corners(kind.shape, HALF).iter().map(|(dx, dy)| format!("{} {}", rounded(x + dx), rounded(y + dy))).collect();
    let fill = if spot.filled { colour } else { "#ffffff" };
    if spot.marked {
        // A wider outline below leaves a rim of black around the point's own.
        scene.add(outline(&steps, fill, "#000000", 4.4));
    }
    scene.add(outline(&steps, fill, colour, 1.6));
}

/// About the origin, for half a side of this length.
fn corners(shape: Shape, h: f64) -> Vec<Place> {
    match shape {
        Shape::Circle => {
            // As many corners as make it round.
            (0..24)
                .map(|corner| {
                    let angle = f64::from(corner) / 24.0 * std::f64::consts::TAU;
                    (h * angle.cos(), h * angle.sin())
                })
                .collect()
        }
        Shape::Square => vec![(-h, -h), (h, -h), (h, h), (-h, h)],
        Shape::Diamond => vec![(0.0, -1.3 * h), (1.3 * h, 0.0), (0.0, 1.3 * h), (-1.3 * h, 0.0)],
        Shape::Triangle => vec![(0.0, -1.2 * h), (1.15 * h, 0.9 * h), (-1.15 * h, 0.9 * h)],
    }
}

fn outline(steps: &[String], fill: &str, stroke: &str, stroke_width: f64) -> Primitive {
    Primitive::Path(Box::new(PathData {
        d: format!("M{}Z", steps.join("L")),
        fill: Some(Color::from(fill)),
        stroke: Color::from(stroke),
        stroke_width,
        opacity: None,
        stroke_dasharray: None,
    }))
}

/// Two decimals are enough for any printer, and the same on every machine.
fn rounded(length: f64) -> f64 {
    (length * 100.0).round() / 100.0
}
