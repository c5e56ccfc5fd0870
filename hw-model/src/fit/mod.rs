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
mod error;
mod levels;
mod methods;
pub mod minimax;

pub use crossing::{Crossing, crossing};
pub use curve::{Curve, Fit};
pub use error::FitError;
pub use levels::{Levels, LevelsError};
pub use methods::{Capabilities, Hardware, Method, UnknownMethod};

use crossing::WideCrossing;
use error::checked;

/// Fits one exponent n, 1 ≤ n ≤ [`MAX_EXPONENT`](crate::exponents::MAX_EXPONENT), any real number.
///
/// # Errors
/// When the exponent is outside that range.
pub fn fit(method: Method, exponent: f64, levels: Levels) -> Result<Fit, FitError> {
    let at_q = WideCrossing::new(checked(exponent)?, levels.q());
    let curve = (method.capabilities().fit)(exponent, levels, &at_q);
    Ok(Fit { epicentre: at_q.rounded(), curve })
}

#[cfg(test)]
mod tests;
