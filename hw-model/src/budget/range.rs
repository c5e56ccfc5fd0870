//! Integer bits: the range of every register over all rows, with the ROM's own integers.

use super::error::horner;
use super::polynomial::extremes;
use super::{BudgetError, RowPolynomial};
use crate::format::QFormat;

/// The values a register can take, and the rows that reach furthest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    low: (f64, f64),
    high: (f64, f64),
}

impl Range {
    /// The range that holds only zero (what a register shows without a ROM word).
    #[must_use]
    pub const fn zero() -> Self {
        Self { low: (0.0, f64::NAN), high: (0.0, f64::NAN) }
    }

    /// Widened to `low..=high`, reached at this exponent.
    #[must_use]
    pub fn with(mut self, (low, high): (f64, f64), exponent: f64) -> Self {
        if low < self.low.0 {
            self.low = (low, exponent);
        }
        if high > self.high.0 {
            self.high = (high, exponent);
        }
        self
    }

    /// The narrowest format with this many fraction bits, or the stated one if it holds the range.
    ///
    /// # Errors
    /// When the range needs more than 63 bits, or the stated format does not hold it.
    pub fn format(
        &self,
        register: &'static str,
        fraction: u32,
        stated: Option<QFormat>,
    ) -> Result<QFormat, BudgetError> {
        let scale = f64::from(fraction).exp2();
        // Floor and ceiling: the integers that enclose every value the register can show.
        let low = (self.low.0 * scale).floor() as i128;
        let high = (self.high.0 * scale).ceil() as i128;
        let furthest = if self.high.0 >= -self.low.0 { self.high.1 } else { self.low.1 };
        let needed = QFormat::for_range(low, high, fraction).map_err(|source| BudgetError::TooWide {
            register,
            exponent: furthest,
            source,
        })?;
        let Some(stated) = stated else {
            return Ok(needed);
        };
        if stated.holds(low) && stated.holds(high) {
            return Ok(stated);
        }
        let exponent = if stated.holds(high) { self.low.1 } else { self.high.1 };
        let (low, high) = (self.low.0, self.high.0);
        Err(BudgetError::Overflow { register, stated, needed, exponent, low, high })
    }
}

/// The rounding errors that the partial results may carry, as real values.
#[derive(Debug, Clone, Default)]
pub struct Carried {
    /// The rounding error of v.
    pub v: f64,
    /// Of t1, t2, …, each by its own rounding.
    pub lines: Vec<f64>,
}

/// The ranges of v, t1, t2, … over all rows of one degree. The coefficients are those in the ROM, as real values.
///
/// A partial result is a polynomial of lower degree in v; its extremes over the region are widened by
/// the rounding errors that reach it, and by a relative 2^−40 for the arithmetic of this analysis.
/// Its own rounding comes last and never takes a sum that is not negative below 0, whatever the mode.
#[must_use]
pub fn ranges(rows: &[RowPolynomial], subtract: bool, carried: &Carried) -> Vec<Range> {
    let mut ranges = vec![Range::zero(); 1 + carried.lines.len()];
    for row in rows {
        let region = ((row.v.0 - carried.v).max(0.0), row.v.1 + carried.v);
        let v = region.1;
        ranges[0] = ranges[0].with(region, row.exponent);
        // The rounding error that reaches the sum of a stage.
        let mut reach = 0.0;
        for (index, (range, own)) in ranges[1..].iter_mut().zip(&carried.lines).enumerate() {
            // What the stage has summed: the terms from its own addend up.
            let terms = row.terms();
            let partial = horner(&terms[terms.len().saturating_sub(index + 2)..], subtract);
            let (low, high) = extremes(&partial, region);
            let scale: f64 = partial.iter().rev().fold(0.0, |sum, c| sum * v + c.abs());
            let slack = reach + scale * (-40_f64).exp2();
            let floor = if low >= slack { 0.0 } else { f64::NEG_INFINITY };
            let low = (low - slack - own).max(floor);
            *range = range.with((low, high + slack + own), row.exponent);
            reach = (reach + own) * v;
        }
    }
    ranges
}
