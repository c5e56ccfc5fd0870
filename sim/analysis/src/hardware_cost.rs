//! What a configuration costs, as far as its own description says: nothing is synthesised here.

use std::fmt;

use hw_model::design::Design;

/// A multiplier: the widths of its operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Multiplier(pub u32, pub u32);

impl fmt::Display for Multiplier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.0, self.1)
    }
}

/// The cost of a configuration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HardwareCost {
    /// Clock cycles from request to result.
    pub latency: u64,
    /// Every multiplier: the three stages', then the divisor's.
    pub multipliers: Vec<Multiplier>,
    /// Bits of the divider: quotient digits times the width of what is subtracted for each. 0 without one.
    pub divider_bits: u64,
    /// Bits of the ROM.
    pub rom_bits: u64,
}

impl HardwareCost {
    /// The cost of this design.
    #[must_use]
    pub fn of(design: &Design) -> Self {
        let datapath = design.datapath();
        let divider_bits = match (datapath.divider(), &datapath.formats().tail) {
            (Some(divider), Some(tail)) => u64::from(divider.digit_count) * u64::from(tail.divisor.width()),
            _ => 0,
        };
        Self {
            latency: datapath.latency() as u64,
            multipliers: multipliers(design),
            divider_bits,
            rom_bits: design.rom().bits(),
        }
    }

    /// Partial-product bits of all multipliers: the product of the operands' widths, summed.
    #[must_use]
    pub fn multiplier_bits(&self) -> u64 {
        self.multipliers.iter().map(|Multiplier(a, b)| u64::from(*a) * u64::from(*b)).sum()
    }
}

/// The operand widths of every multiplier.
#[must_use]
pub fn multipliers(design: &Design) -> Vec<Multiplier> {
    let formats = design.datapath().formats();
    let polynomial = formats.polynomial.iter().flat_map(|polynomial| {
        let v = polynomial.v.width();
        (1..=polynomial.degree()).map(move |stage| Multiplier(polynomial.multiplicand(stage).width(), v))
    });
    let divisor = formats.tail.iter().map(|tail| Multiplier(tail.b.width(), formats.input.width()));
    polynomial.chain(divisor).collect()
}
