//! Boxes of (h, σ), and partitions of one into boxes.
//!
//! A partition is written as the way to it: `0` a box that is left as it is, `1` one that is halved in σ,
//! `2` one that is halved in h; after `1` and `2` come the half with the smaller values and then the other
//! one, each written in the same manner. Whatever text can be read to its end in this way covers the whole
//! box, without gaps: that needs no check of its own.

use thiserror::Error;

use crate::interval::Interval;

/// A box: every h with every σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cell {
    /// The range of h = 1/n, within 0 to 1.
    pub h: Interval,
    /// The range of σ = −n·ln x, 0 or more.
    pub sigma: Interval,
}

/// What a box can be halved in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// The axis of σ = −n·ln x.
    Sigma,
    /// The axis of h = 1/n.
    H,
}

impl Axis {
    /// How a partition writes it.
    #[must_use]
    pub(super) const fn symbol(self) -> char {
        match self {
            Self::Sigma => '1',
            Self::H => '2',
        }
    }
}

/// A box that is not halved.
pub(super) const LEAF: char = '0';

/// Why a text is no partition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub(super) enum PartitionError {
    /// A sign that means nothing here.
    #[error("position {position}: {found:?} is none of {allowed}")]
    Sign {
        /// The place of the sign in the text, counted from 0.
        position: usize,
        /// The character that stands there.
        found: char,
        /// What may stand there.
        allowed: &'static str,
    },
    /// Nothing is left to divide.
    #[error("position {position}: everything is covered, and the text goes on")]
    TooLong {
        /// The place in the text, counted from 0.
        position: usize,
    },
    /// Something is left to divide.
    #[error("it ends before everything is covered")]
    TooShort,
    /// Two neighbouring floats have no middle.
    #[error("position {position}: the box is too small to be halved")]
    TooSmall {
        /// The place in the text, counted from 0.
        position: usize,
    },
}

impl Cell {
    /// Both halves, or `None` where no f64 lies between the ends.
    #[must_use]
    pub(super) fn halves(self, axis: Axis) -> Option<[Self; 2]> {
        let whole = match axis {
            Axis::Sigma => self.sigma,
            Axis::H => self.h,
        };
        let middle = whole.middle();
        if middle <= whole.low() || middle >= whole.high() {
            return None;
        }
        let part = |low, high| match axis {
            Axis::Sigma => Self { sigma: Interval::new(low, high), ..self },
            Axis::H => Self { h: Interval::new(low, high), ..self },
        };
        Some([part(whole.low(), middle), part(middle, whole.high())])
    }
}

/// The boxes of a partition of `root`, in their order. `in_h` allows to halve in h.
///
/// # Errors
/// When the text is no partition.
pub(super) fn boxes(text: &str, root: Cell, in_h: bool) -> Result<Vec<Cell>, PartitionError> {
    let mut waiting = vec![root];
    let mut boxes = Vec::new();
    for (position, found) in text.chars().enumerate() {
        let cell = waiting.pop().ok_or(PartitionError::TooLong { position })?;
        let axis = match found {
            LEAF => {
                boxes.push(cell);
                continue;
            }
            '1' => Axis::Sigma,
            '2' if in_h => Axis::H,
            _ => {
                let allowed = if in_h { "0, 1, 2" } else { "0, 1" };
                return Err(PartitionError::Sign { position, found, allowed });
            }
        };
        let [first, second] = cell.halves(axis).ok_or(PartitionError::TooSmall { position })?;
        waiting.extend([second, first]);
    }
    if waiting.is_empty() { Ok(boxes) } else { Err(PartitionError::TooShort) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn unit() -> Cell {
        Cell { h: Interval::new(0.0, 1.0), sigma: Interval::new(0.0, 1.0) }
    }

    #[test]
    fn a_partition_is_read_to_its_end() {
        let one = |text| boxes(text, unit(), false);
        assert_eq!(one("0").unwrap(), [unit()]);
        let sigmas: Vec<(f64, f64)> =
            one("11000").unwrap().iter().map(|cell| (cell.sigma.low(), cell.sigma.high())).collect();
        assert_eq!(sigmas, [(0.0, 0.25), (0.25, 0.5), (0.5, 1.0)]);
        assert_eq!(one(""), Err(PartitionError::TooShort));
        assert_eq!(one("10"), Err(PartitionError::TooShort));
        assert_eq!(one("00"), Err(PartitionError::TooLong { position: 1 }));
        assert!(one("200").unwrap_err().to_string().contains("position 0: '2' is none of 0, 1"));
        assert!(boxes("300", unit(), true).is_err());
        let deep = "1".repeat(2000) + &"0".repeat(2001);
        assert!(matches!(one(&deep), Err(PartitionError::TooSmall { .. })));
    }

    proptest! {
        /// A random tree: the boxes are those of the area, and every point is in one of them.
        #[test]
        fn nothing_is_left_out(
            signs in proptest::collection::vec(0_u8..3, 1..50),
            h in 0.0_f64..=1.0,
            sigma in 0.0_f64..=1.0,
        ) {
            // Cut off where the tree is complete, and completed by leaves where it is not.
            let mut open = 1;
            let mut text = String::new();
            for sign in signs {
                if open == 0 { break; }
                text.push(char::from(b'0' + sign));
                open = if sign == 0 { open - 1 } else { open + 1 };
            }
            text.push_str(&"0".repeat(open));
            let boxes = boxes(&text, unit(), true).unwrap();
            let area: f64 = boxes.iter().map(|cell| {
                (cell.h.high() - cell.h.low()) * (cell.sigma.high() - cell.sigma.low())
            }).sum();
            prop_assert_eq!(area, 1.0);
            prop_assert!(boxes.iter().any(|cell| cell.h.holds(h) && cell.sigma.holds(sigma)));
        }
    }
}
