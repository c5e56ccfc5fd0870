//! Remez's exchange on one range of s.
//!
//! With s = start + L·w, 0 ≤ w ≤ 1, the polynomial p of degree D and E with p(w_i) − x^n(w_i) = ±E at alternating
//! points follow from divided differences, which kill the polynomial and leave E. The inner points are D:
//!
//! ```text
//! first segment    p = 1 + w·g, g of degree D − 1, D + 1 points:  g(w_i) = z_i ± E/w_i,  z_i = (x^n − 1)/w_i
//!                  E = −z[w1 … w(D+1)] / (±1/w)[w1 … w(D+1)]
//! others           p of degree D, D + 2 points:  E = −x^n[w0 … w(D+1)] / (±1)[w0 … w(D+1)]
//! ```
//!
//! Then the inner points move to where the error turns, and so on until they stay. As the error is flat
//! there, coefficients and E are far more accurate than the points: these are found in f64, those
//! computed in 106 bits.

use super::super::double_double::DoubleDouble;
use crate::registers::{CUBIC, MAX_DEGREE};

/// Rounds of exchange. Convergence is quadratic: 4 to 6 are enough for any n and range.
const ROUNDS: usize = 24;
/// Points have settled when they are known to this part of the range; what that leaves in the coefficients
/// is of the size of its square.
const SETTLED: f64 = 1e-9;

/// The points at which an error is greatest, with the error there, in the order of s.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternation {
    /// (s, p − x^n).
    pub points: Vec<(f64, f64)>,
}

/// Coefficients from the constant term up; those above the degree are 0.
pub(super) type Terms<T> = [T; MAX_DEGREE + 1];

/// The inner points of a polynomial of some degree, in w: as many as the degree.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turns {
    degree: usize,
    w: [f64; MAX_DEGREE],
}

impl Turns {
    /// The points as a list.
    fn points(&self) -> &[f64] {
        &self.w[..self.degree]
    }

    /// Every point, moved.
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { w: self.w.map(f), ..self }
    }

    /// Where the error of a polynomial with a free constant turns, if x^n is like its next power: T(D+1) of Chebyshev.
    fn of_free(degree: usize) -> Self {
        let mut w = [0.0; MAX_DEGREE];
        if degree == CUBIC {
            w[..CUBIC].copy_from_slice(&[0.146_446_609, 0.5, 0.853_553_391]);
        } else {
            for (turn, w) in w[..degree].iter_mut().enumerate() {
                *w = 0.5 * (1.0 - extreme(degree, turn + 1));
            }
        }
        Self { degree, w }
    }

    /// The same where the error is 0 at w = 0: T(D+1) from its first zero on.
    fn of_fixed(degree: usize) -> Self {
        let mut w = [0.0; MAX_DEGREE];
        if degree == CUBIC {
            w[..CUBIC].copy_from_slice(&[0.17, 0.55, 0.88]);
        } else {
            let zero = core_math::cos(std::f64::consts::FRAC_PI_2 / (degree + 1) as f64);
            for (turn, w) in w[..degree].iter_mut().enumerate() {
                *w = (zero - extreme(degree, turn + 1)) / (1.0 + zero);
            }
        }
        Self { degree, w }
    }
}

/// cos(π·i / (D + 1)): where T(D+1) has its extremes.
fn extreme(degree: usize, index: usize) -> f64 {
    core_math::cos(std::f64::consts::PI * index as f64 / (degree + 1) as f64)
}

/// The best polynomial on a range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    exponent: f64,
    start: f64,
    end: f64,
    length: DoubleDouble,
    /// Of 1, w, w², …
    power: Terms<DoubleDouble>,
    /// The inner points, in w.
    turns: Turns,
    /// Whether w = 0 is one of the points.
    free: bool,
    /// c0, c1, c2, … of c0 − v·(c1 − v·(c2 − …)), v = s − start.
    pub c: Terms<DoubleDouble>,
    /// The greatest magnitude of the error; infinite on a range too long for the exchange (a segment that
    /// would reach to σ in the millions).
    pub error: f64,
}

/// How many digits of x^n go into the coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Digits {
    /// Those of an f64, while hand-over points are looked for.
    Rough,
    /// 32 digits, for the coefficients themselves.
    Full,
}

