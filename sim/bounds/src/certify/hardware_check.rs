//! Checking the certificate of a configuration, without the sweep that found it.
//!
//! Every x of every row goes through the data path again. Where the output stays the same from x = a to
//! x = b, x^n lies between aⁿ and bⁿ, as it grows with x: two powers bound the error of the whole run, and
//! no point is left to an estimate. The witnesses go through the data path one by one, the scalar way, and
//! for integer n their error is a ratio of integers.

use hw_model::datapath::Block;
use hw_model::design::Design;
use rayon::prelude::*;
use std::cmp::Ordering;

use super::fault::Fault;
use super::hardware::{HardwareClaim, HardwareRow, Worst, exact_power, least_error, overall, points, power};
use crate::interval::Interval;
use vectors::progress::Progress;

/// x that go through the data path together, and x that make one piece of work for a thread.
const BLOCK: i64 = 4096;
const PIECE: i64 = 1 << 19;

/// Checks the claim and returns how many points were seen.
pub(super) fn check_hardware(claim: &HardwareClaim, progress: &dyn Progress) -> Result<u64, Fault> {
    let refused = |problem: String| Fault::new("configuration", problem);
    let design = Design::new(claim.configuration.clone()).map_err(|error| refused(error.to_string()))?;
    let expected = points(&design).map_err(|error| refused(error.to_string()))?;
    if claim.points != expected {
        return Err(Fault::new("points", format!("the configuration has {expected}")));
    }
    check_summary(claim, &design)?;
    for (index, row) in claim.rows.iter().enumerate() {
        check_row(&design, index as u32, row)
            .map_err(|fault| fault.within(&format!("rows[{index}] (n = {}), ", row.n)))?;
    }
    let seen = sweep(&design, &claim.rows, progress)?;
    if seen != expected {
        return Err(Fault::new("points", format!("{seen} were seen")));
    }
    Ok(seen)
}

/// Checks that the rows are the configuration's, and that the summary follows from the rows.
fn check_summary(claim: &HardwareClaim, design: &Design) -> Result<(), Fault> {
    let exponents = design.rom().exponents();
    let own = claim.rows.iter().map(|row| row.n);
    if !exponents.iter().eq(own) {
        let problem = format!("they are not those of the exponents {exponents}, each in its order");
        return Err(Fault::new("rows", problem));
    }
    for (name, stated, found) in [
        ("epicentre", claim.epicentre, overall(&claim.rows, |row| row.epicentre)),
        ("full_range", claim.full_range, overall(&claim.rows, |row| row.full_range)),
    ] {
        if found != Some(stated) {
            return Err(Fault::new(name, "it is not the greatest of the rows"));
        }
    }
    Ok(())
}

/// Where the epicentre begins, and both witnesses.
fn check_row(design: &Design, address: u32, row: &HardwareRow) -> Result<(), Fault> {
    let (greatest, level) = (design.datapath().front_end().greatest, design.config().q);
    let from = row.epicentre_from;
    // It may reach further than the epicentre: all that is claimed holds there too.
    if from > 0 && at_least(design, row.n, (from - 1).min(greatest), level) != Some(false) {
        let problem = format!("x = {} may belong to the epicentre", from - 1);
        return Err(Fault::new("epicentre_from", problem));
    }
    for (name, worst) in [("epicentre", row.epicentre), ("full_range", row.full_range)] {
        check_witness(design, address, row.n, worst).map_err(|fault| fault.within(&format!("{name}.")))?;
    }
    // A format without 1 may have no x on the epicentre of a large n, and then there is no error.
    let Worst { x, lower, .. } = row.epicentre;
    if lower > 0.0 && at_least(design, row.n, x, level) != Some(true) {
        return Err(Fault::new("epicentre.x", format!("x = {x} is not on the epicentre")));
    }
    Ok(())
}

