//! The cubic of \[Rom\] against blooming: f(1) = 1, f(r) = Q, f(l) = G, f(0) = 0.
//!
//! f(x)/x is a parabola through (1, 1), (r, Q/r), (l, G/l):
//!
//! ```text
//! e1 = (1 − Q/r)/(1 − r)     e2 = (1 − G/l)/(1 − l)
//! a  = (e1 − e2)/(r − l)     b = e1 − a·(1 + r)     c = 1 − a − b
//! k1 = 3a + 2b + c = 1 + e1 + a·(1 − r)
//! k2 = 3a + b      = e1 + a·(2 − r)
//! ```
//!
//! k1 of size n is not computed from a, b, c of size n². r − l = l·expm1((ln Q − ln G)/n) keeps its
//! digits for large n; when G is close to Q, e1 − e2 and r − l lose them together, by Q − G.
//!
//! The coefficients printed in \[Rom\] do not solve the system printed there; these do.

use crate::fit::assemble;
use crate::fit::crossing::WideCrossing;
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Cubic;

/// For n = 1, 2, 3 the only cubic that satisfies the conditions is x^n itself.
pub(super) fn three_point(exponent: f64, at_q: &WideCrossing, at_g: &WideCrossing) -> Cubic {
    if let Some(monomial) = assemble::monomial(exponent, &[1, 2, 3]) {
        return monomial;
    }
    let one = DoubleDouble::ONE;
    let e1 = at_q.shortfall / at_q.s;
    let e2 = at_g.shortfall / at_g.s;
    let log_between = (at_q.log - at_g.log) / DoubleDouble::from(exponent);
    let a = (e1 - e2) / (at_g.x * log_between.exp_m1());
    let b = e1 - a * (one + at_q.x);
    assemble::through_origin([one + e1 + a * at_q.s, e1 + a * (one + at_q.s), a], b)
}
