//! The tail: x / (A − B·x) by a digit-recurrence divider, restoring, one quotient bit a step.
//!
//! The divisor D = A − B·x is a multiply-add line ([`super::stage`]) rounded once. The quotient then
//! comes bit by bit, most significant first, as long division does it:
//!
//! ```text
//! remainder ← 2·remainder + (next bit of the dividend)
//! if remainder ≥ D:  remainder ← remainder − D, quotient bit 1     else: quotient bit 0
//! ```
//!
//! Widths. With k quotient fraction bits, d fraction bits of D and f of x, the quotient's integer is
//! ⌊Z / D⌋ with Z = X·2^(k + d − f). It has W = k bits, or more where 1 and above can come out. The part
//! of Z above its low W bits is the first remainder: it is less than D exactly when the quotient fits
//! W bits, and from then on every remainder is less than D, so D's width holds it. The low W bits of
//! Z wait in `digits`; each step takes one from the top and puts a quotient bit in at the bottom, so
//! one register of W bits serves both.
//!
//! k is the output's fraction bits plus one; the last remainder, zero or not, stands for all further
//! bits, so that every rounding mode is exact: `round((2·quotient + sticky) / 4)`.

use crate::rounding::{Lane, Rounding, round_shift};

use super::stage::MultiplyAdd;

/// The registers of a division under way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Division<L> {
    /// D, never zero where the tail answers.
    pub divisor: L,
    /// What is left of the dividend, 0 or more and less than the divisor.
    pub remainder: L,
    /// Dividend bits still to come (at the top) and quotient bits found (at the bottom).
    pub digits: L,
}

impl Division<i64> {
    /// In the lanes of the arithmetic.
    #[inline(always)]
    pub(super) fn widened<L: Lane>(self) -> Division<L> {
        Division {
            divisor: L::from_bits(self.divisor),
            remainder: L::from_bits(self.remainder),
            digits: L::from_bits(self.digits),
        }
    }
}

impl<L: Lane> Division<L> {
    /// As registers hold it.
    #[inline(always)]
    pub(super) fn narrowed(self) -> Division<i64> {
        Division { divisor: self.divisor.to_bits(), remainder: self.remainder.to_bits(), digits: self.digits.to_bits() }
    }
}

/// The divider of one configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Divider {
    /// D = A − B·x.
    pub divisor: MultiplyAdd,
    /// k + d − f, the places x is moved up to become the dividend; never negative.
    pub dividend_up: u32,
    /// W, the number of quotient bits.
    pub digit_count: u32,
    /// Quotient bits found in one clock cycle.
    pub digits_per_stage: u32,
    /// How the quotient becomes the output.
    pub rounding: Rounding,
}

/// The guard bits that [`Divider::finish`] drops: one more quotient bit, and the sticky bit.
const GUARD_BITS: u32 = 2;

impl Divider {
    /// Quotient fraction bits for an output with this many.
    #[must_use]
    pub const fn quotient_fraction(output: u32) -> u32 {
        output + GUARD_BITS - 1
    }

    /// The same divider, every line rounded by `mode`.
    #[inline(always)]
    #[must_use]
    pub const fn rounded_by(self, mode: Rounding) -> Self {
        Self { rounding: mode, divisor: self.divisor.rounded_by(mode), ..self }
    }

    /// Clock cycles spent on quotient bits.
    #[must_use]
    pub const fn digit_stages(&self) -> u32 {
        self.digit_count.div_ceil(self.digits_per_stage)
    }

    /// Quotient bits that stage `index` finds.
    #[inline(always)]
    #[must_use]
    pub fn digits_of_stage(&self, index: u32) -> u32 {
        let done = (index * self.digits_per_stage).min(self.digit_count);
        self.digits_per_stage.min(self.digit_count - done)
    }

    /// True where a rank of registers takes in what quotient bit `digit` (0 is the first) leaves.
    #[inline(always)]
    #[must_use]
    pub const fn ends_stage(&self, digit: u32) -> bool {
        (digit + 1).is_multiple_of(self.digits_per_stage) || digit + 1 == self.digit_count
    }

