//! What no method is fitted to.

use thiserror::Error;

use crate::exponents::MAX_EXPONENT;

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

/// The exponent, where there is a fit for it.
pub(super) fn checked(exponent: f64) -> Result<f64, FitError> {
    if (1.0..=MAX_EXPONENT).contains(&exponent) { Ok(exponent) } else { Err(FitError::Exponent(exponent)) }
}
