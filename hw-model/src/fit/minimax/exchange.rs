//! Remez's exchange on one range of s.
//!
//! With s = start + L·w, 0 ≤ w ≤ 1, the cubic and E with p(w_i) − x^n(w_i) = ±E at alternating points
//! follow from divided differences, which kill the cubic and leave E:
//!
//! ```text
//! first segment    p = 1 + w·g, g of degree 2, four points:  g(w_i) = z_i ± E/w_i,  z_i = (x^n − 1)/w_i
//!                  E = −z[w1 … w4] / (±1/w)[w1 … w4]
//! others           p of degree 3, five points:  E = −x^n[w0 … w4] / (±1)[w0 … w4]
//! ```
//!
//! Then the inner points move to where the error turns, and so on until they stay. As the error is flat
//! there, coefficients and E are far more accurate than the points: these are found in f64, those
//! computed in 106 bits.

use super::super::double_double::DoubleDouble;

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

/// The best cubic on a range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Best {
    exponent: f64,
    start: f64,
    end: f64,
    length: DoubleDouble,
    /// Of 1, w, w², w³.
    power: [DoubleDouble; 4],
    /// The inner points, in w.
    turns: [f64; 3],
    /// Whether w = 0 is one of the points.
    free: bool,
    /// c0, c1, c2, c3 of c0 − v·(c1 − v·(c2 − v·c3)), v = s − start.
    pub c: [DoubleDouble; 4],
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

/// The best cubic with f = 1 at s = 0, for 0 ≤ s ≤ `end`. `near` is a similar one, where there is one: its
/// points are a better guess than none.
pub(super) fn first(exponent: f64, end: DoubleDouble, digits: Digits, near: Option<&Best>) -> Best {
    let problem =
        Problem { exponent, start: 0.0, end: end.to_f64(), length: end, free: false, digits };
    exchange(problem, near.map_or([0.17, 0.55, 0.88], |near| near.turns))
}

/// The best cubic for `start` ≤ s ≤ `end`.
pub(super) fn further(
    exponent: f64,
    (start, end): (f64, f64),
    digits: Digits,
    near: Option<&Best>,
) -> Best {
    let length = DoubleDouble::from(end) - DoubleDouble::from(start);
    let problem = Problem { exponent, start, end, length, free: true, digits };
    // Where T4 turns.
    exchange(problem, near.map_or([0.146_446_609, 0.5, 0.853_553_391], |near| near.turns))
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

    /// The cubic whose error is ±E at the points, as powers of w, and E (with its sign at the first turn).
    fn levelled(&self, turns: [f64; 3]) -> ([DoubleDouble; 4], DoubleDouble) {
        let one = DoubleDouble::ONE;
        let [a, b, c] = turns;
        if self.free {
            let points = [0.0, a, b, c, 1.0];
            let signs = [-one, one, -one, one, -one];
            let (values, error) = equal(points, points.map(|w| self.reference(w)), signs);
            (newton(points, values), error)
        } else {
            let points = [a, b, c, 1.0];
            let over = |value: DoubleDouble, w: f64| value / DoubleDouble::from(w);
            let z = points.map(|w| over(self.reference(w) - one, w));
            let signs = [one, -one, one, -one];
            let signs = std::array::from_fn(|i| over(signs[i], points[i]));
            let (values, error) = equal(points, z, signs);
            let [g0, g1, g2, _] = newton(points, values);
            ([one, g0, g1, g2], error)
        }
    }
}

/// What the polynomial must be at each point: value + sign·E, with the E that makes its highest divided
/// difference vanish.
fn equal<const N: usize>(
    points: [f64; N],
    values: [DoubleDouble; N],
    signs: [DoubleDouble; N],
) -> ([DoubleDouble; N], DoubleDouble) {
    let highest = |of| divided(points, of)[N - 1];
    let error = -highest(values) / highest(signs);
    (std::array::from_fn(|i| values[i] + signs[i] * error), error)
}

/// Divided differences over the first point, the first two, and so on.
fn divided<const N: usize>(points: [f64; N], mut values: [DoubleDouble; N]) -> [DoubleDouble; N] {
    for order in 1..N {
        for i in (order..N).rev() {
            let distance = DoubleDouble::from(points[i]) - DoubleDouble::from(points[i - order]);
            values[i] = (values[i] - values[i - 1]) / distance;
        }
    }
    values
}

