//! The polynomials whose greatest error is least.
//!
//! \[Rom\]'s cubics pass through given points. These give that up for the least greatest error over a range of
//! x: f(1) = 1 alone is kept, so the first segment of degree D has D coefficients left. For D = 3 that is 88 times
//! less error on the epicentre than `hermite` has for n = 128.
//!
//! **What makes it the least** (Chebyshev). 1 − s·(k1 − s·(k2 − …)) has D free coefficients, and
//! s, s², … vanish together at s = 0 only. So the error is least when it reaches its greatest
//! magnitude at D + 1 points, with alternating signs (`exchange`). A segment further down has a free
//! constant term, and D + 2 such points. The derivative of x^n of order D + 1 never changes its sign on (0, 1), so
//! the error has D turning points and no more: they are D of the points, and the ends of the range are
//! the others.
//!
//! **Segments** (`segments`). The hand-over points are where every segment has the same greatest
//! error E. Then neighbours agree there of themselves: the error has the same sign at both ends of every
//! segment but the first, and at the end of the first, so both sides are x^n ∓ E. That is so for an odd D; of an
//! even D a segment ends at x^n + E and the next begins at x^n − E. Where the range is not given, it ends where x^n =
//! E: what is put to zero below adds no greater error, and the last segment, which for D = 3 ends at x^n − E, meets
//! that zero without a jump.
//!
//! Between n = D − 1 and D the derivative has the other sign: all the same with the signs exchanged, but for the
//! last end, which is 2E high there (for D = 3, E is at most 0.1 % for one segment).

mod exchange;
mod segments;
mod terms;

use exchange::Digits;
use terms::power_form;

pub use exchange::Alternation;
pub use segments::{Fitted, Range, between, segments};
pub(crate) use terms::binomial;

use super::assemble;
use super::crossing::{WideCrossing, crossing};
use super::error::FitError;
use crate::highlight::Cubic;
use crate::registers::CUBIC;

/// The best cubic with f(1) = 1 for x ≥ q, and where its error is greatest.
///
/// For n = 1, 2, 3 that is x^n itself.
pub(super) fn minimax(exponent: f64, at_q: &WideCrossing) -> (Cubic, Option<Alternation>) {
    if let Some(monomial) = assemble::monomial(exponent, &[1, 2, 3]) {
        return (monomial, None);
    }
    let best = exchange::first(exponent, CUBIC, at_q.s, Digits::Full, None);
    let ([_, k1, k2, k3, _], [d, c, b, a, _]) = (best.c, power_form(&best.c));
    (assemble::rounded([k1, k2, k3], [a, b, c, d]), Some(best.alternation()))
}

/// The points at which the best cubic with f(1) = 1 for x^n ≥ `level` has its greatest error; none for n = 1,
/// 2, 3, where it has none.
///
/// # Errors
/// When the exponent or the level is out of range.
pub fn alternation(exponent: f64, level: f64) -> Result<Option<Alternation>, FitError> {
    crossing(exponent, level)?;
    Ok(minimax(exponent, &WideCrossing::new(exponent, level)).1)
}

#[cfg(test)]
mod tests;
