//! The naive model: the pipeline once more, in exact rationals.
//!
//! It is written from the description, not from the code, and shares no arithmetic with the golden
//! model: every value is a ratio of two big integers, a register is such a ratio rounded by looking
//! at what the floor leaves over, and the divider is one exact quotient. Of a design it takes only
//! data: the configuration, the formats of the registers, and the integers of the ROM.
//!
//! Where the description leaves something open, the golden model's documented contract is followed:
//!
//! - a part that does not answer is fed a harmless x: the polynomial u = 0, or in the power form the
//!   greatest x the input format has in [0, 1]; the divider 0;
//! - an address without a ROM word reads the first row, and the region makes its intensity 0;
//! - the clamp of an output format that does not reach 1 is its greatest value;
//! - D is rounded once to its own format, and the quotient x/D once more to the output.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

use hw_model::config::{Config, Form, Tail};
use hw_model::datapath::formats::Formats;
use hw_model::design::Design;
use hw_model::fit::Method;
use hw_model::format::QFormat;
use hw_model::registers::Register;
use hw_model::rom::Row;
use hw_model::rounding::Rounding;
use num_bigint::BigInt;
use num_integer::Integer;

/// Bits of the status port, as the table of flags gives them.
pub const NO_WORD: u8 = 1;
/// The flag of an x above 1.
pub const ABOVE_ONE: u8 = 2;
/// The flag of an x below 0.
pub const FACING_AWAY: u8 = 4;
/// The polynomial left [0, 1].
pub const CLAMPED: u8 = 8;

/// x outside the domain of its exponent.
pub const OUT_OF_DOMAIN: u8 = 16;

/// An exact ratio; not reduced, the denominator positive.
#[derive(Debug, Clone)]
pub struct Exact {
    numerator: BigInt,
    denominator: BigInt,
}

impl Exact {
    /// numerator/denominator.
    ///
    /// # Panics
    /// When the denominator is not positive.
    #[must_use]
    pub fn ratio(numerator: BigInt, denominator: BigInt) -> Self {
        assert!(denominator > BigInt::ZERO, "a denominator is positive");
        Self { numerator, denominator }
    }

    /// The exact number bits/2^fraction.
    #[must_use]
    pub fn of_bits(bits: impl Into<BigInt>, fraction: u32) -> Self {
        Self::ratio(bits.into(), power_of_two(fraction))
    }

    /// The value of a finite f64.
    ///
    /// # Panics
    /// When it is not finite.
    #[must_use]
    pub fn of_f64(value: f64) -> Self {
        assert!(value.is_finite(), "{value} has no exact value");
        let bits = value.to_bits();
        let fraction = BigInt::from(bits % (1 << 52));
        let biased = (bits >> 52) as u32 % 2048;
        let (magnitude, biased) = match biased {
            0 => (fraction, 1),
            _ => (fraction + power_of_two(52), biased),
        };
        let signed = if value < 0.0 { -magnitude } else { magnitude };
        // A unit of the fraction is 2^(biased − 1075).
        Self::ratio(signed * power_of_two(biased), power_of_two(1075))
    }

    /// The integer that `mode` chooses.
    #[must_use]
    pub fn rounded(&self, mode: Rounding) -> BigInt {
        let below = self.numerator.div_floor(&self.denominator);
        // What the floor leaves over, twice: against the denominator it is the comparison with 1/2.
        let left_over = &self.numerator - &below * &self.denominator;
        let twice = &left_over * 2;
        let above_wanted = match mode {
            Rounding::Floor => false,
            Rounding::NearestUp => twice >= self.denominator,
            Rounding::NearestEven => twice > self.denominator || (twice == self.denominator && below.is_odd()),
            Rounding::TowardZero => self.numerator < BigInt::ZERO && left_over != BigInt::ZERO,
        };
        if above_wanted { below + 1 } else { below }
    }

    /// The bits of a register with this many fraction bits that the value is rounded into.
    #[must_use]
    pub fn into_register(&self, fraction: u32, mode: Rounding) -> BigInt {
        let scaled = &self.numerator * power_of_two(fraction);
        Self::ratio(scaled, self.denominator.clone()).rounded(mode)
    }

    /// Which of the two is greater.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        (&self.numerator * &other.denominator).cmp(&(&other.numerator * &self.denominator))
    }

    /// The difference, without its sign.
    #[must_use]
    pub fn distance(&self, other: &Self) -> Self {
        let difference = self.clone() - other.clone();
        let numerator = difference.numerator.magnitude().clone().into();
        Self::ratio(numerator, difference.denominator)
    }

    /// The quotient.
    ///
    /// # Panics
    /// When the divisor is not positive.
    #[must_use]
    pub fn divided_by(&self, divisor: &Self) -> Self {
        Self::ratio(&self.numerator * &divisor.denominator, &self.denominator * &divisor.numerator)
    }
}

