//! Error bounds of the polynomial: how much each register's fraction bits add.

use super::polynomial::{derivative, magnitude};
use super::{Bound, RowPolynomial};
use crate::quantise::power_of_two;
use crate::rounding::Rounding;

/// The registers whose fraction bits the budget chooses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Register {
    /// The variable, u (x is taken as it comes).
    V,
    /// Coefficient of v³.
    C3,
    /// Coefficient of v².
    C2,
    /// Coefficient of v.
    C1,
    /// Constant coefficient.
    C0,
    /// Result of stage 1.
    T1,
    /// Result of stage 2.
    T2,
}

impl Register {
    /// Every register, in the order of [`FractionBits`].
    pub const ALL: [Self; 7] =
        [Self::V, Self::C3, Self::C2, Self::C1, Self::C0, Self::T1, Self::T2];

    /// The name used in configurations and messages.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::V => "u",
            Self::C3 => "c3",
            Self::C2 => "c2",
            Self::C1 => "c1",
            Self::C0 => "c0",
            Self::T1 => "t1",
            Self::T2 => "t2",
        }
    }
}

/// Fraction bits of every register, indexed by [`Register`].
pub type FractionBits = [u32; Register::ALL.len()];

/// The power coefficients of a Horner chain over `terms` (constant term first): where each stage
/// subtracts, every odd power changes sign.
pub(super) fn horner(terms: &[f64], subtract: bool) -> Vec<f64> {
    let sign = |power: usize| {
        if subtract && power % 2 == 1 { -1.0 } else { 1.0 }
    };
    terms.iter().enumerate().map(|(power, term)| sign(power) * term).collect()
}

/// How strongly an error in each register shows in the result of one row.
#[derive(Debug, Clone, Copy)]
pub struct Sensitivity {
    row: RowPolynomial,
    /// The greatest |f′|, |f″| and |f‴| on the row's region.
    slopes: [f64; 3],
}

/// What the formats are between: input and output fraction bits, form and rounding.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings {
    /// Fraction bits of x.
    pub input: u32,
    /// Fraction bits of the intensity.
    pub output: u32,
    /// True in the centred form.
    pub centred: bool,
    /// The rounding of every line.
    pub rounding: Rounding,
}

impl Surroundings {
    /// The greatest error of a rounding line that keeps `fraction` bits.
    pub(crate) fn line_error(&self, fraction: u32) -> f64 {
        let ulp = power_of_two(-(fraction as i32));
        if self.rounding.is_nearest() { 0.5 * ulp } else { ulp }
    }

    /// The same for a line whose exact value has `whole` fraction bits: nothing where all are kept.
    pub(crate) fn rounding_error(&self, fraction: u32, whole: u32) -> f64 {
        if fraction >= whole { 0.0 } else { self.line_error(fraction) }
    }
}

impl Sensitivity {
    /// The sensitivity of a row.
    #[must_use]
    pub fn of(row: RowPolynomial, surroundings: &Surroundings) -> Self {
        let first = derivative(&horner(&row.coefficients, surroundings.centred));
        let second = derivative(&first);
        let third = derivative(&second);
        Self { row, slopes: [first, second, third].map(|slope| magnitude(&slope, row.v)) }
    }

    /// The row.
    #[must_use]
    pub const fn row(&self) -> &RowPolynomial {
        &self.row
    }

    /// The error bounds of the row, in output ulp.
    #[must_use]
    pub fn bound(&self, bits: &FractionBits, surroundings: &Surroundings) -> Bound {
        if !self.row.answers {
            return Bound::default();
        }
        let [v_bits, c3, c2, c1, c0, t1, t2] = *bits;
        let error = self.variable_error(v_bits, surroundings);
        let variable = self.shown(error);
        // The lines see the rounded variable, which may lie outside the region by its error.
        let v = self.row.v.1 + error;
        let coefficient = self.coefficient_bound([c0, c1, c2, c3], v, surroundings);
        let rounding = surroundings.rounding_error(t1, (c3 + v_bits).max(c2)) * v * v
            + surroundings.rounding_error(t2, (t1 + v_bits).max(c1)) * v
            + surroundings.rounding_error(surroundings.output, (t2 + v_bits).max(c0));
        let ulp = power_of_two(-(surroundings.output as i32));
        Bound { coefficient: coefficient / ulp, datapath: (variable + rounding) / ulp, tail: 0.0 }
    }

