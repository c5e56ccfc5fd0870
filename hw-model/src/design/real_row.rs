//! The real functions behind one ROM row.

use crate::config::{Config, Cut, Form, Tail};
use crate::fit::minimax::{self, Range};
use crate::fit::{Curve, FitError, Levels, Method, fit};
use crate::format::QFormat;
use crate::highlight::{Cubic, Power, Rational, Segment};
use crate::quantise::round_scaled;
use crate::registers::{CUBIC, MAX_DEGREE, Register};
use crate::rounding::{Rounding, round_shift};

/// What one row means in real numbers, and where its parts meet.
#[derive(Debug, Clone, PartialEq)]
pub struct RealRow {
    /// The row's exponent n, 1 or more.
    pub exponent: f64,
    /// p = 1 − q: the epicentre is 0 ≤ s ≤ p in s = 1 − x.
    pub epicentre: f64,
    /// The polynomials, from x = 1 downwards; none for schlick.
    pub segments: Vec<RealSegment>,
    /// The first polynomial in powers of x, from the constant term up; zeros for schlick.
    pub power: [f64; MAX_DEGREE + 1],
    /// What the divider computes, where the configuration keeps one.
    pub tail: Option<Rational>,
    /// The least x (in the input's unit) at which a polynomial answers.
    pub cut: i64,
}

/// One segment of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RealSegment {
    /// The polynomial, which counts from `start`.
    pub polynomial: Segment,
    /// The x (in the input's unit) from which v counts: 1, or the least x of the segment before.
    pub start: i64,
    /// The places v is moved up: e = ⌊log2 n⌋ in the centred form (with a range fitted to the error, the greatest that
    /// keeps v below 1), 0 in the power form.
    pub shift: u32,
}

impl RealRow {
    /// The row of one exponent.
    ///
    /// # Errors
    /// When the exponent is out of range.
    pub fn new(config: &Config, levels: Levels, exponent: f64) -> Result<Self, FitError> {
        if ends_are_fitted(config) {
            return Self::fitted(config, levels, exponent);
        }
        let own = fit(config.method, exponent, levels)?;
        let (polynomial, tail) = match own.curve {
            Curve::Cubic(cubic) if config.tail == Tail::Rational => {
                (Some(cubic), fit(Method::Rational, exponent, levels)?.rational().copied())
            }
            Curve::Cubic(cubic) => (Some(cubic), None),
            Curve::Rational(rational) => (None, Some(rational)),
            Curve::Composite { epicentre, tail } => (Some(epicentre), Some(tail)),
        };
        let epicentre = own.epicentre.s;
        let shift = match config.form {
            Form::Centred if polynomial.is_some() => floor_log2(exponent),
            _ => 0,
        };
        let cut_s = match (config.cut, &polynomial) {
            (Cut::Minimum, Some(cubic)) => {
                let lowest = lowest_s(cubic, epicentre, config.output.ulp() / 2.0);
                let narrow = config.multiplier_operand_bits.is_some();
                let most = if narrow { GREATEST_U * (-f64::from(shift)).exp2() } else { 1.0 };
                lowest.min(most).max(epicentre)
            }
            _ => epicentre,
        };
        let own = match &polynomial {
            // The best of another degree on the same range.
            Some(_) if config.method == Method::Minimax && config.degree != CUBIC => {
                let range = Range::Level(levels.q());
                let fitted = minimax::segments(exponent, config.degree, 1, range)?;
                fitted.segments.first().map(|&segment| (segment, fitted.power))
            }
            other => other.as_ref().map(|cubic| {
                let Power { a, b, c, d } = cubic.power;
                (cubic.segment(), [d, c, b, a, 0.0])
            }),
        };
        let start = config.input.one();
        let segment = |(polynomial, _)| RealSegment { polynomial, start, shift };
        Ok(Self {
            exponent,
            epicentre,
            segments: own.map(segment).into_iter().collect(),
            power: own.map_or([0.0; MAX_DEGREE + 1], |(_, power)| power),
            tail,
            cut: cut_bits(config, cut_s),
        })
    }

