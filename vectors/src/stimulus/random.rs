//! Seeded random cases.
//!
//! The generator is ChaCha with 8 rounds; its 32-byte key is the seed, little-endian, followed by
//! zeros. Integers below a bound are drawn by masking a 64-bit word to the bound's bits and drawing
//! again while it is too large: no value is likelier than another, and nothing depends on a
//! library's way of sampling.
//!
//! The first cases visit every row once, in random order. After them one address in 64 has no ROM
//! word. Of every eight x, on average, four lie anywhere in [0, 1], three in the epicentre (which for
//! a large exponent is a sliver next to 1 that an even draw would never hit), and one anywhere in
//! the input format, so above 1 and below 0 where the format reaches there.

use std::ops::RangeInclusive;

use hw_model::design::Design;
use hw_model::quantise::round_scaled;
use hw_model::rounding::Rounding;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::case::{Case, Sample};
use crate::kind::Kind;

/// One address in this many has no ROM word.
const NO_WORD_ONE_IN: u64 = 64;

/// `count` cases drawn from `seed`.
pub fn samples(design: &Design, count: u64, seed: u64) -> impl Iterator<Item = Sample> + '_ {
    let rom = design.rom();
    let mut dice = Dice::new(seed);
    let order = dice.permutation(rom.depth() as u32);
    (0..count as usize).map(move |index| {
        let address = match order.get(index) {
            Some(&address) => address,
            None => any_address(design, &mut dice),
        };
        let x = any_x(design, address, &mut dice);
        Sample { case: Case::at(rom, address, x), kind: Kind::Random }
    })
}

fn any_address(design: &Design, dice: &mut Dice) -> u32 {
    let rom = design.rom();
    let depth = rom.depth() as u64;
    let address = if dice.below(NO_WORD_ONE_IN) == 0 {
        // The port has at least one address more than the ROM has words.
        depth + dice.below((1 << rom.address_width()) - depth)
    } else {
        dice.below(depth)
    };
    address as u32
}

fn any_x(design: &Design, address: u32, dice: &mut Dice) -> i64 {
    let input = design.config().input;
    let greatest = design.datapath().front_end().greatest;
    let range = match dice.below(8) {
        0..=3 => 0..=greatest,
        4..=6 => epicentre(design, address)..=greatest,
        _ => input.min_bits()..=input.max_bits(),
    };
    dice.within(range)
}

/// The least x of the row's epicentre; 0 for an address without a row.
fn epicentre(design: &Design, address: u32) -> i64 {
    let input = design.config().input;
    let greatest = design.datapath().front_end().greatest;
    design.rows().get(address as usize).map_or(0, |row| {
        // p lies in (0, 1), so it rounds to 0..=one.
        let p = round_scaled(row.epicentre, input.fraction_bits(), Rounding::NearestEven);
        (input.one() - p.unwrap_or(0) as i64).clamp(0, greatest)
    })
}

/// A source of unbiased integers.
#[derive(Debug)]
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// A source whose key is the seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        Self(ChaCha8Rng::from_seed(key))
    }

    /// An integer in `0..bound`; `bound` is at least 1.
    pub fn below(&mut self, bound: u64) -> u64 {
        let mask = u64::MAX >> ((bound - 1) | 1).leading_zeros();
        loop {
            let drawn = self.0.next_u64() & mask;
            if drawn < bound {
                return drawn;
            }
        }
    }

    /// An integer of the range, which is not empty and, like every format, within 63 bits.
    pub fn within(&mut self, range: RangeInclusive<i64>) -> i64 {
        let (low, high) = range.into_inner();
        low + self.below((high - low) as u64 + 1) as i64
    }

    /// `0..count` in random order (Fisher and Yates).
    fn permutation(&mut self, count: u32) -> Vec<u32> {
        let mut order: Vec<u32> = (0..count).collect();
        for last in (1..order.len()).rev() {
            order.swap(last, self.below(last as u64 + 1) as usize);
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_is_met_and_never_passed() {
        let mut dice = Dice::new(3);
        for bound in [1, 2, 3, 5, 8, 100] {
            let mut hits = vec![0_u32; bound as usize];
            for _ in 0..1000 * bound {
                hits[dice.below(bound) as usize] += 1;
            }
            // 1000 expected, standard deviation below 32.
            assert!(hits.iter().all(|hits| (800..1200).contains(hits)), "{bound}: {hits:?}");
        }
    }

    #[test]
    fn the_stream_is_the_published_one() {
        // ChaCha8, 256-bit key of zeros, first 16 bytes: 3e00ef2f895f40d6 7f5bb8e81f09a5a1.
        let mut dice = Dice::new(0);
        assert_eq!(dice.0.next_u64(), 0xd640_5f89_2fef_003e);
        assert_eq!(dice.0.next_u64(), 0xa1a5_091f_e8b8_5b7f);
        assert_ne!(Dice::new(1).0.next_u64(), Dice::new(2).0.next_u64());
    }

    #[test]
    fn a_permutation_has_everything_once() {
        let mut order = Dice::new(9).permutation(100);
        assert!(order.windows(2).any(|pair| pair[0] > pair[1]));
        order.sort_unstable();
        assert_eq!(order, (0..100).collect::<Vec<_>>());
    }
}
