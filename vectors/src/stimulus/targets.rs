//! Targets: x that kill the faults of a row ([`crate::faults`]).
//!
//! A bundle that shows a ROM word wrong in its last bit must hold an x for it, and a random x seldom is
//! one. For each row, x of both parts of the pipeline are tried under every fault of the row: the
//! ends of each part, an even grid and random ones. Of them the fewest that kill everything killed are
//! taken. For what none of them kills every x of the row is tried, as long as that is affordable; what then
//! survives in a row is equivalent there.
//!
//! The random ones are drawn from the address, not from the bundle's seed: the targets belong to the
//! design.

use std::ops::RangeInclusive;

use hw_model::datapath::Datapath;
use hw_model::design::Design;
use hw_model::registers::Register;

use super::random::Dice;
use super::rounds::{Point, in_rounds};
use crate::case::Sample;
use crate::faults::cover::fewest;
use crate::faults::{Mask, RowFaults, exhaust};
use crate::kind::Kind;

/// x that all rows together may look at where the candidates were not enough.
const ALLOWANCE: i64 = 1 << 28;

/// The targets of a design, as many as were asked for.
#[derive(Debug, Clone, Default)]
pub struct Targets {
    samples: Vec<Sample>,
    faults: u64,
    killed: u64,
}

impl Targets {
    /// At most `limit` targets, no case twice; with a limit of the ROM's depth or more, at least one in
    /// every row.
    #[must_use]
    pub fn new(design: &Design, limit: u64) -> Self {
        let mut allowance = ALLOWANCE;
        let rows: Vec<Row> =
            (0..design.rom().depth() as u32).map(|address| Row::search(design, address, &mut allowance)).collect();
        let lists: Vec<Vec<Point>> = rows.iter().map(|row| row.points.clone()).collect();
        let samples = in_rounds(design, &lists, &[], limit);
        let mut taken = vec![0; rows.len()];
        for sample in &samples {
            taken[sample.case.address as usize] += 1;
        }
        Self {
            samples,
            faults: rows.iter().map(|row| u64::from(row.faults.count_ones())).sum(),
            killed: rows.iter().zip(taken).map(|(row, taken)| row.killed_by_first(taken)).sum(),
        }
    }

    /// The targets that were taken, as vectors.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// How many faults the rows can have.
    #[must_use]
    pub const fn faults(&self) -> u64 {
        self.faults
    }

    /// How many of them the targets taken kill.
    #[must_use]
    pub const fn killed(&self) -> u64 {
        self.killed
    }
}

/// The targets of one row.
struct Row {
    faults: Mask,
    points: Vec<Point>,
    /// What each point kills.
    masks: Vec<Mask>,
}

impl Row {
    fn search(design: &Design, address: u32, allowance: &mut i64) -> Self {
        let datapath = design.datapath();
        let mut row = RowFaults::new(datapath, address);
        let (mut xs, mut masks) = (Vec::new(), Vec::new());
        for candidates in candidates(datapath, address) {
            let mut killed = Vec::new();
            row.killed(&candidates, row.all(), &mut killed);
            xs.extend(candidates);
            masks.extend(killed);
        }
        // A wrong cut shows at the cut or just below it, and both are among the candidates.
        let survivors = row.all() & !union(&masks) & !row.of_field(Register::Cut);
        let front_end = datapath.front_end();
        if survivors != 0 && front_end.greatest < *allowance {
            *allowance -= front_end.greatest;
            let mut left = survivors;
            for (x, mask) in exhaust(&mut row, survivors, *front_end) {
                xs.push(x);
                masks.push(mask);
                left &= !mask;
                if left == 0 {
                    break;
                }
            }
        }
        let mut chosen = fewest(&masks, union(&masks));
        if chosen.is_empty() {
            // Nothing to kill: the row is met all the same.
            chosen.push(0);
        }
        let points = chosen.iter().map(|&index| Point { kind: Kind::Target, x: xs[index] });
        Self { faults: row.all(), points: points.collect(), masks: chosen.iter().map(|&index| masks[index]).collect() }
    }

    /// How many faults the first points kill.
    fn killed_by_first(&self, taken: usize) -> u64 {
        u64::from(union(&self.masks[..taken]).count_ones())
    }
}

fn union(masks: &[Mask]) -> Mask {
    masks.iter().fold(0, |set, mask| set | mask)
}

/// Where the search looks first: in each part its ends, an even grid, and as many random x.
fn candidates(datapath: &Datapath, address: u32) -> Vec<Vec<i64>> {
    // About a million for the whole ROM.
    let count = ((1 << 19) / datapath.rom().depth().max(1) as i64).clamp(16, 1024);
    let greatest = datapath.front_end().greatest;
    let spans = datapath.polynomial_spans(&datapath.row(address));
    let mut dice = Dice::new(address.into());
    let below = 0..=spans.first().map_or(greatest, |&(first, _)| first - 1);
    let parts = std::iter::once(below).chain(spans.into_iter().map(|(first, last)| first..=last));
    let filled = parts.filter(|part| !part.is_empty());
    filled.map(|part| of_part(part, count, &mut dice)).collect()
}

fn of_part(part: RangeInclusive<i64>, count: i64, dice: &mut Dice) -> Vec<i64> {
    let (low, high) = (*part.start(), *part.end());
    if high - low < 2 * count {
        return part.collect();
    }
    let step = (high - low) / (count - 1);
    let mut xs: Vec<i64> = (0..count).map(|index| low + index * step).collect();
    xs.push(high);
    xs.extend((0..count).map(|_| dice.within(low..=high)));
    xs
}
