//! exp, expm1, ln, and two functions that take the place of divisions by numbers that tend to 0.
//!
//! ```text
//! φ(t) = (1 − e^−t)/t          = ∫₀¹ e^−tu du      = Σ (−t)^k/(k + 1)!        φ(0) = 1
//! ψ(t) = (1 − (1 + t)·e^−t)/t² = ∫₀¹ u·e^−tu du    = Σ (−t)^k/(k!·(k + 2))    ψ(0) = 1/2
//! φ′ = −ψ
//! ```
//!
//! By the integrals both are positive and fall for all t. So the image of an interval needs their values
//! at its ends only, and there is no removable singularity left at 0.

use super::number::Interval;

/// Where the series of ψ gives way to its formula, which cancels for small t.
const SERIES: f64 = 1.0;

/// Terms of the series of ψ: for t ≤ 1 they fall and alternate, and the first one left out,
/// 1/(20!·22) = 2·10⁻²⁰, bounds the rest.
const TERMS: i32 = 20;

impl Interval {
    /// e to the power of every number in it.
    #[must_use]
    pub fn exp(self) -> Self {
        // e^t is positive, which a step down from 0 forgets.
        let Self { low, high } = Self::outward(core_math::exp(self.low), core_math::exp(self.high));
        Self::new(low.max(0.0), high)
    }

    /// Encloses e^t − 1 for every t in the interval.
    #[must_use]
    pub fn expm1(self) -> Self {
        let Self { low, high } = Self::outward(core_math::expm1(self.low), core_math::expm1(self.high));
        Self::new(low.max(-1.0), high)
    }

    /// The square root of what is not negative in it; [`UNKNOWN`](Self::UNKNOWN) where all of it is. IEEE 754 rounds
    /// square roots correctly.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.high < 0.0 {
            return Self::UNKNOWN;
        }
        let Self { low, high } = Self::outward(self.low.max(0.0).sqrt(), self.high.sqrt());
        Self::new(low.max(0.0), high)
    }

    /// The square of every number in it: never negative, which a product of two does not know.
    #[must_use]
    pub fn square(self) -> Self {
        let (least, greatest) = (self.least_magnitude(), self.greatest_magnitude());
        let Self { low, high } = Self::outward(least * least, greatest * greatest);
        Self::new(low.max(0.0), high)
    }

    /// What of it lies from `low` to `high`; none where nothing does.
    #[must_use]
    pub fn within(self, low: f64, high: f64) -> Option<Self> {
        let (low, high) = (self.low.max(low), self.high.min(high));
        (low <= high).then_some(Self { low, high })
    }

    /// The natural logarithm; [`UNKNOWN`](Self::UNKNOWN) unless every number in it is positive.
    #[must_use]
    pub fn ln(self) -> Self {
        if self.low <= 0.0 {
            return Self::UNKNOWN;
        }
        Self::outward(core_math::log(self.low), core_math::log(self.high))
    }

    /// φ(t) for t ≥ 0; [`UNKNOWN`](Self::UNKNOWN) where t may be negative.
    #[must_use]
    pub fn phi(self) -> Self {
        self.falling(phi_at, 1.0)
    }

    /// ψ(t) for t ≥ 0; [`UNKNOWN`](Self::UNKNOWN) where t may be negative.
    #[must_use]
    pub fn psi(self) -> Self {
        self.falling(psi_at, 0.5)
    }

    /// The image under a function that falls from `greatest` at 0 towards 0, by its values at the ends.
    fn falling(self, at: fn(f64) -> Self, greatest: f64) -> Self {
        if self.low < 0.0 {
            return Self::UNKNOWN;
        }
        let high = at(self.low).high;
        let low = if self.high == self.low { at(self.low).low } else { at(self.high).low };
        Self::new(low.max(0.0), high.min(greatest))
    }
}

/// Where two terms of the series of φ do: the next one, t²/6, is below a quarter of the step from a number
/// below 1 to its neighbour.
const TWO_TERMS: f64 = 1.0 / 134_217_728.0;

/// φ at one t ≥ 0. Above [`TWO_TERMS`] expm1 is a normal number, relatively accurate, and so is the quotient.
fn phi_at(t: f64) -> Interval {
    if t <= TWO_TERMS {
        let sum = 1.0 - 0.5 * t;
        if t == 0.0 { Interval::ONE } else { Interval::outward(sum, sum) }
    } else if t == f64::INFINITY {
        Interval::new(0.0, 1.0)
    } else {
        -(-Interval::exactly(t)).expm1() / Interval::exactly(t)
    }
}

/// ψ at one t ≥ 0.
fn psi_at(t: f64) -> Interval {
    let t = Interval::exactly(t);
    if t.high > SERIES {
        let rest = Interval::ONE - (Interval::ONE + t) * (-t).exp();
        // Twice, as t² may overflow.
        return rest / t / t;
    }
    // Horner: term k is term k − 1 times −t/k, over k + 2 in the place of k + 1.
    let mut sum = Interval::ZERO;
    for k in (1..TERMS).rev() {
        let weight = Interval::ONE / Interval::exactly(f64::from(k + 2));
        sum = -t / Interval::exactly(f64::from(k)) * (weight + sum);
    }
    let rest = 1e-19;
    Interval::exactly(0.5) + sum + Interval::new(-rest, rest)
}
