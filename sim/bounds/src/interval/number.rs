//! A set of reals between two f64, and what the four operations make of it.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All reals from `low` to `high`; the ends may be infinite, never NaN, and low ≤ high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Interval {
    /// Every real number: nothing is known.
    pub const UNKNOWN: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// The interval that holds 0 alone.
    pub const ZERO: Self = Self { low: 0.0, high: 0.0 };
    /// The interval that holds 1 alone.
    pub const ONE: Self = Self { low: 1.0, high: 1.0 };

    /// From 0 to 1.
    pub const UNIT: Self = Self { low: 0.0, high: 1.0 };

    /// From `low` to `high` as they are; [`UNKNOWN`](Self::UNKNOWN) unless low ≤ high.
    #[must_use]
    pub fn new(low: f64, high: f64) -> Self {
        if low <= high { Self { low, high } } else { Self::UNKNOWN }
    }

    /// One f64, exactly; an infinity or NaN is no number and gives [`UNKNOWN`](Self::UNKNOWN).
    #[must_use]
    pub fn exactly(value: f64) -> Self {
        if value.is_finite() { Self { low: value, high: value } } else { Self::UNKNOWN }
    }

    /// From the neighbour below `low` to the neighbour above `high`: what two correctly rounded results
    /// enclose.
    #[must_use]
    pub(super) fn outward(low: f64, high: f64) -> Self {
        Self::new(low.next_down(), high.next_up())
    }

    /// The lower end, which belongs to the interval.
    #[must_use]
    pub const fn low(self) -> f64 {
        self.low
    }

    /// The upper end, which belongs to the interval.
    #[must_use]
    pub const fn high(self) -> f64 {
        self.high
    }

    /// An f64 inside, near the middle.
    #[must_use]
    pub fn middle(self) -> f64 {
        let middle = self.low + 0.5 * (self.high - self.low);
        if middle.is_finite() { middle.clamp(self.low, self.high) } else { 0.0_f64.clamp(self.low, self.high) }
    }

    /// Does it hold `value`?
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The greatest magnitude in it.
    #[must_use]
    pub fn greatest_magnitude(self) -> f64 {
        self.high.max(-self.low)
    }

    /// The least magnitude in it: 0 where it holds 0.
    #[must_use]
    pub fn least_magnitude(self) -> f64 {
        self.low.max(-self.high).max(0.0)
    }

    /// The least interval that holds both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    /// The extremes of a product lie at ends of the factors. 0·∞ has no value: the NaN must not be lost
    /// in a minimum.
    fn mul(self, other: Self) -> Self {
        let [a, b] = [self.low * other.low, self.low * other.high];
        let [c, d] = [self.high * other.low, self.high * other.high];
        if [a, b, c, d].iter().any(|product| product.is_nan()) {
            return Self::UNKNOWN;
        }
        let Self { low, high } = Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
        // The step down from 0 must not cost the sign: a product of what is not negative is not negative.
        let signed = self.low < 0.0 || other.low < 0.0;
        Self { low: if signed { low } else { low.max(0.0) }, high }
    }
}

impl Div for Interval {
    type Output = Self;
    /// [`UNKNOWN`](Interval::UNKNOWN) where the divisor may be 0.
    fn div(self, other: Self) -> Self {
        if other.holds(0.0) {
            return Self::UNKNOWN;
        }
        let [a, b] = [self.low / other.low, self.low / other.high];
        let [c, d] = [self.high / other.low, self.high / other.high];
        if [a, b, c, d].iter().any(|quotient| quotient.is_nan()) {
            return Self::UNKNOWN;
        }
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}
