//! The fraction bits: generous at first, then taken away where a bit saves most for its error.

use super::error::{FractionBits, Register, Sensitivity, Surroundings, horner};
use super::polynomial::{extremes, magnitude};
use super::{Bound, BudgetError, RowPolynomial};
use crate::format::MAX_WIDTH;

/// Fraction bits beyond the output's that the search starts from. Errors of ½ ulp at 2^−14 of an
/// output ulp are nothing; a register that needs more has a row with V or S in the thousands, which
/// the normalising shift rules out.
const GENEROUS: u32 = 14;

/// How many ROM bits weigh as much as one multiplier bit. A choice, not a measurement: a 4 Kbit block RAM
/// then weighs a quarter of a 16×16 multiplier.
const ROM_BITS_PER_MULTIPLIER_BIT: f64 = 64.0;

/// The search's view of a configuration.
pub struct Search<'a> {
    /// One for each row.
    pub sensitivities: &'a [Sensitivity],
    /// Formats around the polynomial.
    pub surroundings: Surroundings,
    /// Fraction bits that are stated, by register.
    pub pinned: [Option<u32>; Register::ALL.len()],
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
            let own = usize::from(!self.surroundings.centred);
            let pinned = self.pinned[own..].iter().any(Option::is_some);
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

    fn start(&self, integer: &[i32; Register::ALL.len()]) -> FractionBits {
        let mut bits = [0; Register::ALL.len()];
        for (index, register) in Register::ALL.into_iter().enumerate() {
            // Two bits of the width stay free for a sign and a rounding carry.
            let widest = MAX_WIDTH as i32 - 2 - integer[index].max(0);
            let room = widest.min(self.operand_room(register, integer[index])).max(0) as u32;
            let generous = match register {
                Register::V => self.surroundings.input,
                _ => self.surroundings.output + GENEROUS,
            };
            bits[index] = self.pinned[index].unwrap_or(generous.min(room));
        }
        bits
    }

    /// Fraction bits that the width of a multiplier leaves to a register with these integer bits.
    fn operand_room(&self, register: Register, integer: i32) -> i32 {
        let multiplied =
            matches!(register, Register::V | Register::C3 | Register::T1 | Register::T2);
        match self.operand_bits {
            Some(bits) if multiplied => {
                bits as i32 - integer - i32::from(self.falls_below_zero(register))
            }
            _ => i32::MAX,
        }
    }

    /// True where the register takes a sign.
    fn falls_below_zero(&self, register: Register) -> bool {
        self.sensitivities.iter().any(|sensitivity| {
            let row = sensitivity.row();
            let [_, c1, c2, c3] = row.coefficients;
            let least =
                |terms: &[f64]| extremes(&horner(terms, self.surroundings.centred), row.v).0;
            let low = match register {
                Register::C3 => c3,
                Register::T1 => least(&[c2, c3]),
                Register::T2 => least(&[c1, c2, c3]),
                _ => 0.0,
            };
            low < 0.0
        })
    }

    /// Integer bits (signs aside) of every register, to weigh the cost of its fraction bits.
    fn integer_bits(&self) -> [i32; Register::ALL.len()] {
        let mut greatest = [0.0_f64; Register::ALL.len()];
        for sensitivity in self.sensitivities {
            let values = register_magnitudes(sensitivity.row(), self.surroundings.centred);
            for (most, value) in greatest.iter_mut().zip(values) {
                *most = most.max(value);
            }
        }
        greatest.map(|value| if value > 0.0 { value.log2().floor() as i32 + 1 } else { 0 })
    }

    /// Multiplier bits, and ROM bits at their price.
    fn cost(&self, bits: &FractionBits, integer: &[i32; Register::ALL.len()]) -> f64 {
        let width = |register: Register| {
            f64::from((bits[register as usize] as i32 + integer[register as usize]).max(0))
        };
        let multiplicands = width(Register::C3) + width(Register::T1) + width(Register::T2);
        let word = [Register::C3, Register::C2, Register::C1, Register::C0].map(width);
        let rom = self.sensitivities.len() as f64 * word.iter().sum::<f64>();
        width(Register::V) * multiplicands + rom / ROM_BITS_PER_MULTIPLIER_BIT
    }

    /// The bits with one taken away, where that keeps the budget and saves most for its error.
    fn best_step(
        &self,
        bits: &FractionBits,
        integer: &[i32; Register::ALL.len()],
    ) -> Option<FractionBits> {
        let (error, cost) = (self.worst(bits).0, self.cost(bits, integer));
        let mut best = None;
        for (index, register) in Register::ALL.into_iter().enumerate() {
            let taken_as_it_comes = register == Register::V && !self.surroundings.centred;
            if self.pinned[index].is_some() || bits[index] == 0 || taken_as_it_comes {
                continue;
            }
            let mut fewer = *bits;
            fewer[index] -= 1;
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

/// The greatest magnitude of v, c3, c2, c1, c0, t1, t2 on the row's region.
fn register_magnitudes(row: &RowPolynomial, subtract: bool) -> [f64; Register::ALL.len()] {
    let [c0, c1, c2, c3] = row.coefficients;
    let on_region = |terms: &[f64]| magnitude(&horner(terms, subtract), row.v);
    [
        row.v.1.abs(),
        c3.abs(),
        c2.abs(),
        c1.abs(),
        c0.abs(),
        on_region(&[c2, c3]),
        on_region(&[c1, c2, c3]),
    ]
}
