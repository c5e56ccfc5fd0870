//! Which bits of a register were seen to rise and to fall.

use hw_model::datapath::{Datapath, RankRegister};
use serde::Serialize;

use super::fixed::{Fixed, Known};
use crate::pipeline::Ranks;

/// A register of a rank, and what was seen of its bits.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RegisterBits {
    /// The name of the rank.
    pub rank: String,
    /// The name of the register.
    pub register: String,
    /// Its format.
    pub format: String,
    /// Its bits.
    pub width: u32,
    /// Bits that rose and fell.
    pub toggled: u32,
    /// Bits that cannot change, and the reason, which is the same for all of them.
    pub fixed: Vec<Bit>,
    /// Why those cannot.
    pub reason: Option<String>,
    /// Bits that did not rise and fall, and of which no reason is known.
    pub missed: Vec<Missed>,
}

/// A bit that cannot change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Bit {
    /// The bit, 0 the lowest.
    pub bit: u32,
    /// What it always is.
    pub always: u8,
}

/// A bit that was not seen to rise and fall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Missed {
    /// The bit, 0 the lowest.
    pub bit: u32,
    /// It was seen to be 0.
    pub zero: bool,
    /// It was seen to be 1.
    pub one: bool,
}

/// A register under watch.
pub(super) struct Watched {
    rank: usize,
    register: RankRegister,
    zeros: u64,
    ones: u64,
    rose: u64,
    fell: u64,
    last: Option<u64>,
}

impl Watched {
    /// Every register of every rank.
    pub(super) fn all(datapath: &Datapath) -> Vec<Self> {
        let of_rank = |rank| {
            let watch = move |register| Self { rank, register, zeros: 0, ones: 0, rose: 0, fell: 0, last: None };
            datapath.registers(rank).into_iter().map(watch)
        };
        (0..datapath.rank_count()).flat_map(of_rank).collect()
    }

    /// Looks at the register, where its rank holds a request.
    pub(super) fn see(&mut self, ranks: &Ranks<'_>) {
        if ranks.valid() >> self.rank & 1 == 0 {
            return;
        }
        let word = self.register.format.to_word(self.register.bits(&ranks.rank(self.rank).signals));
        self.zeros |= !word;
        self.ones |= word;
        if let Some(last) = self.last.replace(word) {
            self.rose |= word & !last;
            self.fell |= last & !word;
        }
    }

    /// What was seen, beside what can be.
    pub(super) fn judged(self, datapath: &Datapath, known: &Known<'_>) -> RegisterBits {
        let format = self.register.format;
        let width = format.width();
        let toggled = self.rose & self.fell;
        let known = known.fixed(self.rank, &self.register);
        let Fixed { mask, value, .. } = known.as_ref().map_or_else(Fixed::nothing, Clone::clone);
        let bits = |of: u64| (0..width).filter(move |bit| of >> bit & 1 == 1);
        let fixed: Vec<Bit> = bits(mask & !toggled).map(|bit| Bit { bit, always: (value >> bit & 1) as u8 }).collect();
        let missed = bits(!mask & !toggled).map(|bit| Missed {
            bit,
            zero: self.zeros >> bit & 1 == 1,
            one: self.ones >> bit & 1 == 1,
        });
        RegisterBits {
            rank: datapath.rank_name(self.rank),
            register: self.register.name().to_owned(),
            format: format.to_string(),
            width,
            toggled: bits(toggled).count() as u32,
            missed: missed.collect(),
            reason: known.map(|known| known.reason).filter(|_| !fixed.is_empty()),
            fixed,
        }
    }
}
