//! Draws points with names: with `draw.rs` the only file that knows the plotting crate.

use kuva::plot::{LegendEntry, LegendShape, MarkerShape};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::chart::Chart;
use super::draw::wrapped_entry;
use super::placement::{Frame, NEAR, Place, Wanted, place};
use super::spot::{Shape, Spot};
use super::{style, words};

/// Half the side of a point.
const HALF: f64 = 4.2;
/// The colour of lines from a name to its point.
const LEADER: &str = "#888888";

/// The legend's entries for the kinds of points.
pub(super) fn entries(chart: &Chart) -> Vec<LegendEntry> {
    let entry = |kind: &super::Kind| {
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
    let lines: Vec<Vec<Place>> = chart
        .series
        .iter()
        .map(|series| series.points.iter().map(|&point| to_place(point)).collect())
        .collect();
    let named: Vec<(&Spot, Place)> = chart
        .spots
        .iter()
        .zip(&points)
        .filter(|(spot, _)| !spot.label.is_empty())
        .map(|(spot, &at)| (spot, at))
        .collect();
    let wanted: Vec<Wanted> = named
        .iter()
        .map(|(spot, at)| {
            let size = style::SMALL_SIZE;
            Wanted { at: *at, size: (words::width(&spot.label, size), f64::from(size) + 2.0) }
        })
        .collect();
    let low = (computed.margin_left + 3.0, computed.margin_top + 3.0);
    let high = (low.0 + computed.plot_width() - 6.0, low.1 + computed.plot_height() - 6.0);
    let frames = place(&wanted, &points, &lines, &Frame { low, high });
    for (frame, (_, at)) in frames.iter().zip(&named) {
        leader(frame, *at, scene);
    }
    for (spot, &at) in chart.spots.iter().zip(&points) {
        marker(chart, spot, at, scene);
    }
    for (frame, (spot, at)) in frames.iter().zip(&named) {
        name(frame, *at, &spot.label, scene);
    }
}

fn leader(frame: &Frame, at: Place, scene: &mut Scene) {
    let end = frame.nearest(at);
    if (end.0 - at.0).hypot(end.1 - at.1) <= HALF + NEAR {
        return;
    }
    scene.add(Primitive::Line {
        x1: rounded(at.0),
        y1: rounded(at.1),
        x2: rounded(end.0),
        y2: rounded(end.1),
        stroke: Color::from(LEADER),
        stroke_width: 0.7,
        stroke_dasharray: None,
    });
}

/// The widths of words are upper bounds: a name stands at the end of its frame that faces its point.
fn name(frame: &Frame, at: Place, text: &str, scene: &mut Scene) {
    let middle = (frame.low.0 + frame.high.0) / 2.0;
    let (x, anchor) = if frame.low.0 > at.0 {
        (frame.low.0, TextAnchor::Start)
    } else if frame.high.0 < at.0 {
        (frame.high.0, TextAnchor::End)
    } else {
        (middle, TextAnchor::Middle)
    };
    scene.add(Primitive::Text {
        x: rounded(x),
        y: rounded(frame.high.1 - 3.0),
        content: text.to_owned(),
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
    let h = HALF;
    let corners: Vec<Place> = match kind.shape {
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
    };
    let steps: Vec<String> =
        corners.iter().map(|(dx, dy)| format!("{} {}", rounded(x + dx), rounded(y + dy))).collect();
    let fill = if spot.filled { colour } else { "#ffffff" };
    if spot.marked {
        // A wider outline below leaves a rim of black around the point's own.
        scene.add(outline(&steps, fill, "#000000", 4.4));
    }
    scene.add(outline(&steps, fill, colour, 1.6));
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