    /// What each register adds to the bound, in output ulp, in the order of [`Register::ALL`], and the
    /// rounding of the result last. Their sum is the bound.
    #[must_use]
    pub fn shares(&self, bits: &FractionBits, surroundings: &Surroundings) -> [f64; 8] {
        if !self.row.answers {
            return [0.0; 8];
        }
        let [v_bits, c3, c2, c1, c0, t1, t2] = *bits;
        let error = self.variable_error(v_bits, surroundings);
        let v = self.row.v.1 + error;
        let [e0, e1, e2, e3] = self.moved([c0, c1, c2, c3]);
        let shares = [
            self.shown(error),
            e3 * v * v * v,
            e2 * v * v,
            e1 * v,
            e0,
            surroundings.rounding_error(t1, (c3 + v_bits).max(c2)) * v * v,
            surroundings.rounding_error(t2, (t1 + v_bits).max(c1)) * v,
            surroundings.rounding_error(surroundings.output, (t2 + v_bits).max(c0)),
        ];
        shares.map(|share| share * power_of_two(surroundings.output as i32))
    }

    /// How far the polynomial with the ROM's integers may be from the real one, for variables up to `v`.
    fn coefficient_bound(&self, fractions: [u32; 4], v: f64, surroundings: &Surroundings) -> f64 {
        let apart = self.moved(fractions).iter().rev().fold(0.0, |sum, error| sum * v + error);
        if self.row.steps == [0; 4] {
            return apart;
        }
        // Steps make up for each other, so that their sum says little: the difference of the polynomials is one
        // of degree 3, whose greatest magnitude is known. Real coefficients may be a place of 53 off.
        let difference: [f64; 4] = std::array::from_fn(|power| {
            let (value, scale) =
                (self.row.coefficients[power], power_of_two(fractions[power] as i32));
            let rounded = (value * scale).round_ties_even() + f64::from(self.row.steps[power]);
            rounded / scale - value
        });
        let slack: f64 = self.row.coefficients.iter().rev().fold(0.0, |sum, c| sum * v + c.abs());
        let terms = horner(&difference, surroundings.centred);
        (magnitude(&terms, (self.row.v.0, v)) + 4.0 * slack * f64::EPSILON).min(apart)
    }

    /// How far the ROM's c0, c1, c2, c3 of these fraction bits may be from the real ones.
    fn moved(&self, fractions: [u32; 4]) -> [f64; 4] {
        std::array::from_fn(|power| {
            let steps = f64::from(self.row.steps[power].unsigned_abs());
            let step = steps * power_of_two(-(fractions[power] as i32));
            coefficient_error(self.row.coefficients[power], fractions[power]) + step
        })
    }

    /// The greatest error of the variable by its rounding.
    fn variable_error(&self, v_bits: u32, surroundings: &Surroundings) -> f64 {
        if surroundings.centred {
            let whole = surroundings.input.saturating_sub(self.row.shift);
            surroundings.rounding_error(v_bits, whole)
        } else {
            0.0
        }
    }

    /// How an error of the variable shows in the result. Taylor's series of the cubic ends here, so
    /// this is no approximation.
    fn shown(&self, error: f64) -> f64 {
        let [first, second, third] = self.slopes;
        error * (first + error * (second / 2.0 + error * third / 6.0))
    }
}

/// Half an ulp, or nothing where the format holds the value exactly; and what the f64 itself may be
/// away from the real coefficient, one place of 53 (a of the power form at n = 10⁶ is 10¹² large:
/// 10⁻⁴ of it are lost before the ROM's format is even chosen).
pub(super) fn coefficient_error(value: f64, fraction: u32) -> f64 {
    let scaled = value * power_of_two(fraction as i32);
    let quantised =
        if scaled == scaled.round() { 0.0 } else { 0.5 * power_of_two(-(fraction as i32)) };
    quantised + value.abs() * f64::EPSILON
}
