//! Corners: the inputs at which hardware goes wrong.
//!
//! | corner                        | why                                                        |
//! |-------------------------------|------------------------------------------------------------|
//! | 0, 1, one ulp beside them     | ends of the range; above 1 the input clamps                |
//! | cut, q, one ulp beside them   | another part answers                                       |
//! | worst error, each part        | the point that a report quotes                             |
//! | ties                          | a wrong rounding mode shows only here                      |
//! | least and greatest register   | an overflow shows only here                                |
//! | quotient 0 and greatest       | ends of the divider                                        |
//! | ends of the input format      | facing away, far above 1                                   |
//! | addresses without a word      | the status flag and 0                                      |
//!
//! Every row of the ROM has its own list: eight corners that matter most, the same in every
//! row, then the rest, which starts at another corner in each row. They are taken in rounds, one
//! of each row, so that a count too small for all is shared fairly, and every kind is met in some
//! row. The addresses without a word come after the first round.

mod lattice;
mod row;
mod ties;

use std::collections::HashSet;

use hw_model::design::Design;

use super::rounds::{Point, in_rounds};
use crate::case::{Case, Sample};
use crate::kind::Kind;
use row::Effort;

/// The corners of a design, as many as were asked for.
#[derive(Debug, Clone, Default)]
pub struct Corners {
    samples: Vec<Sample>,
    available: u64,
    present: u64,
}

impl Corners {
    /// At most `limit` corners of every kind, no case twice.
    ///
    /// The searches behind them cost about a thousand evaluations a row; for a ROM of many rows they
    /// are coarser, and beyond 4096 rows they look at a few points only.
    #[must_use]
    pub fn new(design: &Design, limit: u64) -> Self {
        Self::beside(design, limit, &[])
    }

    /// At most `limit` corners that are not among these samples.
    #[must_use]
    pub fn beside(design: &Design, limit: u64, others: &[Sample]) -> Self {
        let effort = Effort::for_depth(design.rom().depth());
        let mut lists: Vec<Vec<Point>> =
            (0..design.rom().depth() as u32).map(|address| row::corners(design, address, effort)).collect();
        let no_word = without_word(design);
        let in_rows: usize = lists.iter().map(Vec::len).sum();
        let taken: HashSet<(u32, i64)> = others.iter().map(|sample| (sample.case.address, sample.case.x)).collect();
        for (address, list) in (0..).zip(&mut lists) {
            list.retain(|point| !taken.contains(&(address, point.x)));
        }
        let elsewhere = in_rows - lists.iter().map(Vec::len).sum::<usize>();
        let samples = in_rounds(design, &lists, &no_word, limit);
        Self { available: (in_rows + no_word.len()) as u64, present: (samples.len() + elsewhere) as u64, samples }
    }

    /// The corners that were taken, as vectors.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// How many corners there are, taken or not.
    #[must_use]
    pub const fn available(&self) -> u64 {
        self.available
    }

    /// How many of them are taken, or were among the samples beside which these stand.
    #[must_use]
    pub const fn present(&self) -> u64 {
        self.present
    }
}

/// The first and the last address without a word, with x at 1, between, at 0 and at the format's end.
fn without_word(design: &Design) -> Vec<Sample> {
    let rom = design.rom();
    let input = design.config().input;
    let greatest = design.datapath().front_end().greatest;
    let first = rom.depth() as u32;
    let last = (1_u32 << rom.address_width()) - 1;
    let mut seen = HashSet::new();
    [greatest, greatest / 2, 0, input.max_bits(), input.min_bits()]
        .into_iter()
        .flat_map(|x| [(first, x), (last, x)])
        .filter(|&case| seen.insert(case))
        .map(|(address, x)| Sample { case: Case::at(rom, address, x), kind: Kind::NoWord })
        .collect()
}
