//! The error of a method as a function that can be bounded over a box of (h, σ) and at a point.
//!
//! Over a box, the mean value theorem: e lies within e(c) + e′(box)·(box − c), and within the plain
//! interval evaluation, of which the smaller bound counts. For boxes of width w the first is off by order
//! w² only. c is the middle in σ and the lower end in h: where the error falls with h, as it does near
//! h = 0, that end is where it is greatest, and nothing is lost by h at all.

use hw_model::fit::{FitError, Levels, Method, fit};

use super::claim::{Measure, Stretch};
use super::curve::{Curve, Logs, reciprocal};
use super::partition::{Axis, Cell};
use crate::interval::{Interval, Real, Slopes};

/// e(h, σ) over a range of h (one exponent, or all of them).
pub(super) trait ErrorFunction: Sync {
    /// A range that holds every h in question.
    fn h(&self) -> Interval;

    /// The range of σ that the region has.
    fn span(&self) -> Span;

    /// Not less than |e| anywhere in the box; and the axis to halve it in where that is too much.
    fn greatest(&self, cell: Cell) -> (f64, Axis);

    /// Not more than |e| at a point. h is the exponent's own where there is only one exponent.
    fn least_at(&self, h: f64, sigma: f64) -> f64;

    /// Not less than |e| for all σ ≥ far; infinite where that cannot be said.
    fn beyond(&self, far: f64) -> f64;
}

/// The σ of a region, whose ends are real numbers that no f64 hits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// A range that holds all of them, for what is to hold everywhere; infinite for a tail.
    pub outer: Interval,
    /// A range that is within them, for a witness.
    pub inner: Interval,
}

impl Span {
    fn of(region: Stretch, logs: &Logs) -> Self {
        let range = |low, high| Interval::new(low, high);
        match region {
            Stretch::Epicentre => Self { outer: range(0.0, logs.l.high()), inner: range(0.0, logs.l.low()) },
            Stretch::Tail => Self { outer: range(logs.l.low(), f64::INFINITY), inner: range(logs.l.high(), f64::MAX) },
        }
    }

    /// The box that a partition divides: up to `far` for a tail.
    #[must_use]
    pub(super) fn root(self, h: Interval, far: Option<f64>) -> Cell {
        let high = far.unwrap_or(self.outer.high());
        Cell { h, sigma: Interval::new(self.outer.low(), high) }
    }
}

/// e = f − x^n, or f/x^n − 1.
fn error<R: Real>(measure: Measure, curve: &Curve<R>, sigma: R) -> R {
    match measure {
        Measure::Absolute => curve.value(sigma) - (-sigma).exp(),
        Measure::Relative => curve.value(sigma) * sigma.exp() - R::exactly(1.0),
    }
}

/// The error of one exponent.
#[derive(Debug, Clone)]
pub(super) struct OneExponent {
    region: Stretch,
    measure: Measure,
    logs: Logs,
    h: Interval,
    curve: Curve<Interval>,
    sloped: Curve<Slopes<1>>,
}

impl OneExponent {
    /// The error of `method` at n ≥ 1.
    ///
    /// # Errors
    /// When n is out of range.
    pub(super) fn new(
        method: Method,
        n: f64,
        region: Stretch,
        measure: Measure,
        levels: Levels,
    ) -> Result<Self, FitError> {
        let (logs, h) = (Logs::new(levels), reciprocal(n));
        let fitted = fit(method, n, levels)?;
        let (curve, sloped) = match fitted.cubic() {
            Some(cubic) if method == Method::Minimax => {
                (Curve::of_coefficients(&cubic.centred, h), Curve::of_coefficients(&cubic.centred, Slopes::from(h)))
            }
            _ => (Curve::new(method, region, &logs, h), Curve::new(method, region, &logs, Slopes::from(h))),
        };
        Ok(Self { region, measure, logs, h, curve, sloped })
    }
}

impl ErrorFunction for OneExponent {
    fn h(&self) -> Interval {
        self.h
    }

    fn span(&self) -> Span {
        Span::of(self.region, &self.logs)
    }

    fn greatest(&self, cell: Cell) -> (f64, Axis) {
        let middle = Interval::exactly(cell.sigma.middle());
        let over = error(self.measure, &self.sloped, Slopes::variable(0, cell.sigma));
        let centre = error(self.measure, &self.curve, middle);
        let mean = centre + over.slopes[0] * (cell.sigma - middle);
        (mean.greatest_magnitude().min(over.value.greatest_magnitude()), Axis::Sigma)
    }

    fn least_at(&self, _: f64, sigma: f64) -> f64 {
        error(self.measure, &self.curve, Interval::exactly(sigma)).least_magnitude()
    }

    /// On a tail both f, a hyperbola, and x^n fall to 0 with growing σ, so that |f − x^n| is at most the
    /// greater of them at `far`. f falls where its denominator is positive, which grows with σ. f/x^n has
    /// no bound.
    fn beyond(&self, far: f64) -> f64 {
        if self.region != Stretch::Tail || self.measure != Measure::Absolute {
            return f64::INFINITY;
        }
        let sigma = Interval::exactly(far);
        // The numerator is positive: so is the denominator, where the quotient is.
        let curve = self.curve.value(sigma);
        if curve.low() > 0.0 { curve.high().max((-sigma).exp().high()) } else { f64::INFINITY }
    }
}

/// The error of every exponent n ≥ 1 at once, h = 1/n from 1 down to the limit 0, on the epicentre.
#[derive(Debug, Clone)]
pub(super) struct EveryExponent {
    method: Method,
    measure: Measure,
    logs: Logs,
}

impl EveryExponent {
    /// The error of `method`.
    #[must_use]
    pub(super) fn new(method: Method, measure: Measure, levels: Levels) -> Self {
        Self { method, measure, logs: Logs::new(levels) }
    }

    fn at<R: Real>(&self, h: R, sigma: R) -> R {
        error(self.measure, &Curve::new(self.method, Stretch::Epicentre, &self.logs, h), sigma)
    }
}

impl ErrorFunction for EveryExponent {
    fn h(&self) -> Interval {
        Interval::new(0.0, 1.0)
    }

    fn span(&self) -> Span {
        Span::of(Stretch::Epicentre, &self.logs)
    }

    fn greatest(&self, cell: Cell) -> (f64, Axis) {
        let middle = Interval::exactly(cell.sigma.middle());
        let low = Interval::exactly(cell.h.low());
        let over: Slopes<2> = self.at(Slopes::variable(0, cell.h), Slopes::variable(1, cell.sigma));
        let [h_slope, sigma_slope] = over.slopes;
        let h_part = h_slope * Interval::new(0.0, (cell.h.high() - cell.h.low()).next_up());
        let sigma_part = sigma_slope * (cell.sigma - middle);
        let mean = self.at(low, middle) + h_part + sigma_part;
        let greatest = mean.greatest_magnitude().min(over.value.greatest_magnitude());
        // What each axis adds on the side where the bound is greater; a fall with h adds nothing.
        let side = if mean.high() >= -mean.low() { Interval::high } else { |i: Interval| -i.low() };
        let axis = if side(h_part) > side(sigma_part) { Axis::H } else { Axis::Sigma };
        (greatest, axis)
    }

    /// The supremum over h > 0 is the maximum over h ≥ 0, as the error is continuous down to h = 0.
    fn least_at(&self, h: f64, sigma: f64) -> f64 {
        self.at(Interval::exactly(h), Interval::exactly(sigma)).least_magnitude()
    }

    fn beyond(&self, _: f64) -> f64 {
        f64::INFINITY
    }
}