fn power_of_two(exponent: u32) -> BigInt {
    BigInt::from(2).pow(exponent)
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let numerator = self.numerator * &other.denominator + other.numerator * &self.denominator;
        Self::ratio(numerator, self.denominator * other.denominator)
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let numerator = self.numerator * &other.denominator - other.numerator * &self.denominator;
        Self::ratio(numerator, self.denominator * other.denominator)
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::ratio(self.numerator * other.numerator, self.denominator * other.denominator)
    }
}

/// What the registers of the polynomial hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lines {
    /// The variable of the polynomial, x or u.
    pub v: BigInt,
    /// After each stage, the last before the clamp.
    pub t: Vec<BigInt>,
}

/// Everything the naive model says about one input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answer {
    /// The polynomial's registers, where the configuration has a polynomial.
    pub lines: Option<Lines>,
    /// D, where the configuration has a divider.
    pub divisor: Option<BigInt>,
    /// `zero`, `polynomial` or `tail`.
    pub region: &'static str,
    /// The intensity, bits in the output format.
    pub intensity: BigInt,
    /// The flags, one bit each.
    pub status: u8,
}

/// The naive model of a design.
#[derive(Debug)]
pub struct Naive<'a> {
    config: &'a Config,
    formats: &'a Formats,
    rows: &'a [Row],
}

impl<'a> Naive<'a> {
    /// Takes the data of a design.
    #[must_use]
    pub fn new(design: &'a Design) -> Self {
        Self { config: design.config(), formats: design.datapath().formats(), rows: design.rom().rows() }
    }

    /// What the hardware does with (address, x).
    #[must_use]
    pub fn answer(&self, address: u32, x: i64) -> Answer {
        let row = self.rows.get(address as usize);
        let above_one = BigInt::from(x) > power_of_two(self.formats.input.fraction_bits());
        let mut status = 0;
        status |= if row.is_none() { NO_WORD } else { 0 };
        status |= if above_one { ABOVE_ONE } else { 0 };
        status |= if x < 0 { FACING_AWAY } else { 0 };

        status |= if self.is_refused(address, x) { OUT_OF_DOMAIN } else { 0 };

        let greatest = greatest_in_unit_interval(self.formats.input);
        let clamped = BigInt::from(x).clamp(BigInt::ZERO, greatest.clone());
        let region = self.region(row, x);
        let row = row.or(self.rows.first()).copied().unwrap_or_default();

        // u = 0 is x = 1, which the input format need not reach.
        let harmless = match self.config.form {
            Form::Power => greatest,
            Form::Centred => power_of_two(self.formats.input.fraction_bits()),
        };
        let polynomial_x = if region == "polynomial" { &clamped } else { &harmless };
        let segment = if region == "polynomial" { self.segment(&row, polynomial_x) } else { 0 };
        let lines = self.lines(&row, polynomial_x, segment);
        let tail_x = if region == "tail" { clamped } else { BigInt::ZERO };
        let divisor = self.divisor(&row, &tail_x);

        let one = greatest_in_unit_interval(self.formats.output);
        let intensity = match (region, &lines, &divisor) {
            ("polynomial", Some(lines), _) => {
                let polynomial = lines.t.last().cloned().unwrap_or_default();
                let intensity = polynomial.clone().clamp(BigInt::ZERO, one);
                status |= if intensity == polynomial { 0 } else { CLAMPED };
                intensity
            }
            ("tail", _, Some(divisor)) => self.quotient(tail_x, divisor).min(one),
            _ => BigInt::ZERO,
        };
        Answer { lines, divisor, region, intensity, status }
    }

    /// True where the configuration has a domain, and x lies below the last x of the input format that is not above
    /// its beginning.
    fn is_refused(&self, address: u32, x: i64) -> bool {
        self.config.domain.get(address as usize).is_some_and(|presented| {
            let fraction = self.formats.input.fraction_bits();
            let first = Exact::of_f64(presented.least).into_register(fraction, Rounding::Floor);
            x >= 0 && BigInt::from(x) < first
        })
    }

    /// A cut or hand-over in the input's unit.
    fn end(&self, row: &Row, name: Register, format: Option<QFormat>) -> BigInt {
        let input = self.formats.input.fraction_bits();
        let fraction = format.map_or(input, |format| format.fraction_bits());
        BigInt::from(row.get(name)) * power_of_two(input - fraction)
    }

