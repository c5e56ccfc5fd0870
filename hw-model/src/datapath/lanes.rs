//! Lanes for blocks of samples, narrower than `i64` in what they can multiply or hold.
//!
//! | lane      | holds   | multiplies | with it                                              |
//! |-----------|---------|------------|------------------------------------------------------|
//! | `i32`     | 32 bits | 32 bits    | twice as many divisions under way in one instruction |
//! | [`Half`]  | 64 bits | 32 by 32   | a product is one instruction also without AVX-512    |
//!
//! Which of them a data path may use follows from the widths of its registers, which were proved: see
//! [`Datapath::operands_fit_half`] and [`Datapath::division_fits_i32`].

use std::ops::{Add, BitAnd, Mul, Neg, Shl, Shr, Sub};

use crate::format::QFormat;
use crate::rounding::Lane;

use super::parts::Datapath;

/// An `i64` of which only the low 32 bits, as a signed number, go into a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Half(i64);

macro_rules! forward {
    ($($operator:ident $function:ident $other:ty, $right:ident => $value:expr;)*) => {$(
        impl $operator<$other> for Half {
            type Output = Self;
            #[inline(always)]
            fn $function(self, $right: $other) -> Self {
                Self($operator::$function(self.0, $value))
            }
        }
    )*};
}

forward! {
    Add add Self, right => right.0;
    Sub sub Self, right => right.0;
    BitAnd bitand Self, right => right.0;
    Shl shl u32, places => places;
    Shr shr u32, places => places;
}

impl Neg for Half {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Mul for Half {
    type Output = Self;
    #[inline(always)]
    fn mul(self, right: Self) -> Self {
        Self(i64::from(self.0 as i32) * i64::from(right.0 as i32))
    }
}

impl Lane for Half {
    const BITS: u32 = 64;
    const ZERO: Self = Self(0);
    const ONE: Self = Self(1);
    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        Self(bits)
    }
    #[inline(always)]
    fn to_bits(self) -> i64 {
        self.0
    }
}

impl Lane for i32 {
    const BITS: u32 = 32;
    const ZERO: Self = 0;
    const ONE: Self = 1;
    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        bits as Self
    }
    #[inline(always)]
    fn to_bits(self) -> i64 {
        self.into()
    }
}

impl Datapath {
    /// True when every operand of every product fits 32 bits with a sign. The products then fit 64.
    pub(super) fn operands_fit_half(&self) -> bool {
        let fits = |format: QFormat| format.width() + u32::from(!format.is_signed()) <= 32;
        let polynomial = self.formats.polynomial.iter().all(|polynomial| {
            (1..=polynomial.degree()).map(|stage| polynomial.multiplicand(stage)).chain([polynomial.v]).all(fits)
        });
        // x goes into the divisor's product clamped to [0, 1], as wide as its format at most.
        let tail = self.formats.tail.iter().all(|tail| fits(tail.b) && fits(self.formats.input));
        self.narrow && polynomial && tail
    }

    /// True when a division fits 32 bits: twice a remainder and a bit; the digits, the sticky bit below them and
    /// the carry of their rounding. Both with a sign.
    pub(super) fn division_fits_i32(&self) -> bool {
        self.formats.tail.as_ref().is_some_and(|tail| {
            tail.divisor.width().max(tail.digits.width() + 1) + 2 <= 32 && i32::try_from(self.output_one).is_ok()
        })
    }
}
