//! Short decimals from text: what almost every number in a file of questions or stimuli is, read without a general
//! parser of numbers, to the same f64.

use std::num::ParseFloatError;

/// The most digits: so many and fewer are an f64, like the power of ten below them.
const MOST_DIGITS: usize = 15;

const TENS: [f64; MOST_DIGITS + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A number of 1 to 15 digits, with a point or without, and nothing else: no sign, no exponent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Decimal {
    digits: u64,
    /// Digits behind the point; none without a point.
    decimals: Option<usize>,
}

impl Decimal {
    /// The decimal that a text begins with, and the rest of the text.
    #[inline]
    #[must_use]
    pub fn begin(text: &[u8]) -> Option<(Self, &[u8])> {
        let (whole, rest) = digits(0, text);
        let (digits, decimals, rest) = match rest {
            [b'.', fraction @ ..] => {
                let (all, rest) = digits(whole, fraction);
                (all, Some(fraction.len() - rest.len()), rest)
            }
            _ => (whole, None, rest),
        };
        let count = text.len() - rest.len() - usize::from(decimals.is_some());
        (1..=MOST_DIGITS).contains(&count).then_some((Self { digits, decimals }, rest))
    }

    /// The nearest f64: a quotient of two, rounded once.
    #[inline]
    #[must_use]
    pub fn real(self) -> f64 {
        self.digits as f64 / TENS[self.decimals.unwrap_or(0)]
    }

    /// The whole number, where it is written as one.
    #[inline]
    #[must_use]
    pub fn whole(self) -> Option<i64> {
        self.decimals.is_none().then_some(self.digits as i64)
    }
}

/// Appends the digits that a text begins with to a number; of too many it makes nothing that means something.
#[inline]
fn digits(mut number: u64, mut text: &[u8]) -> (u64, &[u8]) {
    while let [digit @ b'0'..=b'9', rest @ ..] = text {
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        text = rest;
    }
    (number, text)
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
    }

    proptest! {
        #[test]
        fn every_number_is_what_parse_gives(text in "[0-9]{0,17}\\.?[0-9]{0,17}", tail in "[-+e.0-9 ]{0,3}") {
            check(&text);
            check(&(text + &tail));
        }
    }
}
