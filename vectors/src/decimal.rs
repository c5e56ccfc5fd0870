//! Short decimals from text: what almost every number in a file of questions or stimuli is, read without a general
//! parser of numbers, to the same f64.

use std::num::ParseFloatError;

/// The most digits: so many and fewer are an f64, like the power of ten below them.
const MOST_DIGITS: usize = 15;

const TENS: [u64; MOST_DIGITS + 1] = {
    let mut tens = [1; MOST_DIGITS + 1];
    let mut power = 1;
    while power <= MOST_DIGITS {
        tens[power] = 10 * tens[power - 1];
        power += 1;
    }
    tens
};

/// A number of 1 to 15 digits, with a point or without, and nothing else: no sign, no exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decimal {
    digits: u64,
    /// Digits behind the point; none without a point.
    decimals: Option<usize>,
}

impl Decimal {
    /// The decimal that a text begins with, and the rest of the text.
    #[inline(always)]
    #[must_use]
    pub fn begin(text: &[u8]) -> Option<(Self, &[u8])> {
        let (whole, count) = few_digits(text);
        let rest = text.get(count..)?;
        let [b'.', fraction @ ..] = rest else {
            return (1..=MOST_DIGITS).contains(&count).then_some((Self { digits: whole, decimals: None }, rest));
        };
        let (decimals, behind) = digits(fraction);
        let digits = whole.wrapping_mul(*TENS.get(behind)?).wrapping_add(decimals);
        let decimals = Some(behind);
        (1..=MOST_DIGITS).contains(&(count + behind)).then_some((Self { digits, decimals }, fraction.get(behind..)?))
    }

    /// The nearest f64: a quotient of two, rounded once.
    #[inline]
    #[must_use]
    pub fn real(self) -> f64 {
        self.digits as f64 / TENS[self.decimals.unwrap_or(0)] as f64
    }

    /// The whole number, where it is written as one.
    #[inline]
    #[must_use]
    pub fn whole(self) -> Option<i64> {
        self.decimals.is_none().then_some(self.digits as i64)
    }
}

/// The number that the digits make with which a text begins, and how many they are; of more than 15 digits the number
/// means nothing. Few digits are found soonest.
#[inline(always)]
fn few_digits(text: &[u8]) -> (u64, usize) {
    match text.first_chunk().map(|bytes| digits_of_eight(*bytes)) {
        Some(found) if found.1 < 8 => found,
        _ => digits(text),
    }
}

/// The same however many digits there are. No processor can foresee how many: so there is no loop over bytes.
#[inline(always)]
fn digits(text: &[u8]) -> (u64, usize) {
    match text.first_chunk() {
        Some(bytes) => digits_of_sixteen(*bytes),
        None => one_by_one(text),
    }
}

fn one_by_one(text: &[u8]) -> (u64, usize) {
    let digits = text.iter().take_while(|byte| byte.is_ascii_digit());
    digits.fold((0, 0), |(number, count), digit| {
        (u64::wrapping_mul(number, 10).wrapping_add(u64::from(digit - b'0')), count + 1)
    })
}

/// A byte that is not 0 to 9 has its highest bit set when this is added, or had it; bytes behind it may be wrong.
const BEYOND_NINE: u128 = u128::from_le_bytes([0x80 - 10; 16]);
const HIGHEST: u128 = u128::from_le_bytes([0x80; 16]);
const ZEROS: u128 = u128::from_le_bytes([b'0'; 16]);

#[inline(always)]
fn digits_of_eight(bytes: [u8; 8]) -> (u64, usize) {
    let digits = u64::from_le_bytes(bytes) ^ ZEROS as u64;
    let others = (digits.wrapping_add(BEYOND_NINE as u64) | digits) & HIGHEST as u64;
    let count = others.trailing_zeros() / 8;
    (eight(digits.unbounded_shl(64 - 8 * count)), count as usize)
}

#[inline(always)]
fn digits_of_sixteen(bytes: [u8; 16]) -> (u64, usize) {
    let digits = u128::from_le_bytes(bytes) ^ ZEROS;
    let others = (digits.wrapping_add(BEYOND_NINE) | digits) & HIGHEST;
    let count = others.trailing_zeros() / 8;
    let digits = digits.unbounded_shl(128 - 8 * count);
    (eight(digits as u64) * 100_000_000 + eight((digits >> 64) as u64), count as usize)
}

/// The number of eight digits, the first in the lowest byte: ones are joined to pairs, pairs to fours, fours to the
/// number. Each product has in the upper half of every place what is joined.
#[inline(always)]
fn eight(ones: u64) -> u64 {
    let pairs = (ones.wrapping_mul((10 << 8) + 1) >> 8) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs.wrapping_mul((100 << 16) + 1) >> 16) & 0x0000_ffff_0000_ffff;
    fours.wrapping_mul((10_000 << 32) + 1) >> 32
}

/// The f64 nearest to a number, however it is written: what `parse` gives.
pub(crate) fn real(text: &str) -> Result<f64, ParseFloatError> {
    match Decimal::begin(text.as_bytes()) {
        Some((decimal, [])) => Ok(decimal.real()),
        _ => text.parse(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(text: &str) {
        match (real(text), text.parse::<f64>()) {
            (Ok(ours), Ok(theirs)) => assert_eq!(ours.to_bits(), theirs.to_bits(), "{text}"),
            (ours, theirs) => assert_eq!(ours.is_err(), theirs.is_err(), "{text}"),
        }
    }

    #[test]
    fn the_edges_of_what_is_short() {
        for text in ["", ".", "5.", ".5", "0.", "1..2", "+1", "-0", "1e3", "0x10", "nan", " 1"] {
            check(text);
        }
        for text in ["999999999999999", "0.99999999999999", ".999999999999999", "1.23456789012345"] {
            check(text);
            assert!(Decimal::begin(text.as_bytes()).is_some_and(|(_, rest)| rest.is_empty()), "{text}");
        }
        assert_eq!(Decimal::begin(b"9999999999999999"), None);
        assert_eq!(Decimal::begin("9".repeat(99).as_bytes()), None);
        let (decimal, rest) = Decimal::begin(b"64,0.99").unwrap();
        assert_eq!((decimal.whole(), rest), (Some(64), &b",0.99"[..]));
        assert_eq!(Decimal::begin(b"64.").unwrap().0.whole(), None);
        // As many bytes behind it as are looked at.
        for (text, whole) in
            [("64", 64), ("8304722", 8_304_722), ("83047221", 83_047_221), ("999999999999999", 999_999_999_999_999)]
        {
            for end in ["", ",", "\n", "\u{fb}", "/", ":"] {
                let line = format!("{text}{end}{}", "7".repeat(20));
                let (decimal, rest) = Decimal::begin(if end.is_empty() { text } else { &line }.as_bytes()).unwrap();
                assert_eq!((decimal.whole(), rest.starts_with(end.as_bytes())), (Some(whole), true), "{line}");
            }
        }
    }

    proptest! {
        #[test]
        fn every_number_is_what_parse_gives(text in "[0-9]{0,17}\\.?[0-9]{0,17}", tail in "[-+e.0-9 ]{0,3}") {
            check(&text);
            check(&(text + &tail));
        }
    }
}
