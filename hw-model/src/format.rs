//! Q formats with widths known at run time.
//!
//! `Qm.n` is signed two's complement with m integer bits, the sign included, and n fraction bits;
//! `UQm.n` is unsigned. A value is `bits · 2^−n`. The width m + n is 1 to 63 bits, so the bits of any
//! format fit an `i64`. m may be negative (`UQ-3.20` has 17 bits): the places just below the binary
//! point are then known to be zero and take no hardware.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The widest register, in bits.
pub const MAX_WIDTH: u32 = 63;

/// What happens to a value that a format cannot hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Overflow {
    /// The nearest value the format holds.
    #[default]
    Saturate,
    /// The low bits, as an adder without a guard would leave them.
    Wrap,
    /// An error; for constants and ROM words, where an overflow is a mistake of the configuration.
    Refuse,
}

/// A Q format. Written and parsed as `Q2.16` or `UQ1.15`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct QFormat {
    signed: bool,
    integer: i32,
    fraction: u32,
}

/// Why a format is refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FormatError {
    /// The text is not `Qm.n` or `UQm.n`.
    #[error("{0:?} is not a Q format; write Qm.n (signed) or UQm.n, for example Q2.16 or UQ1.15")]
    Syntax(String),
    /// The width is not in 1..=63.
    #[error("{text} has {width} bits; a format has 1 to 63")]
    Width {
        /// The format as written.
        text: String,
        /// Its width in bits.
        width: i64,
    },
    /// More than 63 fraction bits.
    #[error("{0} has too many fraction bits; a format has at most 63")]
    Fraction(String),
}

/// A value that its format cannot hold, and the policy that refused it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("the bits {bits} do not fit {format}, which holds {} to {}", format.min_bits(), format.max_bits())]
pub struct DoesNotFit {
    /// The bits that do not fit.
    pub bits: i128,
    /// The format they were meant for.
    pub format: QFormat,
}

impl QFormat {
    /// A signed format; `integer` includes the sign bit.
    ///
    /// # Errors
    /// When the width is not 1 to 63 bits.
    pub fn signed(integer: i32, fraction: u32) -> Result<Self, FormatError> {
        Self { signed: true, integer, fraction }.checked()
    }

    /// An unsigned format.
    ///
    /// # Errors
    /// When the width is not 1 to 63 bits.
    pub fn unsigned(integer: i32, fraction: u32) -> Result<Self, FormatError> {
        Self { signed: false, integer, fraction }.checked()
    }

    /// The narrowest format with this many fraction bits that holds every integer in `low..=high`
    /// (both in units of 2^−fraction): unsigned when `low ≥ 0`.
    ///
    /// # Errors
    /// When that needs more than 63 bits.
    pub fn for_range(low: i128, high: i128, fraction: u32) -> Result<Self, FormatError> {
        let signed = low < 0;
        let magnitude_bits = |value: i128| 128 - value.leading_zeros() as i32;
        let width = if signed {
            1 + magnitude_bits(high.max(0)).max(magnitude_bits(!low))
        } else {
            magnitude_bits(high).max(1)
        };
        Self { signed, integer: width - fraction as i32, fraction }.checked()
    }

    /// An unsigned integer format for a field of the hardware's own (an address, flags): `width` bits,
    /// held to 1 to 63.
    #[must_use]
    pub fn field(width: u32) -> Self {
        Self { signed: false, integer: width.clamp(1, MAX_WIDTH) as i32, fraction: 0 }
    }

    fn checked(self) -> Result<Self, FormatError> {
        let width = i64::from(self.integer) + i64::from(self.fraction);
        if !(1..=i64::from(MAX_WIDTH)).contains(&width) {
            return Err(FormatError::Width { text: self.to_string(), width });
        }
        // An exact decimal then has at most 63 digits after the point.
        if self.fraction > MAX_WIDTH {
            return Err(FormatError::Fraction(self.to_string()));
        }
        Ok(self)
    }

    /// True when the format has a sign bit.
    #[must_use]
    pub const fn is_signed(self) -> bool {
        self.signed
    }

    /// Integer bits, the sign included.
    #[must_use]
    pub const fn integer_bits(self) -> i32 {
        self.integer
    }

    /// The number of fraction bits, which may be more than the width.
    #[must_use]
    pub const fn fraction_bits(self) -> u32 {
        self.fraction
    }

    /// All bits, 1 to 63.
    #[must_use]
    pub const fn width(self) -> u32 {
        (self.integer + self.fraction as i32) as u32
    }

    /// The least bits the format holds.
    #[inline]
    #[must_use]
    pub const fn min_bits(self) -> i64 {
        if self.signed { -(1 << (self.width() - 1)) } else { 0 }
    }

    /// The greatest bits the format holds.
    #[inline]
    #[must_use]
    pub const fn max_bits(self) -> i64 {
        let magnitude = self.width() - self.signed as u32;
        ((1_u64 << magnitude) - 1) as i64
    }

    /// One in this format's unit, 2^fraction (which the format itself need not hold).
    #[must_use]
    pub const fn one(self) -> i64 {
        1 << self.fraction
    }

    /// One last place, as a real value: 2^−fraction.
    #[must_use]
    pub const fn ulp(self) -> f64 {
        power_of_two(-(self.fraction as i32))
    }

    /// True when the format holds these bits.
    #[inline]
    #[must_use]
    pub fn holds(self, bits: i128) -> bool {
        (i128::from(self.min_bits())..=i128::from(self.max_bits())).contains(&bits)
    }

