//! Extremes of polynomials of degree four and less on an interval, for the range analysis.

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
    for root in roots(&derivative(coefficients), (low, high)) {
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

/// Real roots of a polynomial of degree three or less; of a cubic those on `low..=high`.
fn roots(coefficients: &[f64], interval: (f64, f64)) -> Vec<f64> {
    match coefficients {
        [.., cubic] if coefficients.len() > 3 && *cubic != 0.0 => cubic_roots(coefficients, interval),
        _ => quadratic_roots(coefficients),
    }
}

/// Between two places where a cubic turns it rises or falls: one root or none, found by halving. The extremes of its
/// integral are flat there, so that neighbouring floats are as good as the root.
fn cubic_roots(coefficients: &[f64], (low, high): (f64, f64)) -> Vec<f64> {
    let mut places = quadratic_roots(&derivative(coefficients));
    places.retain(|place| *place > low && *place < high);
    places.extend([low, high]);
    places.sort_by(f64::total_cmp);
    let mut found = Vec::new();
    for pair in places.windows(2) {
        let (mut below, mut above) = (pair[0], pair[1]);
        let sign = value(coefficients, below) < 0.0;
        if sign == (value(coefficients, above) < 0.0) {
            continue;
        }
        loop {
            let middle = 0.5 * (below + above);
            if middle <= below || middle >= above {
                break;
            }
            let same = (value(coefficients, middle) < 0.0) == sign;
            *(if same { &mut below } else { &mut above }) = middle;
        }
        found.extend([below, above]);
    }
    found
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
            c in prop::array::uniform5(-10.0..10.0), low in -2.0..2.0, length in 0.0..3.0, at in 0.0..1.0
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
        // v⁴ − 2v² turns at 0 and ±1.
        let (least, greatest) = extremes(&[0.0, 0.0, -2.0, 0.0, 1.0], (-0.5, 1.25));
        assert!((least + 1.0).abs() < 1e-15 && greatest == 0.0, "{least} {greatest}");
    }
}
