//! The cubic whose minimum touches zero: f = a·x·(x − m)², f(1) = 1, f(r) = Q.
//!
//! Written x·(u·x − v)² the conditions are u − v = 1 and u·r − v = k, k = √(Q/r), so
//!
//! ```text
//! u = (1 − k)/(1 − r)        1 − k = −expm1(ln Q·(n − 1)/(2n))
//! v = (r − k)/(1 − r)        r − k = k·expm1(ln Q·(3 − n)/(2n))
//! a = u²   b = −2·u·v   c = v²   k1 = 2u + 1   k2 = u·(u + 2)   k3 = u²
//! ```
//!
//! Nothing cancels: v keeps its digits through n = 3, where it changes sign, and the k_i, written
//! with v = u − 1, are sums of positive terms.
//!
//! Domain: every n ≥ 1. f ≥ 0 for all x ≥ 0. The minimum is m = v/u; for n < 3 it lies below 0
//! (for n = 1, where u = 0, at −∞), and f then rises all the way from x = 0 to 1.

use crate::fit::assemble;
use crate::fit::crossing::{WideCrossing, less_one};
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Cubic;

/// For n = 1 and n = 3 this is x^n itself; for n = 2 it is not.
pub(super) fn tangent(exponent: f64, at_q: &WideCrossing) -> Cubic {
    if let Some(monomial) = assemble::monomial(exponent, &[1, 3]) {
        return monomial;
    }
    let (one, two) = (DoubleDouble::ONE, DoubleDouble::from(2.0));
    let twice_n = DoubleDouble::from(2.0 * exponent);
    let half_log_ratio = at_q.log * less_one(exponent) / twice_n;
    let log_r_over_k = at_q.log * (two - less_one(exponent)) / twice_n;
    let u = -half_log_ratio.exp_m1() / at_q.s;
    let v = half_log_ratio.exp() * log_r_over_k.exp_m1() / at_q.s;
    let (a, c) = (u * u, v * v);
    let zero = DoubleDouble::from(0.0);
    assemble::rounded([u + u + one, u * (u + two), a], [a, -(u * v + u * v), c, zero])
}
