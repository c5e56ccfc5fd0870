//! Several segments of one error.

use super::super::crossing::WideCrossing;
use super::super::error::{FitError, checked};
use super::exchange::{self, Alternation, Best, Digits, Terms, root};
use super::terms::{monomial, power_form};
use crate::fit::double_double::DoubleDouble;
use crate::highlight::Segment;
use crate::registers::MAX_DEGREE;

/// How far down the segments reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// To where x^n has this value, above 0 and below 1.
    Level(f64),
    /// To where x^n is the error itself, so that zero below is no worse than the segments.
    Balanced,
}

/// The segments of one exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The segments, in the order of s, the first with f(1) = 1; where one covers everything (an n of 1 up to the
    /// degree), one.
    pub segments: Vec<Segment>,
    /// The first in powers of x, from the constant term up.
    pub power: Terms<f64>,
    /// Where each ends, in s; the last end is that of the range.
    pub ends: Vec<f64>,
    /// The greatest error of all of them.
    pub error: f64,
    /// Where each has it.
    pub alternations: Vec<Alternation>,
}

/// The least error that is looked for. Below, x^n in f64 is rounding.
const LEAST_ERROR: f64 = 1e-15;
/// The greatest: one segment for everything has less.
const GREATEST_ERROR: f64 = 0.5;
/// `count` segments (1 to 16) of one degree (1 to 4) and of equal error.
///
/// # Errors
/// When the exponent or the level is out of range.
pub fn segments(exponent: f64, degree: usize, count: usize, range: Range) -> Result<Fitted, FitError> {
    let exponent = checked(exponent)?;
    let degree = degree.clamp(1, MAX_DEGREE);
    if let Range::Level(level) = range {
        crate::fit::crossing(exponent, level)?;
    }
    if let Some(c) = monomial(exponent, degree) {
        let end = match range {
            Range::Level(level) => WideCrossing::new(exponent, level).s.to_f64(),
            Range::Balanced => 1.0,
        };
        return Ok(Fitted {
            segments: vec![Segment { start: 0.0, c: c.map(DoubleDouble::to_f64) }],
            power: power_form(&c).map(DoubleDouble::to_f64),
            ends: vec![end],
            error: 0.0,
            alternations: vec![],
        });
    }
    Ok(fitted(&Search::new(exponent, degree, count.clamp(1, 16), range).equalised()))
}

/// The best segment of a degree (1 to 4) for `start` ≤ s ≤ `end`, with f(1) = 1 where it starts at 0; in powers of x
/// only then. None where x^n is such a polynomial itself, and for a range that is empty or so long that x^n is all but
/// a spike in it.
#[must_use]
pub fn between(exponent: f64, degree: usize, (start, end): (f64, f64)) -> Option<Fitted> {
    let degree = degree.clamp(1, MAX_DEGREE);
    let search = Search { digits: Digits::Full, ..Search::new(exponent, degree, 1, Range::Balanced) };
    if !(start < end && end < search.far) || monomial(exponent, degree).is_some() {
        return None;
    }
    let best = search.fit(start, end, None);
    best.error.is_finite().then(|| fitted(&[best]))
}

/// Where a rising function, infinite from somewhere on, is 0; the end it is nearest to where it is not.
fn rising_root(mut f: impl FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const CLOSE: f64 = 1e-10;
    const STEEP: f64 = 8.0;
    if f(low) >= 0.0 {
        return low;
    }
    let mut at_high = f64::INFINITY;
    // Halving until both ends are near and none is where the function bends away to infinity; then
    // regula falsi does the rest.
    while high - low > CLOSE {
        if high - low < 3.0 && at_high < STEEP {
            return root(f, (low, high), CLOSE).unwrap_or(high);
        }
        let middle = 0.5 * (low + high);
        let at_middle = f(middle);
        if at_middle < 0.0 {
            low = middle;
        } else {
            (high, at_high) = (middle, at_middle);
        }
    }
    high
}

struct Search {
    exponent: f64,
    degree: usize,
    count: usize,
    range: Range,
    /// No segment goes further. No configuration needs that, and an exchange on a range where x^n is all but a spike
    /// would not see it.
    far: f64,
    digits: Digits,
    /// The segments of the last error that was tried.
    last: Vec<Best>,
}

impl Search {
    /// Segments with the least common error that still reach as far as they are to.
    fn equalised(mut self) -> Vec<Best> {
        let (low, high) = (core_math::log(LEAST_ERROR), core_math::log(GREATEST_ERROR));
        let log_error = rising_root(|log_error| self.beyond(log_error), low, high);
        self.digits = Digits::Full;
        self.chain(core_math::exp(log_error))
    }

