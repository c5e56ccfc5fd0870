//! Generators of stimulus, one file for each way of choosing.
//!
//! They know nothing of checkers: they see the design, and give cases. The same design, strategy,
//! count and seed give the same cases in the same order, on every machine.

pub mod corners;
pub mod even;
pub mod exhaustive;
pub mod random;
mod rounds;
pub mod targets;

use std::iter;

use hw_model::design::Design;

use crate::case::{Case, Sample, Strategy};
use crate::faults::{Compact, OneByOne, Workers};
use crate::kind::Kind;
use corners::Corners;
use targets::Targets;

/// Targets and corners take at most this share of a mixture (as a ratio; more where there are more targets),
/// the even grid at most an eighth.
const CORNER_SHARE: (u64, u64) = (3, 4);
const EVEN_SHARE: (u64, u64) = (1, 8);

/// What a strategy will give: targets and corners worked out, everything else yet to be generated.
#[derive(Debug, Clone)]
pub struct Stimulus<'a> {
    design: &'a Design,
    seed: u64,
    listed: Vec<Sample>,
    compact: Option<Compact>,
    targets: Targets,
    corners: Corners,
    even: u64,
    random: u64,
    exhaustive: bool,
}

impl<'a> Stimulus<'a> {
    /// `count` cases (fewer where the strategy has fewer, as [`Strategy::Corners`] may; as many as are
    /// needed for [`Strategy::Compact`]; all of them for [`Strategy::Exhaustive`]), in this order:
    /// targets, corners, even grid, random.
    ///
    /// With `count` at least the ROM's depth, every word is met, whatever the strategy.
    #[must_use]
    pub fn new(design: &'a Design, strategy: Strategy, count: u64, seed: u64) -> Self {
        Self::with_workers(design, strategy, count, seed, &OneByOne)
    }

    /// The same; `workers` do what takes long.
    #[must_use]
    pub fn with_workers(design: &'a Design, strategy: Strategy, count: u64, seed: u64, workers: &impl Workers) -> Self {
        let mut stimulus = Self::empty(design, seed);
        match strategy {
            // Its cases come with `of_cases`.
            Strategy::List => {}
            Strategy::Corners => stimulus.corners = Corners::new(design, count),
            Strategy::Even => stimulus.even = count,
            Strategy::Random => stimulus.random = count,
            Strategy::Exhaustive => stimulus.exhaustive = true,
            Strategy::Mixed => stimulus.mix(count),
            Strategy::Compact => stimulus.compact = Some(Compact::search(design, workers)),
        }
        stimulus
    }

    /// These cases in this order, and no others. The `seed` is for what is drawn beside the cases.
    #[must_use]
    pub fn of_cases(design: &'a Design, cases: &[Case], seed: u64) -> Self {
        let listed = cases.iter().map(|&case| Sample { case, kind: Kind::Listed }).collect();
        Self { listed, ..Self::empty(design, seed) }
    }

    fn empty(design: &'a Design, seed: u64) -> Self {
        Self {
            design,
            seed,
            listed: Vec::new(),
            compact: None,
            targets: Targets::default(),
            corners: Corners::default(),
            even: 0,
            random: 0,
            exhaustive: false,
        }
    }

    fn mix(&mut self, count: u64) {
        let part = |(times, of): (u64, u64)| count / of * times + count % of * times / of;
        self.targets = Targets::new(self.design, count);
        let targets = self.targets.samples();
        let corners = part(CORNER_SHARE).saturating_sub(targets.len() as u64);
        self.corners = Corners::beside(self.design, corners, targets);
        let left = count - (targets.len() + self.corners.samples().len()) as u64;
        self.even = left.min(part(EVEN_SHARE));
        self.random = left - self.even;
    }

    /// How many cases there will be. (All addresses and x of a wide configuration exceed a `u64`.)
    #[must_use]
    pub fn len(&self) -> u128 {
        let all = if self.exhaustive { exhaustive::len(self.design) } else { 0 };
        let chosen = self.listed.len() + self.targeted().len() + self.corners.samples().len();
        all + chosen as u128 + u128::from(self.even) + u128::from(self.random)
    }

    /// True when there will be none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The corners that the vectors were taken from.
    #[must_use]
    pub const fn corners(&self) -> &Corners {
        &self.corners
    }

    /// The targets of a mixture.
    #[must_use]
    pub const fn targets(&self) -> &Targets {
        &self.targets
    }

    /// The outcome of [`Strategy::Compact`].
    #[must_use]
    pub const fn compact(&self) -> Option<&Compact> {
        self.compact.as_ref()
    }

    /// The cases chosen for the faults they kill.
    fn targeted(&self) -> &[Sample] {
        match &self.compact {
            Some(compact) => compact.samples(),
            None => self.targets.samples(),
        }
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
        let chosen = self.listed.iter().chain(self.targeted()).chain(self.corners.samples()).copied();
        Box::new(chosen.chain(even::samples(self.design, self.even)).chain(random))
    }
}
