//! Why a configuration gives no hardware.

use thiserror::Error;

use crate::budget::BudgetError;
use crate::clock::ClockError;
use crate::config::ConfigError;
use crate::fit::FitError;
use crate::presets;
use crate::quantise::QuantiseError;

/// Why a configuration gives no hardware.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DesignError {
    /// A preset that is none.
    #[error("there is no preset {name:?}; the presets are {}", presets::ALL.map(|preset| preset.name).join(", "))]
    NoPreset {
        /// The name.
        name: String,
    },
    /// The configuration contradicts itself.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A method has no fit for one of the exponents.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// No widths keep the budget, or a stated width is too small.
    #[error(transparent)]
    Budget(#[from] BudgetError),
    /// No ranks of registers follow from the clock.
    #[error("field `clock`: {0}")]
    Clock(#[from] ClockError),
    /// A ROM field does not hold the value of a row.
    #[error("ROM field {field} at n = {exponent}: {source}")]
    Quantise {
        /// The field's name, as in the ROM's layout.
        field: &'static str,
        /// The row's exponent.
        exponent: f64,
        /// What is wrong with the value or the format.
        source: QuantiseError,
    },
}