    /// The row of minimax segments whose ends are part of the fit.
    fn fitted(config: &Config, levels: Levels, exponent: f64) -> Result<Self, FitError> {
        let range = match config.cut {
            Cut::Balanced => Range::Balanced,
            Cut::Epicentre | Cut::Minimum => Range::Level(levels.q()),
        };
        let count = config.segments;
        let fitted = minimax::segments(exponent, config.degree, count, range)?;
        let end = |index: usize| fitted.ends.get(index).or(fitted.ends.last()).copied();
        let last = end(usize::MAX).unwrap_or(1.0);
        // An x^n that is such a polynomial itself (n = 1, 2, 3) goes on in the other segments, so that v stays below 1.
        let alone = fitted.segments.len() == 1;
        let end = |index: usize| match alone {
            true => last * (index + 1) as f64 / count as f64,
            false => end(index).unwrap_or(1.0),
        };
        let centred = config.form == Form::Centred;
        let mut segments = Vec::with_capacity(count);
        let (mut start, mut start_s) = (config.input.one(), 0.0);
        for index in 0..count {
            let nothing = Segment { start: start_s, c: [0.0; MAX_DEGREE + 1] };
            let own = if alone { fitted.segments.first() } else { fitted.segments.get(index) };
            let polynomial = own.copied().unwrap_or(nothing);
            // The first counts from 1 as it is.
            let polynomial = if index == 0 { polynomial } else { polynomial.counted_from(start_s) };
            let shift = if centred { fitted_shift(end(index) - start_s) } else { 0 };
            segments.push(RealSegment { polynomial, start, shift });
            start = cut_bits(config, end(index));
            start_s = distance(config, start);
        }
        Ok(Self {
            exponent,
            epicentre: crate::fit::crossing(exponent, levels.q())?.s,
            segments,
            power: fitted.power,
            tail: None,
            cut: cut_bits(config, last),
        })
    }

    /// The row with its ends rounded to the stated formats of cut and hand-over. A further segment then counts from
    /// its new hand-over, and what was fitted to a length, polynomial and shift, is fitted to the new one, if there is
    /// one: so an end of few bits costs little more error.
    ///
    /// A cut moves down: a divider is never asked for more than Q, and a domain that lies above the cut of one
    /// configuration lies above that of another without the divider.
    #[must_use]
    pub(super) fn in_places(&self, config: &Config) -> Self {
        let in_place = |end: i64, format: Option<QFormat>, mode: Rounding| {
            format.map_or(end, |format| rounded_end(end, config.input, format, mode))
        };
        let hand_over = config.widths[Register::HandOver(1)];
        let cut = in_place(self.cut, config.widths[Register::Cut], Rounding::Floor);
        let mut moved = Self { cut, ..self.clone() };
        for segment in moved.segments.iter_mut().skip(1) {
            segment.start = in_place(segment.start, hand_over, Rounding::NearestEven);
        }
        if &moved == self {
            return moved;
        }
        let are_fitted = ends_are_fitted(config);
        let mut end = distance(config, cut);
        for (index, segment) in moved.segments.iter_mut().enumerate().rev() {
            let start = distance(config, segment.start);
            if index > 0 {
                segment.polynomial = segment.polynomial.counted_from(start);
            }
            if are_fitted && end - start > 0.0 {
                if config.form == Form::Centred {
                    segment.shift = fitted_shift(end - start);
                }
                if let Some(best) = minimax::between(self.exponent, config.degree, (start, end)) {
                    segment.polynomial = best.segments.first().copied().unwrap_or(segment.polynomial);
                    moved.power = if index == 0 { best.power } else { moved.power };
                }
            }
            end = start;
        }
        moved
    }

    /// The least x in the input's unit that lies on the epicentre, x ≥ q.
    #[must_use]
    pub fn first_of_epicentre(&self, config: &Config) -> i64 {
        cut_bits(config, self.epicentre)
    }

    /// The least x (in the input's unit) at which segment `index` answers: where the next one begins, or the cut.
    #[must_use]
    pub fn least_of_segment(&self, index: usize) -> i64 {
        self.segments.get(index + 1).map_or(self.cut, |next| next.start.max(self.cut))
    }