/// x^n ≥ level, where it can be decided.
fn at_least(design: &Design, n: f64, x: i64, level: f64) -> Option<bool> {
    let enclosure = power(design, n, x);
    if enclosure.low() >= level {
        return Some(true);
    }
    if enclosure.high() < level {
        return Some(false);
    }
    let ordering = exact_power(design, n, x)?.compare(level)?;
    // How the level compares with the power.
    Some(ordering != Ordering::Greater)
}

fn check_witness(design: &Design, address: u32, n: f64, worst: Worst) -> Result<(), Fault> {
    let Worst { lower, upper, x, output } = worst;
    if !(0.0 <= lower && lower <= upper) {
        return Err(Fault::new("lower", format!("{lower} to {upper} is no interval of magnitudes")));
    }
    if !(0..=design.datapath().front_end().greatest).contains(&x) {
        return Err(Fault::new("x", format!("{x} is not within [0, 1]")));
    }
    let own = design.datapath().evaluate(address, x).intensity;
    if own != output {
        return Err(Fault::new("output", format!("at x = {x} the hardware answers {own}")));
    }
    let least = least_error(design, n, x, output);
    if least >= lower {
        Ok(())
    } else {
        Err(Fault::new("lower", format!("the error at x = {x} is at least {least} only")))
    }
}

/// Every x of every row against the row's bounds.
fn sweep(design: &Design, rows: &[HardwareRow], progress: &dyn Progress) -> Result<u64, Fault> {
    let greatest = design.datapath().front_end().greatest;
    let pieces = greatest / PIECE + 1;
    (0..rows.len() as i64 * pieces)
        .into_par_iter()
        .map(|index| {
            let (address, piece) = ((index / pieces) as usize, index % pieces);
            let last = (piece * PIECE + PIECE - 1).min(greatest);
            let seen = CheckedRow::new(design, address, &rows[address]).sweep(piece * PIECE, last)?;
            progress.advance(seen);
            Ok(seen)
        })
        .collect::<Vec<_>>()
        .into_iter()
        .sum()
}

struct CheckedRow<'a> {
    design: &'a Design,
    address: usize,
    row: &'a HardwareRow,
}

impl<'a> CheckedRow<'a> {
    const fn new(design: &'a Design, address: usize, row: &'a HardwareRow) -> Self {
        Self { design, address, row }
    }

    fn sweep(&self, first: i64, last: i64) -> Result<u64, Fault> {
        let mut block = Block::default();
        let mut seen = 0;
        let mut begin = first;
        while begin <= last {
            let xs: Vec<i64> = (begin..=last.min(begin + BLOCK - 1)).collect();
            self.design.datapath().evaluate_block(self.address as u32, &xs, &mut block);
            let mut start = begin;
            for run in block.intensities.chunk_by(|a, b| a == b) {
                let end = start + run.len() as i64 - 1;
                self.check_run(start, end, run[0])?;
                start = end + 1;
                seen += run.len() as u64;
            }
            begin += BLOCK;
        }
        Ok(seen)
    }

    /// One output from x = start to x = end.
    fn check_run(&self, start: i64, end: i64, output: i64) -> Result<(), Fault> {
        self.within("full_range", self.row.full_range, start, end, output)?;
        let from = self.row.epicentre_from;
        if end >= from {
            self.within("epicentre", self.row.epicentre, start.max(from), end, output)?;
        }
        Ok(())
    }

    fn within(&self, name: &str, worst: Worst, start: i64, end: i64, output: i64) -> Result<(), Fault> {
        let n = self.row.n;
        let powers = power(self.design, n, start).hull(power(self.design, n, end));
        let intensity = Interval::exactly(output as f64 * self.design.config().output.ulp());
        let greatest = (intensity - powers).greatest_magnitude();
        if greatest <= worst.upper {
            return Ok(());
        }
        let field = format!("rows[{}] (n = {n}), {name}.upper", self.address);
        let problem = format!("from x = {start} to {end} the error is bounded by {greatest} only");
        Err(Fault::new(field, problem))
    }
}
