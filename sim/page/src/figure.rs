//! A chart as the data that the script of a page draws: the same points as in the picture, and nothing computed.

use std::collections::BTreeMap;

use plot::{Axis, Chart, Mark, Scale, Series, Shape, Spot, Stroke, stroke};
use serde::Serialize;

use super::error::PageError;

/// What the script reads.
#[derive(Serialize)]
struct Figure<'a> {
    x: Scaled<'a>,
    y: Scaled<'a>,
    /// The x of every row, then for each curve its y, or nothing where it has no point.
    columns: Vec<Vec<Option<f64>>>,
    curves: Vec<Curve<'a>>,
    spots: Vec<Named<'a>>,
}

#[derive(Serialize)]
struct Scaled<'a> {
    label: &'a str,
    log: bool,
    range: Option<(f64, f64)>,
}

#[derive(Serialize)]
struct Curve<'a> {
    name: &'a str,
    colour: &'static str,
    dashes: Option<&'static str>,
    width: f64,
    /// Points and no line.
    points: bool,
    /// A dot at each point of a line.
    dots: bool,
}

#[derive(Serialize)]
struct Named<'a> {
    at: (f64, f64),
    kind: &'a str,
    shape: &'static str,
    colour: &'static str,
    filled: bool,
    marked: bool,
    label: &'a str,
    told: &'a str,
}

/// A chart as JSON that can stand in a script element: no `<` in it.
pub(super) fn data(chart: &Chart) -> Result<String, PageError> {
    let (low, high) = ends(chart);
    let bound = |value: f64| vec![(low, value), (high, value)];
    let lines: Vec<Vec<(f64, f64)>> = chart.reference_lines.iter().map(|line| bound(line.value)).collect();
    let points = chart.series.iter().map(|series| series.points.as_slice()).chain(lines.iter().map(Vec::as_slice));
    let curves = chart.series.iter().enumerate().map(curve);
    let figure = Figure {
        x: scaled(&chart.x_axis),
        y: scaled(&chart.y_axis),
        columns: columns(points.collect()),
        curves: curves.chain(chart.reference_lines.iter().map(|line| reference(&line.label))).collect(),
        spots: chart.spots.iter().map(|spot| named(chart, spot)).collect(),
    };
    let named = |cause| PageError::Plot { title: chart.title.clone(), cause };
    Ok(serde_json::to_string(&figure).map_err(named)?.replace('<', "\\u003c"))
}

/// The least and the greatest x of the chart's points, or the range of its axis.
fn ends(chart: &Chart) -> (f64, f64) {
    let spots = chart.spots.iter().map(|spot| spot.at.0);
    let all = chart.series.iter().flat_map(|series| series.points.iter().map(|point| point.0)).chain(spots);
    let extent = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
    chart.x_axis.range.unwrap_or_else(|| all.fold((f64::INFINITY, f64::NEG_INFINITY), extent))
}

fn scaled(axis: &Axis) -> Scaled<'_> {
    Scaled { label: &axis.label, log: axis.scale == Scale::Log, range: axis.range }
}

fn curve((index, series): (usize, &Series)) -> Curve<'_> {
    let Stroke { colour, dashes, width } = stroke(series.colour.unwrap_or(index), series.mark);
    let points = series.mark == Mark::Points || series.points.len() == 1;
    Curve { name: &series.name, colour, dashes, width, points, dots: series.dots }
}

fn reference(label: &str) -> Curve<'_> {
    let Stroke { colour, dashes, width } = Stroke::REFERENCE;
    Curve { name: label, colour, dashes, width, points: false, dots: false }
}

fn named<'a>(chart: &'a Chart, spot: &'a Spot) -> Named<'a> {
    let kind = chart.kinds.get(spot.kind);
    Named {
        at: spot.at,
        kind: kind.map_or("", |kind| &kind.name),
        shape: kind.map_or("circle", |kind| match kind.shape {
            Shape::Circle => "circle",
            Shape::Square => "square",
            Shape::Diamond => "diamond",
            Shape::Triangle => "triangle",
        }),
        colour: stroke(kind.map_or(0, |kind| kind.colour), Mark::Solid).colour,
        filled: spot.filled,
        marked: spot.marked,
        label: &spot.label,
        told: &spot.told,
    }
}

/// The points of all curves in rows of rising x. A curve that has several points at an x has them in as many rows.
fn columns(curves: Vec<&[(f64, f64)]>) -> Vec<Vec<Option<f64>>> {
    let mut rows: BTreeMap<Ordered, Vec<Vec<f64>>> = BTreeMap::new();
    for (index, points) in curves.iter().enumerate() {
        for &(x, y) in *points {
            rows.entry(Ordered(x)).or_insert_with(|| vec![Vec::new(); curves.len()])[index].push(y);
        }
    }
    let mut columns = vec![Vec::new(); curves.len() + 1];
    for (Ordered(x), values) in rows {
        for row in 0..values.iter().map(Vec::len).max().unwrap_or(0) {
            columns[0].push(Some(x));
            for (column, values) in columns[1..].iter_mut().zip(&values) {
                column.push(values.get(row).copied());
            }
        }
    }
    columns
}

/// A finite number, in its order.
struct Ordered(f64);

impl PartialEq for Ordered {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Ordered {}
impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_all_curves_stand_in_rows_of_rising_x() {
        let (step, line): (&[_], &[_]) = (&[(1.0, 9.0), (1.0, 4.0), (2.0, 4.0)], &[(2.0, 5.0), (0.5, 7.0)]);
        let found = columns(vec![step, line]);
        let some = |values: &[f64]| values.iter().map(|&value| Some(value)).collect::<Vec<_>>();
        assert_eq!(found[0], some(&[0.5, 1.0, 1.0, 2.0]));
        assert_eq!(found[1], [None, Some(9.0), Some(4.0), Some(4.0)]);
        assert_eq!(found[2], [Some(7.0), None, None, Some(5.0)]);
    }

    #[test]
    fn data_ends_no_script_element() {
        let mut chart = Chart::new("t", Axis::linear("x"), Axis::log("</script>"));
        chart.series.push(Series::new("a", vec![(0.0, 1.0)], Mark::Dashed));
        let data = data(&chart).unwrap();
        assert!(!data.contains('<') && data.contains("\\u003c/script>"), "{data}");
    }
}
