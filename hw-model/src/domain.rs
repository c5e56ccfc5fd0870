//! The x that a piece of hardware is built for, where that is not all of them.
//!
//! A configuration with a domain answers for its exponents from a least x up to 1, and for nothing else: below
//! that the intensity is 0 and the status says `out_of_domain`. The least x of a row takes the place of its cut, so
//! that widths follow from the domain alone. It may not lie below the cut: there a zero would be an answer, and not
//! a refusal.

use serde::{Deserialize, Serialize};

use crate::config::{Config, ConfigError, Tail};
use crate::quantise::round_scaled;
use crate::rounding::Rounding;

/// What is presented with one exponent: x from `least` to 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Presented {
    /// The exponent, one of the configuration's.
    pub n: f64,
    /// The least x, 0 to 1. The hardware has the next x of its input format at or below it.
    pub least: f64,
}

fn wrong<T>(problem: String) -> Result<T, ConfigError> {
    Err(ConfigError::Field { field: "domain", problem })
}

/// Checks what can be checked without the rows.
pub(crate) fn check(config: &Config) -> Result<(), ConfigError> {
    let domain = &config.domain;
    if domain.is_empty() {
        return Ok(());
    }
    if config.tail != Tail::Zero {
        return wrong(
            "a domain leaves out what answers below the cut: say \"tail\": \"zero\", or leave \
             the domain out"
                .to_owned(),
        );
    }
    if !config.exponents.iter().eq(domain.iter().map(|presented| presented.n)) {
        let exponents = &config.exponents;
        return wrong(format!("give one n and least for each exponent, in the order {exponents}"));
    }
    match domain.iter().find(|presented| !(0.0..=1.0).contains(&presented.least)) {
        Some(Presented { n, least }) => wrong(format!("least of n = {n} is {least}; use a number from 0 to 1")),
        None => Ok(()),
    }
}

/// The least x of the domain of an exponent, in the input's unit and rounded down, which no presented x rounds below;
/// none where the configuration has no domain.
///
/// # Errors
/// When the row's polynomial does not answer there: the domain begins below `cut`.
pub(crate) fn least_bits(config: &Config, exponent: f64, cut: i64) -> Result<Option<i64>, ConfigError> {
    let Some(presented) = config.domain.iter().find(|presented| presented.n == exponent) else {
        return Ok(None);
    };
    let fraction = config.input.fraction_bits();
    let bits = round_scaled(presented.least, fraction, Rounding::Floor).unwrap_or(0) as i64;
    if bits >= cut {
        return Ok(Some(bits));
    }
    let needed = cut as f64 * config.input.ulp();
    wrong(format!(
        "least of n = {exponent} is {}, below its cut at {needed}, where zero answers; use {needed} or more, or \
         leave the domain out",
        presented.least
    ))
}
