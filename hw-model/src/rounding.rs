//! Rounding modes, and the one place where fraction bits are dropped.
//!
//! A line that drops `d` fraction bits computes `v / 2^d` and must choose an integer beside it:
//!
//! | mode           | chooses                              | error in output ulp | hardware                  |
//! |----------------|--------------------------------------|---------------------|---------------------------|
//! | `floor`        | the integer below                    | −1 < e ≤ 0          | nothing: drop the bits    |
//! | `nearest_up`   | the nearest, a tie to the one above  | −½ < e ≤ ½          | one carry in              |
//! | `nearest_even` | the nearest, a tie to the even one   | −½ ≤ e ≤ ½          | carry in and a tie detect |
//! | `toward_zero`  | the integer beside it nearer to zero | −1 < e < 1          | carry in when negative    |
//!
//! [`Lane`] is the machine integer a line is computed in. The arithmetic of the data path is written
//! once, over `Lane`; the narrow lane serves blocks of samples, the wide one any legal format.

use std::fmt;
use std::ops::{Add, BitAnd, Mul, Neg, Shl, Shr, Sub};

use serde::{Deserialize, Serialize};

/// How a line that drops fraction bits chooses between the two integers beside the exact value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rounding {
    /// Down, towards −∞ (two's complement truncation).
    Floor,
    /// To the nearest; a tie goes up, towards +∞.
    #[default]
    NearestUp,
    /// To the nearest; a tie goes to the even integer.
    NearestEven,
    /// Towards zero: fraction bits are cut off a magnitude.
    TowardZero,
}

impl Rounding {
    /// Every mode, in the order of the table above.
    pub const ALL: [Self; 4] = [Self::Floor, Self::NearestUp, Self::NearestEven, Self::TowardZero];

    /// The name used in configurations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Floor => "floor",
            Self::NearestUp => "nearest_up",
            Self::NearestEven => "nearest_even",
            Self::TowardZero => "toward_zero",
        }
    }

    /// The last word of the name, for narrow columns.
    #[must_use]
    pub fn short_name(self) -> &'static str {
        self.name().rsplit('_').next().unwrap_or_default()
    }

    /// True for the two modes whose error never exceeds half an ulp.
    #[must_use]
    pub const fn is_nearest(self) -> bool {
        matches!(self, Self::NearestUp | Self::NearestEven)
    }
}

impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A signed machine integer wide enough for the lines of a data path.
///
/// `i64` carries every line of at most 63 bits; `i128` every legal one (two 63-bit operands give a
/// product of at most 126 bits, and the addend one more).
pub trait Lane:
    Copy
    + Ord
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + Shl<u32, Output = Self>
    + Shr<u32, Output = Self>
    + BitAnd<Output = Self>
{
    /// Bits of the machine integer, sign included.
    const BITS: u32;
    /// The integer 0.
    const ZERO: Self;
    /// The integer 1.
    const ONE: Self;
    /// Widens or narrows a register's bits; registers hold at most 63 bits, so `i64` loses none.
    fn from_bits(bits: i64) -> Self;
    /// The register's bits again: the low 64, which are all of them wherever a register is as wide as its
    /// values. Only hardware built wrongly has others, and they are trimmed afterwards.
    fn to_bits(self) -> i64;
}

impl Lane for i64 {
    const BITS: u32 = 64;
    const ZERO: Self = 0;
    const ONE: Self = 1;
    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        bits
    }
    #[inline(always)]
    fn to_bits(self) -> i64 {
        self
    }
}

impl Lane for i128 {
    const BITS: u32 = 128;
    const ZERO: Self = 0;
    const ONE: Self = 1;
    #[inline(always)]
    fn from_bits(bits: i64) -> Self {
        Self::from(bits)
    }
    #[inline(always)]
    fn to_bits(self) -> i64 {
        self as i64
    }
}

