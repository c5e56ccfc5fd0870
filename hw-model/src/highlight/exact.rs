//! The exact oracle: for x = k/2^W and an integer exponent n, x^n = k^n / 2^(W·n), a ratio of integers.
//!
//! Nothing here rounds until the last step, and that step is integer arithmetic too. It checks the
//! f64 reference, and it measures pipeline outputs without any reference between.

use std::cmp::Ordering;

use dashu_int::ops::BitTest;
use dashu_int::{IBig, Sign, UBig};
use thiserror::Error;

/// The largest W·n, the bits of the denominator: 63-bit inputs up to n = 66 576. The numerator then
/// takes at most half a megabyte.
pub const MAX_BITS: u64 = 1 << 22;

/// The widest x, in fraction bits.
pub const MAX_FRACTION: u32 = 63;

/// The least exponent of two an f64 can hold, 2^−1074.
const LEAST_EXPONENT: i64 = -1074;

/// Significant bits of an f64.
const SIGNIFICANT: i64 = 53;

/// x^n as an exact ratio of integers: a numerator over a power of two.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactPower {
    numerator: UBig,
    log2_denominator: u64,
}

/// Why a power is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum ExactError {
    /// x is not in [0, 1], or has too many fraction bits.
    #[error("x = {k}/2^{fraction} is refused; the oracle takes 0 <= k <= 2^fraction, fraction <= {MAX_FRACTION}")]
    Input {
        /// The numerator of x.
        k: u64,
        /// The fraction bits of x.
        fraction: u32,
    },
    /// The power has too many bits.
    #[error(
        "{fraction} fraction bits to the power {exponent} exceed {MAX_BITS} bits; use a smaller exponent or fewer \
         fraction bits"
    )]
    TooLarge {
        /// The fraction bits of x.
        fraction: u32,
        /// The integer exponent n that was asked for.
        exponent: u32,
    },
}

impl ExactPower {
    /// (k/2^fraction)^exponent; 0^0 is 1.
    ///
    /// # Errors
    /// When k/2^fraction is not in [0, 1], or the result would exceed [`MAX_BITS`].
    pub fn new(k: u64, fraction: u32, exponent: u32) -> Result<Self, ExactError> {
        if fraction > MAX_FRACTION || k > 1 << fraction {
            return Err(ExactError::Input { k, fraction });
        }
        let log2_denominator = u64::from(fraction) * u64::from(exponent);
        if log2_denominator > MAX_BITS {
            return Err(ExactError::TooLarge { fraction, exponent });
        }
        // The cap on the bits does not bound the exponent when fraction = 0; then k is 0 or 1.
        let numerator = UBig::from(k).pow(exponent as usize);
        Ok(Self { numerator, log2_denominator })
    }

    /// The numerator over the denominator 2^[`log2_denominator`](Self::log2_denominator).
    #[must_use]
    pub const fn numerator(&self) -> &UBig {
        &self.numerator
    }

    /// The logarithm to base 2 of the denominator.
    #[must_use]
    pub const fn log2_denominator(&self) -> u64 {
        self.log2_denominator
    }

    /// The nearest f64, a tie to the even one; subnormal and zero results included.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        nearest_f64(&self.numerator, self.exponent())
    }

    /// How the f64 `value` compares with the exact power; `None` for NaN.
    #[must_use]
    pub fn compare(&self, value: f64) -> Option<Ordering> {
        if value.is_infinite() {
            return value.partial_cmp(&0.0);
        }
        let (significand, exponent) = decode(value)?;
        let (difference, _) = self.difference(significand, exponent);
        Some(difference.cmp(&IBig::ZERO))
    }

    /// `value` − x^n, in units of the last place an f64 has at x^n (2^−1074 at least). The difference
    /// is exact and rounded once, to the f64 returned. NaN and infinities come back as they are.
    #[must_use]
    pub fn error_in_ulp(&self, value: f64) -> f64 {
        let Some((significand, exponent)) = decode(value) else {
            return value;
        };
        let (difference, unit) = self.difference(significand, exponent);
        let ulp = match bits_of(&self.numerator) {
            0 => LEAST_EXPONENT,
            bits => (bits + self.exponent() - SIGNIFICANT).max(LEAST_EXPONENT),
        };
        signed_nearest_f64(difference, unit - ulp)
    }

    /// bits/2^fraction − x^n, exact and rounded once, to the f64 returned.
    #[must_use]
    pub fn error_of_bits(&self, bits: i64, fraction: u32) -> f64 {
        let (difference, unit) = self.difference(bits, -i64::from(fraction));
        signed_nearest_f64(difference, unit)
    }

    fn exponent(&self) -> i64 {
        // At most MAX_BITS.
        -(self.log2_denominator as i64)
    }

    /// significand·2^exponent − x^n as an integer and the exponent of its unit.
    fn difference(&self, significand: i64, exponent: i64) -> (IBig, i64) {
        let unit = exponent.min(self.exponent());
        let value = IBig::from(significand) << (exponent - unit) as usize;
        let power = IBig::from(self.numerator.clone()) << (self.exponent() - unit) as usize;
        (value - power, unit)
    }
}