/// The best polynomial of a degree with f = 1 at s = 0, for 0 ≤ s ≤ `end`. `near` is a similar one, where there is
/// one: its points are a better guess than none.
pub(super) fn first(exponent: f64, degree: usize, end: DoubleDouble, digits: Digits, near: Option<&Best>) -> Best {
    let problem = Problem { exponent, start: 0.0, end: end.to_f64(), length: end, free: false, digits };
    exchange(problem, near.map_or_else(|| Turns::of_fixed(degree), |near| near.turns))
}

/// The best polynomial of a degree for `start` ≤ s ≤ `end`.
pub(super) fn further(
    exponent: f64,
    degree: usize,
    (start, end): (f64, f64),
    digits: Digits,
    near: Option<&Best>,
) -> Best {
    let length = DoubleDouble::from(end) - DoubleDouble::from(start);
    let problem = Problem { exponent, start, end, length, free: true, digits };
    exchange(problem, near.map_or_else(|| Turns::of_free(degree), |near| near.turns))
}

#[derive(Clone, Copy)]
struct Problem {
    exponent: f64,
    start: f64,
    end: f64,
    length: DoubleDouble,
    free: bool,
    digits: Digits,
}

/// x^n = e^(n·ln(1 − s)) in 106 bits.
fn reference(exponent: f64, s: DoubleDouble) -> DoubleDouble {
    if s.to_f64() >= 1.0 {
        return DoubleDouble::from(0.0);
    }
    let log = DoubleDouble::from(exponent) * DoubleDouble::ln_one_minus(s);
    // Beyond the range of exp, and far below any error.
    if log.to_f64() < -700.0 { DoubleDouble::from(0.0) } else { log.exp() }
}

impl Problem {
    fn reference(&self, w: f64) -> DoubleDouble {
        if self.digits == Digits::Rough {
            return DoubleDouble::from(self.rough(w).0);
        }
        let s = DoubleDouble::from(self.start) + self.length * DoubleDouble::from(w);
        reference(self.exponent, s)
    }

    /// x^n and its two first slopes against w, in f64.
    fn rough(&self, w: f64) -> (f64, f64, f64) {
        let length = self.length.to_f64();
        let s = self.start + length * w;
        if s >= 1.0 {
            return (0.0, 0.0, 0.0);
        }
        let log = core_math::log1p(-s);
        let value = core_math::exp(self.exponent * log);
        let slope = -self.exponent * length * value / (1.0 - s);
        (value, slope, (1.0 - self.exponent) * length * slope / (1.0 - s))
    }

    /// The polynomial whose error is ±E at the points, as powers of w, and E (with its sign at the first turn).
    fn levelled(&self, turns: Turns) -> (Terms<DoubleDouble>, DoubleDouble) {
        let one = DoubleDouble::ONE;
        let start = self.free.then_some(0.0);
        let points: Vec<f64> = start.into_iter().chain(turns.points().iter().copied()).chain([1.0]).collect();
        // The sign at the first turn is +, whether or not w = 0 is a point before it.
        let signs = (0..points.len()).map(|i| if (i % 2 == 0) == self.free { -one } else { one });
        if self.free {
            let values = points.iter().map(|&w| self.reference(w)).collect();
            let (values, error) = equal(&points, values, signs.collect());
            (newton(&points, values, turns.degree), error)
        } else {
            let over = |value: DoubleDouble, w: f64| value / DoubleDouble::from(w);
            let z = points.iter().map(|&w| over(self.reference(w) - one, w)).collect();
            let signs = signs.zip(&points).map(|(sign, &w)| over(sign, w)).collect();
            let (values, error) = equal(&points, z, signs);
            let g = newton(&points, values, turns.degree);
            let mut power = [DoubleDouble::from(0.0); MAX_DEGREE + 1];
            power[0] = one;
            power[1..=turns.degree].copy_from_slice(&g[..turns.degree]);
            (power, error)
        }
    }
}

/// What the polynomial must be at each point: value + sign·E, with the E that makes its highest divided
/// difference vanish.
fn equal(points: &[f64], values: Vec<DoubleDouble>, signs: Vec<DoubleDouble>) -> (Vec<DoubleDouble>, DoubleDouble) {
    let highest = |of: &[DoubleDouble]| divided(points, of.to_vec()).last().copied().unwrap_or(DoubleDouble::ONE);
    let error = -highest(&values) / highest(&signs);
    (values.into_iter().zip(signs).map(|(value, sign)| value + sign * error).collect(), error)
}

/// Divided differences over the first point, the first two, and so on.
fn divided(points: &[f64], mut values: Vec<DoubleDouble>) -> Vec<DoubleDouble> {
    for order in 1..points.len() {
        for i in (order..points.len()).rev() {
            let distance = DoubleDouble::from(points[i]) - DoubleDouble::from(points[i - order]);
            values[i] = (values[i] - values[i - 1]) / distance;
        }
    }
    values
}