/// `value / 2^drop`, rounded to an integer by `mode`.
///
/// `drop` is less than the lane's width, and `value` leaves room for half an output ulp below the
/// lane's maximum; both follow from the width analysis of the line.
#[inline(always)]
pub fn round_shift<L: Lane>(value: L, drop: u32, mode: Rounding) -> L {
    if drop == 0 {
        return value;
    }
    let half = L::ONE << (drop - 1);
    match mode {
        Rounding::Floor => value >> drop,
        Rounding::NearestUp => (value + half) >> drop,
        // A tie is rounded down when the integer below is even: half − 1 + (its last bit).
        Rounding::NearestEven => {
            let odd = (value >> drop) & L::ONE;
            (value + half - L::ONE + odd) >> drop
        }
        // The sign bit spread over the dropped places lifts a negative value to the integer above.
        Rounding::TowardZero => {
            let lift = (value >> (L::BITS - 1)) & ((L::ONE << drop) - L::ONE);
            (value + lift) >> drop
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use proptest::prelude::*;

    /// numerator/denominator rounded to an integer, by comparison with the integer below.
    pub(crate) fn rounded_ratio(numerator: i64, denominator: i64, mode: Rounding) -> i64 {
        let below = numerator.div_euclid(denominator);
        let twice = 2 * numerator.rem_euclid(denominator);
        let up = match mode {
            Rounding::Floor => false,
            Rounding::NearestUp => twice >= denominator,
            Rounding::NearestEven => twice > denominator || (twice == denominator && below % 2 != 0),
            Rounding::TowardZero => below < 0 && twice > 0,
        };
        below + i64::from(up)
    }

    #[test]
    fn modes_have_their_names() {
        let names = Rounding::ALL.map(|mode| mode.to_string());
        assert_eq!(names, ["floor", "nearest_up", "nearest_even", "toward_zero"]);
        assert_eq!(Rounding::ALL.map(Rounding::is_nearest), [false, true, true, false]);
    }

    #[test]
    fn ties_and_signs_go_where_the_table_says() {
        // value in quarters: −1½, −¼, ½, ¾, 1½, 2½
        let quarters = [-6_i64, -1, 2, 3, 6, 10];
        let expected = [
            (Rounding::Floor, [-2, -1, 0, 0, 1, 2]),
            (Rounding::NearestUp, [-1, 0, 1, 1, 2, 3]),
            (Rounding::NearestEven, [-2, 0, 0, 1, 2, 2]),
            (Rounding::TowardZero, [-1, 0, 0, 0, 1, 2]),
        ];
        for (mode, wanted) in expected {
            let got = quarters.map(|value| round_shift(value, 2, mode));
            assert_eq!(got, wanted, "{mode}");
            assert_eq!(quarters.map(|value| rounded_ratio(value, 4, mode)), wanted, "{mode}");
        }
    }

    proptest! {
        #[test]
        fn rounding_stays_within_its_error(value in -(1_i64 << 60)..(1 << 60), drop in 0_u32..60) {
            for mode in Rounding::ALL {
                let rounded = i128::from(round_shift(value, drop, mode));
                prop_assert_eq!(rounded, round_shift(i128::from(value), drop, mode));
                let error = (rounded << drop) - i128::from(value);
                let ulp = 1_i128 << drop;
                match mode {
                    Rounding::Floor => prop_assert!(-ulp < error && error <= 0),
                    Rounding::NearestUp => prop_assert!(-ulp < 2 * error && 2 * error <= ulp),
                    Rounding::NearestEven => {
                        prop_assert!(2 * error.abs() <= ulp);
                        prop_assert!(2 * error.abs() < ulp || drop == 0 || rounded % 2 == 0);
                    }
                    Rounding::TowardZero => {
                        prop_assert!(error.abs() < ulp);
                        prop_assert!((rounded << drop).abs() <= i128::from(value).abs());
                    }
                }
            }
        }
    }
}
