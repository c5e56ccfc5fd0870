//! What a bundle's vectors exercise: bits of registers, corners, regions under stalls and bubbles.
//!
//! The vectors go through the clocked [`Pipeline`](crate::pipeline::Pipeline) with stalls and bubbles drawn from a seed,
//! as the emitted testbench sends them. A bit of a register is covered where it was seen to rise and to fall from one
//! request to the next. What cannot change is told apart from what did not, with the reason ([`fixed`]).

mod bits;
mod corners;
mod crosses;
pub mod fixed;
mod traffic;

use hw_model::design::Design;
use serde::Serialize;
use vectors::Sample;

pub use bits::{Bit, Missed, RegisterBits};
pub use corners::CornerClass;
pub use crosses::{Passage, RegionTraffic};

use bits::Watched;
use crosses::Crosses;
use fixed::Known;

/// What a run of vectors exercised.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Coverage {
    /// The seed of the stalls and bubbles.
    pub seed: u64,
    /// Clock cycles of the run.
    pub cycles: u64,
    /// Bits of all registers.
    pub bits: u64,
    /// Bits that rose and fell.
    pub toggled: u64,
    /// Bits that cannot change.
    pub fixed: u64,
    /// Every register of every rank.
    pub registers: Vec<RegisterBits>,
    /// Every class of corner that the design has.
    pub corners: Vec<CornerClass>,
    /// Every region that the design has, with what befell its requests.
    pub regions: Vec<RegionTraffic>,
    /// Every region with every one that follows it.
    pub passages: Vec<Passage>,
}

impl Coverage {
    /// Of these vectors of a design, in their order.
    #[must_use]
    pub fn of(design: &Design, samples: &[Sample], seed: u64) -> Self {
        let datapath = design.datapath();
        let mut watched = Watched::all(datapath);
        let mut crosses = Crosses::new(datapath);
        let cycles = traffic::run(datapath, samples, seed, |cycle| {
            for watch in &mut watched {
                watch.see(&cycle.ranks);
            }
            crosses.see(cycle);
        });
        let known = Known::of(datapath);
        let registers: Vec<RegisterBits> = watched.into_iter().map(|watch| watch.judged(datapath, &known)).collect();
        let sum = |part: fn(&RegisterBits) -> u64| registers.iter().map(part).sum();
        Self {
            seed,
            cycles,
            bits: sum(|register| register.width.into()),
            toggled: sum(|register| register.toggled.into()),
            fixed: sum(|register| register.fixed.len() as u64),
            corners: corners::classes(design, samples),
            regions: crosses.traffic(),
            passages: crosses.passages(),
            registers,
        }
    }

    /// The share of the bits that can change which did: 1 where there are none.
    #[must_use]
    pub fn share(&self) -> f64 {
        let changeable = self.bits - self.fixed;
        if changeable == 0 { 1.0 } else { self.toggled as f64 / changeable as f64 }
    }
}
