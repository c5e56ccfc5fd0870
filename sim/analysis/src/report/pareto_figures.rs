//! The plots of work against precision: each contender a point, the non-dominated ones joined by steps.

use crate::pareto::front::dominators;
use crate::pareto::{ContenderRow, ParetoReport, TimingRow};
use plot::{Axis, Chart, Kind, Mark, Series, Shape, Size, Spot};

/// The least error that is drawn at its place. What is smaller stands at the foot with its value.
const LEAST_DRAWN: f64 = 1e-8;

/// A picture's worth of points.
struct Picture<'a> {
    name: &'static str,
    title: &'static str,
    cost: &'static str,
    points: Vec<Point<'a>>,
    /// How many kinds take part; one: presets alone.
    kinds: usize,
}

/// The error of a contender in a region.
type ErrorOf = fn(&ContenderRow) -> Option<f64>;

struct Point<'a> {
    row: &'a ContenderRow,
    cost: f64,
    error: f64,
}

/// The pictures with their names, without those that would have nothing to show.
#[must_use]
pub fn figures(report: &ParetoReport) -> Vec<(&'static str, Chart)> {
    let regions: [(Area, ErrorOf); 2] =
        [(Area::Epicentre, |row| row.epicentre_worst), (Area::Whole, |row| row.whole_worst)];
    let mut charts = Vec::new();
    for (region, error) in regions {
        for picture in pictures(report, region, error) {
            if !picture.points.is_empty() {
                charts.push((picture.name, chart(report, region, &picture)));
            }
        }
    }
    charts
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Area {
    Epicentre,
    Whole,
}

impl Area {
    const fn choose(self, epicentre: &'static str, whole: &'static str) -> &'static str {
        match self {
            Self::Epicentre => epicentre,
            Self::Whole => whole,
        }
    }
}

fn pictures(report: &ParetoReport, region: Area, error: ErrorOf) -> Vec<Picture<'_>> {
    let points = |cost: &dyn Fn(usize, &ContenderRow) -> Option<f64>| {
        let rows = report.contenders.iter().enumerate();
        rows.filter_map(|(at, row)| Some(Point { row, cost: cost(at, row)?, error: error(row)? })).collect()
    };
    let timed = |of: fn(&TimingRow) -> Option<f64>| {
        move |at: usize, _: &ContenderRow| of(report.timing.as_ref()?.rows.get(at)?)
    };
    vec![
        Picture {
            name: region.choose("pareto_time_epicentre", "pareto_time_whole"),
            title: "Error against run time, one exponent for a block of samples",
            cost: "run time, ns per sample (median)",
            points: points(&timed(|row| Some(row.block_median))),
            kinds: 4,
        },
        Picture {
            name: region.choose("pareto_mixed_epicentre", "pareto_mixed_whole"),
            title: "Error against run time, an exponent for each sample",
            cost: "run time, ns per sample (median)",
            points: points(&timed(|row| row.mixed_median)),
            kinds: 3,
        },
        Picture {
            name: region.choose("pareto_multipliers_epicentre", "pareto_multipliers_whole"),
            title: "Error of the presets against their multipliers",
            cost: "partial-product bits of all multipliers",
            points: points(&|_, row| row.multiplier_bits.map(|bits| bits as f64)),
            kinds: 1,
        },
        Picture {
            name: region.choose("pareto_rom_epicentre", "pareto_rom_whole"),
            title: "Error of the presets against their ROM",
            cost: "ROM, kbit for all exponents",
            points: points(&|_, row| row.latency.map(|_| row.storage_bits as f64 / 1024.0)),
            kinds: 1,
        },
    ]
}

fn chart(report: &ParetoReport, region: Area, picture: &Picture<'_>) -> Chart {
    let error = region.choose("greatest error on the epicentre (xⁿ ≥ 1/2)", "greatest error on all of [0, 1]");
    let drawn = |point: &Point<'_>| (point.cost, point.error.max(LEAST_DRAWN));
    let x_range = range(picture.points.iter().map(|point| point.cost));
    let hidden = picture.points.iter().any(|point| point.error < LEAST_DRAWN);
    let mut y_range = range(picture.points.iter().map(|point| drawn(point).1));
    if hidden {
        // Room for their names below them.
        y_range.0 = LEAST_DRAWN / 8.0;
    }
    let mut chart = Chart::new(
        picture.title,
        Axis::log(picture.cost).with_range(x_range.0, x_range.1),
        Axis::log(error).with_range(y_range.0, y_range.1),
    );
    chart.size = Size::Page;
    chart.subtitle = Some(conditions(report, picture));
    chart.kinds = kinds(picture.kinds);
    let points: Vec<[f64; 2]> = picture.points.iter().map(|point| [point.cost, point.error]).collect();
    let dominators = dominators(&points);
    let front = steps(&points, &dominators, x_range, y_range);
    chart.series.push(Series::new("not dominated in this picture (black rims)", front, Mark::Solid));
    chart.series.extend(pairs(picture));
    let spots = picture
        .points
        .iter()
        .zip(&dominators)
        .map(|(point, dominator)| Spot { marked: dominator.is_none(), ..spot(picture, point, drawn(point)) });
    chart.spots = spots.collect();
    chart
}