/// A finite f64 as significand·2^exponent.
fn decode(value: f64) -> Option<(i64, i64)> {
    if !value.is_finite() {
        return None;
    }
    let bits = value.to_bits();
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let biased = (bits >> 52 & 0x7ff) as i64;
    let (magnitude, exponent) = match biased {
        0 => (fraction, LEAST_EXPONENT),
        _ => (fraction | 1 << 52, biased - 1 + LEAST_EXPONENT),
    };
    let sign = if value.is_sign_negative() { -1 } else { 1 };
    Some((sign * magnitude, exponent))
}

fn bits_of(value: &UBig) -> i64 {
    value.bit_len() as i64
}

fn signed_nearest_f64(value: IBig, exponent: i64) -> f64 {
    let (sign, magnitude) = value.into_parts();
    let nearest = nearest_f64(&magnitude, exponent);
    match sign {
        Sign::Positive => nearest,
        Sign::Negative => -nearest,
    }
}

/// magnitude·2^exponent rounded to the nearest f64, a tie to the even one.
fn nearest_f64(magnitude: &UBig, exponent: i64) -> f64 {
    let bits = bits_of(magnitude);
    // The value is below 2^top. Of its bits an f64 keeps 53, or those from 2^−1074 up if that is fewer.
    let top = bits + exponent;
    if top > 1024 {
        return f64::INFINITY;
    }
    let keep = SIGNIFICANT.min(top - LEAST_EXPONENT);
    if bits == 0 || keep < 0 {
        return 0.0;
    }
    let drop = bits - keep;
    if drop <= 0 {
        return scale(low_word(magnitude), exponent);
    }
    let drop_bits = drop as usize;
    let kept = low_word(&(magnitude >> drop_bits));
    let half = magnitude.bit(drop_bits - 1);
    let below_half = magnitude.trailing_zeros().is_some_and(|zeros| zeros < drop_bits - 1);
    let up = half && (below_half || kept & 1 == 1);
    scale(kept + u64::from(up), exponent + drop)
}

/// The value of an integer of at most 53 bits.
fn low_word(value: &UBig) -> u64 {
    // Never the alternative: the callers have counted the bits.
    u64::try_from(value).unwrap_or(u64::MAX)
}

/// significand·2^exponent, which is an f64 (or overflows to infinity). Two factors, because 2^−1074
/// is not a normal number and 2^971·2^53 overflows only in the last product.
fn scale(significand: u64, exponent: i64) -> f64 {
    let first = exponent / 2;
    significand as f64 * power_of_two(first) * power_of_two(exponent - first)
}

