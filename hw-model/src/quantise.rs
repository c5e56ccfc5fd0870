//! Real ↔ fixed: the only place where a real number becomes bits, and where bits become a real number.
//!
//! The carrier is `fixed`'s `I64F64`: 64 fraction bits, exact for the bits of every [`QFormat`] (at
//! most 63 bits, at most 63 of them fraction), with named rounding and exact decimal printing.

use fixed::types::I64F64;
use thiserror::Error;

use crate::format::{DoesNotFit, Overflow, QFormat, power_of_two};
use crate::rounding::Rounding;

/// Why a real number did not become bits.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum QuantiseError {
    /// The value is NaN or infinite.
    #[error("{0} cannot be quantised; give a finite number")]
    NotFinite(f64),
    /// The rounded value lies outside the format, and the overflow policy refuses.
    #[error(
        "{value} does not fit {format}, which holds {} to {}",
        decimal(format.min_bits(), *format),
        decimal(format.max_bits(), *format)
    )]
    Overflow {
        /// The value that does not fit.
        value: f64,
        /// The format it was meant for.
        format: QFormat,
    },
}

/// The bits of `value` in `format`: scaled by 2^fraction (exact in binary floating point), rounded
/// once by `rounding`, and brought into range by `overflow`.
///
/// # Errors
/// When `value` is not finite, or outside the format under [`Overflow::Refuse`].
#[inline]
pub fn quantise(value: f64, format: QFormat, rounding: Rounding, overflow: Overflow) -> Result<i64, QuantiseError> {
    let bits = round_scaled(value, format.fraction_bits(), rounding)?;
    format.fit(bits, overflow).map_err(|DoesNotFit { .. }| QuantiseError::Overflow { value, format })
}

/// The bits of the real number `x` in the input format: the nearest that the format has, a tie to even. The one way in
/// which a real number becomes an x.
///
/// What lies outside the format is brought to its ends, as [`Overflow::Saturate`] says, for an x that was computed; or
/// refused, [`Overflow::Refuse`], for one that somebody wrote.
///
/// # Errors
/// As [`quantise`].
///
/// ```
/// use hw_model::format::Overflow;
/// use hw_model::quantise::x_bits;
///
/// let input = "UQ1.23".parse().unwrap();
/// assert_eq!(x_bits(0.99, input, Overflow::Refuse), Ok(8_304_722));
/// assert_eq!(x_bits(-0.2, input, Overflow::Saturate), Ok(0));
/// assert!(x_bits(2.5, input, Overflow::Refuse).is_err());
/// ```
#[inline]
pub fn x_bits(x: f64, input: QFormat, overflow: Overflow) -> Result<i64, QuantiseError> {
    quantise(x, input, Rounding::NearestEven, overflow)
}

/// `value · 2^fraction_bits` rounded to an integer; beyond ±2^64 it is held there, which every
/// format then sees as an overflow.
///
/// # Errors
/// When `value` is not finite.
#[inline]
pub fn round_scaled(value: f64, fraction_bits: u32, rounding: Rounding) -> Result<i128, QuantiseError> {
    if !value.is_finite() {
        return Err(QuantiseError::NotFinite(value));
    }
    let scaled = value * power_of_two(fraction_bits as i32);
    // Between this size and twice it the last place of an f64 is 1, so an addition rounds to it, a tie to even.
    let round = power_of_two(52) + power_of_two(51);
    if rounding == Rounding::NearestEven && scaled.abs() < power_of_two(51) {
        return Ok(((scaled + round) - round) as i64 as i128);
    }
    let limit = power_of_two(64);
    let scaled = scaled.clamp(-limit, limit);
    if scaled.abs() >= power_of_two(62) {
        // A double of this size is an integer, and I64F64 may not hold it.
        return Ok(scaled as i128);
    }
    // Below 2^-11 a double may have bits that I64F64 has not. All that matters of such a value is
    // its sign and that it is not zero: every mode treats it as it treats ±2^-11.
    let tiny = (-11_f64).exp2();
    let scaled = if scaled != 0.0 && scaled.abs() < tiny { tiny.copysign(scaled) } else { scaled };
    let exact = I64F64::from_num(scaled);
    let integer = match rounding {
        Rounding::Floor => exact.floor(),
        Rounding::NearestUp => (exact + I64F64::from_num(0.5)).floor(),
        Rounding::NearestEven => exact.round_ties_even(),
        Rounding::TowardZero => exact.round_to_zero(),
    };
    Ok(integer.to_num::<i128>())
}