    /// The division x / (A − B·x), before its first quotient bit.
    #[inline(always)]
    pub fn begin<L: Lane>(&self, x: L, a: L, b: L) -> Division<L> {
        let dividend = x << self.dividend_up;
        let low_mask = (L::ONE << self.digit_count) - L::ONE;
        Division {
            divisor: self.divisor.apply(b, x, a),
            remainder: dividend >> self.digit_count,
            digits: dividend & low_mask,
        }
    }

    /// The division with one more quotient bit found: a dividend bit moves into the remainder, the quotient bit takes
    /// its place.
    #[inline(always)]
    pub fn digit<L: Lane>(&self, division: Division<L>) -> Division<L> {
        let Division { divisor, remainder, digits } = division;
        let low_mask = (L::ONE << self.digit_count) - L::ONE;
        let next_bit = digits >> (self.digit_count - 1);
        let doubled = (remainder << 1) + next_bit;
        let goes = doubled >= divisor;
        Division {
            divisor,
            remainder: if goes { doubled - divisor } else { doubled },
            digits: ((digits << 1) & low_mask) + if goes { L::ONE } else { L::ZERO },
        }
    }

    /// One quotient bit of many divisions side by side, as many as the shortest list has.
    #[inline(always)]
    pub fn digit_of_all<L: Lane>(&self, divisors: &[L], remainders: &mut [L], digits: &mut [L]) {
        for ((&divisor, remainder), digits) in divisors.iter().zip(remainders).zip(digits) {
            let next = self.digit(Division { divisor, remainder: *remainder, digits: *digits });
            (*remainder, *digits) = (next.remainder, next.digits);
        }
    }

    /// The quotient bits of stage `index` (0 is the first); the last stage may find fewer.
    #[inline(always)]
    pub fn digit_stage<L: Lane>(&self, index: u32, division: Division<L>) -> Division<L> {
        (0..self.digits_of_stage(index)).fold(division, |division, _| self.digit(division))
    }

    /// The finished quotient in the output's unit, rounded once, at most `one`.
    #[inline(always)]
    pub fn finish<L: Lane>(&self, division: Division<L>, one: L) -> L {
        let sticky = if division.remainder == L::ZERO { L::ZERO } else { L::ONE };
        let quotient = (division.digits << 1) + sticky;
        round_shift(quotient, GUARD_BITS, self.rounding).min(one)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::datapath::stage::Fractions;
    use crate::rounding::tests::rounded_ratio;

    /// Every x and divisor of a small divider against the integers: A = D, B = 0.
    #[test]
    fn every_small_quotient_is_the_rounded_ratio() {
        let (x_fraction, d_fraction, output) = (5_u32, 4_u32, 6_u32);
        let k = Divider::quotient_fraction(output);
        let mut compared = 0;
        for rounding in Rounding::ALL {
            let fractions = Fractions { multiplicand: 4, variable: x_fraction, addend: 4, result: d_fraction };
            let divider = Divider {
                divisor: MultiplyAdd::aligned(fractions, true, rounding),
                dividend_up: k + d_fraction - x_fraction,
                digit_count: k + 1,
                digits_per_stage: 3,
                rounding,
            };
            for x in 0..=32_i64 {
                for d in 1..200_i64 {
                    // x/32 over d/16 in units of 2^−6
                    let (numerator, denominator) = (x * 16 * 64, d * 32);
                    if numerator > denominator * 64 {
                        continue;
                    }
                    let stages = 0..divider.digit_stages();
                    let division = stages.fold(divider.begin(x, d, 0), |division, index| {
                        assert!(division.remainder < d);
                        divider.digit_stage(index, division)
                    });
                    let got = divider.finish(division, 64);
                    assert_eq!(got, rounded_ratio(numerator, denominator, rounding), "{x}/{d} {rounding}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 10_000, "{compared}");
    }
}
