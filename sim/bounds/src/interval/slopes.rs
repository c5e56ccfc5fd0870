//! Values with their slopes: forward differentiation, in intervals.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Interval;

/// What a formula is written for once: an interval, or an interval with its slopes.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + From<Interval>
{
    /// e to the power of this number.
    fn exp(self) -> Self;
    /// e to the power of this number, less 1.
    fn expm1(self) -> Self;
    /// (1 − e^−self)/self, 1 at 0.
    fn phi(self) -> Self;
    /// An f64, exactly.
    fn exactly(value: f64) -> Self {
        Self::from(Interval::exactly(value))
    }
}

impl Real for Interval {
    fn exp(self) -> Self {
        self.exp()
    }
    fn expm1(self) -> Self {
        self.expm1()
    }
    fn phi(self) -> Self {
        self.phi()
    }
}

/// A function of K variables over a box: its range, and the range of each partial derivative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes<const K: usize> {
    /// The interval of the function's values.
    pub value: Interval,
    /// The intervals of its derivatives, one for each variable.
    pub slopes: [Interval; K],
}

impl<const K: usize> Slopes<K> {
    /// The variable of this index.
    #[must_use]
    pub fn variable(index: usize, value: Interval) -> Self {
        let slope = |i| if i == index { Interval::ONE } else { Interval::ZERO };
        Self { value, slopes: std::array::from_fn(slope) }
    }

    /// f(self), where f′(self) is `slope`.
    fn chain(self, value: Interval, slope: Interval) -> Self {
        Self { value, slopes: self.slopes.map(|inner| times(slope, inner)) }
    }
}

/// A product that is exactly 0 where a factor is, as the slope of a constant. What is unknown may not
/// even exist (at a pole), and stays unknown.
fn times(a: Interval, b: Interval) -> Interval {
    let zero = a == Interval::ZERO || b == Interval::ZERO;
    if zero && a != Interval::UNKNOWN && b != Interval::UNKNOWN { Interval::ZERO } else { a * b }
}

/// A sum that is exact where a term is 0.
fn plus(a: Interval, b: Interval) -> Interval {
    if a == Interval::ZERO {
        b
    } else if b == Interval::ZERO {
        a
    } else {
        a + b
    }
}

impl<const K: usize> From<Interval> for Slopes<K> {
    fn from(value: Interval) -> Self {
        Self { value, slopes: [Interval::ZERO; K] }
    }
}

impl<const K: usize> Neg for Slopes<K> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slopes: self.slopes.map(|slope| -slope) }
    }
}

impl<const K: usize> Add for Slopes<K> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let slope = |i: usize| plus(self.slopes[i], other.slopes[i]);
        Self { value: self.value + other.value, slopes: std::array::from_fn(slope) }
    }
}

impl<const K: usize> Sub for Slopes<K> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const K: usize> Mul for Slopes<K> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = |i: usize| plus(times(self.slopes[i], other.value), times(self.value, other.slopes[i]));
        Self { value: self.value * other.value, slopes: std::array::from_fn(slope) }
    }
}

impl<const K: usize> Div for Slopes<K> {
    type Output = Self;
    /// (a/b)′ = (a′ − (a/b)·b′)/b. Where b may be 0 nothing is known, of the slopes neither.
    fn div(self, other: Self) -> Self {
        if other.value.holds(0.0) {
            return Self { value: Interval::UNKNOWN, slopes: [Interval::UNKNOWN; K] };
        }
        let value = self.value / other.value;
        let slope = |i: usize| {
            let numerator = plus(self.slopes[i], -times(value, other.slopes[i]));
            if numerator == Interval::ZERO { numerator } else { numerator / other.value }
        };
        Self { value, slopes: std::array::from_fn(slope) }
    }
}

impl<const K: usize> Real for Slopes<K> {
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, value)
    }
    fn expm1(self) -> Self {
        self.chain(self.value.expm1(), self.value.exp())
    }
    fn phi(self) -> Self {
        self.chain(self.value.phi(), -self.value.psi())
    }
}
