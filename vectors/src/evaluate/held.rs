//! What the registers of a rank hold, for people.

use hw_model::datapath::{Datapath, RankRegister, Signals};
use hw_model::format::QFormat;
use hw_model::quantise::{decimal, real};

use super::answer::Question;
use crate::table::hex;

/// A register of a rank with what it holds.
#[derive(Debug, Clone)]
pub struct Held {
    /// The register.
    pub register: RankRegister,
    /// What it holds: bits in the register's format.
    pub bits: i64,
}

impl Held {
    /// Every register of a rank, with what these signals hold of it, in the order of traces.
    #[must_use]
    pub fn of_rank(datapath: &Datapath, rank: usize, signals: &Signals) -> Vec<Self> {
        let registers = datapath.registers(rank).into_iter();
        registers.map(|register| Self { bits: register.bits(signals), register }).collect()
    }

    /// The same of every rank, the first one first, as a question passes through on its own.
    #[must_use]
    pub fn of_question(datapath: &Datapath, question: &Question) -> Vec<Vec<Self>> {
        let passage = datapath.passage(question.address, question.x);
        passage.iter().enumerate().map(|(rank, signals)| Self::of_rank(datapath, rank, signals)).collect()
    }

    /// The register's name, without its rank.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.register.name()
    }

    /// The format of the bits.
    #[must_use]
    pub const fn format(&self) -> QFormat {
        self.register.format
    }

    /// The word in hex, after `0x`.
    #[must_use]
    pub fn hex(&self) -> String {
        hex(self.bits, self.format())
    }

    /// Every bit of the word, the highest first. The point stands before the last
    /// [`fraction_bits`](QFormat::fraction_bits) of them, or outside.
    #[must_use]
    pub fn binary(&self) -> String {
        format!("{:01$b}", self.format().to_word(self.bits), self.format().width() as usize)
    }

    /// The real number that the bits mean.
    #[must_use]
    pub fn value(&self) -> f64 {
        real(self.bits, self.format())
    }

    /// The same number with all its decimals.
    #[must_use]
    pub fn decimal(&self) -> String {
        decimal(self.bits, self.format())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_model::design::Design;

    #[test]
    fn a_word_is_the_same_in_every_notation() {
        let design = Design::preset("paper").unwrap();
        let datapath = design.datapath();
        let question = Question::of(datapath.rom(), 64.0, 8_304_722);
        let ranks = Held::of_question(datapath, &question);
        assert_eq!(ranks.len(), datapath.rank_count());
        let mut negative = 0;
        for held in ranks.iter().flatten() {
            let word = u64::from_str_radix(&held.binary(), 2).unwrap();
            assert_eq!(held.binary().len() as u32, held.format().width());
            assert_eq!(held.format().from_word(word), held.bits);
            let digits = held.format().width().div_ceil(4) as usize;
            assert_eq!(held.hex(), format!("0x{word:0digits$x}"));
            assert_eq!(held.decimal().parse::<f64>().unwrap(), held.value());
            negative += u32::from(held.bits < 0);
        }
        assert!(negative > 0, "two's complement was seen");
        assert_eq!(ranks[0][0].name(), "x");
    }
}
