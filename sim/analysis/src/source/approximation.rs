//! What is chosen for a source, and the real function that follows for one exponent.

use hw_model::fit::minimax::{self, Range};
use hw_model::fit::{Curve, FitError, Levels, Method, fit};
use hw_model::highlight::{Cubic, Rational, Segment};
use hw_model::registers::CUBIC;

/// What approximates x^n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Approximation {
    /// A method as it is: a cubic down to its minimum and zero below, a ratio, or both.
    Method(Method, Levels),
    /// Minimax segments down to where x^n is their greatest error, and zero below.
    Segments {
        /// The degree of each, 1 to 4.
        degree: usize,
        /// How many there are, 1 to 8.
        count: usize,
    },
}

/// The real function of one exponent: polynomials from x = 1 downwards, and what is below them.
#[derive(Debug, Clone, PartialEq)]
pub struct RealPieces {
    /// The polynomials, each with the s = 1 − x at which it ends; none for a ratio alone.
    pub segments: Vec<(f64, Segment)>,
    /// The ratio below them; zero where there is none.
    pub tail: Option<Rational>,
}

impl Approximation {
    /// The function for one exponent.
    ///
    /// # Errors
    /// When the exponent is out of range.
    pub fn pieces(self, exponent: f64) -> Result<RealPieces, FitError> {
        match self {
            Self::Method(method, levels) => {
                let fit = fit(method, exponent, levels)?;
                let epicentre = fit.epicentre.s;
                let to = |end: f64, cubic: &Cubic| vec![(end, cubic.segment())];
                Ok(match &fit.curve {
                    Curve::Cubic(cubic) => {
                        let minimum = cubic.centred.first_minimum().unwrap_or(1.0).clamp(epicentre, 1.0);
                        RealPieces { segments: to(minimum, cubic), tail: None }
                    }
                    Curve::Rational(rational) => RealPieces { segments: Vec::new(), tail: Some(*rational) },
                    Curve::Composite { epicentre: cubic, tail } => {
                        RealPieces { segments: to(epicentre, cubic), tail: Some(*tail) }
                    }
                })
            }
            Self::Segments { degree, count } => {
                let fitted = minimax::segments(exponent, degree, count, Range::Balanced)?;
                let mut segments: Vec<_> = fitted.ends.into_iter().zip(fitted.segments).collect();
                // Where x^n is itself such a polynomial, one segment is everything, and the others are never reached.
                if let Some(&last) = segments.last() {
                    segments.resize(count, last);
                }
                Ok(RealPieces { segments, tail: None })
            }
        }
    }

    /// The greatest degree of its polynomials.
    #[must_use]
    pub const fn degree(self) -> usize {
        match self {
            Self::Method(..) => CUBIC,
            Self::Segments { degree, .. } => degree,
        }
    }

    /// Q, the level at which the highlight's own range ends.
    #[must_use]
    pub fn level(self) -> f64 {
        match self {
            Self::Method(_, levels) => levels.q(),
            Self::Segments { .. } => Levels::default().q(),
        }
    }

    /// What is computed, for a comment.
    #[must_use]
    pub fn said(self) -> String {
        match self {
            Self::Method(method, _) => method.name().to_owned(),
            Self::Segments { degree, count } => format!(
                "minimax, {count} segment{} of degree {degree}, 0 where x^n is the greatest error",
                if count == 1 { "" } else { "s" }
            ),
        }
    }
}
