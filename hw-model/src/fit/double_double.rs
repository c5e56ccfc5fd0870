//! Numbers of about 106 bits, the unevaluated sum of two f64.
//!
//! Why: a fit subtracts numbers that agree in many digits. With n = 1 + 10⁻⁷ the Hermite coefficients
//! are 10⁻⁷ of the terms they are made of, and plain f64 leaves them nine digits; with Q = 1 − 10⁻⁶ the
//! second divided difference keeps ten. Here every such loss comes out of 32 digits.
//!
//! Algorithms and error bounds (u = 2⁻⁵³, barring overflow and underflow): Joldes, Muller, Popescu,
//! "Tight and rigorous error bounds for basic building blocks of double-word arithmetic", 2017.
//! Addition 3u², multiplication 5u², division 10u². `exp_m1` and `ln` are below, with their argument.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// hi + lo, |lo| ≤ ½ ulp(hi).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// a + b exactly, for any a and b (Knuth).
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let b_part = hi - a;
    let lo = (a - (hi - b_part)) + (b - b_part);
    DoubleDouble { hi, lo }
}

/// a + b exactly, for |a| ≥ |b| or a = 0 (Dekker).
fn fast_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

/// a·b exactly: a fused multiply-add rounds once, and the error of a product is an f64.
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    DoubleDouble { hi, lo: a.mul_add(b, -hi) }
}

impl DoubleDouble {
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    /// The nearest f64: all but the low 53 bits.
    pub const fn to_f64(self) -> f64 {
        self.hi
    }

    /// The natural logarithm of a normal f64.
    ///
    /// One Newton step on y ↦ x·e^−y: with y₀ the f64 logarithm, ln x = y₀ + ln(1 + r), where
    /// r = x·e^−y₀ − 1 = (x − 1) + x·expm1(−y₀). As y₀ is correctly rounded, |r| ≤ 2⁻⁵³·|y₀|, and r alone
    /// is ln(1 + r) but for r²/2: 2⁻¹⁰⁷·|y₀| of the result, at most 2⁻⁹⁷. Written in the second way, r
    /// keeps the result accurate relative to itself for x → 1.
    pub fn ln(x: f64) -> Self {
        let guess = Self::from(core_math::log(x));
        guess + (two_sum(x, -1.0) + (-guess).exp_m1() * Self::from(x))
    }

    /// ln(1 − s) for 0 ≤ s < 1: the same Newton step, with r = (1 − s)·e^−y₀ − 1 = expm1(−y₀) − s·e^−y₀, of
    /// which both terms are of size s/(1 − s); absolute error 2⁻⁹²·s/(1 − s).
    pub fn ln_one_minus(s: Self) -> Self {
        let guess = Self::from(core_math::log1p(-s.hi));
        let grown = (-guess).exp_m1();
        guess + (grown - s * (Self::ONE + grown))
    }

    /// e^self − 1 for −700 ≤ self ≤ 700, with a relative error of at most 2⁻⁹⁴.
    ///
    /// The argument is halved until it is at most 2⁻⁷, where twelve Taylor terms leave 2⁻¹¹⁷; then
    /// e^2t − 1 = (e^t − 1)·(2 + (e^t − 1)) undoes each halving. No step subtracts for t > 0, and for
    /// t < 0 the sum 2 + (e^t − 1) stays above 1, so the relative error of the result is never more
    /// than max(1, |self|) times what the (at most 17) steps add up to.
    pub fn exp_m1(self) -> Self {
        let mut scale = 1.0;
        let mut halvings = 0;
        while (self.hi * scale).abs() > 1.0 / 128.0 {
            scale *= 0.5;
            halvings += 1;
        }
        let t = Self { hi: self.hi * scale, lo: self.lo * scale };
        // t·(1 + t/2·(1 + t/3·(1 + …)))
        let mut series = Self::ONE;
        for term in (2..=12).rev() {
            series = Self::ONE + t * series / Self::from(f64::from(term));
        }
        let mut result = t * series;
        for _ in 0..halvings {
            result = result * (Self::from(2.0) + result);
        }
        result
    }