/// The coefficients of 1, w, w², w³ of the cubic through the values: Newton's form, multiplied out.
fn newton<const N: usize>(points: [f64; N], values: [DoubleDouble; N]) -> [DoubleDouble; 4] {
    let differences = divided(points, values);
    let mut power = [DoubleDouble::from(0.0); 4];
    for i in (0..4.min(N)).rev() {
        let at = DoubleDouble::from(points[i]);
        for k in (1..4).rev() {
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

fn exchange(problem: Problem, guess: [f64; 3]) -> Best {
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
    fn settled(&self, guess: [f64; 3], shortenings: u32) -> Option<[f64; 3]> {
        let rough = Self { digits: Digits::Rough, ..*self };
        rough.exchanged(guess).or_else(|| {
            let length = self.length * DoubleDouble::from(0.5);
            let shorter = Self { length, ..*self };
            let turns = shorter.settled(guess, shortenings.checked_sub(1)?)?;
            rough.exchanged(turns.map(|w| 0.5 * w))
        })
    }

    fn exchanged(&self, mut turns: [f64; 3]) -> Option<[f64; 3]> {
        for _ in 0..ROUNDS {
            let (power, error) = self.levelled(turns);
            if error.to_f64().abs() < UNSEEN {
                break;
            }
            let next = self.turning_points(power, turns)?;
            let moved = (0..3).map(|i| (next[i] - turns[i]).abs()).fold(0.0, f64::max);
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
    fn turning_points(&self, power: [DoubleDouble; 4], turns: [f64; 3]) -> Option<[f64; 3]> {
        let rough = Rough { problem: *self, power: power.map(DoubleDouble::to_f64) };
        rough.turns_near(turns).or_else(|| rough.turns_between_zeros(turns))
    }
}

/// The error of a cubic and its slopes against w, in f64.
struct Rough {
    problem: Problem,
    power: [f64; 4],
}

impl Rough {
    fn error(&self, w: f64) -> f64 {
        let [p0, p1, p2, p3] = self.power;
        p0 + w * (p1 + w * (p2 + w * p3)) - self.problem.rough(w).0
    }

    /// The first and the second slope.
    fn slopes(&self, w: f64) -> (f64, f64) {
        let [_, p1, p2, p3] = self.power;
        let (_, first, second) = self.problem.rough(w);
        (p1 + w * (2.0 * p2 + w * (3.0 * p3)) - first, 2.0 * p2 + w * (6.0 * p3) - second)
    }

    /// By Newton's method; none where it leaves the neighbourhood of a point.
    fn turns_near(&self, turns: [f64; 3]) -> Option<[f64; 3]> {
        const STEPS: usize = 8;
        let mut found = turns;
        for i in 0..3 {
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
        Some(found)
    }

    /// Between the zeros, of which one lies between any two points. None where rounding hides them: the
    /// error is then nothing but rounding.
    fn turns_between_zeros(&self, [a, b, c]: [f64; 3]) -> Option<[f64; 3]> {
        // The zeros only part the turning points.
        let zero = |low, high| root(|w| self.error(w), (low, high), 1e-3);
        let before = if self.problem.free { zero(0.0, a)? } else { 0.0 };
        let zeros = [before, zero(a, b)?, zero(b, c)?, zero(c, 1.0)?];
        let turn = |i: usize| root(|w| self.slopes(w).0, (zeros[i], zeros[i + 1]), 0.1 * SETTLED);
        Some([turn(0)?, turn(1)?, turn(2)?])
    }
}

/// The zero of a function between two points where its signs differ (regula falsi, Illinois); none where
/// they do not. `close` is the part of the greater end to which it is found.
pub(super) fn root(
    mut f: impl FnMut(f64) -> f64,
    (low, high): (f64, f64),
    close: f64,
) -> Option<f64> {
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

    fn new(
        problem: Problem,
        power: [DoubleDouble; 4],
        turns: [f64; 3],
        error: DoubleDouble,
    ) -> Self {
        let Problem { exponent, start, end, length, free, .. } = problem;
        let (square, cube) = (length * length, length * length * length);
        let [p0, p1, p2, p3] = power;
        let c = [p0, -(p1 / length), p2 / square, -(p3 / cube)];
        Self { exponent, start, end, length, power, turns, free, c, error: error.to_f64().abs() }
    }

    /// The points, with the error that the cubic has there before its coefficients are rounded.
    pub fn alternation(&self) -> Alternation {
        let start = self.free.then_some(0.0);
        let points = start.into_iter().chain(self.turns).chain([1.0]).map(|w| {
            let s = DoubleDouble::from(self.start) + self.length * DoubleDouble::from(w);
            let w = DoubleDouble::from(w);
            let [p0, p1, p2, p3] = self.power;
            let error = p0 + w * (p1 + w * (p2 + w * p3)) - reference(self.exponent, s);
            (s.to_f64(), error.to_f64())
        });
        Alternation { points: points.collect() }
    }
}
