//! From an exponent to real coefficients.
//!
//! Every coefficient is computed in numbers of 106 bits and rounded once, with functions that give
//! the same bits on every platform; see `double_double` for why. For levels from 10⁻⁹ to 1 − 10⁻⁶
//! the result is the nearest f64 or, in a near tie, its neighbour, for any n: also close to an n at
//! which a coefficient vanishes (c of `hermite` at the f64 next above 3 is off by six roundings, the worst that
//! `blysk stability` found), and with G close to Q. Q → 1 costs digits only beyond 1 − 10⁻¹⁰ (there
//! the error is still below 10⁻¹⁵). For Q below 10⁻⁹, b, c and d, which tend to 0 there while k1, k2,
//! k3 do not, are accurate to 10⁻³¹ of the greatest coefficient, and not relative to themselves.
//!
//! The formulas, method by method, stand in the files of their names. \[Rom\] is O. N. Romaniuk,
//! A. L. V. Chan, P. I. Mykhaylov, R. Yu. Chekhmestruk, I. V. Perun, "Approximation of classical
//! distributive functions using a cubic polynomial" (in Ukrainian).

mod assemble;
mod crossing;
mod double_double;
mod hermite;
mod levels;
mod method;
pub mod minimax;
mod quadratic;
mod rational;
mod tangent;
mod three_point;

use thiserror::Error;

pub use crossing::Crossing;
pub use levels::{Levels, LevelsError};
pub use method::{Method, UnknownMethod};

use crate::exponents::MAX_EXPONENT;
use crate::highlight::{Cubic, Rational};
use crossing::WideCrossing;

/// The approximation of x^n by one method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Where the epicentre begins: x = q = Q^(1/n), s = p = 1 − q.
    pub epicentre: Crossing,
    /// The function of x that approximates x^n.
    pub curve: Curve,
}

/// The function of x a method arrives at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// One cubic for all x (for the parabola, k3 = a = 0).
    Cubic(Cubic),
    /// One hyperbola for all x.
    Rational(Rational),
    /// A cubic on the epicentre, a hyperbola below it.
    Composite {
        /// For x ≥ q.
        epicentre: Cubic,
        /// For x < q.
        tail: Rational,
    },
}

/// Why a fit is refused.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FitError {
    /// The exponent is outside 1..=[`MAX_EXPONENT`].
    #[error("the exponent {0} is out of range; exponents are numbers from 1 to 1e15")]
    Exponent(f64),
    /// The level is not one that x^n crosses.
    #[error("the level {0} is out of range; x^n crosses every level above 0 and up to 1")]
    Level(f64),
}

/// Fits one exponent n, 1 ≤ n ≤ [`MAX_EXPONENT`], any real number.
///
/// # Errors
/// When the exponent is outside that range.
pub fn fit(method: Method, exponent: f64, levels: Levels) -> Result<Fit, FitError> {
    let at_q = WideCrossing::new(checked(exponent)?, levels.q());
    let hermite = || hermite::hermite(exponent, &at_q);
    let rational = || rational::rational(exponent, levels.q(), &at_q);
    let curve = match method {
        Method::Hermite => Curve::Cubic(hermite()),
        Method::ThreePoint => {
            let at_g = WideCrossing::new(exponent, levels.g());
            Curve::Cubic(three_point::three_point(exponent, &at_q, &at_g))
        }
        Method::Tangent => Curve::Cubic(tangent::tangent(exponent, &at_q)),
        Method::Minimax => Curve::Cubic(minimax::minimax(exponent, &at_q).0),
        Method::Quadratic => Curve::Cubic(quadratic::quadratic(exponent, &at_q)),
        Method::Rational => Curve::Rational(rational()),
        Method::Composite => Curve::Composite { epicentre: hermite(), tail: rational() },
        Method::Schlick => Curve::Rational(Rational::schlick(exponent)),
    };
    Ok(Fit { epicentre: at_q.rounded(), curve })
}

/// Where x^n crosses `level`, 0 < level ≤ 1: x = level^(1/n), and s = 1 − x without cancellation.
///
/// # Errors
/// When the exponent is outside 1..=[`MAX_EXPONENT`], or the level is not above 0 (subnormal numbers
/// included) and at most 1.
pub fn crossing(exponent: f64, level: f64) -> Result<Crossing, FitError> {
    let exponent = checked(exponent)?;
    if !(f64::MIN_POSITIVE..=1.0).contains(&level) {
        return Err(FitError::Level(level));
    }
    Ok(WideCrossing::new(exponent, level).rounded())
}

fn checked(exponent: f64) -> Result<f64, FitError> {
    if (1.0..=MAX_EXPONENT).contains(&exponent) { Ok(exponent) } else { Err(FitError::Exponent(exponent)) }
}

impl Fit {
    /// The approximation at x = 1 − s, s in [0, 1], without any clamp.
    #[must_use]
    pub fn value_at_s(&self, s: f64) -> f64 {
        match &self.curve {
            Curve::Cubic(cubic) => cubic.centred.value_at_s(s),
            Curve::Rational(rational) => rational.value_at_s(s),
            Curve::Composite { epicentre, .. } if s <= self.epicentre.s => epicentre.centred.value_at_s(s),
            Curve::Composite { tail, .. } => tail.value_at_s(s),
        }
    }

    /// Its slope against s (the slope against x is the negative of it).
    #[must_use]
    pub fn slope_at_s(&self, s: f64) -> f64 {
        match &self.curve {
            Curve::Cubic(cubic) => cubic.centred.slope_at_s(s),
            Curve::Rational(rational) => rational.slope_at_s(s),
            Curve::Composite { epicentre, .. } if s <= self.epicentre.s => epicentre.centred.slope_at_s(s),
            Curve::Composite { tail, .. } => tail.slope_at_s(s),
        }
    }

    /// The approximation at x in [0, 1]. A hyperbola keeps its digits also for x so small that 1 − x is 1.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        match &self.curve {
            Curve::Rational(rational) => rational.value(x),
            Curve::Composite { tail, .. } if x < self.epicentre.x => tail.value(x),
            Curve::Cubic(_) | Curve::Composite { .. } => self.value_at_s(1.0 - x),
        }
    }

    /// The cubic, where the method has one.
    #[must_use]
    pub const fn cubic(&self) -> Option<&Cubic> {
        match &self.curve {
            Curve::Cubic(cubic) | Curve::Composite { epicentre: cubic, .. } => Some(cubic),
            Curve::Rational(_) => None,
        }
    }

    /// The hyperbola, where the method has one.
    #[must_use]
    pub const fn rational(&self) -> Option<&Rational> {
        match &self.curve {
            Curve::Rational(rational) | Curve::Composite { tail: rational, .. } => Some(rational),
            Curve::Cubic(_) => None,
        }
    }
}

#[cfg(test)]
mod tests;
