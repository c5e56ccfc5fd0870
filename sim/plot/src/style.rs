//! Sizes, colours and strokes.
//!
//! The sizes are chosen for a column of a paper, 8.5 cm wide, or for its whole width: there the smallest
//! text stands at about 6 pt. The colours are those of Okabe and Ito, which people with any common colour
//! vision deficiency can tell apart; their yellow is left out, as it cannot be seen on white.

use super::chart::{Mark, Size};

/// Width of a picture, in SVG units, and height of the drawing area between the axes; title and legend
/// come on top of it.
pub(super) const fn size(size: Size) -> (f64, f64) {
    match size {
        Size::Column => (480.0, 230.0),
        Size::Page => (720.0, 400.0),
    }
}
/// The part of the width that title and axis label may take.
pub(super) const fn text_width(of: Size) -> f64 {
    size(of).0 - 110.0
}
/// The part of the width that one name in the legend may take.
pub(super) const fn legend_width(of: Size) -> f64 {
    size(of).0 - 150.0
}
/// Free space the backend leaves at the foot of a picture, and which is cut off.
pub(super) const FOOT: f64 = 18.0;

/// Height of the title's letters.
pub(super) const TITLE_SIZE: u32 = 15;
/// Height of the letters on the axes.
pub(super) const LABEL_SIZE: u32 = 13;
/// Height of the letters under ticks, in the legend and in the subtitle.
pub(super) const SMALL_SIZE: u32 = 12;

/// The bundled font first, then fonts of like proportions, then whatever there is.
pub(super) const FONT_FAMILY: &str = "'DejaVu Sans', Verdana, sans-serif";

/// The colour of reference lines, grey so that they stand behind the data.
pub(super) const REFERENCE_COLOUR: &str = "#555555";
/// The stroke of reference lines.
pub(super) const REFERENCE_DASHES: &str = "4 3";

/// Dark and light in turn, so that a dashed curve shows on top of the one before it.
const COLOURS: [&str; 7] = ["#000000", "#D55E00", "#56B4E9", "#009E73", "#CC79A7", "#0072B2", "#E69F00"];

/// The colour of the `index`-th series.
pub(super) const fn colour(index: usize) -> &'static str {
    COLOURS[index % COLOURS.len()]
}

/// The same, where its mark has none of its own.
pub(super) const fn colour_of(index: usize, mark: Mark) -> &'static str {
    match mark {
        Mark::Thin => "#999999",
        _ => colour(index),
    }
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// As CSS writes a colour.
    pub colour: &'static str,
    /// Lengths of dashes and gaps in turn, as SVG writes them; `None` for a line without gaps.
    pub dashes: Option<&'static str>,
    /// The width of the line, in SVG units.
    pub width: f64,
}

impl Stroke {
    /// The stroke of reference lines.
    pub const REFERENCE: Self = Self { colour: REFERENCE_COLOUR, dashes: Some(REFERENCE_DASHES), width: 1.0 };
}

/// The stroke of the `index`-th series of a chart, for what draws charts elsewhere as the pictures do.
#[must_use]
pub const fn stroke(index: usize, mark: Mark) -> Stroke {
    Stroke { colour: colour_of(index, mark), dashes: dashes(mark), width: stroke_width(mark) }
}

/// Width of a line: whole lines are wider, as broken ones are often drawn over them.
pub(super) const fn stroke_width(mark: Mark) -> f64 {
    match mark {
        Mark::Solid => 2.2,
        Mark::Dashed | Mark::DashDot | Mark::Points => 1.8,
        Mark::Dotted => 2.2,
        Mark::Thin => 0.9,
    }
}

/// The dashes of a mark on the curve, as SVG writes them.
pub(super) const fn dashes(mark: Mark) -> Option<&'static str> {
    match mark {
        Mark::Solid | Mark::Points | Mark::Thin => None,
        Mark::Dashed => Some("7 3"),
        Mark::Dotted => Some("2 2.5"),
        Mark::DashDot => Some("7 3 2 3"),
    }
}

/// The same in the legend, shorter so that the sample shows the pattern and not only its start.
pub(super) const fn legend_dashes(mark: Mark) -> Option<&'static str> {
    match mark {
        Mark::Solid | Mark::Points | Mark::Thin => None,
        Mark::Dashed => Some("5 2"),
        Mark::Dotted => Some("2 1.5"),
        Mark::DashDot => Some("5 2 2 3"),
    }
}
