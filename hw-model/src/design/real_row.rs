//! The real functions behind one ROM row.

use crate::config::{Config, Cut, Form, Tail};
use crate::fit::minimax::{self, Range};
use crate::fit::{Curve, FitError, Levels, Method, fit};
use crate::format::QFormat;
use crate::highlight::{Cubic, Rational, Segment};
use crate::quantise::round_scaled;
use crate::rounding::{Rounding, round_shift};

/// What one row means in real numbers, and where its parts meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RealRow {
    /// The row's exponent n, 1 or more.
    pub exponent: f64,
    /// p = 1 − q: the epicentre is 0 ≤ s ≤ p in s = 1 − x.
    pub epicentre: f64,
    /// The polynomial, or its first segment; none for schlick.
    pub polynomial: Option<Cubic>,
    /// The second segment, where there is one: it starts at `hand_over`.
    pub outer: Option<Outer>,
    /// What the divider computes, where the configuration keeps one.
    pub tail: Option<Rational>,
    /// The least x (in the input's unit) at which the polynomial answers.
    pub cut: i64,
    /// The least x (in the input's unit) at which the first segment answers; the cut where it is the only one,
    /// and 0 in a configuration of one segment.
    pub hand_over: i64,
    /// e = ⌊log2 n⌋ in the centred form (with a range fitted to the error, the greatest that keeps u below 1), 0
    /// in the power form.
    pub shift: u32,
}

