//! Range and error analysis: from the input and output formats and an error budget to the width of
//! every register.
//!
//! **What is promised.** For every row and every representable x, the pipeline differs from the same
//! polynomial (or ratio) with real coefficients, evaluated at the same x, by at most the budget: 1
//! output ulp unless the configuration says otherwise. Approximation (polynomial against x^n) and
//! input quantisation are not in it; no width can mend them.
//!
//! **Error.** A rounding to f fraction bits is off by at most 2^−f, half of it when rounding to
//! nearest. Going through the rest of Horner's rule it is multiplied by v once a stage, so with
//! V = max v and S = max |f′(v)| on the row's region, the parts add up to
//!
//! ```text
//! coefficients   δ3·V³ + δ2·V² + δ1·V + δ0        (δ = ½ ulp of each, 0 where the row is exact;
//!                                                  where it is moved by steps, the greatest
//!                                                  difference of the two polynomials)
//! data path      S·δv  + ρ1·V² + ρ2·V + ρ3        (ρ = ½ or 1 ulp by the mode, 0 where exact)
//! ```
//!
//! for a cubic, and alike for other degrees, where V includes δv, and S·δv stands for the terms that Taylor's series
//! has: as many as the degree;
//! and for the tail g = x/D, D = A − B·x, whose error grows towards its upper end x = cut:
//! (δA + x·δB + ρD)·g/D + ρ of the quotient. See [`error`].
//!
//! **Widths.** Fraction bits start generous; bits are then taken away one at a time, each time where
//! that saves most hardware for the error it adds, while the worst row stays within the budget
//! ([`search`]). Integer bits follow from the ranges of the polynomial and its partial results over
//! the region, with the ROM's own integers, widened by the rounding errors ([`range`]).

pub mod error;
mod polynomial;
pub mod range;
pub mod search;
pub mod tail;

use thiserror::Error;

use crate::format::{FormatError, QFormat};
use crate::registers::MAX_DEGREE;
use crate::steps::Steps;

/// What the analysis must know of the polynomial of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowPolynomial {
    /// The row's exponent n, 1 or more.
    pub exponent: f64,
    /// e: the places s is moved up to become u; 0 in the power form.
    pub shift: u32,
    /// The polynomial's degree, and the number of its stages.
    pub degree: usize,
    /// c0, c1, … of t1 = c(d − 1) ± c(d)·v, …, t(d) = c0 ± t(d − 1)·v; 0 above the degree.
    pub coefficients: [f64; MAX_DEGREE + 1],
    /// The units of their last places by which the integers of the coefficients are moved beyond rounding.
    pub steps: Steps,
    /// The least and the greatest v the polynomial is given.
    pub v: (f64, f64),
    /// False where the cut lies above every x of the input format (UQ0.n and a large n): the polynomial
    /// is still fed, so its ranges count, but its error reaches no result.
    pub answers: bool,
}

impl RowPolynomial {
    /// The coefficients up to the degree.
    #[must_use]
    pub fn terms(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }
}

/// What the analysis must know of the tail of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowTail {
    /// The row's exponent n, 1 or more.
    pub exponent: f64,
    /// A of the tail x/(A − B·x).
    pub a: f64,
    /// B of the tail x/(A − B·x).
    pub b: f64,
    /// The greatest x the divider is given; 0 where the tail is empty.
    pub greatest_x: f64,
}

/// Why no widths can be had.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum BudgetError {
    /// A register needs more than 63 bits.
    #[error(
        "register {register} at n = {exponent}: {source}; use fewer fraction bits or smaller exponents, \
         or the centred form"
    )]
    TooWide {
        /// The register's name, as in traces.
        register: &'static str,
        /// The exponent that needs it.
        exponent: f64,
        /// The format that the register would need, with its width.
        source: FormatError,
    },
    /// A stated format does not hold what the register can take.
    #[error(
        "register {register}, stated as {stated}, could overflow at n = {exponent}: its values reach {low} to {high}, \
         {stated} holds {} to {}; it needs {needed}",
        crate::quantise::decimal(stated.min_bits(), *stated),
        crate::quantise::decimal(stated.max_bits(), *stated)
    )]
    Overflow {
        /// The register's name, as in traces.
        register: &'static str,
        /// The format that the configuration states for it.
        stated: QFormat,
        /// The format that would hold it.
        needed: QFormat,
        /// The exponent whose values are out of range.
        exponent: f64,
        /// The least value that the register takes, as a real number.
        low: f64,
        /// The greatest value that the register takes, as a real number.
        high: f64,
    },
    /// A stated format has too few fraction bits for its line to be exact where it must be.
    #[error(
        "register {register}, stated as {stated}, needs {least} fraction bits or more, so that the dividend is an \
         integer"
    )]
    TooFewFractionBits {
        /// The register's name, as in traces.
        register: &'static str,
        /// The format that the configuration states for it.
        stated: QFormat,
        /// The fewest fraction bits.
        least: u32,
    },
    /// The error cannot be kept within the budget.
    #[error(
        "the error budget of {budget} ulp cannot be kept: {what} reach {needed:.3} ulp at n = {exponent}; \
         raise error_budget_ulp, round to nearest, or allow wider formats"
    )]
    NotKept {
        /// The budget, in output ulp.
        budget: f64,
        /// Which widths were tried.
        what: &'static str,
        /// The worst row's error, in output ulp.
        needed: f64,
        /// The exponent of the row with the greatest error.
        exponent: f64,
    },
    /// An operand is wider than the configuration's multipliers.
    #[error(
        "register {register} has {format}, {} bits, more than multiplier_operand_bits = {most}; raise it, or state a \
         narrower format in widths.{register}",
        format.width()
    )]
    OperandTooWide {
        /// The register's name, as in traces.
        register: &'static str,
        /// The format that the register has, by analysis or as stated.
        format: QFormat,
        /// The widest operand allowed.
        most: u32,
    },
    /// A line is wider than the 127 bits of the widest lane.
    #[error("the line of {line} needs {bits} bits, more than 127; use fewer fraction bits")]
    LineTooWide {
        /// The name of the register that the line computes.
        line: &'static str,
        /// The bits that the line's exact value takes before rounding.
        bits: u32,
    },
}

/// The error bounds of one row, in output ulp.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bound {
    /// Coefficient quantisation, epicentre or whole polynomial region.
    pub coefficient: f64,
    /// Data-path rounding of the polynomial.
    pub datapath: f64,
    /// Both together, on the tail.
    pub tail: f64,
}

impl Bound {
    /// The greater of polynomial and tail.
    #[must_use]
    pub fn total(&self) -> f64 {
        (self.coefficient + self.datapath).max(self.tail)
    }
}
