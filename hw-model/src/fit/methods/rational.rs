//! The tail of \[Rom\]: g = x/(A − B·x) with g(q) = Q, g′(q) = nQ/q.
//!
//! A = nq/Q, B = (n − 1)/Q, and the denominator at x = 1 is A − B = (1 − n·p)/Q, in which n·p is of
//! size −ln Q however large n is. (The misprinted derivative in \[Rom\] lacks the square of A − B·x.)

use crate::fit::crossing::{WideCrossing, less_one};
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Rational;

/// For n = 1 this is x itself.
pub(super) fn rational(exponent: f64, level: f64, at_q: &WideCrossing) -> Rational {
    let n = DoubleDouble::from(exponent);
    let level = DoubleDouble::from(level);
    Rational {
        a: (n * at_q.x / level).to_f64(),
        b: (less_one(exponent) / level).to_f64(),
        at_one: ((DoubleDouble::ONE - n * at_q.s) / level).to_f64(),
    }
}
