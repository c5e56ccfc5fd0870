//! Why a picture is refused.

use thiserror::Error;

/// Why there is no picture. Data that cannot be drawn truthfully is refused rather than drawn.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The chart has no series.
    #[error("the chart {title:?} has no series")]
    NoSeries {
        /// The title of the chart.
        title: String,
    },
    /// A series has no points.
    #[error("the series {name:?} has no points")]
    NoPoints {
        /// The name of the series.
        name: String,
    },
    /// A coordinate is infinite or not a number.
    #[error("{name:?} has a point ({x}, {y}) that is not finite")]
    NotFinite {
        /// The name of the series, or the label of the reference line.
        name: String,
        /// The x of the point.
        x: f64,
        /// The y of the point.
        y: f64,
    },
    /// A value that a logarithmic axis cannot show.
    #[error("{value} has no place on the logarithmic axis {axis:?}, which starts at {least:e}")]
    BelowLogarithmic {
        /// The label of the axis.
        axis: String,
        /// The value that has no logarithm.
        value: f64,
        /// The least value a logarithmic axis shows.
        least: f64,
    },
    /// The range of an axis is empty, reversed, not finite, or too narrow to tell its ends apart.
    #[error("{low} to {high} is not a range for the axis {axis:?}")]
    Range {
        /// The label of the axis.
        axis: String,
        /// The lower end that was given.
        low: f64,
        /// The upper end that was given.
        high: f64,
    },
    /// The text handed over is not an SVG.
    #[error("the SVG cannot be read: {0}")]
    Svg(String),
    /// The picture would have no pixels, or more than is sensible.
    #[error("{width} × {height} pixels at scale {scale} is not a size for a picture")]
    Size {
        /// The width in pixels.
        width: f32,
        /// The height in pixels.
        height: f32,
        /// Pixels per SVG unit.
        scale: f32,
    },
    /// The PNG could not be written.
    #[error("the PNG cannot be encoded: {0}")]
    Png(String),
}
