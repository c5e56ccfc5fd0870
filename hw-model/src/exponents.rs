//! The Phong exponents a piece of hardware is built for, and how people write them.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The greatest exponent. Here the whole epicentre is 7·10⁻¹⁶ wide, a few times the distance between
/// 1 and the next f64 below it; and every integer up to it is an f64.
pub const MAX_EXPONENT: f64 = 1e15;

/// The most exponents one list may hold: a ROM address of 16 bits.
pub const MAX_COUNT: usize = 1 << 16;

/// A run of at least this many consecutive integers is written as a range.
const SHORTEST_RANGE: usize = 3;

/// A non-empty, strictly increasing list of exponents, each from 1 to [`MAX_EXPONENT`].
///
/// Parsed from comma-separated numbers and inclusive integer ranges: `1..=256`, `1,2,8,64`,
/// `1..=8,16,2.5e3`. Its `Display` is the canonical text, which parses back to the same list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Exponents(Vec<f64>);

/// Why a list of exponents is refused.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExponentsError {
    /// Nothing between two commas, or nothing at all.
    #[error("an exponent is missing in {0:?}; write for example 1..=256 or 1,2.5,64")]
    Empty(String),
    /// The piece is not a decimal number.
    #[error("{0:?} is not an exponent; write a number such as 64 or 2.5, or a range such as 1..=256")]
    NotANumber(String),
    /// The number is below 1, above [`MAX_EXPONENT`], infinite or NaN.
    #[error("the exponent {0} is out of range; exponents are numbers from 1 to 1e15")]
    OutOfRange(String),
    /// A range with `..` or `...`, which might or might not include its end.
    #[error("{piece:?} leaves open whether its end belongs to it; write {low}..={high}")]
    OpenRange {
        /// The range as written.
        piece: String,
        /// The range's first bound, as written.
        low: String,
        /// The range's last bound, as written.
        high: String,
    },
    /// A bound of a range is not an integer.
    #[error("the range {0:?} does not run over integers; write fractional exponents one by one")]
    FractionalRange(String),
    /// The range is empty.
    #[error("the range {0:?} runs downwards; write the smaller bound first")]
    BackwardRange(String),
    /// The exponent is the one before it again.
    #[error("the exponent {0} is given twice; give each exponent once")]
    Duplicate(f64),
    /// The exponent is below the one before it.
    #[error("the exponent {next} follows {previous}; list the exponents in increasing order")]
    Unsorted {
        /// The exponent before, which is greater.
        previous: f64,
        /// The smaller exponent after it.
        next: f64,
    },
    /// More than [`MAX_COUNT`] exponents.
    #[error("{0:?} brings the list over {MAX_COUNT} exponents; list fewer, or build several tables")]
    TooMany(String),
}

/// Reads one exponent, a decimal number from 1 to [`MAX_EXPONENT`]; space around it is ignored.
///
/// # Errors
/// When the text is not such a number; the message says what would be.
pub fn parse_exponent(text: &str) -> Result<f64, ExponentsError> {
    let text = text.trim();
    let exponent: f64 = text.parse().map_err(|_| ExponentsError::NotANumber(text.to_owned()))?;
    checked(exponent).map_err(|_| ExponentsError::OutOfRange(text.to_owned()))
}

fn checked(exponent: f64) -> Result<f64, ExponentsError> {
    if (1.0..=MAX_EXPONENT).contains(&exponent) {
        Ok(exponent)
    } else {
        Err(ExponentsError::OutOfRange(exponent.to_string()))
    }
}

impl Exponents {
    /// Takes a list as it is.
    ///
    /// # Errors
    /// When it is empty or too long, does not strictly increase, or leaves 1..=[`MAX_EXPONENT`].
    pub fn new(list: Vec<f64>) -> Result<Self, ExponentsError> {
        if list.is_empty() {
            return Err(ExponentsError::Empty(String::new()));
        }
        if let Some(first_too_many) = list.get(MAX_COUNT) {
            return Err(ExponentsError::TooMany(first_too_many.to_string()));
        }
        for &exponent in &list {
            checked(exponent)?;
        }
        for (&previous, &next) in list.iter().zip(&list[1..]) {
            if previous == next {
                return Err(ExponentsError::Duplicate(next));
            }
            if previous > next {
                return Err(ExponentsError::Unsorted { previous, next });
            }
        }
        Ok(Self(list))
    }

