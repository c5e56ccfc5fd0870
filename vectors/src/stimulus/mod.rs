//! Generators of stimulus, one file for each way of choosing.
//!
//! They know nothing of checkers: they see the design, and give cases. The same design, strategy,
//! count and seed give the same cases in the same order, on every machine.

pub mod corners;
pub mod even;
pub mod exhaustive;
pub mod random;

use std::iter;

use hw_model::design::Design;

use crate::case::{Sample, Strategy};
use corners::Corners;

/// Corners take at most this share of a mixture (as a ratio), the even grid at most an eighth.
const CORNER_SHARE: (u64, u64) = (3, 4);
const EVEN_SHARE: (u64, u64) = (1, 8);

/// What a strategy will give: corners worked out, everything else yet to be generated.
#[derive(Debug, Clone)]
pub struct Stimulus<'a> {
    design: &'a Design,
    seed: u64,
    corners: Corners,
    even: u64,
    random: u64,
    exhaustive: bool,
}

impl<'a> Stimulus<'a> {
    /// `count` cases (fewer where the strategy has fewer, as [`Strategy::Corners`] may; all of them
    /// for [`Strategy::Exhaustive`]), in this order: corners, even grid, random.
    ///
    /// With `count` at least the ROM's depth, every word is met, whatever the strategy.
    #[must_use]
    pub fn new(design: &'a Design, strategy: Strategy, count: u64, seed: u64) -> Self {
        let mut stimulus = Self {
            design,
            seed,
            corners: Corners::default(),
            even: 0,
            random: 0,
            exhaustive: false,
        };
        match strategy {
            Strategy::Corners => stimulus.corners = Corners::new(design, count),
            Strategy::Even => stimulus.even = count,
            Strategy::Random => stimulus.random = count,
            Strategy::Exhaustive => stimulus.exhaustive = true,
            Strategy::Mixed => stimulus.mix(count),
        }
        stimulus
    }

    fn mix(&mut self, count: u64) {
        let part = |(times, of): (u64, u64)| count / of * times + count % of * times / of;
        let every_row = count.min(self.design.rom().depth() as u64);
        self.corners = Corners::new(self.design, part(CORNER_SHARE).max(every_row));
        let left = count - self.corners.samples().len() as u64;
        self.even = left.min(part(EVEN_SHARE));
        self.random = left - self.even;
    }

    /// How many cases there will be. (All addresses and x of a wide configuration exceed a `u64`.)
    #[must_use]
    pub fn len(&self) -> u128 {
        let all = if self.exhaustive { exhaustive::len(self.design) } else { 0 };
        all + self.corners.samples().len() as u128 + u128::from(self.even) + u128::from(self.random)
    }

    /// True when there will be none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The corners.
    #[must_use]
    pub const fn corners(&self) -> &Corners {
        &self.corners
    }

    /// Every case, one at a time.
    #[must_use]
    pub fn samples(&self) -> Box<dyn Iterator<Item = Sample> + '_> {
        if self.exhaustive {
            return Box::new(exhaustive::samples(self.design));
        }
        let random: Box<dyn Iterator<Item = Sample>> = match self.random {
            0 => Box::new(iter::empty()),
            count => Box::new(random::samples(self.design, count, self.seed)),
        };
        let corners = self.corners.samples().iter().copied();
        Box::new(corners.chain(even::samples(self.design, self.even)).chain(random))
    }
}