    /// Brings bits that may lie outside the format into it.
    ///
    /// # Errors
    /// With [`Overflow::Refuse`], when the format does not hold them.
    #[inline]
    pub fn fit(self, bits: i128, overflow: Overflow) -> Result<i64, DoesNotFit> {
        if self.holds(bits) {
            return Ok(bits as i64);
        }
        match overflow {
            Overflow::Saturate if bits < 0 => Ok(self.min_bits()),
            Overflow::Saturate => Ok(self.max_bits()),
            Overflow::Wrap => Ok(self.from_word(bits as u64)),
            Overflow::Refuse => Err(DoesNotFit { bits, format: self }),
        }
    }

    /// The bits as a memory holds them: two's complement, `width` bits, the rest zero.
    #[must_use]
    pub const fn to_word(self, bits: i64) -> u64 {
        bits as u64 & self.mask()
    }

    /// The signed or unsigned integer a memory word means; places above the width are ignored.
    #[must_use]
    pub const fn from_word(self, word: u64) -> i64 {
        let unused = 64 - self.width();
        if self.signed { ((word << unused) as i64) >> unused } else { (word & self.mask()) as i64 }
    }

    const fn mask(self) -> u64 {
        (1 << self.width()) - 1
    }
}

impl fmt::Display for QFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let prefix = if self.signed { "Q" } else { "UQ" };
        f.pad(&format!("{prefix}{}.{}", self.integer, self.fraction))
    }
}

impl FromStr for QFormat {
    type Err = FormatError;

    fn from_str(text: &str) -> Result<Self, FormatError> {
        let syntax = || FormatError::Syntax(text.to_owned());
        let (signed, numbers) = match text.strip_prefix("UQ") {
            Some(rest) => (false, rest),
            None => (true, text.strip_prefix('Q').ok_or_else(syntax)?),
        };
        let (integer, fraction) = numbers.split_once('.').ok_or_else(syntax)?;
        if integer.starts_with('+') || fraction.starts_with('+') {
            return Err(syntax());
        }
        Self {
            signed,
            integer: integer.parse().map_err(|_| syntax())?,
            fraction: fraction.parse().map_err(|_| syntax())?,
        }
        .checked()
    }
}

impl TryFrom<String> for QFormat {
    type Error = FormatError;
    fn try_from(text: String) -> Result<Self, FormatError> {
        text.parse()
    }
}

impl From<QFormat> for String {
    fn from(format: QFormat) -> Self {
        format.to_string()
    }
}

/// 2^power as an f64, without a call; for powers from −1022 to 1023.
pub(crate) const fn power_of_two(power: i32) -> f64 {
    f64::from_bits(((1023 + power) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_format() -> impl Strategy<Value = QFormat> {
        (any::<bool>(), 1_i32..=63, 0_u32..=63).prop_map(|(signed, width, fraction)| QFormat {
            signed,
            integer: width - fraction as i32,
            fraction,
        })
    }

    #[test]
    fn edges_of_one_and_sixty_three_bits() {
        let bit: QFormat = "UQ0.1".parse().unwrap();
        assert_eq!((bit.width(), bit.min_bits(), bit.max_bits()), (1, 0, 1));
        let sign: QFormat = "Q1.0".parse().unwrap();
        assert_eq!((sign.width(), sign.min_bits(), sign.max_bits()), (1, -1, 0));
        let wide: QFormat = "UQ0.63".parse().unwrap();
        assert_eq!(wide.max_bits(), i64::MAX);
        let wide: QFormat = "Q63.0".parse().unwrap();
        assert_eq!((wide.min_bits(), wide.max_bits()), (-(1 << 62), (1 << 62) - 1));
    }

    #[test]
    fn what_is_not_a_format_is_refused() {
        for text in ["", "Q", "Q1", "1.15", "UQ1.15 ", "Q+1.2", "Q1.-2", "q1.2"] {
            assert_eq!(text.parse::<QFormat>(), Err(FormatError::Syntax(text.into())));
        }
        for text in ["Q0.0", "UQ64.0", "UQ1.63", "Q-3.3", "Q2000000000.4000000000"] {
            assert!(
                matches!(text.parse::<QFormat>(), Err(FormatError::Width { .. } | FormatError::Syntax(_))),
                "{text}"
            );
        }
        for text in ["UQ-63.64", "UQ-3.66"] {
            assert_eq!(text.parse::<QFormat>(), Err(FormatError::Fraction(text.into())));
        }
    }

    proptest! {
        #[test]
        fn text_and_words_come_back(format in any_format(), bits in any::<i64>()) {
            prop_assert_eq!(format.to_string().parse(), Ok(format));
            let held = format.fit(bits.into(), Overflow::Wrap).unwrap();
            prop_assert!(format.holds(held.into()));
            prop_assert_eq!(format.from_word(format.to_word(held)), held);
            prop_assert_eq!((i128::from(bits) - i128::from(held)) % (1_i128 << format.width()), 0);
        }

        #[test]
        fn the_range_format_is_the_narrowest(a in -(1_i128 << 61)..(1 << 61), b in -(1_i128 << 61)..(1 << 61)) {
            let (low, high) = (a.min(b), a.max(b));
            let format = QFormat::for_range(low, high, 20).unwrap();
            prop_assert!(format.holds(low) && format.holds(high));
            if format.width() > 1 {
                let narrower = QFormat { integer: format.integer - 1, ..format };
                prop_assert!(!narrower.holds(low) || !narrower.holds(high));
            }
        }
    }
}