    /// The exponents as numbers of 1 or more, increasing.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }

    /// The exponents one by one, increasing.
    pub fn iter(&self) -> std::iter::Copied<std::slice::Iter<'_, f64>> {
        self.0.iter().copied()
    }

    /// How many there are, 1 to [`MAX_COUNT`].
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a list is never empty")]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The least exponent, which has ROM address 0.
    #[must_use]
    pub fn first(&self) -> f64 {
        self.0[0]
    }

    /// The greatest exponent, which has the last ROM address.
    #[must_use]
    pub fn last(&self) -> f64 {
        self.0[self.0.len() - 1]
    }

    /// The place of exactly this exponent in the list, counted from 0.
    #[inline]
    #[must_use]
    pub fn position(&self, exponent: f64) -> Option<usize> {
        // Where the list counts up by one, which most do.
        let counted = (exponent - self.first()) as u32 as usize;
        if self.0.get(counted) == Some(&exponent) {
            return Some(counted);
        }
        self.0.binary_search_by(|n| n.total_cmp(&exponent)).ok()
    }
}

impl<'a> IntoIterator for &'a Exponents {
    type Item = f64;
    type IntoIter = std::iter::Copied<std::slice::Iter<'a, f64>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl FromStr for Exponents {
    type Err = ExponentsError;

    fn from_str(text: &str) -> Result<Self, ExponentsError> {
        let mut list = Vec::new();
        for piece in text.split(',') {
            let piece = piece.trim();
            if piece.is_empty() {
                return Err(ExponentsError::Empty(text.to_owned()));
            }
            push_piece(&mut list, piece)?;
        }
        Self::new(list)
    }
}

/// Appends what one piece between commas means, and refuses before it would allocate too much.
fn push_piece(list: &mut Vec<f64>, piece: &str) -> Result<(), ExponentsError> {
    let (low, count) = match parse_range(piece)? {
        Some((low, high)) => (low, high - low + 1.0),
        None => (parse_exponent(piece)?, 1.0),
    };
    if list.len() as f64 + count > MAX_COUNT as f64 {
        return Err(ExponentsError::TooMany(piece.to_owned()));
    }
    list.extend((0..count as usize).map(|i| low + i as f64));
    Ok(())
}

/// The bounds of `low..=high`, or nothing when the piece is not a range.
fn parse_range(piece: &str) -> Result<Option<(f64, f64)>, ExponentsError> {
    let Some((low, rest)) = piece.split_once("..") else {
        return Ok(None);
    };
    let Some(high) = rest.strip_prefix('=') else {
        return Err(ExponentsError::OpenRange {
            piece: piece.to_owned(),
            low: low.trim().to_owned(),
            high: rest.trim_start_matches('.').trim().to_owned(),
        });
    };
    let (low, high) = (parse_exponent(low)?, parse_exponent(high)?);
    if low.fract() != 0.0 || high.fract() != 0.0 {
        return Err(ExponentsError::FractionalRange(piece.to_owned()));
    }
    if low > high {
        return Err(ExponentsError::BackwardRange(piece.to_owned()));
    }
    Ok(Some((low, high)))
}

impl fmt::Display for Exponents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rest = self.as_slice();
        let mut separator = "";
        while let Some((&first, tail)) = rest.split_first() {
            let run = integer_run(rest);
            if run >= SHORTEST_RANGE {
                write!(f, "{separator}{first}..={}", rest[run - 1])?;
                rest = &rest[run..];
            } else {
                write!(f, "{separator}{first}")?;
                rest = tail;
            }
            separator = ",";
        }
        Ok(())
    }
}

/// How many of the first exponents are consecutive integers.
fn integer_run(list: &[f64]) -> usize {
    let first = list[0];
    list.iter().enumerate().take_while(|&(i, &n)| n.fract() == 0.0 && n == first + i as f64).count()
}

impl TryFrom<String> for Exponents {
    type Error = ExponentsError;
    fn try_from(text: String) -> Result<Self, ExponentsError> {
        text.parse()
    }
}