    fn new(exponent: f64, degree: usize, count: usize, range: Range) -> Self {
        // Beyond the goal by e^4, so that the search sees it from both sides.
        let least = match range {
            Range::Level(level) => level,
            Range::Balanced => LEAST_ERROR,
        };
        let far = -core_math::expm1((core_math::log(least) - 4.0) / exponent);
        Self { exponent, degree, count, range, far, digits: Digits::Rough, last: vec![] }
    }

    /// How near the error of a segment comes to its goal, as a part of itself.
    const fn close(&self) -> f64 {
        match self.digits {
            Digits::Rough => 1e-11,
            Digits::Full => 1e-13,
        }
    }

    /// How far beyond its goal the last segment reaches, in σ = −ln x^n; rises with the error.
    fn beyond(&mut self, log_error: f64) -> f64 {
        self.last = self.chain(core_math::exp(log_error));
        let end = self.last.last().map_or(0.0, end_of);
        let sigma = if end >= self.far { f64::INFINITY } else { -self.exponent * core_math::log1p(-end) };
        match self.range {
            Range::Level(level) => sigma + core_math::log(level),
            Range::Balanced => sigma + log_error,
        }
    }

    /// Segments one after the other, each as long as its error stays within `error`.
    fn chain(&self, error: f64) -> Vec<Best> {
        let mut chain: Vec<Best> = Vec::with_capacity(self.count);
        // Of e^−σ, as long as the root of the error whose order is the degree's next.
        let mut guess = 4.0 * self.root_of(error) / self.exponent;
        for index in 0..self.count {
            let start = chain.last().map_or(0.0, end_of);
            if start >= self.far {
                break;
            }
            let near = self.last.get(index);
            if let Some(near) = near {
                guess = near.length() * self.root_of(error / near.error);
            }
            let best = self.longest(start, guess.min(0.5 * (self.far - start)), error, near);
            guess = best.length();
            chain.push(best);
        }
        chain
    }

    /// The root of order degree + 1: an error grows with about that power of the length.
    fn root_of(&self, error: f64) -> f64 {
        match self.degree {
            1 => error.sqrt(),
            2 => core_math::cbrt(error),
            3 => error.sqrt().sqrt(),
            _ => core_math::pow(error, 1.0 / (self.degree + 1) as f64),
        }
    }

    /// The longest segment from `start` whose error is within `error`. The error grows with about the (degree + 1)-th
    /// power of the length, so that in logarithms a secant arrives at once.
    fn longest(&self, start: f64, guess: f64, error: f64, near: Option<&Best>) -> Best {
        const STEPS: usize = 60;
        let most = self.far - start;
        let goal = core_math::log(error);
        let excess = |best: &Best| core_math::log(best.error.max(f64::MIN_POSITIVE)) - goal;
        let (mut length, mut slope) = (guess, (self.degree + 1) as f64);
        let (mut short, mut long) = (0.0, most);
        let mut last: Option<(f64, f64)> = None;
        let mut best = self.fit(start, start + length, near);
        for _ in 0..STEPS {
            let here = excess(&best);
            if here.abs() < self.close() || (length >= most && here <= 0.0) {
                break;
            }
            *(if here < 0.0 { &mut short } else { &mut long }) = length;
            if let Some((log_length, before)) = last {
                let estimate = (here - before) / (core_math::log(length) - log_length);
                if estimate > 0.5 && estimate.is_finite() {
                    slope = estimate;
                }
            }
            last = Some((core_math::log(length), here));
            // A step beyond a factor of 4 is not trusted, nor one beyond what is known.
            let step = (-here / slope).clamp(-1.4, 1.4);
            let mut next = length * core_math::exp(step);
            if next <= short || (next >= long && long < most) {
                next = 0.5 * (short + long);
            }
            next = next.min(most);
            if next == length {
                break;
            }
            length = next;
            let end = if length >= most { self.far } else { start + length };
            best = self.fit(start, end, Some(&best));
        }
        best
    }

    fn fit(&self, start: f64, end: f64, near: Option<&Best>) -> Best {
        if start == 0.0 {
            exchange::first(self.exponent, self.degree, DoubleDouble::from(end), self.digits, near)
        } else {
            exchange::further(self.exponent, self.degree, (start, end), self.digits, near)
        }
    }
}

fn end_of(best: &Best) -> f64 {
    best.range().1
}

fn fitted(chain: &[Best]) -> Fitted {
    let segment = |best: &Best| Segment { start: best.range().0, c: best.c.map(DoubleDouble::to_f64) };
    let first = chain.first().map_or([DoubleDouble::from(0.0); MAX_DEGREE + 1], |best| best.c);
    Fitted {
        segments: chain.iter().map(segment).collect(),
        power: power_form(&first).map(DoubleDouble::to_f64),
        ends: chain.iter().map(end_of).collect(),
        error: chain.iter().map(|best| best.error).fold(0.0, f64::max),
        alternations: chain.iter().map(Best::alternation).collect(),
    }
}
