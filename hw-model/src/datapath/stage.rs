//! One multiply-add stage: `t = addend ± multiplicand · v`, rounded once.
//!
//! The stages of the polynomial (Horner's rule, as many as its degree) and the divisor of the tail are this line. Of a
//! cubic:
//!
//! | stage   | power form     | centred form   | tail         |
//! |---------|----------------|----------------|--------------|
//! | 1       | t1 = c2 + c3·v | t1 = c2 − c3·v | D = A − B·x  |
//! | 2       | t2 = c1 + t1·v | t2 = c1 − t1·v |              |
//! | 3       | t3 = c0 + t2·v | t3 = c0 − t2·v |              |
//!
//! The centred form subtracts because 1 − u(k1 − u(k2 − u·k3)) then has coefficients that are all
//! positive for the fits used, and a sign bit less in each operand.
//!
//! Widths: with m, v, a, t the fraction bits of multiplicand, variable, addend and result, the product
//! is kept whole (m + v fraction bits); product and addend are moved up to the larger of m + v and a
//! (no bit is lost), added, and only then rounded to t.

use crate::registers::MAX_DEGREE;
use crate::rounding::{Lane, Rounding, round_shift};

/// A multiply-add line with its alignment; built by [`MultiplyAdd::aligned`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MultiplyAdd {
    subtract: bool,
    product_up: u32,
    addend_up: u32,
    result_up: u32,
    drop: u32,
    rounding: Rounding,
}

/// The stages of a polynomial, the first of which multiplies the highest coefficient. None where there is no
/// polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stages {
    degree: usize,
    lines: [MultiplyAdd; MAX_DEGREE],
}

impl Stages {
    /// No stages: what has no polynomial.
    pub const NONE: Self = Self { degree: 0, lines: [MultiplyAdd::NOTHING; MAX_DEGREE] };

    /// These stages; at most [`MAX_DEGREE`] of them count.
    #[must_use]
    pub fn new(lines: impl IntoIterator<Item = MultiplyAdd>) -> Self {
        let mut stages = Self::NONE;
        for (place, line) in stages.lines.iter_mut().zip(lines) {
            *place = line;
            stages.degree += 1;
        }
        stages
    }

    /// The stages in their order.
    #[inline(always)]
    #[must_use]
    pub fn lines(&self) -> &[MultiplyAdd] {
        &self.lines[..self.degree]
    }

    /// How many there are: the polynomial's degree.
    #[inline(always)]
    #[must_use]
    pub const fn degree(&self) -> usize {
        self.degree
    }

    /// Each stage changed.
    #[inline(always)]
    #[must_use]
    pub(super) fn map(self, change: impl Fn(MultiplyAdd) -> MultiplyAdd) -> Self {
        Self { lines: self.lines.map(change), ..self }
    }

    /// Stage `index`, 0 for the first; one that is not there makes 0 of zeros.
    #[inline(always)]
    pub(super) const fn line(&self, index: usize) -> &MultiplyAdd {
        &self.lines[index]
    }
}

/// The fraction bits that meet in a multiply-add line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fractions {
    /// Of the multiplicand (c3, t1, t2 or B).
    pub multiplicand: u32,
    /// Of the variable (x or u).
    pub variable: u32,
    /// Of the addend (c2, c1, c0 or A).
    pub addend: u32,
    /// Of the result (t1, t2, t3 or D).
    pub result: u32,
}

impl MultiplyAdd {
    /// A line that is not there: of zeros it makes 0.
    pub(super) const NOTHING: Self =
        Self { subtract: false, product_up: 0, addend_up: 0, result_up: 0, drop: 0, rounding: Rounding::Floor };

    /// The line for these fraction bits; `subtract` takes the product away from the addend.
    #[must_use]
    pub const fn aligned(fractions: Fractions, subtract: bool, rounding: Rounding) -> Self {
        let product = fractions.multiplicand + fractions.variable;
        let common = if product > fractions.addend { product } else { fractions.addend };
        Self {
            subtract,
            product_up: common - product,
            addend_up: common - fractions.addend,
            result_up: fractions.result.saturating_sub(common),
            drop: common.saturating_sub(fractions.result),
            rounding,
        }
    }

