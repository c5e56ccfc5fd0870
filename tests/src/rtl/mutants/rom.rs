//! Mutants that are another ROM image: a field one unit off, two rows exchanged.

use std::collections::BTreeSet;
use std::fmt::{self, Write};

use hw_model::design::Design;
use hw_model::rom::Row;
use rayon::prelude::*;
use vectors::faults::{Fault, FieldFault, field_faults};

use super::{Bench, Outcome, class};
use crate::rtl::Failure;
use crate::rtl::simulators::Simulator;
use naive::configurations::Random;

/// Exchanges of rows that are not neighbours.
const DISTANT: u64 = 64;

/// What is wrong with a ROM.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrong {
    /// A field of a row is one unit of its last place more or less.
    Field(FieldFault),
    /// Two rows have each other's words; the first is the lower one.
    Swap(u32, u32),
}

impl Wrong {
    /// The fault of the model that this is; it has none for rows that are not neighbours.
    #[must_use]
    pub const fn fault(self) -> Option<Fault> {
        match self {
            Self::Field(fault) => Some(Fault::Field(fault)),
            Self::Swap(low, high) if low + 1 == high => Some(Fault::Swap(low)),
            Self::Swap(..) => None,
        }
    }

    /// The class it is counted in.
    #[must_use]
    pub fn class(self) -> &'static str {
        self.fault().map_or(super::DISTANT_ROWS, class)
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field(fault) => fault.fmt(f),
            Self::Swap(low, high) => write!(f, "swap:{low}-{high}"),
        }
    }
}

/// Every field of every row, every two neighbours, and rows far apart, chosen by `seed`.
#[must_use]
pub fn faults(design: &Design, seed: u64) -> Vec<Wrong> {
    let datapath = design.datapath();
    let depth = datapath.rom().depth() as u32;
    let fields = (0..depth).flat_map(|address| field_faults(datapath, address));
    let neighbours = (1..depth).map(|high| Wrong::Swap(high - 1, high));
    fields.map(Wrong::Field).chain(neighbours).chain(distant(depth, seed)).collect()
}

/// Pairs of rows that are not neighbours, each once.
fn distant(depth: u32, seed: u64) -> impl Iterator<Item = Wrong> {
    let others = u64::from(depth.saturating_sub(1)) * u64::from(depth.saturating_sub(2)) / 2;
    let mut random = Random::new(seed, 0);
    let mut row = move || random.integer(0, i64::from(depth) - 1) as u32;
    let mut pairs = BTreeSet::new();
    while (pairs.len() as u64) < DISTANT.min(others) {
        let (one, other) = (row(), row());
        if one.abs_diff(other) > 1 {
            pairs.insert((one.min(other), one.max(other)));
        }
    }
    pairs.into_iter().map(|(low, high)| Wrong::Swap(low, high))
}

/// The rows of the faulty ROM.
fn rows(design: &Design, wrong: Wrong) -> Vec<Row> {
    let mut rows = design.rom().rows().to_vec();
    match wrong {
        Wrong::Field(fault) => {
            let row = &mut rows[fault.address as usize];
            row.set(fault.field, row.get(fault.field) + fault.step);
        }
        Wrong::Swap(low, high) => rows.swap(low as usize, high as usize),
    }
    rows
}

fn image(design: &Design, rows: &[Row]) -> String {
    let layout = design.rom().layout();
    let digits = layout.word_width().div_ceil(4).max(1) as usize;
    rows.iter().fold(String::new(), |mut text, row| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:0digits$x}", layout.pack(row));
        text
    })
}

/// Runs each fault of the ROM with the built testbench.
///
/// # Errors
/// When a run gives no verdict.
pub fn run(bench: &Bench, simulator: &Simulator, design: &Design, faults: &[Wrong]) -> Result<Vec<Outcome>, Failure> {
    let outcome = |fault: &Wrong| {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let place = bench.place(&format!("rom-{thread}"), &["rom.mem"])?;
        std::fs::write(place.join("rom.mem"), image(design, &rows(design, *fault)))
            .map_err(|error| Failure(error.to_string()))?;
        let killed_by = bench.run(simulator, &place, &[])?;
        Ok(Outcome { name: fault.to_string(), killed_by })
    };
    faults.par_iter().map(outcome).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distant_rows_are_no_neighbours_and_chosen_by_the_seed() {
        let pairs: Vec<Wrong> = distant(256, 1).collect();
        assert_eq!(pairs.len() as u64, DISTANT);
        assert!(pairs.iter().all(|wrong| wrong.fault().is_none()), "{pairs:?}");
        assert_eq!(pairs, distant(256, 1).collect::<Vec<_>>());
        assert_ne!(pairs, distant(256, 2).collect::<Vec<_>>());
        // 0-2, 0-3, 1-3.
        assert_eq!((distant(4, 1).count(), distant(2, 1).count()), (3, 0));
    }
}
