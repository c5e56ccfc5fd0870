//! Where a configuration puts ranks of registers beyond those that every pipeline has.
//!
//! Every pipeline has a rank behind the ROM's memory, one behind the front end, one behind each multiply-add, those of
//! the divider and one behind the clamp. A clock that is too fast for what lies between two of them wants more:
//!
//! ```text
//! ROM ─ [rom] ─ compare ─ [front_end] ─ choose, shift, round ─ v ─┐
//!     ┌───────────────────────────────────────────────────────────┘
//!     └ per multiply-add: [operands] ─ multiply ─ [product] ─ add ─ [sum] ─ round ─ t
//! ```
//!
//! What is computed stays the same in every bit; what changes is in which cycle a register shows it.

use serde::{Deserialize, Serialize};

use crate::handshake::ReadySlice;

/// Ranks of registers beyond the least, by the part that they cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pipelining {
    /// A register behind the ROM's own, so that nothing but a wire stands behind the memory.
    pub rom: bool,
    /// Ranks inside the front end, 0 or 1: behind the comparisons of x, and the distances computed beside them.
    pub front_end: u32,
    /// A register before each multiplier, which only copies its operands.
    pub operands: bool,
    /// Ranks behind each multiplier: 1 holds the whole product; 2 hold the products of pieces of the operands, the
    /// lower ones of [`PIECE`] bits, and then the whole.
    pub product: u32,
    /// A register behind each sum, before it is rounded.
    pub sum: bool,
    /// A register slice of two entries at one end, which takes ready off every path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ready_slice: Option<ReadySlice>,
}

/// Bits of the pieces in which operands are multiplied where the product takes two ranks: what a block multiplies.
pub const PIECE: u32 = 18;

/// A step of a multiply-add that ends in a rank of registers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineStep {
    /// The operands are copied.
    Operands,
    /// The products of pieces of the operands.
    Partial,
    /// The product, whole.
    Product,
    /// The sum, before it is rounded.
    Sum,
    /// The result.
    Result,
}

impl Pipelining {
    /// True where a pipeline has the least ranks.
    #[must_use]
    pub fn is_least(&self) -> bool {
        *self == Self::default()
    }

    /// What can be checked without a data path.
    ///
    /// # Errors
    /// Says what would be right.
    pub fn check(&self) -> Result<(), String> {
        if self.front_end > 1 {
            return Err("\"front_end\" is the number of ranks inside the front end: use 0 or 1".to_owned());
        }
        if self.product > 2 {
            return Err("\"product\" is the number of ranks behind a multiplier: use 0, 1 or 2".to_owned());
        }
        Ok(())
    }

    /// The rank that compares x with the cut, counted from 0.
    #[inline(always)]
    #[must_use]
    pub const fn compare_rank(&self) -> usize {
        1 + self.rom as usize
    }

    /// The rank behind the front end, which holds the variable.
    #[inline(always)]
    #[must_use]
    pub const fn front_end_rank(&self) -> usize {
        self.compare_rank() + self.front_end as usize
    }

    /// Ranks before the multiply-adds.
    #[inline(always)]
    #[must_use]
    pub const fn head_ranks(&self) -> usize {
        self.front_end_rank() + 1
    }

    /// Ranks of a multiply-add.
    #[inline(always)]
    #[must_use]
    pub const fn line_ranks(&self) -> usize {
        self.operands as usize + self.product as usize + self.sum as usize + 1
    }

    /// What rank `index` (0 is the first) of a multiply-add takes in.
    #[must_use]
    pub fn line_step(&self, index: usize) -> LineStep {
        let steps = [
            (LineStep::Operands, self.operands as usize),
            (LineStep::Partial, usize::from(self.product > 1)),
            (LineStep::Product, usize::from(self.product > 0)),
            (LineStep::Sum, self.sum as usize),
        ];
        let all = steps.into_iter().flat_map(|(step, ranks)| std::iter::repeat_n(step, ranks));
        all.chain([LineStep::Result]).nth(index).unwrap_or(LineStep::Result)
    }
}