/// 2^exponent for −1022 ≤ exponent ≤ 1023, by its bits.
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::highlight::phong;
    use proptest::prelude::*;

    fn ratio(numerator: u64, log2_denominator: u64) -> ExactPower {
        ExactPower { numerator: numerator.into(), log2_denominator }
    }

    #[test]
    fn small_powers_by_hand() {
        let eighth = ExactPower::new(1, 1, 3).unwrap();
        assert_eq!(eighth.to_f64(), 0.125);
        assert_eq!(eighth.error_of_bits(9, 6), 1.0 / 64.0);
        assert_eq!(eighth.error_of_bits(0, 0), -0.125);
        assert_eq!(eighth.error_in_ulp(0.125 + 2.0_f64.powi(-55)), 1.0);
        assert_eq!(eighth.error_in_ulp(0.125 - 2.0_f64.powi(-56)), -0.5);
        assert_eq!(eighth.compare(0.125), Some(Ordering::Equal));
        assert_eq!(eighth.compare(-0.125), Some(Ordering::Less));
        assert_eq!(eighth.compare(f64::INFINITY), Some(Ordering::Greater));
        assert_eq!(eighth.compare(f64::NAN), None);
        assert_eq!(ExactPower::new(0, 24, 5).unwrap().to_f64(), 0.0);
        assert_eq!(ExactPower::new(0, 24, 5).unwrap().error_in_ulp(5e-324), 1.0);
        assert_eq!(ExactPower::new(1 << 63, 63, 9).unwrap().to_f64(), 1.0);
        assert_eq!(ExactPower::new(1, 0, u32::MAX).unwrap().to_f64(), 1.0);
    }

    #[test]
    fn ties_go_to_even_also_below_the_normal_range() {
        let odd = (1_u64 << 53) + 1;
        assert_eq!(ratio(odd, 0).to_f64(), 2.0_f64.powi(53));
        assert_eq!(ratio(odd + 2, 0).to_f64(), 2.0_f64.powi(53) + 4.0);
        assert_eq!(ratio(2 * odd + 1, 1).to_f64(), 2.0_f64.powi(53) + 2.0);
        assert_eq!(ratio(u64::MAX, 64).to_f64(), 1.0);
        assert_eq!(ratio(1, 1074).to_f64(), 5e-324);
        assert_eq!(ratio(1, 1075).to_f64(), 0.0);
        assert_eq!(ratio(3, 1076).to_f64(), 5e-324);
        assert_eq!(ratio(3, 1075).to_f64(), 1e-323);
        assert_eq!(ratio(1, 1076).to_f64(), 0.0);
        assert_eq!(ratio((1 << 52) - 1, 1074).to_f64(), f64::MIN_POSITIVE.next_down());
        let huge = UBig::from(u64::MAX) << 960;
        assert_eq!(nearest_f64(&huge, 0), f64::INFINITY);
        assert_eq!(nearest_f64(&huge, -1), 2.0_f64.powi(1023));
    }

    #[test]
    fn what_is_too_large_is_refused_with_the_limit() {
        let input = ExactPower::new(5, 2, 3).unwrap_err();
        assert!(input.to_string().contains("5/2^2 is refused"), "{input}");
        assert!(ExactPower::new(5, 64, 3).is_err());
        let size = ExactPower::new(1, 63, 66_577).unwrap_err();
        assert!(size.to_string().contains("smaller exponent"), "{size}");
        assert!(ExactPower::new((1 << 63) - 1, 63, 66_576).is_ok());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// Two opinions that share no arithmetic: integers here, core-math's correctly rounded pow there.
        #[test]
        fn the_reference_is_the_rounded_exact_power(
            fraction in 1_u32..=24, seed in any::<u64>(), exponent in 1_u32..=64,
        ) {
            let k = seed % ((1 << fraction) + 1);
            let exact = ExactPower::new(k, fraction, exponent).unwrap();
            let x = k as f64 / f64::from(1_u32 << fraction);
            let reference = phong(exponent.into(), x);
            prop_assert_eq!(exact.to_f64().to_bits(), reference.to_bits());
            let error = exact.error_in_ulp(reference);
            prop_assert!(error.abs() <= 0.5, "{}", error);
            prop_assert_eq!(exact.compare(reference), error.partial_cmp(&0.0));
        }

        #[test]
        fn a_neighbour_is_one_ulp_further(k in 1_u64..1 << 24, exponent in 1_u32..=40) {
            let exact = ExactPower::new(k, 24, exponent).unwrap();
            let reference = exact.to_f64();
            // One ulp above is one ulp above, except across a power of two.
            prop_assume!(reference.to_bits() << 12 != 0 && reference < 1.0);
            let step = exact.error_in_ulp(reference.next_up()) - exact.error_in_ulp(reference);
            prop_assert!((step - 1.0).abs() < 1e-12, "{}", step);
        }
    }
}
