//! The fraction bits: generous at first, then taken away where a bit saves most for its error.

use super::error::{FractionBits, Sensitivity, Surroundings, chosen, horner};
use super::polynomial::{extremes, magnitude};
use super::{Bound, BudgetError, RowPolynomial};
use crate::format::MAX_WIDTH;
use crate::registers::{Register, Table};

/// Fraction bits beyond the output's that the search starts from. Errors of ½ ulp at 2^−14 of an
/// output ulp are nothing; a register that needs more has a row with V or S in the thousands, which
/// the normalising shift rules out.
const GENEROUS: u32 = 14;

/// How many ROM bits weigh as much as one multiplier bit. A choice, not a measurement: a 4 Kbit block RAM
/// then weighs a quarter of a 16×16 multiplier.
const ROM_BITS_PER_MULTIPLIER_BIT: f64 = 64.0;

/// The search's view of a configuration.
pub struct Search<'a> {
    /// The degree of every row.
    pub degree: usize,
    /// One for each row.
    pub sensitivities: &'a [Sensitivity],
    /// Formats around the polynomial.
    pub surroundings: Surroundings,
    /// Fraction bits that are stated, by register.
    pub pinned: Table<Option<u32>>,
    /// The widest operand of a multiplier, where the configuration states one.
    pub operand_bits: Option<u32>,
    /// The error budget, in output ulp.
    pub budget: f64,
}

impl Search<'_> {
    /// The fraction bits of every register.
    ///
    /// # Errors
    /// When the budget cannot be kept even by generous widths, or by the stated ones.
    pub fn run(&self) -> Result<FractionBits, BudgetError> {
        let integer = self.integer_bits();
        let mut bits = self.start(&integer);
        let (worst, exponent) = self.worst(&bits);
        if worst > self.budget {
            // In the power form V is x, and no format is stated for it.
            let counts = |register| register != Register::V || self.surroundings.centred;
            let pinned = chosen(self.degree).any(|r| counts(r) && self.pinned[r].is_some());
            return Err(BudgetError::NotKept {
                budget: self.budget,
                what: match self.operand_bits {
                    Some(_) => "the widest operands within multiplier_operand_bits",
                    None if pinned => "the stated widths",
                    None => "even generous widths",
                },
                needed: worst,
                exponent,
            });
        }
        while let Some(next) = self.best_step(&bits, &integer) {
            bits = next;
        }
        Ok(bits)
    }

    /// The worst row's error in output ulp, and its exponent.
    fn worst(&self, bits: &FractionBits) -> (f64, f64) {
        self.sensitivities
            .iter()
            .map(|row| (row.bound(bits, &self.surroundings).total(), row.row().exponent))
            .fold((0.0, 1.0), |worst, row| if row.0 > worst.0 { row } else { worst })
    }

    fn start(&self, integer: &Table<i32>) -> FractionBits {
        let mut bits = FractionBits::default();
        for register in chosen(self.degree) {
            let integer = integer[register];
            // Two bits of the width stay free for a sign and a rounding carry.
            let widest = MAX_WIDTH as i32 - 2 - integer.max(0);
            let room = widest.min(self.operand_room(register, integer)).max(0) as u32;
            let generous = match register {
                Register::V => self.surroundings.input,
                _ => self.surroundings.output + GENEROUS,
            };
            bits[register] = self.pinned[register].unwrap_or(generous.min(room));
        }
        bits
    }

    /// Fraction bits that the width of a multiplier leaves to a register with these integer bits.
    fn operand_room(&self, register: Register, integer: i32) -> i32 {
        match self.operand_bits {
            Some(bits) if self.is_multiplied(register) => {
                bits as i32 - integer - i32::from(self.falls_below_zero(register))
            }
            _ => i32::MAX,
        }
    }

    /// True for the operands of the multipliers: the variable, the highest coefficient, and what stages but the last
    /// give.
    fn is_multiplied(&self, register: Register) -> bool {
        match register {
            Register::V | Register::T(_) => true,
            Register::C(_, power) => power == self.degree,
            _ => false,
        }
    }

    /// True where a multiplied register takes a sign.
    fn falls_below_zero(&self, register: Register) -> bool {
        self.sensitivities.iter().any(|sensitivity| {
            let row = sensitivity.row();
            let least = |terms: &[f64]| extremes(&horner(terms, self.surroundings.centred), row.v).0;
            let low = match register {
                Register::C(_, power) if power == self.degree => row.coefficients[power],
                Register::T(stage) => least(partial(row, stage)),
                _ => 0.0,
            };
            low < 0.0
        })
    }

    /// Integer bits (signs aside) of every register, to weigh the cost of its fraction bits.
    fn integer_bits(&self) -> Table<i32> {
        let mut integer = Table::default();
        for register in chosen(self.degree) {
            let magnitudes =
                self.sensitivities.iter().map(|row| register_magnitude(row.row(), register, self.surroundings.centred));
            let greatest = magnitudes.fold(0.0, f64::max);
            integer[register] = if greatest > 0.0 { greatest.log2().floor() as i32 + 1 } else { 0 };
        }
        integer
    }

    /// Multiplier bits, and ROM bits at their price.
    fn cost(&self, bits: &FractionBits, integer: &Table<i32>) -> f64 {
        let width = |register: Register| f64::from((bits[register] as i32 + integer[register]).max(0));
        let highest = width(Register::C(0, self.degree));
        let multiplicands = (1..self.degree).fold(highest, |sum, t| sum + width(Register::T(t)));
        let word: f64 = (0..=self.degree).rev().map(|power| width(Register::C(0, power))).sum();
        let rom = self.sensitivities.len() as f64 * word;
        width(Register::V) * multiplicands + rom / ROM_BITS_PER_MULTIPLIER_BIT
    }

    /// The bits with one taken away, where that keeps the budget and saves most for its error.
    fn best_step(&self, bits: &FractionBits, integer: &Table<i32>) -> Option<FractionBits> {
        let (error, cost) = (self.worst(bits).0, self.cost(bits, integer));
        let mut best = None;
        for register in chosen(self.degree) {
            let taken_as_it_comes = register == Register::V && !self.surroundings.centred;
            if self.pinned[register].is_some() || bits[register] == 0 || taken_as_it_comes {
                continue;
            }
            let mut fewer = *bits;
            fewer[register] -= 1;
            let error_after = self.worst(&fewer).0;
            if error_after > self.budget {
                continue;
            }
            // A hundredth of a millionth of an ulp keeps a step that adds no error finite.
            let added = (error_after - error).max(0.0) + 1e-8;
            let gain = (cost - self.cost(&fewer, integer)) / added;
            if best.is_none_or(|(most, _)| gain > most) {
                best = Some((gain, fewer));
            }
        }
        best.map(|(_, bits)| bits)
    }

    /// The bound of each row with these fraction bits.
    #[must_use]
    pub fn bounds(&self, bits: &FractionBits) -> Vec<Bound> {
        self.sensitivities.iter().map(|row| row.bound(bits, &self.surroundings)).collect()
    }
}

/// The terms that stage `stage` has summed: those from its own addend up.
fn partial(row: &RowPolynomial, stage: usize) -> &[f64] {
    &row.terms()[row.degree - stage..]
}

/// The greatest magnitude of a register on the row's region.
fn register_magnitude(row: &RowPolynomial, register: Register, subtract: bool) -> f64 {
    match register {
        Register::V => row.v.1.abs(),
        Register::C(_, power) => row.coefficients[power].abs(),
        Register::T(stage) => magnitude(&horner(partial(row, stage), subtract), row.v),
        _ => 0.0,
    }
}
