//! Why the search has no result.

use hw_model::design::DesignError;
use hw_model::fit::FitError;
use hw_model::format::QFormat;
use thiserror::Error;

/// Why there is no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SizingError {
    /// A fit.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A design.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// Nothing is near enough.
    #[error(
        "nothing keeps an error of {error}: the nearest, {nearest}, has {real:.6} at n = {n} {why}; allow more, a \
         smaller range, or a wider output"
    )]
    Nothing {
        /// What was asked for.
        error: f64,
        /// The nearest candidate.
        nearest: String,
        /// Its real error.
        real: f64,
        /// The exponent of that error.
        n: f64,
        /// What kept it from being built.
        why: String,
    },
    /// Nothing was asked.
    #[error(
        "no exponent has an x in the range: where x^n is that much, x is beyond {input}; ask for a larger range, or an \
         input with more bits"
    )]
    Empty {
        /// The format of x.
        input: QFormat,
    },
    /// A register could lose a bit.
    #[error("register {register} could have a bit less; please report the command")]
    Spare {
        /// The register.
        register: &'static str,
    },
    /// A witness that does not say what it was called for.
    #[error("the witness of register {register} at n = {n} fails; please report the command")]
    Silent {
        /// The register.
        register: &'static str,
        /// The exponent.
        n: f64,
    },
}