    /// Fraction bits dropped by the rounding; 0 means the line is exact.
    #[must_use]
    pub const fn dropped_bits(&self) -> u32 {
        self.drop
    }

    /// Places the product is moved up to meet the addend.
    #[must_use]
    pub const fn product_up(&self) -> u32 {
        self.product_up
    }

    /// Places the addend is moved up to meet the product.
    #[must_use]
    pub const fn addend_up(&self) -> u32 {
        self.addend_up
    }

    /// Places the sum is moved up where the result has more fraction bits.
    #[must_use]
    pub const fn result_up(&self) -> u32 {
        self.result_up
    }

    /// How the sum is rounded.
    #[must_use]
    pub const fn rounding(&self) -> Rounding {
        self.rounding
    }

    /// The same line, rounded by `mode`.
    #[inline(always)]
    #[must_use]
    pub const fn rounded_by(self, mode: Rounding) -> Self {
        Self { rounding: mode, ..self }
    }

    /// True where product and addend meet without being moved up and bits are dropped from their sum, as in
    /// nearly every line.
    #[must_use]
    pub const fn is_plain(&self) -> bool {
        self.product_up == 0 && self.result_up == 0 && self.drop > 0
    }

    /// The same plain line, with all that the compiler may know of it: it leaves no choice in a loop.
    #[inline(always)]
    #[must_use]
    pub const fn known_plain(self, subtract: bool) -> Self {
        let drop = if self.drop == 0 { 1 } else { self.drop };
        Self { subtract, product_up: 0, result_up: 0, drop, ..self }
    }

    /// True when the product is taken away from the addend.
    #[must_use]
    pub const fn subtracts(&self) -> bool {
        self.subtract
    }

    /// The bits a lane must have for operands of these widths, sign included: the product, the
    /// addend, each moved to the common place, one bit for their sum, one for the rounding carry. And
    /// more bits than are dropped, of which narrow operands with many fraction bits may have fewer.
    #[must_use]
    pub fn lane_bits(&self, multiplicand: u32, variable: u32, addend: u32) -> u32 {
        let product = multiplicand + variable + self.product_up;
        let sum = product.max(addend + self.addend_up) + self.result_up + 3;
        sum.max(self.drop + 1)
    }

    /// `addend ± multiplicand · variable`, rounded once to the result's fraction bits.
    #[inline(always)]
    pub fn apply<L: Lane>(&self, multiplicand: L, variable: L, addend: L) -> L {
        self.rounded(self.sum(multiplicand * variable, addend))
    }

    /// `addend ± product` at their common place, moved up where the result has more fraction bits; not rounded yet.
    #[inline(always)]
    pub(super) fn sum<L: Lane>(&self, product: L, addend: L) -> L {
        let product = product << self.product_up;
        let addend = addend << self.addend_up;
        let sum = if self.subtract { addend - product } else { addend + product };
        sum << self.result_up
    }

    /// A sum rounded to the result's fraction bits.
    #[inline(always)]
    pub(super) fn rounded<L: Lane>(&self, sum: L) -> L {
        round_shift(sum, self.drop, self.rounding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_alignment_means_the_same_number() {
        // 3/4 − 5/8 · 1/2 = 7/16, in every mixture of fraction bits that holds it exactly.
        for addend in 2..6 {
            for multiplicand in 3..6 {
                for variable in 1..6 {
                    for result in 4..12 {
                        let fractions = Fractions { multiplicand, variable, addend, result };
                        let line = MultiplyAdd::aligned(fractions, true, Rounding::Floor);
                        let t = line.apply((5_i64 << multiplicand) / 8, (1 << variable) / 2, (3 << addend) / 4);
                        assert_eq!(t << 4, 7 << result, "{fractions:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_sum_is_rounded_and_not_the_product() {
        // 1/4 + 1/2·1/2 = 1/2 in integers: the tie goes up only if nothing was dropped before.
        let fractions = Fractions { multiplicand: 1, variable: 1, addend: 2, result: 0 };
        let line = MultiplyAdd::aligned(fractions, false, Rounding::NearestUp);
        assert_eq!(line.apply(1_i64, 1, 1), 1);
        assert_eq!(line.apply(1_i64, 1, 0), 0);
        assert_eq!(line.apply(-1_i64, 1, -1), 0);
    }
}
