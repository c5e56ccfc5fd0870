//! The last line of the polynomial: into [0, 1].
//!
//! t3 has the output's fraction bits already, with integer bits (and a sign) for every value the
//! polynomial can take. A cubic may dip below zero above its cut, or round to one ulp above 1; both
//! are clamped, and said so in the status.

use crate::rounding::Lane;

/// `t3` clamped to `0..=one`.
#[inline(always)]
pub fn clamp<L: Lane>(t3: L, one: L) -> L {
    t3.max(L::ZERO).min(one)
}
