//! The reference x^n in f64, correctly rounded.

/// x^n, correctly rounded (error at most half an ulp of the result).
///
/// `x` in [0, 1], `exponent` ≥ 1. The platform's own `pow` is not correctly rounded and differs
/// between platforms; a reference must do neither.
#[must_use]
pub fn phong(exponent: f64, x: f64) -> f64 {
    core_math::pow(x, exponent)
}

/// (1 − s)^n for s in [0, 1], also where 1 − s is not an f64.
///
/// 1 − s = x + δ with x the nearest f64 and δ known exactly, and (x + δ)^n = x^n · (1 + δ/x)^n.
/// The first factor is correctly rounded. |δ| ≤ 2⁻⁵⁴, so for n ≤ 10¹⁵ the exponent n·ln(1 + δ/x) of
/// the second is small wherever the first has not vanished, and its rounding costs little: the
/// relative error is at most 4·2⁻⁵³. (The plain exp(n·ln(1 − s)) multiplies the error of the
/// logarithm by |ln x^n|, up to 745.)
#[must_use]
pub fn phong_at_s(exponent: f64, s: f64) -> f64 {
    let x = 1.0 - s;
    let delta = (1.0 - x) - s;
    let power = phong(exponent, x);
    if delta == 0.0 || x == 0.0 {
        return power;
    }
    power * core_math::exp(exponent * core_math::log1p(delta / x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_exact() {
        for n in [1.0, 2.5, 64.0, 1e15] {
            assert_eq!((phong(n, 0.0), phong(n, 1.0)), (0.0, 1.0));
            assert_eq!((phong_at_s(n, 1.0), phong_at_s(n, 0.0)), (0.0, 1.0));
        }
    }

    // 40-digit values of (1 − s)^n at the f64 s, computed with mpmath.
    #[test]
    fn close_to_one_no_digit_is_lost() {
        for (n, s, expected) in [
            (1e9, 6.93147180559945e-10, 0.499_999_999_879_886_9),
            (1e15, 1e-15, 0.367_879_441_171_442_1),
            (64.0, 0.1, 0.001_179_018_457_773_857_9),
            (2.5, 0.75, 0.031_25),
        ] {
            let got = phong_at_s(n, s);
            let error = (got / expected - 1.0).abs();
            assert!(error <= 5e-16, "n = {n}, s = {s}: {got:e} is off by {error:e}");
        }
    }
}