/// The second segment of a row, which answers between the cut and the hand-over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outer {
    /// The cubic, counted from the hand-over.
    pub segment: Segment,
    /// The places its v is moved up, so that it stays below 1.
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
        let cut = cut_bits(config, cut_s);
        Ok(Self { exponent, epicentre, polynomial, outer: None, tail, cut, hand_over: 0, shift })
    }

    /// The row of minimax segments whose ends are part of the fit.
    fn fitted(config: &Config, levels: Levels, exponent: f64) -> Result<Self, FitError> {
        let range = match config.cut {
            Cut::Balanced => Range::Balanced,
            Cut::Epicentre | Cut::Minimum => Range::Level(levels.q()),
        };
        let fitted = minimax::segments(exponent, config.segments as usize, range)?;
        let end = |index: usize| fitted.ends.get(index).or(fitted.ends.last()).copied();
        let last = end(usize::MAX).unwrap_or(1.0);
        let alone = config.segments > 1 && fitted.further.is_empty();
        // An x^n that is a cubic itself (n = 1, 2, 3) goes on in the second segment, so that u stays below 1.
        let first = if alone { 0.5 * last } else { end(0).unwrap_or(1.0) };
        let hand_over = cut_bits(config, first);
        let start = (config.input.one() - hand_over) as f64 * config.input.ulp();
        let k = fitted.first.centred;
        let same = Segment { start: 0.0, c: [1.0, k.k1, k.k2, k.k3] };
        let further = fitted.further.first().or(alone.then_some(&same));
        let outer = further.map(|segment| Outer {
            segment: segment.counted_from(start),
            shift: fitted_shift(last - start),
        });
        let centred = config.form == Form::Centred;
        Ok(Self {
            exponent,
            epicentre: crate::fit::crossing(exponent, levels.q())?.s,
            polynomial: Some(fitted.first),
            outer,
            tail: None,
            cut: cut_bits(config, last),
            hand_over: if config.segments > 1 { hand_over } else { 0 },
            shift: if centred { fitted_shift(first) } else { 0 },
        })
    }

    /// The row with its ends rounded to the stated formats of cut and hand-over. The second segment then counts from
    /// the new hand-over, and a shift that was fitted to a length is fitted to the new one, if there is one.
    ///
    /// A cut moves down: a divider is never asked for more than Q, and a domain that lies above the cut of one
    /// configuration lies above that of another without the divider.
    #[must_use]
    pub(super) fn in_places(&self, config: &Config) -> Self {
        let in_place = |end: i64, format: Option<QFormat>, mode: Rounding| {
            format.map_or(end, |format| rounded_end(end, config.input, format, mode))
        };
        let cut = in_place(self.cut, config.widths.cut, Rounding::Floor);
        let hand_over = in_place(self.hand_over, config.widths.hand_over, Rounding::NearestEven);
        if (cut, hand_over) == (self.cut, self.hand_over) {
            return *self;
        }
        let length = |end: i64| (config.input.one() - end) as f64 * config.input.ulp();
        let is_fitted = config.form == Form::Centred && ends_are_fitted(config);
        let refitted = |length: f64, shift: u32| match is_fitted && length > 0.0 {
            true => fitted_shift(length),
            false => shift,
        };
        let outer = self.outer.map(|outer| Outer {
            segment: outer.segment.counted_from(length(hand_over)),
            shift: refitted(length(cut) - length(hand_over), outer.shift),
        });
        let first = length(if self.outer.is_some() { hand_over } else { cut });
        Self { cut, hand_over, outer, shift: refitted(first, self.shift), ..*self }
    }

    /// The least x in the input's unit that lies on the epicentre, x ≥ q.
    #[must_use]
    pub fn first_of_epicentre(&self, config: &Config) -> i64 {
        cut_bits(config, self.epicentre)
    }

    /// The real function at x = 1 − s, with real coefficients, through the same parts as the
    /// hardware: the polynomial above the cut (clamped to [0, 1]), the ratio or zero below.
    #[must_use]
    #[inline]
    pub fn value_at_s(&self, s: f64, above_cut: bool) -> f64 {
        match (&self.polynomial, &self.tail) {
            (Some(cubic), _) if above_cut => match &self.outer {
                Some(Outer { segment, .. }) if s > segment.start => segment.value_at_s(s),
                _ => cubic.centred.value_at_s(s),
            }
            .clamp(0.0, 1.0),
            (_, Some(rational)) => rational.value_at_s(s),
            _ => 0.0,
        }
    }
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

    #[test]
    fn ends_are_rounded_and_the_polynomials_stay() {
        let fields = r#""method": "minimax", "segments": 2, "cut": "balanced""#;
        let narrow = rows(fields, r#""cut": "UQ1.6", "hand_over": "UQ1.4""#);
        let mut moved = 0;
        for (wide, narrow) in rows(fields, "").into_iter().zip(narrow) {
            assert_eq!((narrow.cut % 64, narrow.hand_over % 256), (0, 0), "{narrow:?}");
            assert!((0..64).contains(&(wide.cut - narrow.cut)), "{narrow:?}");
            assert!((narrow.hand_over - wide.hand_over).abs() <= 128, "{narrow:?}");
            moved += u32::from(narrow.hand_over != wide.hand_over);
            for s in [0.0, 0.01, 0.2, 0.7, 1.0] {
                let [was, is] =
                    [&wide, &narrow].map(|row| row.outer.unwrap().segment.value_at_s(s));
                assert!((was - is).abs() <= 1e-9 * was.abs().max(1.0), "{was} {is}");
            }
            let length = |end: i64| (4096 - end) as f64 / 4096.0;
            let [first, all] = [narrow.hand_over, narrow.cut].map(length);
            for (length, shift) in
                [(first, narrow.shift), (all - first, narrow.outer.unwrap().shift)]
            {
                let u = length * f64::from(shift).exp2();
                let fits = u < 1.0 && 2.0 * u > 0.99;
                assert!(fits || length <= 0.0, "{length} {shift}");
            }
        }
        assert!(moved > 2, "{moved} hand-overs moved");
    }

    #[test]
    fn a_segment_that_is_rounded_away_keeps_its_shift() {
        for (fields, widths) in [
            (r#""method": "minimax", "segments": 2"#, r#""cut": "UQ1.2", "hand_over": "UQ1.2""#),
            (r#""method": "minimax", "cut": "balanced""#, r#""cut": "UQ1.0""#),
        ] {
            for (wide, narrow) in rows(fields, "").into_iter().zip(rows(fields, widths)) {
                let shifts = |row: &RealRow| (row.shift, row.outer.map_or(0, |outer| outer.shift));
                let ([was, is], n) = ([&wide, &narrow].map(shifts), wide.exponent);
                assert!(is.0 <= was.0.max(2) && is.1 <= was.1.max(2), "n = {n}: {was:?} {is:?}");
            }
        }
    }

    #[test]
    fn a_cut_moves_down() {
        for fields in [r#""tail": "rational""#, r#""cut": "minimum""#] {
            let fields = format!(r#""method": "hermite", {fields}"#);
            for (wide, narrow) in
                rows(&fields, "").into_iter().zip(rows(&fields, r#""cut": "UQ1.3""#))
            {
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