    /// The real function at x = 1 − s, with real coefficients, through the same parts as the
    /// hardware: the polynomials above the cut (clamped to [0, 1]), the ratio or zero below.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64, above_cut: bool) -> f64 {
        match (self.segments.split_first(), &self.tail) {
            (Some((first, further)), _) if above_cut => further
                .iter()
                .rev()
                .find(|segment| s > segment.polynomial.start)
                .unwrap_or(first)
                .polynomial
                .value_at_s(s)
                .clamp(0.0, 1.0),
            (_, Some(rational)) => rational.value_at_s(s),
            _ => 0.0,
        }
    }
}

/// s = 1 − x of bits of x.
fn distance(config: &Config, x: i64) -> f64 {
    (config.input.one() - x) as f64 * config.input.ulp()
}

/// Where the multipliers' operands are limited, u = s·2^e stays below 2 with room for its rounding, so that
/// it has one integer bit. On the epicentre it is below 1.36 anyway; further down `hermite` goes beyond at n = 4
/// only (2.75). `three_point` and `tangent` do at every fifth exponent, and being cut there they would
/// jump, so without such a limit the bit is spent.
const GREATEST_U: f64 = 2.0 - 1.0 / 128.0;

/// Where the polynomial is of no more use below the epicentre: s of its minimum (1 where it falls all
/// the way), or the s before it at which the polynomial has fallen to `nothing`.
///
/// With half an output ulp for `nothing`, what lies beyond is as well shown by 0.
fn lowest_s(cubic: &Cubic, epicentre: f64, nothing: f64) -> f64 {
    let minimum = cubic.centred.first_minimum().unwrap_or(1.0).clamp(epicentre, 1.0);
    if cubic.centred.value_at_s(minimum) >= nothing {
        return minimum;
    }
    // It falls from Q at the epicentre's end to the minimum, so it takes the value once in between.
    // 64 halvings reach neighbouring floats.
    let (mut above, mut below) = (epicentre, minimum);
    for _ in 0..64 {
        let middle = 0.5 * (above + below);
        if cubic.centred.value_at_s(middle) > nothing {
            above = middle;
        } else {
            below = middle;
        }
    }
    above
}

/// The least x in the input's unit with x ≥ 1 − s: 1 − ⌊s⌋ in that unit. s ≤ 1, so it is not negative.
fn cut_bits(config: &Config, s: f64) -> i64 {
    let floor = round_scaled(s, config.input.fraction_bits(), Rounding::Floor).unwrap_or(0);
    config.input.one() - floor as i64
}

/// True where the ends of the segments are part of the fit, and shifts follow from the lengths.
fn ends_are_fitted(config: &Config) -> bool {
    config.segments > 1 || config.cut == Cut::Balanced
}

/// The bits of an end in the input's unit, rounded to the last place of a format with no more fraction bits; at most 1.
fn rounded_end(end: i64, input: QFormat, format: QFormat, mode: Rounding) -> i64 {
    let dropped = input.fraction_bits() - format.fraction_bits();
    round_shift(end, dropped, mode) << dropped
}

/// The greatest e that keeps length·2^e below 1, with room for its rounding (0 where there is none);
/// 0 ≤ length ≤ 1. Below 1 the powers of u do not multiply the last bit of a coefficient. At most 62, for a
/// segment of no length.
fn fitted_shift(length: f64) -> u32 {
    const GREATEST: f64 = 1.0 - 1.0 / 128.0;
    if length > 0.0 { floor_log2((GREATEST / length).max(1.0)).min(62) } else { 62 }
}

/// ⌊log2 n⌋ from the binary exponent of n ≥ 1: exact, where a logarithm could round up.
fn floor_log2(n: f64) -> u32 {
    const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
    const BIAS: u32 = f64::MAX_EXP as u32 - 1;
    ((n.to_bits() >> FRACTION_BITS) as u32).saturating_sub(BIAS)
}

#[cfg(test)]
mod tests {
    use super::{RealRow, floor_log2};
    use crate::config::Config;
    use crate::highlight::phong_at_s;

