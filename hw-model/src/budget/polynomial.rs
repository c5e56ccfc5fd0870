//! Extremes of polynomials of degree three and less on an interval, for the range analysis.

/// c0 + c1·v + c2·v² + … by Horner's rule.
pub(super) fn value(coefficients: &[f64], v: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * v + c)
}

/// The coefficients of the derivative.
pub(super) fn derivative(coefficients: &[f64]) -> Vec<f64> {
    coefficients.iter().enumerate().skip(1).map(|(power, c)| power as f64 * c).collect()
}

/// The least and greatest value on `low..=high`: at an end, or where the derivative vanishes.
pub(super) fn extremes(coefficients: &[f64], (low, high): (f64, f64)) -> (f64, f64) {
    let ends = [value(coefficients, low), value(coefficients, high)];
    let mut range = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    for root in quadratic_roots(&derivative(coefficients)) {
        if root > low && root < high {
            let y = value(coefficients, root);
            range = (range.0.min(y), range.1.max(y));
        }
    }
    range
}

/// The greatest magnitude on `low..=high`.
pub(super) fn magnitude(coefficients: &[f64], interval: (f64, f64)) -> f64 {
    let (low, high) = extremes(coefficients, interval);
    low.abs().max(high.abs())
}

/// Real roots of a polynomial of degree two or less, without cancellation: the larger root of the
/// usual formula, the other from their product.
fn quadratic_roots(coefficients: &[f64]) -> Vec<f64> {
    let at = |power: usize| coefficients.get(power).copied().unwrap_or(0.0);
    let (c, b, a) = (at(0), at(1), at(2));
    if a == 0.0 {
        return if b == 0.0 { vec![] } else { vec![-c / b] };
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return vec![];
    }
    let sum = -0.5 * (b + discriminant.sqrt().copysign(b));
    if sum == 0.0 { vec![0.0] } else { vec![sum / a, c / sum] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_point_lies_outside_the_extremes(
            c in prop::array::uniform4(-10.0..10.0), low in -2.0..2.0, length in 0.0..3.0, at in 0.0..1.0
        ) {
            let interval = (low, low + length);
            let (least, greatest) = extremes(&c, interval);
            let y = value(&c, low + at * length);
            prop_assert!(y >= least - 1e-9 && y <= greatest + 1e-9);
        }
    }

    #[test]
    fn a_cubic_turns_where_its_derivative_vanishes() {
        // v³ − 3v turns at ±1 with ∓2.
        assert_eq!(extremes(&[0.0, -3.0, 0.0, 1.0], (-1.5, 1.5)), (-2.0, 2.0));
        assert_eq!(extremes(&[5.0], (0.0, 1.0)), (5.0, 5.0));
    }
}