fn conditions(report: &ParetoReport, picture: &Picture<'_>) -> String {
    let seen = if report.exhaustive {
        "every representable x".to_owned()
    } else {
        format!("SAMPLED: one x in {}", report.every)
    };
    let marks = if picture.kinds > 1 { "; filled: f64, open: f32" } else { "" };
    format!("n = {}, x in {}, {seen}{marks}", shortened(&report.exponents), report.input)
}

/// A list of exponents where there is no room for all of them.
#[must_use]
pub fn shortened(exponents: &str) -> String {
    const MOST: usize = 30;
    match exponents.char_indices().nth(MOST) {
        None => exponents.to_owned(),
        Some((end, _)) => format!("{}…", &exponents[..end]),
    }
}

/// The kinds, in the order of [`kind`].
fn kinds(count: usize) -> Vec<Kind> {
    let of = |name: &str, shape, colour| Kind { name: name.to_owned(), shape, colour };
    if count == 1 {
        return vec![of("preset", Shape::Square, 4)];
    }
    let mut kinds = vec![
        of("method", Shape::Circle, 1),
        of("powf, repeated squaring (powers)", Shape::Diamond, 2),
        of("straight lines from a table", Shape::Triangle, 3),
        of("preset: the model, bit for bit", Shape::Square, 4),
    ];
    kinds.truncate(count);
    kinds
}

fn kind(picture: &Picture<'_>, row: &ContenderRow) -> usize {
    let name = row.contender.as_str();
    match () {
        () if picture.kinds == 1 => 0,
        () if row.kind == "hardware" => 3,
        () if name.starts_with("linear") => 2,
        () if name.starts_with("pow") => 1,
        () => 0,
    }
}

fn spot(picture: &Picture<'_>, point: &Point<'_>, at: (f64, f64)) -> Spot {
    let row = point.row;
    let family = row.contender.trim_start_matches("preset ");
    let family = family.trim_end_matches(" f32").trim_end_matches(" f64");
    let label = if point.error < LEAST_DRAWN {
        format!("{family} ↓ {}", scientific(point.error))
    } else if row.kind == "f64" && partner(picture, point).is_some() {
        // The line to its partner says whose it is.
        String::new()
    } else {
        family.to_owned()
    };
    Spot { at, kind: kind(picture, row), filled: row.kind != "f32", marked: false, label, told: told(picture, point) }
}

/// What is told of a contender that a reader points at: its name, and the values of both axes.
fn told(picture: &Picture<'_>, point: &Point<'_>) -> String {
    let (cost, error) = (point.cost, scientific(point.error));
    format!("{}: greatest error {error}; {}: {cost}", point.row.contender, picture.cost)
}

/// 5.6·10⁻¹⁷; an error of 0 is said as such.
fn scientific(error: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    if error == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{error:.1e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    format!("{digits}·10{}", power.chars().map(raised).collect::<String>())
}

/// The same function in f32, where both are drawn at their places.
fn partner<'a>(picture: &'a Picture<'_>, point: &Point<'_>) -> Option<&'a Point<'a>> {
    let family = point.row.contender.strip_suffix(" f64")?;
    let name = format!("{family} f32");
    let drawn = |other: &&Point<'_>| other.row.contender == name && other.error >= LEAST_DRAWN;
    picture.points.iter().find(drawn).filter(|_| point.error >= LEAST_DRAWN)
}

/// Lines between f64 and f32 of the same function. All have one name in the legend, which is with the first.
fn pairs(picture: &Picture<'_>) -> Vec<Series> {
    let both = picture.points.iter().filter_map(|point| {
        let other = partner(picture, point)?;
        Some(vec![(point.cost, point.error), (other.cost, other.error)])
    });
    both.enumerate()
        .map(|(index, ends)| {
            let name = if index == 0 { "the same function in f64 and f32" } else { "" };
            Series::new(name, ends, Mark::Thin)
        })
        .collect()
}

/// The steps through the points that no other dominates in cost and error, from the top to the right end.
fn steps(
    points: &[[f64; 2]],
    dominators: &[Option<usize>],
    (_, right): (f64, f64),
    (_, top): (f64, f64),
) -> Vec<(f64, f64)> {
    let mut front: Vec<[f64; 2]> = points
        .iter()
        .zip(dominators)
        .filter(|(_, dominator)| dominator.is_none())
        .map(|(point, _)| [point[0], point[1].max(LEAST_DRAWN)])
        .collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
    let mut line = Vec::new();
    let mut height = top;
    for [cost, error] in front {
        line.push((cost, height));
        line.push((cost, error));
        height = error;
    }
    line.push((right, height));
    line
}

/// The ends of a logarithmic axis: an eighth of the data's length beyond them, and a factor of 1.5 at least.
fn range(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(0.0, f64::max);
    let spare = (high / low).powf(0.12).max(1.5);
    (low / spare, high * spare)
}