    fn rows(fields: &str, widths: &str) -> Vec<RealRow> {
        let json = format!(
            r#"{{"name": "ends", "exponents": "1,2,5,40,1000", "input": "UQ1.12", "output": "UQ1.8",
                {fields}, "widths": {{{widths}}}}}"#
        );
        let config = Config::from_json(&json).unwrap();
        let levels = config.levels().unwrap();
        let row = |n| RealRow::new(&config, levels, n).unwrap().in_places(&config);
        config.exponents.iter().map(row).collect()
    }

    /// The greatest error of a segment from its start to `end`, in x's unit.
    fn greatest(row: &RealRow, index: usize, end: i64) -> f64 {
        let segment = row.segments[index];
        let error = |x: i64| {
            let s = (4096 - x) as f64 / 4096.0;
            (segment.polynomial.value_at_s(s) - phong_at_s(row.exponent, s)).abs()
        };
        (end..=segment.start).map(error).fold(0.0, f64::max)
    }

    #[test]
    fn ends_are_rounded_and_the_polynomials_are_the_best_between_them() {
        let fields = r#""method": "minimax", "segments": 2, "cut": "balanced""#;
        let narrow = rows(fields, r#""cut": "UQ1.6", "hand_over": "UQ1.4""#);
        let (mut moved, mut better) = (0, 0);
        for (wide, narrow) in rows(fields, "").into_iter().zip(narrow) {
            let hand_over = |row: &RealRow| row.segments[1].start;
            assert_eq!((narrow.cut % 64, hand_over(&narrow) % 256), (0, 0), "{narrow:?}");
            assert!((0..64).contains(&(wide.cut - narrow.cut)), "{narrow:?}");
            assert!((hand_over(&narrow) - hand_over(&wide)).abs() <= 128, "{narrow:?}");
            for (index, end) in [hand_over(&narrow), narrow.cut].into_iter().enumerate() {
                let [was, is] = [&wide, &narrow].map(|row| greatest(row, index, end));
                assert!(is <= was * (1.0 + 1e-6) + 1e-14, "segment {index}: {was:e} {is:e} {narrow:?}");
                better += u32::from(is < 0.9 * was);
            }
            moved += u32::from(hand_over(&narrow) != hand_over(&wide));
            let length = |end: i64| (4096 - end) as f64 / 4096.0;
            let [first, all] = [hand_over(&narrow), narrow.cut].map(length);
            for (length, shift) in [(first, narrow.segments[0].shift), (all - first, narrow.segments[1].shift)] {
                let u = length * f64::from(shift).exp2();
                let fits = u < 1.0 && 2.0 * u > 0.99;
                assert!(fits || length <= 0.0, "{length} {shift}");
            }
        }
        assert!(moved > 2 && better > 2, "{moved} hand-overs moved, {better} segments are better for it");
    }

    #[test]
    fn a_segment_that_is_rounded_away_keeps_its_shift() {
        for (fields, widths) in [
            (r#""method": "minimax", "segments": 2"#, r#""cut": "UQ1.2", "hand_over": "UQ1.2""#),
            (r#""method": "minimax", "cut": "balanced""#, r#""cut": "UQ1.0""#),
        ] {
            for (wide, narrow) in rows(fields, "").into_iter().zip(rows(fields, widths)) {
                let shifts =
                    |row: &RealRow| (row.segments[0].shift, row.segments.get(1).map_or(0, |outer| outer.shift));
                let ([was, is], n) = ([&wide, &narrow].map(shifts), wide.exponent);
                assert!(is.0 <= was.0.max(2) && is.1 <= was.1.max(2), "n = {n}: {was:?} {is:?}");
            }
        }
    }

    #[test]
    fn a_cut_moves_down() {
        for fields in [r#""tail": "rational""#, r#""cut": "minimum""#] {
            let fields = format!(r#""method": "hermite", {fields}"#);
            for (wide, narrow) in rows(&fields, "").into_iter().zip(rows(&fields, r#""cut": "UQ1.3""#)) {
                assert!((0..512).contains(&(wide.cut - narrow.cut)), "{narrow:?}");
            }
        }
    }

    #[test]
    fn the_shift_is_exact_beside_powers_of_two() {
        for e in 0..50 {
            let power = f64::from(e).exp2();
            assert_eq!(floor_log2(power), e as u32);
            assert_eq!(floor_log2(power.next_up()), e as u32);
            assert_eq!(floor_log2((2.0 * power).next_down()), e as u32);
        }
    }
}
