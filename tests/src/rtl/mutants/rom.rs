//! Mutants that are another ROM image: a field one unit off, two rows exchanged.

use std::fmt::Write;

use hw_model::design::Design;
use hw_model::rom::Row;
use rayon::prelude::*;
use vectors::faults::{Fault, field_faults};

use super::{Bench, Outcome};
use crate::rtl::Failure;
use crate::rtl::simulators::Simulator;

/// Every fault of a row.
#[must_use]
pub fn faults(design: &Design) -> Vec<Fault> {
    let datapath = design.datapath();
    let depth = datapath.rom().depth() as u32;
    let fields = (0..depth).flat_map(|address| field_faults(datapath, address));
    fields.map(Fault::Field).chain((0..depth.saturating_sub(1)).map(Fault::Swap)).collect()
}

/// The rows of the faulty ROM; none where the fault is not one of the ROM.
fn rows(design: &Design, fault: Fault) -> Option<Vec<Row>> {
    let mut rows = design.rom().rows().to_vec();
    match fault {
        Fault::Field(fault) => {
            let row = &mut rows[fault.address as usize];
            row.set(fault.field, row.get(fault.field) + fault.step);
        }
        Fault::Swap(address) => rows.swap(address as usize, address as usize + 1),
        _ => return None,
    }
    Some(rows)
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
pub fn run(
    bench: &Bench,
    simulator: &Simulator,
    design: &Design,
    faults: &[Fault],
) -> Result<Vec<Outcome>, Failure> {
    let outcome = |fault: &Fault| {
        let Some(rows) = rows(design, *fault) else { return Ok(None) };
        let thread = rayon::current_thread_index().unwrap_or(0);
        let place = bench.place(&format!("rom-{thread}"), &["rom.mem"])?;
        std::fs::write(place.join("rom.mem"), image(design, &rows))
            .map_err(|error| Failure(error.to_string()))?;
        let killed_by = bench.run(simulator, &place, &[])?;
        Ok(Some(Outcome { name: fault.to_string(), killed_by }))
    };
    let outcomes: Vec<Option<Outcome>> =
        faults.par_iter().map(outcome).collect::<Result<_, Failure>>()?;
    Ok(outcomes.into_iter().flatten().collect())
}
