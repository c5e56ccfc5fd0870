//! The parabola of \[Rom\], Fig. 2: f(1) = 1, f(q) = Q, f′(q) = nQ/q.
//!
//! The differences D1, D2 and Δ are those of `hermite`; k1 = −D1 + Δ, k2 = D2, k3 = 0. Its value at
//! x = 0 is not zero: d = 1 − k1 + k2.

use super::hermite::Differences;
use crate::fit::assemble;
use crate::fit::crossing::WideCrossing;
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Cubic;

/// For n = 1 and n = 2 the only such parabola is x^n itself.
pub(super) fn quadratic(exponent: f64, at_q: &WideCrossing) -> Cubic {
    if let Some(monomial) = assemble::monomial(exponent, &[1, 2]) {
        return monomial;
    }
    let Differences { first_less_one, bend } = Differences::new(exponent, at_q);
    let zero = DoubleDouble::from(0.0);
    // k1 − 1 vanishes with n − 1, and so does d: it is taken before the 1 is added.
    let slope_less_one = first_less_one + bend;
    let k1 = DoubleDouble::ONE + slope_less_one;
    let k2 = bend / at_q.s;
    assemble::rounded([k1, k2, zero], [zero, k2, k1 - (k2 + k2), k2 - slope_less_one])
}
