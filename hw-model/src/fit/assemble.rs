//! From 32-digit coefficients to the two forms of a cubic.

use super::double_double::DoubleDouble;
use crate::highlight::{Centred, Cubic, Power};

/// Rounds each coefficient of both forms once.
pub(super) fn rounded(centred: [DoubleDouble; 3], power: [DoubleDouble; 4]) -> Cubic {
    let [k1, k2, k3] = centred.map(DoubleDouble::to_f64);
    let [a, b, c, d] = power.map(DoubleDouble::to_f64);
    Cubic { centred: Centred { k1, k2, k3 }, power: Power { a, b, c, d } }
}

/// A cubic with f(1) = 1 and f(0) = 0, so that a = k3, c = 1 − a − b, and d is zero exactly.
pub(super) fn through_origin(centred: [DoubleDouble; 3], b: DoubleDouble) -> Cubic {
    let a = centred[2];
    let c = DoubleDouble::ONE - a - b;
    rounded(centred, [a, b, c, DoubleDouble::from(0.0)])
}

/// x^n itself, when n is one of `degrees`: where the conditions have that one solution, its zeros
/// are zeros, not the last digit of a cancellation.
pub(super) fn monomial(exponent: f64, degrees: &[u8]) -> Option<Cubic> {
    let degree = degrees.iter().find(|&&n| f64::from(n) == exponent)?;
    let (centred, power) = match degree {
        1 => ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]),
        2 => ([2.0, 1.0, 0.0], [0.0, 1.0, 0.0, 0.0]),
        3 => ([3.0, 3.0, 1.0], [1.0, 0.0, 0.0, 0.0]),
        _ => return None,
    };
    Some(rounded(centred.map(DoubleDouble::from), power.map(DoubleDouble::from)))
}