/// The coefficients of 1, w, w², … of the polynomial of a degree through the values: Newton's form, multiplied out.
fn newton(points: &[f64], values: Vec<DoubleDouble>, degree: usize) -> Terms<DoubleDouble> {
    let differences = divided(points, values);
    let mut power = [DoubleDouble::from(0.0); MAX_DEGREE + 1];
    for i in (0..(degree + 1).min(points.len())).rev() {
        let at = DoubleDouble::from(points[i]);
        for k in (1..=degree).rev() {
            power[k] = power[k - 1] - at * power[k];
        }
        power[0] = differences[i] - at * power[0];
    }
    power
}

/// Errors this small are rounding in f64, and their turning points cannot be seen.
const UNSEEN: f64 = 1e-14;
/// Halvings of the range in search of a guess.
const SHORTENINGS: u32 = 60;

fn exchange(problem: Problem, guess: Turns) -> Best {
    let settled = problem.settled(guess, SHORTENINGS);
    let turns = settled.unwrap_or(guess);
    let (power, error) = problem.levelled(turns);
    let mut best = Best::new(problem, power, turns, error);
    if settled.is_none() {
        best.error = f64::INFINITY;
    }
    best
}

impl Problem {
    /// The inner points. On a range so long that a guess leads nowhere, those of a shorter one are a better
    /// guess.
    fn settled(&self, guess: Turns, shortenings: u32) -> Option<Turns> {
        let rough = Self { digits: Digits::Rough, ..*self };
        rough.exchanged(guess).or_else(|| {
            let length = self.length * DoubleDouble::from(0.5);
            let shorter = Self { length, ..*self };
            let turns = shorter.settled(guess, shortenings.checked_sub(1)?)?;
            rough.exchanged(turns.map(|w| 0.5 * w))
        })
    }

    fn exchanged(&self, mut turns: Turns) -> Option<Turns> {
        for _ in 0..ROUNDS {
            let (power, error) = self.levelled(turns);
            if error.to_f64().abs() < UNSEEN {
                break;
            }
            let next = self.turning_points(power, turns)?;
            let pairs = next.points().iter().zip(turns.points());
            let moved = pairs.map(|(next, last)| (next - last).abs()).fold(0.0, f64::max);
            turns = next;
            // The next move would be of the size of this one's square.
            if moved * moved < SETTLED {
                break;
            }
        }
        Some(turns)
    }
}

impl Problem {
    /// Where the error turns next to each of these points.
    fn turning_points(&self, power: Terms<DoubleDouble>, turns: Turns) -> Option<Turns> {
        let rough = Rough { problem: *self, power: power.map(DoubleDouble::to_f64) };
        rough.turns_near(turns).or_else(|| rough.turns_between_zeros(turns))
    }
}

/// The error of a polynomial and its slopes against w, in f64.
struct Rough {
    problem: Problem,
    power: Terms<f64>,
}

impl Rough {
    fn error(&self, w: f64) -> f64 {
        horner(&self.power, |term, _| term, w) - self.problem.rough(w).0
    }

    /// The first and the second slope.
    fn slopes(&self, w: f64) -> (f64, f64) {
        let (_, first, second) = self.problem.rough(w);
        let [_, slope @ ..] = &self.power;
        let [_, _, bend @ ..] = &self.power;
        (
            horner(slope, |term, i| (i + 1.0) * term, w) - first,
            horner(bend, |term, i| (i + 2.0) * (i + 1.0) * term, w) - second,
        )
    }

    /// By Newton's method; none where it leaves the neighbourhood of a point.
    fn turns_near(&self, turns: Turns) -> Option<Turns> {
        const STEPS: usize = 8;
        let mut moved = turns;
        let (turns, found) = (turns.points(), &mut moved.w);
        for i in 0..turns.len() {
            let before = if i == 0 { 0.0 } else { turns[i - 1] };
            let after = turns.get(i + 1).copied().unwrap_or(1.0);
            let (low, high) = (0.6 * turns[i] + 0.4 * before, 0.6 * turns[i] + 0.4 * after);
            let mut step = f64::INFINITY;
            for _ in 0..STEPS {
                let (first, second) = self.slopes(found[i]);
                step = first / second;
                found[i] -= step;
                if !(low..=high).contains(&found[i]) {
                    return None;
                }
                if step * step < SETTLED * SETTLED {
                    break;
                }
            }
            // Newton's method finds any turning point: it has to be one of the same side.
            let same_side = self.error(found[i]) * self.error(turns[i]) > 0.0;
            if !same_side || step.abs() > 1e-6 {
                return None;
            }
        }
        Some(moved)
    }