    fn region(&self, row: Option<&Row>, x: i64) -> &'static str {
        let Some(row) = row else { return "zero" };
        let polynomial = self.config.method != Method::Schlick;
        if x < 0 {
            "zero"
        } else if polynomial && BigInt::from(x) >= self.end(row, Register::Cut, self.formats.cut) {
            "polynomial"
        } else if self.config.tail == Tail::Rational {
            "tail"
        } else {
            "zero"
        }
    }

    /// The furthest segment whose hand-over lies above x; the first where none does.
    fn segment(&self, row: &Row, x: &BigInt) -> usize {
        let begins = |segment| self.end(row, Register::HandOver(segment), self.formats.hand_over);
        (1..self.config.segments).filter(|&segment| begins(segment) > *x).max().unwrap_or(0)
    }

    /// Power form, of a cubic: t1 = c2 + c3·x, t2 = c1 + t1·x, t3 = c0 + t2·x. Centred form: the same with minus,
    /// and u = (1 − x)·2^e for x; in a further segment (hand-over − x)·2^e, with coefficients and e of
    /// its own. Every register is rounded once.
    fn lines(&self, row: &Row, x: &BigInt, segment: usize) -> Option<Lines> {
        let formats = self.formats.polynomial.as_ref()?;
        let mode = self.config.rounding;
        let input = self.formats.input.fraction_bits();
        let x = Exact::of_bits(x.clone(), input);
        let start = match segment {
            0 => Exact::of_bits(1, 0),
            _ => {
                let end = self.end(row, Register::HandOver(segment), self.formats.hand_over);
                Exact::of_bits(end, input)
            }
        };
        let v = match self.config.form {
            Form::Power => x,
            Form::Centred => {
                let shift = row.get(Register::Shift(segment));
                let shift = u32::try_from(shift).expect("a shift is a count");
                (start - x) * Exact::of_bits(power_of_two(shift), 0)
            }
        };
        let (v_bits, v) = register(&v, formats.v.fraction_bits(), mode);
        let degree = self.config.degree;
        let coefficient = |power: usize| {
            let fraction = formats.coefficients()[power].fraction_bits();
            Exact::of_bits(row.get(Register::C(segment, power)), fraction)
        };
        let mut value = coefficient(degree);
        let mut t = Vec::new();
        for power in (0..degree).rev() {
            let product = value * v.clone();
            let sum = match self.config.form {
                Form::Power => coefficient(power) + product,
                Form::Centred => coefficient(power) - product,
            };
            let fraction = match power {
                0 => self.formats.output.fraction_bits(),
                _ => formats.t()[degree - 1 - power].fraction_bits(),
            };
            let (bits, rounded) = register(&sum, fraction, mode);
            t.push(bits);
            value = rounded;
        }
        Some(Lines { v: v_bits, t })
    }

    /// D = A − B·x, rounded once.
    fn divisor(&self, row: &Row, x: &BigInt) -> Option<BigInt> {
        let formats = self.formats.tail.as_ref()?;
        let coefficient = |name, format: QFormat| Exact::of_bits(row.get(name), format.fraction_bits());
        let a = coefficient(Register::TailA, formats.a);
        let b = coefficient(Register::TailB, formats.b);
        let x = Exact::of_bits(x.clone(), self.formats.input.fraction_bits());
        let (bits, _) = register(&(a - b * x), formats.divisor.fraction_bits(), self.config.rounding);
        Some(bits)
    }

    /// x/D, rounded once.
    fn quotient(&self, x: BigInt, divisor: &BigInt) -> BigInt {
        let formats = self.formats.tail.as_ref().expect("a tail answers with a divider");
        let x = Exact::of_bits(x, self.formats.input.fraction_bits());
        let divisor = Exact::of_bits(divisor.clone(), formats.divisor.fraction_bits());
        x.divided_by(&divisor).into_register(self.formats.output.fraction_bits(), self.config.rounding)
    }
}

/// The bits a value is rounded into, and the value those bits have.
fn register(value: &Exact, fraction: u32, mode: Rounding) -> (BigInt, Exact) {
    let bits = value.into_register(fraction, mode);
    let held = Exact::of_bits(bits.clone(), fraction);
    (bits, held)
}

/// 1 in the format's unit, or the greatest value of a format that does not reach 1.
fn greatest_in_unit_interval(format: QFormat) -> BigInt {
    let magnitude_bits = format.width() - u32::from(format.is_signed());
    let greatest: BigInt = power_of_two(magnitude_bits) - 1;
    greatest.min(power_of_two(format.fraction_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_four_modes_by_hand() {
        // −1½, −¼, ½, ¾, 1½, 2½
        let quarters = [-6, -1, 2, 3, 6, 10];
        for (mode, wanted) in [
            (Rounding::Floor, [-2, -1, 0, 0, 1, 2]),
            (Rounding::NearestUp, [-1, 0, 1, 1, 2, 3]),
            (Rounding::NearestEven, [-2, 0, 0, 1, 2, 2]),
            (Rounding::TowardZero, [-1, 0, 0, 0, 1, 2]),
        ] {
            let got = quarters.map(|value| Exact::of_bits(value, 2).rounded(mode));
            assert_eq!(got, wanted.map(BigInt::from), "{mode}");
        }
    }

    #[test]
    fn an_f64_keeps_its_value() {
        for (value, numerator, fraction) in [(0.75, 3, 2), (-5.0, -5, 0), (0.0, 0, 0)] {
            let difference = Exact::of_f64(value) - Exact::of_bits(numerator, fraction);
            assert_eq!(difference.numerator, BigInt::ZERO, "{value}");
        }
        let least = Exact::of_f64(5e-324) - Exact::of_bits(1, 1074);
        assert_eq!(least.numerator, BigInt::ZERO);
    }
}
