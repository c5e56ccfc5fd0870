//! The cubic of \[Rom\]: f(1) = 1, f(q) = Q, f′(q) = nQ/q, f(0) = 0.
//!
//! Newton's form on the nodes 1, q, q, 0, with p = 1 − q, R = Q/q = q^(n−1) and P = 1 − R:
//!
//! ```text
//! D1 = (Q − 1)/p            = −(1 + q·P/p)
//! Δ  = −n·R − D1            = P·(q/p + n) − (n − 1)
//! D2 = Δ/p
//! D3 = R·(n − 1)/q − D2
//! f  = 1 + D1·s + D2·s·(s − p) + D3·s·(s − p)²        s = 1 − x
//! ```
//!
//! The right-hand sides hold only terms that vanish with n − 1, so that D2 and D3 keep their digits
//! as n → 1. What is left to cancel does so by a factor of 1 − Q at most, and by n − 2 or n − 3 where
//! a coefficient has its zero; 32 digits carry that.

use crate::fit::assemble;
use crate::fit::crossing::{WideCrossing, less_one};
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Cubic;

/// D1 and D2·p = Δ, the divided differences that `hermite` and `quadratic` share.
pub(super) struct Differences {
    /// −D1 − 1 = q·P/p, of size n − 1.
    pub first_less_one: DoubleDouble,
    /// Δ = D2·p, the change of the divided difference.
    pub bend: DoubleDouble,
}

impl Differences {
    pub fn new(exponent: f64, at_q: &WideCrossing) -> Self {
        let n = DoubleDouble::from(exponent);
        let q_over_p = at_q.x / at_q.s;
        Self { first_less_one: at_q.shortfall * q_over_p, bend: at_q.shortfall * (q_over_p + n) - less_one(exponent) }
    }
}

/// k1 = −D1 + Δ − p²·D3, k2 = D2 − 2p·D3, k3 = −D3; a = k3, b = D2 + (1 + 2q)·D3, c = 1 − a − b.
///
/// For n = 1, 2, 3 the only cubic that satisfies the conditions is x^n itself.
pub(super) fn hermite(exponent: f64, at_q: &WideCrossing) -> Cubic {
    if let Some(monomial) = assemble::monomial(exponent, &[1, 2, 3]) {
        return monomial;
    }
    let (p, q) = (at_q.s, at_q.x);
    let Differences { first_less_one, bend } = Differences::new(exponent, at_q);
    let d2 = bend / p;
    let d3 = at_q.ratio * less_one(exponent) / q - d2;
    let b = d2 + d3 * (DoubleDouble::ONE + q + q);
    assemble::through_origin([DoubleDouble::ONE + (first_less_one + bend) - p * p * d3, d2 - (p + p) * d3, -d3], b)
}
