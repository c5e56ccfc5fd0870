//! The function of a source in f32: the same operations in the same order.

use hw_model::fit::FitError;
use hw_model::registers::MAX_DEGREE;
use thiserror::Error;

use super::approximation::RealPieces;
use crate::pareto::functions::{ContenderRow, RationalRow};

/// Why there is no source.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum SourceError {
    /// An exponent that no method takes.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// A coefficient is no f32.
    #[error("n = {0}: a coefficient is beyond f32, whose greatest number is 3.4e38; use lesser exponents")]
    Large(f64),
    /// The table would be longer than a compiler takes.
    #[error("{numbers} numbers in the table of a source are more than {most}; use fewer exponents or segments")]
    Long {
        /// How many numbers the table would have.
        numbers: usize,
        /// How many it may have.
        most: usize,
    },
}

/// The function of one exponent in f32.
#[derive(Debug, Clone, PartialEq)]
pub struct Piecewise {
    /// The polynomials, from x = 1 downwards.
    pub segments: Vec<SingleSegment>,
    /// A − B and B of the ratio x/((A − B) + B·s) below them; zero where there is none.
    pub tail: Option<[f32; 2]>,
    degree: usize,
}

/// One polynomial c0 − v·(c1 − v·(c2 − …)), v = s − start, s = 1 − x, in f32.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingleSegment {
    /// The s at which it ends.
    pub end: f32,
    /// The s from which v counts.
    pub start: f32,
    /// c0 to c4.
    pub c: [f32; MAX_DEGREE + 1],
}

impl Piecewise {
    /// The real function with every number rounded to f32.
    ///
    /// # Errors
    /// When one of them is beyond f32; `exponent` is for the message.
    pub fn nearest(real: &RealPieces, degree: usize, exponent: f64) -> Result<Self, SourceError> {
        let segment = |&(end, segment): &(f64, hw_model::highlight::Segment)| SingleSegment {
            end: end as f32,
            start: segment.start as f32,
            c: segment.c.map(|c| c as f32),
        };
        let segments: Vec<SingleSegment> = real.segments.iter().map(segment).collect();
        let tail = real.tail.map(|ratio| [ratio.at_one as f32, ratio.b as f32]);
        let mut all = segments.iter().flat_map(|segment| segment.c).chain(tail.into_iter().flatten());
        if all.all(f32::is_finite) { Ok(Self { segments, tail, degree }) } else { Err(SourceError::Large(exponent)) }
    }

    /// The numbers of a row of the table, a line for each segment and one for the tail.
    pub(super) fn lines(&self) -> impl Iterator<Item = Vec<f32>> {
        let segment = |segment: &SingleSegment| {
            [segment.end, segment.start].into_iter().chain(segment.c[..=self.degree].iter().copied()).collect()
        };
        self.segments.iter().map(segment).chain(self.tail.map(|tail| tail.to_vec()))
    }

    /// The value at x, which is first brought into [0, 1].
    #[must_use]
    pub fn at(&self, x: f32) -> f32 {
        let x = x.clamp(0.0, 1.0);
        let s = 1.0 - x;
        let Some(segment) = self.segments.iter().find(|segment| s <= segment.end) else {
            return self.tail.map_or(0.0, |[at_one, b]| RationalRow::of(at_one, b).at(x));
        };
        let v = s - segment.start;
        let c = &segment.c[..=self.degree];
        c.iter().copied().rev().reduce(|inner, c| c - v * inner).unwrap_or(0.0).clamp(0.0, 1.0)
    }
}
