//! Where the label of a reference line goes.
//!
//! A label on its line reads best, but only where it fits and no curve runs through it. It is
//! written above the line at the right end; the legend takes it otherwise.

use super::chart::{Bounds, Chart, ReferenceLine};
use super::style::{self, SMALL_SIZE};
use super::words;

/// Samples of a curve between two of its points, so that a long straight piece is seen too.
const BETWEEN: u32 = 16;

/// True when the label can stand on its line.
pub(super) fn fits_on_line(chart: &Chart, bounds: Bounds, line: &ReferenceLine) -> bool {
    // In fractions of the drawing area, which takes at least 0.8 of the width.
    let (width, height) = style::size(chart.size);
    let area = (0.8 * width, height);
    let width = (words::width(&line.label, SMALL_SIZE) + 12.0) / area.0;
    let height = (f64::from(SMALL_SIZE) + 10.0) / area.1;
    let foot = chart.y_axis.fraction(line.value, bounds.y);

    let covered = |(x, y): (f64, f64)| x >= 1.0 - width && y >= foot && y <= foot + height;
    let other_line =
        |other: &ReferenceLine| other != line && covered((1.0, chart.y_axis.fraction(other.value, bounds.y)));
    width < 0.7
        && foot >= 0.0
        && foot + height <= 1.0
        && !chart.reference_lines.iter().any(other_line)
        && !chart.series.iter().any(|series| {
            let place = |&(x, y): &(f64, f64)| (chart.x_axis.fraction(x, bounds.x), chart.y_axis.fraction(y, bounds.y));
            let places: Vec<_> = series.points.iter().map(place).collect();
            places.iter().copied().any(covered) || places.windows(2).any(|pair| between(pair[0], pair[1]).any(covered))
        })
}

fn between(from: (f64, f64), to: (f64, f64)) -> impl Iterator<Item = (f64, f64)> {
    (1..BETWEEN).map(move |step| {
        let part = f64::from(step) / f64::from(BETWEEN);
        (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))
    })
}
