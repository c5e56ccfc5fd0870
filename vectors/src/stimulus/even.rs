//! Evenly spaced x over [0, 1].
//!
//! The grid has one point for each case, and neighbouring points belong to neighbouring rows: with m
//! points a row and D rows, point i·D + r of a grid over [0, 1] goes to row r. So every row is
//! sampled in steps of 1/m, and all rows together in steps of 1/(m·D); with one row it is a plain
//! even grid with both ends.
//!
//! The points come from 1 downwards. Where the count is no multiple of D, what is missing is missing
//! next to 0, where least happens; the rows that do get a point there are spread evenly.

use hw_model::design::Design;

use crate::case::{Case, Sample};
use crate::kind::Kind;

/// `count` cases of the grid. An x comes twice in a row only when there are more points than x.
pub fn samples(design: &Design, count: u64) -> impl Iterator<Item = Sample> + '_ {
    let rom = design.rom();
    let depth = rom.depth() as u64;
    let rounds = count.div_ceil(depth);
    (0..count).map(move |index| {
        let round = rounds - 1 - index / depth;
        let in_this_round = (count - index / depth * depth).min(depth);
        let row = spread(index % depth, in_this_round, depth);
        let x = grid_point(round * depth + row, rounds * depth, design);
        Sample { case: Case::at(rom, row as u32, x), kind: Kind::Even }
    })
}

/// Member `index` of `count` ≤ `of` numbers spread over `0..of`, both ends included.
pub(super) fn spread(index: u64, count: u64, of: u64) -> u64 {
    match count {
        0 | 1 => 0,
        // The product may pass 64 bits, the quotient is below `of`.
        _ => (u128::from(index) * u128::from(of - 1) / u128::from(count - 1)) as u64,
    }
}

/// Point `index` of `count` on [0, greatest], rounded to the nearest x.
fn grid_point(index: u64, count: u64, design: &Design) -> i64 {
    let greatest = design.datapath().front_end().greatest;
    let steps = i128::from(count - 1).max(1);
    // At most 2^64 · 2^63; the quotient is at most `greatest`.
    ((i128::from(index) * i128::from(greatest) + steps / 2) / steps) as i64
}
