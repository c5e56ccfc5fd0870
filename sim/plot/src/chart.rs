//! What a chart holds, whatever draws it.

use super::axis::Axis;
use super::error::PlotError;
use super::spot::{Kind, Spot};

/// How large a picture is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Size {
    /// For a column of a paper.
    #[default]
    Column,
    /// For the whole width of a page.
    Page,
}

/// How a series is marked. The strokes differ, so that curves can be told apart without colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mark {
    /// A line without gaps.
    #[default]
    Solid,
    /// A line of long dashes.
    Dashed,
    /// A line of dots.
    Dotted,
    /// A line of dashes and dots in turn.
    DashDot,
    /// A dot at each point, and no line: for measurements with nothing in between.
    Points,
    /// A thin grey line that stands back: it only says what belongs together.
    Thin,
}

impl Mark {
    /// The stroke for the `index`-th curve of a chart whose curves are of equal rank.
    #[must_use]
    pub const fn nth(index: usize) -> Self {
        match index % 4 {
            0 => Self::Solid,
            1 => Self::Dashed,
            2 => Self::Dotted,
            _ => Self::DashDot,
        }
    }
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The name in the legend, which has none for an empty one.
    pub name: String,
    /// The points, in the order in which a line joins them.
    pub points: Vec<(f64, f64)>,
    /// How its points are drawn: a kind of line, or dots.
    pub mark: Mark,
    /// Its colour, counted from 0; without one its place in the chart counts. What stands in several pictures has one.
    pub colour: Option<usize>,
    /// Whether a line has a dot at each of its points, too: where there are few, with nothing in between.
    pub dots: bool,
}

impl Series {
    /// A curve with this name in the legend, through these points.
    #[must_use]
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>, mark: Mark) -> Self {
        Self { name: name.into(), points, mark, colour: None, dots: false }
    }

    /// A line through a single point has no length, so that point is drawn as one.
    pub(super) fn visible_mark(&self) -> Mark {
        match self.points.len() {
            1 => Mark::Points,
            _ => self.mark,
        }
    }
}

/// A horizontal line that curves are to be held against, such as a bound.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceLine {
    /// The y at which the line is drawn.
    pub value: f64,
    /// What it means. Written on the line where it fits and covers no curve, else in the legend.
    pub label: String,
}

impl ReferenceLine {
    /// A horizontal line at `value`.
    #[must_use]
    pub fn new(value: f64, label: impl Into<String>) -> Self {
        Self { value, label: label.into() }
    }
}

/// A chart: plain data, all of it public.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What the chart shows, in a few words.
    pub title: String,
    /// The conditions under which it was measured.
    pub subtitle: Option<String>,
    /// The horizontal axis: its title and range.
    pub x_axis: Axis,
    /// The vertical axis: its title and range.
    pub y_axis: Axis,
    /// The curves, those drawn first below.
    pub series: Vec<Series>,
    /// Horizontal lines to hold the curves against.
    pub reference_lines: Vec<ReferenceLine>,
    /// Points with names, drawn over the curves.
    pub spots: Vec<Spot>,
    /// The kinds they are of.
    pub kinds: Vec<Kind>,
    /// How large it is.
    pub size: Size,
}

/// The ends of both axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
}

impl Chart {
    /// An empty chart, to be given series.
    #[must_use]
    pub fn new(title: impl Into<String>, x_axis: Axis, y_axis: Axis) -> Self {
        Self {
            title: title.into(),
            subtitle: None,
            x_axis,
            y_axis,
            series: Vec::new(),
            reference_lines: Vec::new(),
            spots: Vec::new(),
            kinds: Vec::new(),
            size: Size::Column,
        }
    }

    /// Every point of every series, and those with names.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        let named = self.spots.iter().map(|spot| spot.at);
        self.series.iter().flat_map(|series| series.points.iter().copied()).chain(named)
    }

    pub(super) fn bounds(&self) -> Result<Bounds, PlotError> {
        let lines = self.reference_lines.iter().map(|line| line.value);
        let dots = |series: &Series| series.dots || series.visible_mark() == Mark::Points;
        let room = if self.series.iter().any(dots) { 0.03 } else { 0.0 };
        let (across, up) = (self.points().map(|point| point.0), self.points().map(|point| point.1));
        Ok(Bounds { x: self.x_axis.bounds(across, room)?, y: self.y_axis.bounds(up.chain(lines), room)? })
    }

    /// Every coordinate is a number, and there is something to draw.
    pub(super) fn check_points(&self) -> Result<(), PlotError> {
        if self.series.is_empty() {
            return Err(PlotError::NoSeries { title: self.title.clone() });
        }
        for series in &self.series {
            if series.points.is_empty() {
                return Err(PlotError::NoPoints { name: series.name.clone() });
            }
            for &(x, y) in &series.points {
                check_finite(&series.name, x, y)?;
            }
        }
        self.reference_lines.iter().try_for_each(|line| check_finite(&line.label, 0.0, line.value))?;
        self.spots.iter().try_for_each(|spot| check_finite(&spot.label, spot.at.0, spot.at.1))
    }
}

fn check_finite(name: &str, x: f64, y: f64) -> Result<(), PlotError> {
    if x.is_finite() && y.is_finite() {
        return Ok(());
    }
    Err(PlotError::NotFinite { name: name.to_owned(), x, y })
}