/// The same, moved by `steps` units of the last place after rounding, and never brought into range.
///
/// # Errors
/// When `value` is not finite, or the result outside the format.
pub fn quantise_moved(value: f64, format: QFormat, rounding: Rounding, steps: i32) -> Result<i64, QuantiseError> {
    let bits = round_scaled(value, format.fraction_bits(), rounding)? + i128::from(steps);
    let moved = value + f64::from(steps) * format.ulp();
    format.fit(bits, Overflow::Refuse).map_err(|DoesNotFit { .. }| QuantiseError::Overflow { value: moved, format })
}

/// The real value of `bits` in `format`, rounded to the nearest `f64` when it has more than 53
/// significant bits (exact otherwise).
#[inline]
#[must_use]
pub fn real(bits: i64, format: QFormat) -> f64 {
    // Rounded here, where it needs to be; a power of two moves it and loses nothing.
    bits as f64 * format.ulp()
}

/// The exact decimal value of `bits` in `format`, without trailing zeros: `0.5`, `-1.25`, `3`.
#[must_use]
pub fn decimal(bits: i64, format: QFormat) -> String {
    let digits = format!("{:.*}", format.fraction_bits() as usize, exact(bits, format));
    match digits.split_once('.') {
        None => digits,
        Some((whole, fraction)) => match fraction.trim_end_matches('0') {
            "" => whole.to_owned(),
            fraction => format!("{whole}.{fraction}"),
        },
    }
}

/// |bits| < 2^63 moved up by 64 − fraction ≤ 64 places: less than 2^127, so nothing is lost.
fn exact(bits: i64, format: QFormat) -> I64F64 {
    I64F64::from_bits(i128::from(bits) << (64 - format.fraction_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rounding::round_shift;
    use proptest::prelude::*;

    #[test]
    fn decimals_are_exact() {
        let check = |text: &str, bits, format: &str| {
            assert_eq!(decimal(bits, format.parse().unwrap()), text);
        };
        check("0.000030517578125", 1, "UQ1.15");
        check("1", 1 << 15, "UQ1.15");
        check("-0.5", -1, "Q1.1");
        check("-4611686018427387904", i64::MIN / 2, "Q63.0");
        check("0.000000000000000000108420217248550443400745280086994171142578125", 1, "UQ0.63");
    }

    #[test]
    fn what_is_not_finite_or_does_not_fit_is_refused() {
        let format: QFormat = "UQ1.15".parse().unwrap();
        let quantise = |value| quantise(value, format, Rounding::NearestEven, Overflow::Refuse);
        assert!(matches!(quantise(f64::NAN), Err(QuantiseError::NotFinite(_))));
        assert!(matches!(quantise(f64::INFINITY), Err(QuantiseError::NotFinite(_))));
        let error = quantise(2.0).unwrap_err();
        assert_eq!(error.to_string(), "2 does not fit UQ1.15, which holds 0 to 1.999969482421875");
        assert!(quantise(-1e300).is_err() && quantise(1e300).is_err());
    }

    #[test]
    fn a_tiny_value_is_rounded_by_its_sign() {
        let tiny = 1e-300;
        let round = |value, mode| round_scaled(value, 20, mode).unwrap();
        assert_eq!(round(-tiny, Rounding::Floor), -1);
        assert_eq!(round(tiny, Rounding::Floor), 0);
        for mode in [Rounding::NearestUp, Rounding::NearestEven, Rounding::TowardZero] {
            assert_eq!((round(-tiny, mode), round(tiny, mode)), (0, 0), "{mode}");
        }
    }

    proptest! {
        #[test]
        fn a_real_value_is_the_exact_one_rounded(bits in any::<i64>(), drop in 0_u32..63, fraction in 0_u32..=63) {
            let (bits, format) = (bits >> 1 >> drop, QFormat::signed(63 - fraction as i32, fraction).unwrap());
            prop_assert_eq!(real(bits, format), exact(bits, format).to_num::<f64>());
        }

        #[test]
        fn quantising_agrees_with_dropping_bits(mantissa in -(1_i64 << 52)..(1 << 52), drop in 0_u32..50) {
            // mantissa · 2^−drop as a real number, against the integer rounding of the data path
            let value = mantissa as f64 / f64::from(drop).exp2();
            for mode in Rounding::ALL {
                let wanted = round_shift(i128::from(mantissa), drop, mode);
                prop_assert_eq!(round_scaled(value, 0, mode).unwrap(), wanted, "{}", mode);
            }
        }

        #[test]
        fn bits_come_back_from_their_real_value(bits in -(1_i64 << 52)..(1 << 52), fraction in 0_u32..=63) {
            let format = QFormat::signed(53 - fraction as i32, fraction).unwrap();
            let value = real(bits, format);
            for mode in Rounding::ALL {
                prop_assert_eq!(quantise(value, format, mode, Overflow::Refuse), Ok(bits));
            }
            prop_assert_eq!(decimal(bits, format).parse::<f64>().unwrap(), value);
        }
    }
}
