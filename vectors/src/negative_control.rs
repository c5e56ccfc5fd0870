//! The negative control: expected answers of which one is wrong on purpose.
//!
//! A testbench that compares nothing passes as well as one that compares everything. Run with
//! `negative_control.mem` in the place of `expected.mem` it must fail, at this vector and at no other.

use hw_model::datapath::Datapath;
use serde::{Deserialize, Serialize};

use crate::packing::WordLayout;
use crate::stimulus::random::Dice;

/// The wrong answer of a bundle.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NegativeControl {
    /// The vector, counted from 0.
    pub vector: u64,
    /// The bit of the intensity that is flipped; 0 is the lowest.
    pub bit: u32,
    /// The word of the golden model, in hex digits.
    pub expected: String,
    /// The word that stands in its place.
    pub corrupted: String,
}

/// Which bit of which vector is flipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Flip {
    /// The vector, counted from 0.
    pub vector: u64,
    /// The bit of the intensity.
    pub bit: u32,
}

impl Flip {
    /// Drawn from the bundle's seed, for a bundle of `vectors` ≥ 1. (Inverted, the seed gives another stream
    /// than the one that the random cases are drawn from.)
    #[must_use]
    pub fn draw(datapath: &Datapath, vectors: u64, seed: u64) -> Self {
        let mut dice = Dice::new(!seed);
        let vector = dice.below(vectors.max(1));
        let bit = dice.below(datapath.formats().output.width().into()) as u32;
        Self { vector, bit }
    }

    /// The word of the wrong answer: the intensity lies at the bottom of the word.
    #[must_use]
    pub const fn corrupt(self, word: u128) -> u128 {
        word ^ 1 << self.bit
    }

    /// What the manifest says of it, given the right word.
    #[must_use]
    pub fn record(self, layout: &WordLayout, word: u128) -> NegativeControl {
        let hex = |word: u128| format!("{word:00$x}", layout.digits());
        let Self { vector, bit } = self;
        NegativeControl { vector, bit, expected: hex(word), corrupted: hex(self.corrupt(word)) }
    }
}
