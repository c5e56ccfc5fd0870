//! What a method arrives at: a function of x that approximates x^n.

use super::crossing::Crossing;
use crate::highlight::{Cubic, Rational};

/// The approximation of x^n by one method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Where the epicentre begins: x = q = Q^(1/n), s = p = 1 − q.
    pub epicentre: Crossing,
    /// The function of x that approximates x^n.
    pub curve: Curve,
}

/// The function of x a method arrives at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// One cubic for all x (for the parabola, k3 = a = 0).
    Cubic(Cubic),
    /// One hyperbola for all x.
    Rational(Rational),
    /// A cubic on the epicentre, a hyperbola below it.
    Composite {
        /// For x ≥ q.
        epicentre: Cubic,
        /// For x < q.
        tail: Rational,
    },
}

impl Fit {
    /// The approximation at x = 1 − s, s in [0, 1], without any clamp.
    #[must_use]
    pub fn value_at_s(&self, s: f64) -> f64 {
        match &self.curve {
            Curve::Cubic(cubic) => cubic.centred.value_at_s(s),
            Curve::Rational(rational) => rational.value_at_s(s),
            Curve::Composite { epicentre, .. } if s <= self.epicentre.s => epicentre.centred.value_at_s(s),
            Curve::Composite { tail, .. } => tail.value_at_s(s),
        }
    }

    /// Its slope against s (the slope against x is the negative of it).
    #[must_use]
    pub fn slope_at_s(&self, s: f64) -> f64 {
        match &self.curve {
            Curve::Cubic(cubic) => cubic.centred.slope_at_s(s),
            Curve::Rational(rational) => rational.slope_at_s(s),
            Curve::Composite { epicentre, .. } if s <= self.epicentre.s => epicentre.centred.slope_at_s(s),
            Curve::Composite { tail, .. } => tail.slope_at_s(s),
        }
    }

    /// The approximation at x in [0, 1]. A hyperbola keeps its digits also for x so small that 1 − x is 1.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        match &self.curve {
            Curve::Rational(rational) => rational.value(x),
            Curve::Composite { tail, .. } if x < self.epicentre.x => tail.value(x),
            Curve::Cubic(_) | Curve::Composite { .. } => self.value_at_s(1.0 - x),
        }
    }

    /// The cubic, where the method has one.
    #[must_use]
    pub const fn cubic(&self) -> Option<&Cubic> {
        match &self.curve {
            Curve::Cubic(cubic) | Curve::Composite { epicentre: cubic, .. } => Some(cubic),
            Curve::Rational(_) => None,
        }
    }

    /// The hyperbola, where the method has one.
    #[must_use]
    pub const fn rational(&self) -> Option<&Rational> {
        match &self.curve {
            Curve::Rational(rational) | Curve::Composite { tail: rational, .. } => Some(rational),
            Curve::Cubic(_) => None,
        }
    }
}