    /// Between the zeros, of which one lies between any two points. None where rounding hides them: the
    /// error is then nothing but rounding.
    fn turns_between_zeros(&self, turns: Turns) -> Option<Turns> {
        // The zeros only part the turning points.
        let zero = |low, high| root(|w| self.error(w), (low, high), 1e-3);
        let points = turns.points();
        let mut before = if self.problem.free { zero(0.0, points[0])? } else { 0.0 };
        let mut found = turns;
        for (i, turn) in found.w[..turns.degree].iter_mut().enumerate() {
            let after = zero(points[i], points.get(i + 1).copied().unwrap_or(1.0))?;
            *turn = root(|w| self.slopes(w).0, (before, after), 0.1 * SETTLED)?;
            before = after;
        }
        Some(found)
    }
}

/// Σ weight(term_i, i)·w^i by Horner's rule.
fn horner(terms: &[f64], weight: impl Fn(f64, f64) -> f64, w: f64) -> f64 {
    let weighted = terms.iter().enumerate().map(|(i, &term)| weight(term, i as f64));
    weighted.rev().fold(0.0, |sum, term| term + w * sum)
}

/// The zero of a function between two points where its signs differ (regula falsi, Illinois); none where
/// they do not. `close` is the part of the greater end to which it is found.
pub(super) fn root(mut f: impl FnMut(f64) -> f64, (low, high): (f64, f64), close: f64) -> Option<f64> {
    const STEPS: usize = 100;
    let (mut low, mut high, mut last) = (low, high, f64::NAN);
    let (mut at_low, mut at_high) = (f(low), f(high));
    if at_low == 0.0 {
        return Some(low);
    }
    if at_high == 0.0 {
        return Some(high);
    }
    if at_low.is_nan() || at_high.is_nan() || (at_low < 0.0) == (at_high < 0.0) {
        return None;
    }
    let mut replaced_low = None;
    for _ in 0..STEPS {
        let mut middle = (low * at_high - high * at_low) / (at_high - at_low);
        if !(middle > low && middle < high) {
            middle = 0.5 * (low + high);
        }
        let at_middle = f(middle);
        if at_middle == 0.0 || (middle - last).abs() <= close * high.abs() {
            return Some(middle);
        }
        last = middle;
        // An end that stays twice loses half its weight.
        let replaces_low = (at_middle < 0.0) == (at_low < 0.0);
        let again = replaced_low == Some(replaces_low);
        replaced_low = Some(replaces_low);
        if replaces_low {
            (low, at_low) = (middle, at_middle);
            at_high *= if again { 0.5 } else { 1.0 };
        } else {
            (high, at_high) = (middle, at_middle);
            at_low *= if again { 0.5 } else { 1.0 };
        }
    }
    Some(0.5 * (low + high))
}

impl Best {
    /// Where the segment begins and ends, in s.
    pub const fn range(&self) -> (f64, f64) {
        (self.start, self.end)
    }

    /// end − start, in f64.
    pub const fn length(&self) -> f64 {
        self.length.to_f64()
    }

    fn new(problem: Problem, power: Terms<DoubleDouble>, turns: Turns, error: DoubleDouble) -> Self {
        let Problem { exponent, start, end, length, free, .. } = problem;
        let (square, cube) = (length * length, length * length * length);
        let [p0, p1, p2, p3, p4] = power;
        let c = [p0, -(p1 / length), p2 / square, -(p3 / cube), p4 / (square * square)];
        Self { exponent, start, end, length, power, turns, free, c, error: error.to_f64().abs() }
    }

    /// The points, with the error that the polynomial has there before its coefficients are rounded.
    pub fn alternation(&self) -> Alternation {
        let start = self.free.then_some(0.0);
        let points = start.into_iter().chain(self.turns.points().iter().copied()).chain([1.0]).map(|w| {
            let s = DoubleDouble::from(self.start) + self.length * DoubleDouble::from(w);
            let w = DoubleDouble::from(w);
            let zero = DoubleDouble::from(0.0);
            let value = self.power.iter().rev().fold(zero, |sum, &term| term + w * sum);
            let error = value - reference(self.exponent, s);
            (s.to_f64(), error.to_f64())
        });
        Alternation { points: points.collect() }
    }
}
