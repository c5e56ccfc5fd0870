//! The terms c0 − s·(c1 − s·(c2 − …)) of a polynomial, and what they are in powers of x.

use super::super::double_double::DoubleDouble;
use super::exchange::Terms;
use crate::registers::MAX_DEGREE;

/// c0 − s·(c1 − s·(c2 − …)) in powers of x = 1 − s: the coefficient of x^j is Σ (−1)^(i − j)·(i over j)·c_i over i ≥ j.
pub(super) fn power_form(c: &Terms<DoubleDouble>) -> Terms<DoubleDouble> {
    std::array::from_fn(|j| {
        (j + 1..=MAX_DEGREE).fold(c[j], |sum, i| {
            let term = DoubleDouble::from(f64::from(binomial(i, j))) * c[i];
            if (i - j) % 2 == 0 { sum + term } else { sum - term }
        })
    })
}

/// i over j, for i ≤ 4.
pub(crate) fn binomial(i: usize, j: usize) -> u32 {
    (0..j).fold(1, |product, k| product * (i - k) as u32 / (k + 1) as u32)
}

/// The c of x^n = (1 − s)^n itself, where n is a whole number up to the degree.
pub(super) fn monomial(exponent: f64, degree: usize) -> Option<Terms<DoubleDouble>> {
    let n = (1..=degree).find(|&n| n as f64 == exponent)?;
    let of_power = |i: usize| if i <= n { f64::from(binomial(n, i)) } else { 0.0 };
    Some(std::array::from_fn(|i| DoubleDouble::from(of_power(i))))
}
