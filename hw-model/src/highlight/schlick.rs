//! Schlick's approximation x/(n − n·x + x), the baseline of every comparison.
//!
//! C. Schlick, "A fast alternative to Phong's specular model", Graphics Gems IV, 1994.

/// x/(n − n·x + x) for `x` in [0, 1] and `exponent` n ≥ 1, also for x so small that 1 − x is 1.
#[must_use]
pub fn schlick(exponent: f64, x: f64) -> f64 {
    x / denominator(exponent, 1.0 - x)
}

/// The same at x = 1 − s, s in [0, 1]: (1 − s)/(1 + (n − 1)·s).
///
/// Both terms of this denominator are positive, so nothing cancels close to s = 0, where
/// n − n·x + x is a small difference of numbers of size n.
#[must_use]
pub fn schlick_at_s(exponent: f64, s: f64) -> f64 {
    (1.0 - s) / denominator(exponent, s)
}

fn denominator(exponent: f64, s: f64) -> f64 {
    1.0 + (exponent - 1.0) * s
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_ends_and_the_first_exponent_are_exact() {
        assert_eq!((schlick(64.0, 0.0), schlick(64.0, 1.0)), (0.0, 1.0));
        assert_eq!((schlick(1.0, 0.375), schlick(1.0, 1e-20)), (0.375, 1e-20));
        // n = 2, x = 1/2: (1/2) / (2 − 1 + 1/2)
        assert!((schlick(2.0, 0.5) - 1.0 / 3.0).abs() < 1e-16);
    }

    proptest! {
        #[test]
        fn both_forms_agree_where_neither_cancels(n in 1.0_f64..1e3, x in 0.0_f64..0.9) {
            let printed = x / (n - n * x + x);
            prop_assert!((schlick(n, x) - printed).abs() <= 1e-14 * printed);
        }
    }
}
