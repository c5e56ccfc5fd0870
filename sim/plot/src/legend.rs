//! What the legend says of curves, lines and kinds of points.

use kuva::plot::{LegendEntry, LegendShape};

use super::chart::{Chart, Mark, Series};
use super::{style, words};

/// The entries of a curve: none where it has no name.
pub(super) fn entry(chart: &Chart, index: usize, series: &Series) -> Vec<LegendEntry> {
    if series.name.is_empty() {
        return Vec::new();
    }
    let mark = series.visible_mark();
    let shape = match mark {
        Mark::Points => LegendShape::Circle,
        _ => LegendShape::Line,
    };
    let dashes = style::legend_dashes(mark);
    wrapped_entry(chart, &series.name, style::colour_of(series.colour.unwrap_or(index), mark), shape, dashes)
}

/// The entries of a reference line whose label does not stand on it.
pub(super) fn rule_entry(chart: &Chart, label: &str) -> Vec<LegendEntry> {
    let dashes = Some(style::REFERENCE_DASHES);
    wrapped_entry(chart, label, style::REFERENCE_COLOUR, LegendShape::Line, dashes)
}

/// A name too long for the width goes on in entries of its own, which have no sample. The backend
/// then has one column, so that they stand below one another.
pub(super) fn wrapped_entry(
    chart: &Chart,
    name: &str,
    colour: &str,
    shape: LegendShape,
    dashes: Option<&str>,
) -> Vec<LegendEntry> {
    let lines = words::lines(&plain(name), style::SMALL_SIZE, style::legend_width(chart.size));
    let first =
        LegendEntry { label: String::new(), color: colour.to_owned(), shape, dasharray: dashes.map(str::to_owned) };
    let following =
        || LegendEntry { label: String::new(), color: "none".to_owned(), shape: LegendShape::Line, dasharray: None };
    std::iter::once(first)
        .chain(std::iter::repeat_with(following))
        .zip(lines)
        .map(|(entry, label)| LegendEntry { label, ..entry })
        .collect()
}

/// The backend takes a pair of dollar signs for a formula; here they are dollar signs.
pub(super) fn plain(text: &str) -> String {
    text.replace('$', "\\$")
}