    /// e^self for −700 ≤ self ≤ 700; relative error as for [`exp_m1`](Self::exp_m1).
    ///
    /// A negative argument goes through the reciprocal, since 1 + expm1 would cancel.
    pub fn exp(self) -> Self {
        if self.hi < 0.0 { Self::ONE / (Self::ONE + (-self).exp_m1()) } else { Self::ONE + self.exp_m1() }
    }
}

impl From<f64> for DoubleDouble {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// `AccurateDWPlusDW`: relative error 3u² even when the operands cancel.
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.hi, other.hi);
        let low = two_sum(self.lo, other.lo);
        let sum = fast_two_sum(high.hi, high.lo + low.hi);
        fast_two_sum(sum.hi, low.lo + sum.lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    /// The product, by algorithm `DWTimesDW2` of the paper named above.
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.hi, other.hi);
        let cross = self.hi.mul_add(other.lo, self.lo * other.hi);
        fast_two_sum(product.hi, product.lo + cross)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// `DWDivDW2`: an f64 quotient, and what its exact remainder adds.
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let remainder = self - other * Self::from(quotient);
        fast_two_sum(quotient, remainder.hi / other.hi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// a as a multiple of b, minus one, in units of u² = 2⁻¹⁰⁶.
    fn error(a: DoubleDouble, b: DoubleDouble) -> f64 {
        ((a - b) / b).to_f64() * 2.0_f64.powi(106)
    }

    fn sum(hi: f64, lo: f64) -> DoubleDouble {
        DoubleDouble { hi, lo }
    }

    // Both halves by mpmath at 60 digits, at the f64 arguments.
    #[test]
    fn functions_against_sixty_digits() {
        let ln_2 = sum(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
        assert!(error(-DoubleDouble::ln(0.5), ln_2).abs() < 100.0);
        assert!(error(DoubleDouble::ln(4.0), ln_2 + ln_2).abs() < 100.0);
        let e = sum(std::f64::consts::E, 1.445_646_891_729_250_2e-16);
        assert!(error(DoubleDouble::ONE.exp(), e).abs() < 100.0);
        assert!(error((-DoubleDouble::ONE).exp() * e, DoubleDouble::ONE).abs() < 100.0);
    }

    proptest! {
        #[test]
        fn logarithm_and_exponential_undo_each_other(magnitude in 1e-300_f64..1.0, near in 1e-16_f64..0.5) {
            for x in [magnitude, near, 1.0 - near, core_math::exp(magnitude * -600.0)] {
                let back = DoubleDouble::ln(x).exp();
                // ln's relative error times |ln x|
                prop_assert!(error(back, DoubleDouble::from(x)).abs() < 1e5, "{:e}", x);
            }
            let small = DoubleDouble::ln(1.0 - near).exp_m1();
            let exact = two_sum(1.0 - near, -1.0);
            prop_assert!(error(small, exact).abs() < 1e3, "{:e} {}", near, error(small, exact));
        }

        #[test]
        fn the_exponential_turns_sums_into_products(a in -300.0_f64..300.0, b in -300.0_f64..300.0) {
            let product = DoubleDouble::from(a).exp() * DoubleDouble::from(b).exp();
            let together = two_sum(a, b).exp();
            prop_assert!(error(product, together).abs() < 1e5);
        }

        #[test]
        fn division_undoes_multiplication(a in 1e-9_f64..1e9, b in 1e-9_f64..1e9, c in 0.0_f64..1e-9) {
            let (a, b) = (two_sum(a, a * c * 1e-7), two_sum(b, -b * c * 1e-8));
            prop_assert!(error(a * b / b, a).abs() < 20.0);
            prop_assert!(error((a + b) - b, a).abs() < 6.0 * (b.hi / a.hi).max(1.0));
        }
    }
}
