//! Real numbers of [`PRECISION`] bits beside f64, so that one expression can be evaluated in both.
//!
//! At n = 10¹⁵ an expression loses 50 bits in 1 − q, twice that where the loss is squared, and next to
//! an n at which a coefficient vanishes as much again: 200 bits at most. A test computes everything once more
//! with 256 bits added.

use std::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// Significant bits of a [`Wide`].
pub(super) const PRECISION: usize = 384;

/// What an expression asks of its numbers.
pub(super) trait Real:
    Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number an f64 is.
    fn of(value: f64) -> Self;
    fn exp(self) -> Self;
    fn exp_m1(self) -> Self;
    fn ln(self) -> Self;
    fn sqrt(self) -> Self;
    /// level^(1/n), as a program would ask for it; `log` is ln level.
    fn root_of(level: f64, log: &Self, n: &Self) -> Self;
}

/// Correctly rounded functions: what is lost is lost by the expression.
impl Real for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn exp(self) -> Self {
        core_math::exp(self)
    }
    fn exp_m1(self) -> Self {
        core_math::expm1(self)
    }
    fn ln(self) -> Self {
        core_math::log(self)
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    fn root_of(level: f64, _log: &Self, n: &Self) -> Self {
        core_math::pow(level, 1.0 / n)
    }
}

/// A number of `BITS` significant bits.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub(super) struct Wide<const BITS: usize = PRECISION>(FBig<HalfEven, 2>);

impl<const BITS: usize> Wide<BITS> {
    /// The f64 nearest to this number.
    pub(super) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    /// True when this is less than 2^−`bits` of `other`: a zero, but for the rounding of what made it.
    pub(super) fn vanishes_beside(&self, other: &Self, bits: i32) -> bool {
        let scaled = self.clone() * Self::of(f64::from(bits).exp2());
        scaled.0.clone() * scaled.0 < other.0.clone() * other.0.clone()
    }
}

impl<const BITS: usize> Real for Wide<BITS> {
    fn of(value: f64) -> Self {
        // Only an infinity or NaN is refused, and no expression is given one.
        let exact = FBig::try_from(value).unwrap_or(FBig::ZERO);
        Self(exact.with_precision(BITS).value())
    }
    fn exp(self) -> Self {
        Self(self.0.exp())
    }
    fn exp_m1(self) -> Self {
        Self(self.0.exp_m1())
    }
    fn ln(self) -> Self {
        Self(self.0.ln())
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn root_of(_level: f64, log: &Self, n: &Self) -> Self {
        (log.clone() / n.clone()).exp()
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<const BITS: usize> $operator for Wide<BITS> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<const BITS: usize> Neg for Wide<BITS> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}
