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
//! The formulas, method by method, stand in the files of their names in `methods/`, and what each method is in the
//! table beside them. \[Rom\] is O. N. Romaniuk, A. L. V. Chan, P. I. Mykhaylov, R. Yu. Chekhmestruk, I. V. Perun,
//! "Approximation of classical distributive functions using a cubic polynomial" (in Ukrainian).

mod assemble;
mod crossing;
mod curve;
mod double_double;
mod levels;
mod methods;
pub mod minimax;

use thiserror::Error;

pub use crossing::Crossing;
pub use curve::{Curve, Fit};
pub use levels::{Levels, LevelsError};
pub use methods::{Capabilities, Hardware, Method, UnknownMethod};

use crate::exponents::MAX_EXPONENT;
use crossing::WideCrossing;

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
    let curve = (method.capabilities().fit)(exponent, levels, &at_q);
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

#[cfg(test)]
mod tests;
