//! The rational curve x/(a − b·x), a hyperbola through the origin: the tail of the composite method,
//! and Schlick's approximation.

/// x/(a − b·x).
///
/// At x = 1 − s the denominator is `at_one` + b·s. For large n, a and b are both of size n while
/// a − b stays of size 1, so the difference is kept as a number of its own instead of being computed
/// from the rounded a and b (which at n = 10⁹ would leave it six digits).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rational {
    /// a, the denominator at x = 0; of size n.
    pub a: f64,
    /// b, how fast the denominator falls with x; of size n, not negative.
    pub b: f64,
    /// a − b, the denominator at x = 1. Negative when the pole lies at x < 1, which for a tail
    /// fitted at q means between q and 1, outside the tail.
    pub at_one: f64,
}

impl Rational {
    /// Schlick's approximation for the exponent n ≥ 1: a = n, b = n − 1.
    #[must_use]
    pub fn schlick(exponent: f64) -> Self {
        Self { a: exponent, b: exponent - 1.0, at_one: 1.0 }
    }

    /// The value at x = 1 − s, s in [0, 1].
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64) -> f64 {
        (1.0 - s) / self.denominator(s)
    }

    /// The slope against s, −a/(a − b·x)² at x = 1 − s.
    #[must_use]
    pub fn slope_at_s(&self, s: f64) -> f64 {
        let denominator = self.denominator(s);
        -(self.a / denominator) / denominator
    }

    /// The value at x in [0, 1]. Above x = 1/2, 1 − x is exact and no digit is lost.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        x / self.denominator(1.0 - x)
    }

    #[inline]
    fn denominator(&self, s: f64) -> f64 {
        self.at_one + self.b * s
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::highlight::schlick_at_s;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn schlick_is_one_of_the_family(n in 1.0_f64..1e9, s in 0.0_f64..=1.0) {
            let (curve, direct) = (Rational::schlick(n), schlick_at_s(n, s));
            prop_assert_eq!(curve.value_at_s(s), direct);
        }

        #[test]
        fn the_slope_is_the_limit_of_differences(n in 1.0_f64..100.0, s in 0.01_f64..0.99) {
            let curve = Rational::schlick(n);
            let h = 1e-6;
            let difference = (curve.value_at_s(s + h) - curve.value_at_s(s - h)) / (2.0 * h);
            let slope = curve.slope_at_s(s);
            prop_assert!((difference - slope).abs() <= 1e-6 * slope.abs(), "{} {}", difference, slope);
        }
    }
}
