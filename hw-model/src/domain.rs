//! The x that a piece of hardware is built for, where that is not all of them.
//!
//! A configuration with a domain answers for its exponents from a least x up to 1, and for nothing else: below
//! that the intensity is 0 and the status says `out_of_domain`. The least x of a row takes the place of its cut, so
//! that widths follow from the domain alone. It may not lie below the cut: there a zero would be an answer, and not
//! a refusal.

use serde::{Deserialize, Serialize};

use crate::exponents::Exponents;
use crate::format::QFormat;
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

/// Checks what can be checked without the rows: of a configuration of these exponents, with a tail or without.
///
/// # Errors
/// What is wrong, and what would be right.
pub(crate) fn check(domain: &[Presented], exponents: &Exponents, has_tail: bool) -> Result<(), String> {
    if domain.is_empty() {
        return Ok(());
    }
    if has_tail {
        return Err("a domain leaves out what answers below the cut: say \"tail\": \"zero\", or leave the domain \
                    out"
        .to_owned());
    }
    if !exponents.iter().eq(domain.iter().map(|presented| presented.n)) {
        return Err(format!("give one n and least for each exponent, in the order {exponents}"));
    }
    match domain.iter().find(|presented| !(0.0..=1.0).contains(&presented.least)) {
        Some(Presented { n, least }) => Err(format!("least of n = {n} is {least}; use a number from 0 to 1")),
        None => Ok(()),
    }
}

/// The least x of the domain of an exponent, in the unit of `input` and rounded down; no presented x rounds below it.
/// None where there is no domain.
///
/// # Errors
/// When the row's polynomial does not answer there: the domain begins below `cut`.
pub(crate) fn least_bits(domain: &[Presented], input: QFormat, exponent: f64, cut: i64) -> Result<Option<i64>, String> {
    let Some(presented) = domain.iter().find(|presented| presented.n == exponent) else {
        return Ok(None);
    };
    let bits = round_scaled(presented.least, input.fraction_bits(), Rounding::Floor).unwrap_or(0) as i64;
    if bits >= cut {
        return Ok(Some(bits));
    }
    let needed = cut as f64 * input.ulp();
    Err(format!(
        "least of n = {exponent} is {}, below its cut at {needed}, where zero answers; use {needed} or more, or \
         leave the domain out",
        presented.least
    ))
}