impl From<Exponents> for String {
    fn from(exponents: Exponents) -> Self {
        exponents.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn error(text: &str) -> String {
        text.parse::<Exponents>().unwrap_err().to_string()
    }

    #[test]
    fn numbers_and_ranges_mix() {
        let list: Exponents = " 1..=3, 16 ,2.5e3,1e15".parse().unwrap();
        assert_eq!(list.as_slice(), [1.0, 2.0, 3.0, 16.0, 2500.0, 1e15]);
        assert_eq!(list.to_string(), "1..=3,16,2500,1000000000000000");
        assert_eq!((list.first(), list.last(), list.len()), (1.0, 1e15, 6));
        assert_eq!((list.position(16.0), list.position(16.5)), (Some(3), None));
        assert_eq!(list.position(f64::NAN), None);
        let whole: Exponents = "1..=256".parse().unwrap();
        assert_eq!((whole.len(), whole.to_string().as_str()), (256, "1..=256"));
        assert_eq!("7,8".parse::<Exponents>().unwrap().to_string(), "7,8");
        assert_eq!("1..=65536".parse::<Exponents>().unwrap().len(), MAX_COUNT);
    }

    #[test]
    fn a_refusal_names_the_piece_and_what_would_be_right() {
        for (text, piece, advice) in [
            ("", "\"\"", "1..=256"),
            ("1,,2", "\"1,,2\"", "missing"),
            ("1,two", "\"two\"", "such as 64"),
            ("1..256", "\"1..256\"", "write 1..=256"),
            ("1...256", "\"1...256\"", "write 1..=256"),
            ("1..=", "\"\"", "write a number"),
            ("1..=2..=3", "\"2..=3\"", "write a number"),
            ("NaN", "NaN", "from 1 to 1e15"),
            ("inf", "inf", "from 1 to 1e15"),
            ("1e999", "1e999", "from 1 to 1e15"),
            ("1.1e15", "1.1e15", "from 1 to 1e15"),
            ("0.999", "0.999", "from 1 to 1e15"),
            ("-4", "-4", "from 1 to 1e15"),
            ("0..=4", "0", "from 1 to 1e15"),
            ("1.5..=4", "\"1.5..=4\"", "one by one"),
            ("9..=4", "\"9..=4\"", "smaller bound first"),
            ("1,2,2", "2", "once"),
            ("1..=8,4", "4 follows 8", "increasing"),
            ("2,1..=65536", "\"1..=65536\"", "65536 exponents"),
            ("1..=1e15", "\"1..=1e15\"", "65536 exponents"),
        ] {
            let message = error(text);
            assert!(message.contains(piece) && message.contains(advice), "{text:?} gave: {message}");
        }
        assert!(Exponents::new(vec![1.0; MAX_COUNT + 1]).is_err());
        assert!(Exponents::new(vec![1.0, f64::NAN]).is_err());
        assert!(Exponents::new(vec![]).is_err());
    }

    #[test]
    fn serde_carries_the_text() {
        let list: Exponents = serde_json::from_str("\"1..=4,9.5\"").unwrap();
        assert_eq!(serde_json::to_string(&list).unwrap(), "\"1..=4,9.5\"");
        let refusal = serde_json::from_str::<Exponents>("\"1..4\"").unwrap_err();
        assert!(refusal.to_string().contains("1..=4"), "{refusal}");
    }

    proptest! {
        #[test]
        fn canonical_text_comes_back(
            integers in proptest::collection::btree_set(1_u32..40, 1..30),
            fractions in proptest::collection::vec(1.0_f64..1e15, 0..4),
        ) {
            let mut list: Vec<f64> = integers.into_iter().map(f64::from).chain(fractions).collect();
            list.sort_by(f64::total_cmp);
            list.dedup();
            let exponents = Exponents::new(list.clone()).unwrap();
            prop_assert_eq!(exponents.to_string().parse::<Exponents>(), Ok(exponents.clone()));
            for (i, &n) in list.iter().enumerate() {
                prop_assert_eq!(exponents.position(n), Some(i));
            }
        }

        #[test]
        fn no_text_panics(text in "[0-9.,=e+ -]{0,12}|.{0,8}") {
            let _ = text.parse::<Exponents>();
        }
    }
}
