//! Everything that is drawn for people.
//!
//! A [`Chart`] is plain data: axes, series, reference lines. It becomes an SVG with
//! [`Chart::to_svg`], and an SVG becomes a PNG with [`svg_to_png`]. The crates that do the drawing
//! are named only in `draw.rs`, `legend.rs`, `spots.rs`, `raster.rs`, `texts.rs` and `canvas.rs`, so that each can be
//! replaced without touching a caller. A diagram is drawn on a [`canvas`], and [`texts()`] says where its words stand.
//!
//! A picture is a function of its data: no system fonts, no clock, no random identifiers. The same
//! chart gives the same bytes, so a generated figure can be kept under version control and compared.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod axis;
pub mod canvas;
mod chart;
mod draw;
mod error;
mod figures;
mod legend;
mod placement;
mod raster;
mod reference;
mod spot;
mod spots;
mod style;
#[cfg(test)]
mod tests;
mod texts;
mod words;

pub use axis::{Axis, Scale};
pub use chart::{Chart, Mark, ReferenceLine, Series, Size};
pub use error::PlotError;
pub use figures::{Curve, angle_grid, error_versus_exponent, intensity_versus_angle};
pub use raster::{svg_to_pixels, svg_to_png};
pub use spot::{Kind, Shape, Spot};
pub use style::{Stroke, stroke};
pub use texts::{Text, texts};
