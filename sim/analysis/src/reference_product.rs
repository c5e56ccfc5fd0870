//! x^n for a block of x and rising n, far more exact than an f64: the reference that exhaustive error
//! statistics of things as good as f64 `powf` are held against.
//!
//! From x^(n−1) = h + l to x^n, with x an f64 (every x of at most 52 fraction bits is one):
//!
//! ```text
//! h′ = h·x rounded          e = h·x − h′, exact (a fused multiply-add)
//! l′ = l·x + e, rounded once
//! ```
//!
//! **Error.** |e| ≤ 2⁻⁵³·h′, so after k steps |l| ≤ k·2⁻⁵³·x^k, and the only rounding that counts, that of
//! l′, adds k·2⁻¹⁰⁶·x^k. What is there is multiplied by x like the value itself, so after n steps the
//! relative error is at most n(n + 1)/2 · 2⁻¹⁰⁶: 2⁻⁹⁰ for n = 256, 2⁻⁸² for [`GREATEST`]. h is not
//! renormalised, and need not be: l stays small enough beside it.
//!
//! Below `VANISHED` both become 0, before a residual could underflow; that is an absolute error of the
//! size of that constant.
//!
//! An n that is no integer, or too great to walk to, is answered by the correctly rounded f64: l = 0, and
//! the error is half an ulp of it.

use hw_model::highlight::phong;
use multiversion::multiversion;

/// The greatest exponent that is reached by multiplying.
pub(crate) const GREATEST: f64 = 4096.0;

/// 2⁻⁵⁰⁰: powers below it are taken for 0.
const VANISHED: f64 = f64::from_bits((1023 - 500) << 52);

/// The powers of a block of x.
#[derive(Debug, Clone, Default)]
pub(crate) struct ReferenceProduct {
    xs: Vec<f64>,
    exponent: f64,
    high: Vec<f64>,
    low: Vec<f64>,
    /// What answers where there is no product, with its zeros.
    direct: (Vec<f64>, Vec<f64>),
}

impl ReferenceProduct {
    /// Begins with x^0 of these x, each in [0, 1].
    pub(crate) fn start(&mut self, xs: &[f64]) {
        self.xs.clear();
        self.xs.extend_from_slice(xs);
        self.exponent = 0.0;
        for (part, value) in [(&mut self.high, 1.0), (&mut self.low, 0.0)] {
            part.clear();
            part.resize(xs.len(), value);
        }
    }

    /// x^n of every x as h and l, whose sum it is. Exponents are asked for in rising order.
    pub(crate) fn at(&mut self, exponent: f64) -> (&[f64], &[f64]) {
        let reached = exponent.fract() == 0.0 && (self.exponent..=GREATEST).contains(&exponent);
        if !reached {
            let (high, low) = &mut self.direct;
            high.clear();
            high.extend(self.xs.iter().map(|&x| phong(exponent, x)));
            low.clear();
            low.resize(self.xs.len(), 0.0);
            return (high, low);
        }
        while self.exponent < exponent {
            step(&self.xs, &mut self.high, &mut self.low);
            self.exponent += 1.0;
        }
        (&self.high, &self.low)
    }
}

/// One more factor x. A fused multiply-add is exact by definition, so every version gives the same bits.
#[multiversion(targets("x86_64+avx2+fma", "x86_64+avx512f+avx512dq+avx512vl"))]
fn step(xs: &[f64], high: &mut [f64], low: &mut [f64]) {
    for ((&x, high), low) in xs.iter().zip(high).zip(low) {
        let product = *high * x;
        let residual = high.mul_add(x, -product);
        let rest = low.mul_add(x, residual);
        let there = product >= VANISHED;
        *high = if there { product } else { 0.0 };
        *low = if there { rest } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_model::highlight::ExactPower;
    use proptest::prelude::*;

    proptest! {
        /// h is within the product's bound of the exact ratio of integers, and l mends it: the error that
        /// is left of h + l is nothing in units of h's last place.
        #[test]
        fn it_is_the_power(k in 1_u64..=1 << 23, n in 1_u32..=300) {
            let x = k as f64 / (1_u64 << 23) as f64;
            let exact = ExactPower::new(k, 23, n).unwrap();
            prop_assume!(exact.to_f64() > 1e-140);
            let mut powers = ReferenceProduct::default();
            powers.start(&[x]);
            let (high, low) = powers.at(f64::from(n));
            // In ulps of the power: h is off by d, and l is −d.
            let off = exact.error_in_ulp(high[0]);
            let ulp = exact.to_f64().next_up() - exact.to_f64();
            prop_assert!(off.abs() <= f64::from(n));
            prop_assert!((off + low[0] / ulp).abs() <= 1e-9 * (1.0 + off.abs()), "{off} {}", low[0]);
        }
    }

    #[test]
    fn gaps_and_fractions_between_do_no_harm() {
        let xs = [0.0, 0.25, 0.999, 1.0];
        let mut powers = ReferenceProduct::default();
        powers.start(&xs);
        for n in [1.0, 2.5, 3.0, 64.0, 64.5, 5000.0] {
            let (high, low) = powers.at(n);
            for (index, &x) in xs.iter().enumerate() {
                let value = high[index] + low[index];
                assert!((value - phong(n, x)).abs() <= 1e-16 * value, "{x}^{n}");
            }
        }
    }
}
