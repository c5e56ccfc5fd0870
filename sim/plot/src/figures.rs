//! The figures of the paper, as functions of plain data.

use super::axis::{Axis, LEAST_LOGARITHMIC, Scale};
use super::chart::{Chart, Mark, ReferenceLine, Series};

/// A curve with a name for the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name in the legend.
    pub name: String,
    /// Its points: what they mean is said by the figure they go into.
    pub points: Vec<(f64, f64)>,
    /// Colour and stroke, counted from 0: the same for the same thing in several figures. Without it the place counts.
    pub style: Option<usize>,
}

impl Curve {
    /// A curve with this name, through these points.
    #[must_use]
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.into(), points, style: None }
    }

    /// The same with this colour and stroke.
    #[must_use]
    pub fn styled(self, style: usize) -> Self {
        Self { style: Some(style), ..self }
    }
}

/// Error against the exponent, as in Fig. 1 of the paper: points are (n, error in per cent).
///
/// With a logarithmic error axis, errors below 1e-10 % are left out: such an axis has no place for
/// them, and they are zero but for the rounding of the reference (every method is exact at n = 1).
#[must_use]
pub fn error_versus_exponent(
    title: impl Into<String>,
    error_scale: Scale,
    curves: Vec<Curve>,
    bounds: Vec<ReferenceLine>,
) -> Chart {
    let y_axis = match error_scale {
        Scale::Linear => Axis::linear("error, %"),
        Scale::Log => Axis::log("error, %"),
    };
    let mut chart = Chart::new(title, Axis::log("exponent n"), y_axis);
    chart.series = curves
        .into_iter()
        .map(|mut curve| {
            if error_scale == Scale::Log {
                curve.points.retain(|&(_, error)| !(0.0..LEAST_LOGARITHMIC).contains(&error));
            }
            curve
        })
        .enumerate()
        .map(|(index, curve)| series(index, curve))
        .collect();
    chart.reference_lines = bounds;
    let dots = chart.series.iter().any(|series| series.dots);
    let ends = extent(chart.points().map(|point| point.0));
    // Dots at both ends need some room beside them.
    chart.x_axis.range = ends.map(|(low, high)| {
        let room = if dots { (high / low).powf(0.03) } else { 1.0 };
        (low / room, high * room)
    });
    chart
}

/// Intensity against the angle, as in Fig. 3 of the paper: points are (γ in degrees, intensity).
///
/// [`angle_grid`] gives angles that show the whole highlight of an exponent.
#[must_use]
pub fn intensity_versus_angle(title: impl Into<String>, curves: Vec<Curve>) -> Chart {
    let mut chart = Chart::new(title, Axis::linear("angle γ, degrees"), Axis::linear("intensity"));
    chart.series = curves.into_iter().enumerate().map(|(index, curve)| series(index, curve)).collect();
    chart.x_axis.range = extent(chart.points().map(|point| point.0));
    chart
}

/// `count` equally spaced angles γ from 0 to where cosⁿ γ has fallen to 1/1000 (90° at most), each
/// as (γ in degrees, cos γ).
///
/// The angles are spaced and not the cosines: the cosine is flat at the top of the highlight, where
/// equal steps of it would leave the most interesting part without points.
#[must_use]
pub fn angle_grid(exponent: f64, count: usize) -> Vec<(f64, f64)> {
    let edge = 1e-3_f64.powf(exponent.recip()).acos().to_degrees();
    let last = edge.ceil().clamp(1.0, 90.0);
    (0..count)
        .map(|index| {
            let degrees = last * index as f64 / count.saturating_sub(1).max(1) as f64;
            // 0 and not 6e-17 where the cosine of 90° is meant.
            let cosine = if degrees == 90.0 { 0.0 } else { degrees.to_radians().cos() };
            (degrees, cosine)
        })
        .collect()
}

/// Up to as many points are shown one by one: exponents that stand apart, with nothing measured in between.
const FEW: usize = 12;

fn series(index: usize, curve: Curve) -> Series {
    let style = curve.style.unwrap_or(index);
    Series {
        colour: curve.style,
        dots: curve.points.len() <= FEW,
        ..Series::new(curve.name, curve.points, Mark::nth(style))
    }
}

/// From the least to the greatest value; `None`, which leaves the choice to the axis, when they
/// are the same or there are none.
fn extent(values: impl Iterator<Item = f64> + Clone) -> Option<(f64, f64)> {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(f64::NEG_INFINITY, f64::max);
    (low < high).then_some((low, high))
}
