//! What each register adds to the error bound, and what one bit less of it would cost.

use super::polynomial::{pieces, stated, surroundings};
use super::real_row::RealRow;
use super::tail::row_tail;
use super::whole::Design;
use crate::budget::RowTail;
use crate::budget::error::{FractionBits, Sensitivity, chosen};
use crate::budget::tail::{TailWidths, shares};
use crate::registers::Register;

/// The part of one register in the error bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// The register: `u`, `c3` to `c0`, `t1`, `t2`, `t3`, `tail_a`, `tail_b`, `divisor`, `quotient`.
    pub register: &'static str,
    /// The most its rounding shows in the result over all rows, in output ulp.
    pub ulp: f64,
    /// The exponent of the row where it shows most.
    pub exponent: f64,
    /// The worst row's whole bound with a fraction bit less, in output ulp; A, B and D give up theirs
    /// together. None where the number of bits is not the budget's to choose.
    pub one_bit_fewer: Option<f64>,
}

impl Share {
    const fn new(register: &'static str) -> Self {
        Self { register, ulp: 0.0, exponent: f64::NAN, one_bit_fewer: None }
    }

    fn raise(&mut self, ulp: f64, exponent: f64) {
        if self.exponent.is_nan() || ulp > self.ulp {
            (self.ulp, self.exponent) = (ulp, exponent);
        }
    }
}

impl Design {
    /// The part of every register in the error bound; registers that the configuration does not have
    /// are left out. Of one row of one segment they add up to its [`bounds`](Self::bounds), or to more where
    /// coefficients are moved by steps, which make up for each other.
    #[must_use]
    pub fn error_shares(&self) -> Vec<Share> {
        let mut all = self.polynomial_shares();
        all.extend(self.tail_shares());
        all
    }

    fn polynomial_shares(&self) -> Vec<Share> {
        let Some(formats) = &self.datapath.formats().polynomial else { return Vec::new() };
        let config = &self.config;
        let surroundings = surroundings(config);
        let rows: Vec<Sensitivity> =
            pieces(config, &self.rows).iter().map(|piece| Sensitivity::of(piece.row, &surroundings)).collect();
        let registers: Vec<Register> = chosen(formats.degree()).collect();
        let mut bits = FractionBits::default();
        for &register in &registers {
            let format = self.datapath.formats().get(register);
            bits[register] = format.map_or(0, |format| format.fraction_bits());
        }
        let last = Register::T(formats.degree());
        let names = registers.iter().map(|&register| match register {
            Register::V => "u",
            other => other.name(),
        });
        let mut all: Vec<Share> = names.chain([last.name()]).map(Share::new).collect();
        for row in &rows {
            let shares = row.shares(&bits, &surroundings);
            for (share, ulp) in all.iter_mut().zip(shares) {
                share.raise(ulp, row.row().exponent);
            }
        }
        for (share, &register) in all.iter_mut().zip(&registers) {
            let chosen = stated(config, register).is_none() && bits[register] > 0;
            share.one_bit_fewer = chosen.then(|| {
                let mut fewer = bits;
                fewer[register] -= 1;
                let bounds = rows.iter().map(|row| row.bound(&fewer, &surroundings).total());
                bounds.fold(0.0, f64::max)
            });
        }
        // x is no register of its own.
        if !surroundings.centred {
            all.remove(0);
        }
        all
    }

    fn tail_shares(&self) -> Vec<Share> {
        let Some(formats) = &self.datapath.formats().tail else { return Vec::new() };
        let widths = TailWidths { a: formats.a, b: formats.b, divisor: formats.divisor };
        let surroundings = surroundings(&self.config);
        let mut all = ["tail_a", "tail_b", "divisor", "quotient"].map(Share::new);
        let mut worst = 0.0_f64;
        let rows: Vec<RowTail> = of_rows(&self.rows, |row| row_tail(&self.config, row)).collect();
        for row in &rows {
            let of = |fewer| shares(row, &widths, fewer, surroundings.input, &surroundings);
            for (share, ulp) in all.iter_mut().zip(of(0)) {
                share.raise(ulp, row.exponent);
            }
            worst = worst.max(of(1).iter().sum());
        }
        let stated = &self.config.widths;
        let chosen = [Register::TailA, Register::TailB, Register::Divisor].map(|r| stated[r].is_none());
        for (share, chosen) in all.iter_mut().zip(chosen) {
            share.one_bit_fewer = chosen.then_some(worst);
        }
        all.to_vec()
    }
}

fn of_rows<'a, T: 'a>(rows: &'a [RealRow], of: impl Fn(&RealRow) -> Option<T> + 'a) -> impl Iterator<Item = T> + 'a {
    rows.iter().filter_map(of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::presets;

    #[test]
    fn the_shares_of_a_row_are_its_bound() {
        for preset in presets::ALL {
            let design = Design::new(preset.config().unwrap()).unwrap();
            let one_row = |exponent: f64| {
                let mut config = design.config().clone();
                config.exponents = exponent.to_string().parse().unwrap();
                // The same formats for one row as for all of them.
                config.widths = design.widths().with(Register::Cut, None).with(Register::HandOver(1), None);
                Design::new(config).unwrap()
            };
            for exponent in [1.0, 2.0, 37.0, 256.0] {
                let design = one_row(exponent);
                let (polynomial, tail) = (design.polynomial_shares(), design.tail_shares());
                let sum = |shares: &[Share]| shares.iter().map(|share| share.ulp).sum::<f64>();
                let bound = design.bounds()[0];
                let epicentre = bound.coefficient + bound.datapath;
                // Of two segments the worse one counts for each register, and one of them for the bound.
                let two = design.datapath().segment_count() > 1;
                let over = sum(&polynomial) - epicentre;
                assert!(over > -1e-9 && over < if two { 0.5 } else { 1e-9 }, "{}", preset.name);
                assert!((sum(&tail) - bound.tail).abs() < 1e-9, "{}", preset.name);
            }
        }
    }

    #[test]
    fn no_bit_that_the_budget_chose_can_be_spared() {
        for preset in presets::ALL {
            let design = Design::new(preset.config().unwrap()).unwrap();
            let budget = design.config().error_budget_ulp;
            for share in design.error_shares() {
                assert!(share.one_bit_fewer.is_none_or(|worst| worst > budget), "{share:?}");
            }
        }
    }
}
