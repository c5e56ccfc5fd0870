//! Error bounds of the polynomial: how much each register's fraction bits add.

use super::polynomial::{derivative, magnitude};
use super::{Bound, RowPolynomial};
use crate::format::power_of_two;
use crate::registers::{MAX_DEGREE, Register, Table};
use crate::rounding::Rounding;
use crate::steps::Steps;

/// The registers of a polynomial of this degree whose fraction bits the budget chooses, in the order in which they are
/// reported: the variable, the coefficients from the highest power down, the results of all stages but the last.
pub fn chosen(degree: usize) -> impl Iterator<Item = Register> {
    let coefficients = (0..=degree).rev().map(|power| Register::C(0, power));
    std::iter::once(Register::V).chain(coefficients).chain((1..degree).map(Register::T))
}

/// Fraction bits of every register that the budget chooses.
pub type FractionBits = Table<u32>;

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
    /// The greatest magnitude of each derivative, from the first on, on the row's region.
    slopes: [f64; MAX_DEGREE],
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
        let mut terms = horner(row.terms(), surroundings.centred);
        let slopes = std::array::from_fn(|_| {
            terms = derivative(&terms);
            magnitude(&terms, row.v)
        });
        Self { row, slopes }
    }

    /// The row whose errors are analysed.
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
        let error = self.variable_error(bits[Register::V], surroundings);
        let variable = self.shown(error);
        // The lines see the rounded variable, which may lie outside the region by its error.
        let v = self.row.v.1 + error;
        let coefficient = self.coefficient_bound(bits, v, surroundings);
        let rounding: f64 = self.roundings(bits, v, surroundings).sum();
        let ulp = power_of_two(-(surroundings.output as i32));
        Bound { coefficient: coefficient / ulp, datapath: (variable + rounding) / ulp, tail: 0.0 }
    }

    /// What each register adds to the bound, in output ulp, in the order of [`chosen`], and the
    /// rounding of the result last. Their sum is the bound.
    #[must_use]
    pub fn shares(&self, bits: &FractionBits, surroundings: &Surroundings) -> Vec<f64> {
        let degree = self.row.degree;
        if !self.row.answers {
            return vec![0.0; 2 * degree + 2];
        }
        let error = self.variable_error(bits[Register::V], surroundings);
        let v = self.row.v.1 + error;
        let moved = self.moved(bits);
        let coefficients = (0..=degree).rev().map(|power| times_power(moved[power], v, power));
        std::iter::once(self.shown(error))
            .chain(coefficients)
            .chain(self.roundings(bits, v, surroundings))
            .map(|share| share * power_of_two(surroundings.output as i32))
            .collect()
    }

    /// How the rounding of each stage shows in the result, for a variable of `v`: it is multiplied by it in each stage
    /// that follows.
    fn roundings<'a>(
        &self,
        bits: &'a FractionBits,
        v: f64,
        surroundings: &'a Surroundings,
    ) -> impl Iterator<Item = f64> + use<'a> {
        let degree = self.row.degree;
        (1..=degree).map(move |stage| {
            let multiplicand = if stage == 1 { Register::C(0, degree) } else { Register::T(stage - 1) };
            let product = bits[multiplicand] + bits[Register::V];
            let whole = product.max(bits[Register::C(0, degree - stage)]);
            let kept = if stage == degree { surroundings.output } else { bits[Register::T(stage)] };
            times_power(surroundings.rounding_error(kept, whole), v, degree - stage)
        })
    }

    /// How far the polynomial with the ROM's integers may be from the real one, for variables up to `v`.
    fn coefficient_bound(&self, bits: &FractionBits, v: f64, surroundings: &Surroundings) -> f64 {
        let apart = self.moved(bits).iter().rev().fold(0.0, |sum, error| sum * v + error);
        if self.row.steps == Steps::default() {
            return apart;
        }
        // Steps make up for each other, so that their sum says little: the difference of the polynomials is one
        // of the same degree, whose greatest magnitude is known. Real coefficients may be a place of 53 off.
        let difference: Vec<f64> = (0..=self.row.degree)
            .map(|power| {
                let scale = power_of_two(bits[Register::C(0, power)] as i32);
                let value = self.row.coefficients[power];
                let rounded = (value * scale).round_ties_even() + f64::from(self.row.steps[power]);
                rounded / scale - value
            })
            .collect();
        let slack: f64 = self.row.terms().iter().rev().fold(0.0, |sum, c| sum * v + c.abs());
        let terms = horner(&difference, surroundings.centred);
        (magnitude(&terms, (self.row.v.0, v)) + 4.0 * slack * f64::EPSILON).min(apart)
    }

    /// How far the ROM's coefficients of these fraction bits may be from the real ones.
    fn moved(&self, bits: &FractionBits) -> [f64; MAX_DEGREE + 1] {
        std::array::from_fn(|power| {
            if power > self.row.degree {
                return 0.0;
            }
            let fraction = bits[Register::C(0, power)];
            let steps = f64::from(self.row.steps[power].unsigned_abs());
            let step = steps * (-f64::from(fraction)).exp2();
            coefficient_error(self.row.coefficients[power], fraction) + step
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

    /// How an error of the variable shows in the result. Taylor's series of the polynomial ends here, so
    /// this is no approximation.
    fn shown(&self, error: f64) -> f64 {
        let [first, second, third, fourth] = self.slopes;
        let third = third + error * fourth / 4.0;
        error * (first + error * (second / 2.0 + error * third / 6.0))
    }
}

/// value·v^power, multiplied one by one.
fn times_power(value: f64, v: f64, power: usize) -> f64 {
    (0..power).fold(value, |product, _| product * v)
}

/// Half an ulp, or nothing where the format holds the value exactly; and what the f64 itself may be
/// away from the real coefficient, one place of 53 (a of the power form at n = 10⁶ is 10¹² large:
/// 10⁻⁴ of it are lost before the ROM's format is even chosen).
pub(super) fn coefficient_error(value: f64, fraction: u32) -> f64 {
    let scaled = value * f64::from(fraction).exp2();
    let quantised = if scaled == scaled.round() { 0.0 } else { 0.5 * (-f64::from(fraction)).exp2() };
    quantised + value.abs() * f64::EPSILON
}
