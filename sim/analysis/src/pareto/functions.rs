//! The functions of x, each with the constants of one exponent: what is computed for one sample.
//!
//! Plain multiplications, additions and divisions in f32 or f64, nothing fused and nothing reordered, so
//! that each gives the same bits on every machine; `powf` is the platform's.

use hw_model::fit::minimax::Fitted;
use hw_model::highlight::{Cubic, Rational, Segment};
use hw_model::registers::MAX_DEGREE;
use num_traits::Float;

/// A type of floating-point numbers, f32 or f64, in which methods are computed.
pub trait Real: Float + Send + Sync + 'static {
    /// The bits that one number takes in a table.
    const BITS: u32;
    /// The number of this type nearest to an f64.
    fn nearest(value: f64) -> Self;
    /// The same number as an f64.
    fn wide(self) -> f64;
    /// Its integer part, not negative.
    fn whole(self) -> u32;
}

macro_rules! real {
    ($real:ty, $bits:literal) => {
        impl Real for $real {
            const BITS: u32 = $bits;
            #[inline(always)]
            fn nearest(value: f64) -> Self {
                value as $real
            }
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn whole(self) -> u32 {
                self as u32
            }
        }
    };
}
real!(f32, 32);
real!(f64, 64);

/// A function of x with its constants.
pub(crate) trait ContenderRow<T> {
    fn at(&self, x: T) -> T;
}

/// 1 − s·(k1 − s·(k2 − s·k3)), s = 1 − x, and not less than 0; 0 for s above `cut`.
#[derive(Debug, Clone, Copy)]
pub struct CubicRow<T> {
    k: [T; 3],
    cut: T,
}

impl<T: Real> CubicRow<T> {
    pub(super) fn new(cubic: &Cubic, cut: f64) -> Self {
        Self::of_segment(&cubic.segment(), cut)
    }

    /// A cubic that counts from s = 0, with the value 1 there.
    fn of_segment(segment: &Segment, cut: f64) -> Self {
        let [_, k1, k2, k3, _] = segment.c;
        Self { k: [k1, k2, k3].map(T::nearest), cut: T::nearest(cut) }
    }

    /// Down to the cubic's minimum below the epicentre, or to x = 0 where it has none.
    pub(super) fn to_its_minimum(cubic: &Cubic, epicentre: f64) -> Self {
        let minimum = cubic.centred.first_minimum().unwrap_or(1.0);
        Self::new(cubic, minimum.clamp(epicentre, 1.0))
    }

    #[inline(always)]
    fn polynomial(&self, s: T) -> T {
        let [k1, k2, k3] = self.k;
        let value = T::one() - s * (k1 - s * (k2 - s * k3));
        if value > T::zero() { value } else { T::zero() }
    }
}

impl<T: Real> ContenderRow<T> for CubicRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        let s = T::one() - x;
        let value = self.polynomial(s);
        if s <= self.cut { value } else { T::zero() }
    }
}

/// x/(a − b + b·s), and 1 where that would be more (`rational` above its epicentre).
#[derive(Debug, Clone, Copy)]
pub struct RationalRow<T> {
    at_one: T,
    b: T,
}

impl<T: Real> RationalRow<T> {
    pub(super) fn new(rational: &Rational) -> Self {
        Self::of(T::nearest(rational.at_one), T::nearest(rational.b))
    }

    pub(crate) const fn of(at_one: T, b: T) -> Self {
        Self { at_one, b }
    }
}

impl<T: Real> ContenderRow<T> for RationalRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        let denominator = self.at_one + self.b * (T::one() - x);
        let value = x / denominator;
        if denominator > x { value } else { T::one() }
    }
}

/// The cubic down to its cut, the ratio below.
#[derive(Debug, Clone, Copy)]
pub struct CompositeRow<T> {
    pub(super) epicentre: CubicRow<T>,
    pub(super) tail: RationalRow<T>,
}

impl<T: Real> ContenderRow<T> for CompositeRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        let s = T::one() - x;
        let (above, below) = (self.epicentre.polynomial(s), self.tail.at(x));
        if s <= self.epicentre.cut { above } else { below }
    }
}

/// A cubic from the highlight down, another below it, neither less than 0; 0 below both.
#[derive(Debug, Clone, Copy)]
pub struct SegmentsRow<T> {
    first: CubicRow<T>,
    start: T,
    c: [T; 4],
    end: T,
}

impl<T: Real> SegmentsRow<T> {
    /// Two segments, of which the second may be missing: then the first is x^n itself.
    pub(super) fn new(fitted: &Fitted) -> Self {
        let nothing = Segment { start: 0.0, c: [0.0; MAX_DEGREE + 1] };
        let first = fitted.segments.first().unwrap_or(&nothing);
        let second = fitted.segments.get(1).unwrap_or(&nothing);
        let [c0, c1, c2, c3, _] = second.c;
        let end = |place: usize| fitted.ends.get(place).or(fitted.ends.last()).map_or(1.0, |&s| s);
        Self {
            first: CubicRow::of_segment(first, end(0)),
            start: T::nearest(second.start),
            c: [c0, c1, c2, c3].map(T::nearest),
            end: T::nearest(end(1)),
        }
    }
}

impl<T: Real> ContenderRow<T> for SegmentsRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        let s = T::one() - x;
        let [c0, c1, c2, c3] = self.c;
        let v = s - self.start;
        let second = c0 - v * (c1 - v * (c2 - v * c3));
        let second = if second > T::zero() { second } else { T::zero() };
        // Both are computed and one is chosen, so that no branch keeps samples apart.
        let first = self.first.polynomial(s);
        let below = if s <= self.end { second } else { T::zero() };
        if s <= self.first.cut { first } else { below }
    }
}

/// n, for x/(n − n·x + x) as Schlick printed it.
#[derive(Debug, Clone, Copy)]
pub struct SchlickRow<T>(pub(super) T);

impl<T: Real> ContenderRow<T> for SchlickRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        x / (self.0 - self.0 * x + x)
    }
}

/// n, for the platform's `powf`.
#[derive(Debug, Clone, Copy)]
pub struct PowfRow<T>(pub(super) T);

impl<T: Real> ContenderRow<T> for PowfRow<T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        x.powf(self.0)
    }
}

/// Straight lines between the values of one exponent.
pub(super) struct LinearRow<'a, T>(pub(super) &'a [T]);

impl<T: Real> ContenderRow<T> for LinearRow<'_, T> {
    #[inline(always)]
    fn at(&self, x: T) -> T {
        let Some(last) = self.0.len().checked_sub(2) else { return T::zero() };
        let place = x * T::nearest((last + 1) as f64);
        let index = place.whole().min(last as u32);
        let (low, high) = (self.0[index as usize], self.0[index as usize + 1]);
        low + (place - T::nearest(f64::from(index))) * (high - low)
    }
}
