//! The error of a function in f32, measured against x^n at x that are f32 themselves.

use hw_model::fit::{FitError, crossing};
use hw_model::highlight::phong;

use super::piecewise::Piecewise;

/// Steps of each of the three even spreads of x: over [0, 1], over the highlight's own range, and over the part of
/// [0, 1] where x^n is not yet nothing.
const STEPS: u32 = 1 << 15;

/// How far x^n is followed, in units of 1/n of s = 1 − x: it falls by e⁻⁴⁰.
const FOLLOWED: f64 = 40.0;

/// A greatest error and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// |f(x) − x^n|, as a fraction of full intensity.
    pub error: f64,
    /// The x where.
    pub x: f32,
}

/// The greatest errors of one exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// On the highlight's own range, x^n ≥ Q.
    pub highlight: Worst,
    /// On all of [0, 1].
    pub whole: Worst,
    /// The x that were looked at.
    pub count: usize,
}

/// Measures a function: three even spreads of x, and every x around the end of a segment.
///
/// # Errors
/// When the exponent or the level Q is out of range.
pub fn measured(function: &Piecewise, exponent: f64, level: f64) -> Result<Measured, FitError> {
    let highlight = crossing(exponent, level)?;
    let spread = |length: f64| {
        (0..=STEPS).map(move |step| (1.0 - length * f64::from(step) / f64::from(STEPS)).clamp(0.0, 1.0) as f32)
    };
    let around = |end: f32| [(1.0 - end).next_down(), 1.0 - end, (1.0 - end).next_up()];
    let ends = function.segments.iter().flat_map(|segment| around(segment.end));
    let xs = [1.0, highlight.s, (FOLLOWED / exponent).min(1.0)].into_iter().flat_map(spread).chain(ends);
    let none = Worst { error: 0.0, x: 1.0 };
    let mut found = Measured { highlight: none, whole: none, count: 0 };
    for x in xs.filter(|x| (0.0..=1.0).contains(x)) {
        let error = (f64::from(function.at(x)) - phong(exponent, x.into())).abs();
        found.count += 1;
        let regions = [(true, &mut found.whole), (f64::from(x) >= highlight.x, &mut found.highlight)];
        for (_, worst) in regions.into_iter().filter(|(inside, worst)| *inside && error > worst.error) {
            *worst = Worst { error, x };
        }
    }
    Ok(found)
}
