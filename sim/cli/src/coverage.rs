//! `blysk vectors --coverage`: what vectors exercise, for people.

use std::io::Write;

use sim::coverage::{Coverage, RegisterBits};

use super::out::Out;
use super::table::{Cell, Format, Rows, write_folded};

/// What the file of a bundle's coverage is called.
pub(super) const FILE: &str = "coverage.json";

/// Prints every table, and the shares below them.
pub(super) fn print(coverage: &Coverage, out: &mut Out) -> anyhow::Result<()> {
    writeln!(out)?;
    registers(coverage).print(out, Format::Table, 6)?;
    writeln!(out)?;
    let mut corners = Rows::new(&["corner", "met", "of"]);
    for class in &coverage.corners {
        corners.push(vec![class.name.as_str().into(), integer(class.met), integer(class.available)]);
    }
    corners.print(out, Format::Table, 6)?;
    writeln!(out)?;
    let columns = ["region", "requests", "ranks", "stalled in", "bubble behind", "request behind"];
    let mut regions = Rows::new(&columns);
    for region in &coverage.regions {
        let ranks = [region.ranks, region.stalled, region.before_bubble, region.before_request];
        let counts = ranks.map(|count| integer(count as u64));
        regions.push([vec![Cell::from(region.region), integer(region.requests)], counts.to_vec()].concat());
    }
    regions.print(out, Format::Table, 6)?;
    let passages: Vec<String> =
        coverage.passages.iter().map(|pass| format!("{} {} after {}", pass.count, pass.to, pass.from)).collect();
    write_folded(out, &format!("requests: {}", passages.join(", ")))?;
    writeln!(
        out,
        "{} of {} bits rose and fell in {} cycles; {} cannot change: {:.2} % of the others",
        coverage.toggled,
        coverage.bits,
        coverage.cycles,
        coverage.fixed,
        100.0 * coverage.share()
    )?;
    Ok(())
}

/// A register a line; those of which nothing is to be said but that all bits changed have no words.
fn registers(coverage: &Coverage) -> Rows {
    let mut rows = Rows::new(&["register", "bits", "changed", "cannot", "missed", "why not"]);
    for register in &coverage.registers {
        let unseen = (!register.missed.is_empty()).then(|| format!("not seen: {}", missed(register)));
        let why: Vec<String> = register.reason.iter().cloned().chain(unseen).collect();
        rows.push(vec![
            format!("{}.{}", register.rank, register.register).into(),
            integer(register.width.into()),
            integer(register.toggled.into()),
            integer(register.fixed.len() as u64),
            integer(register.missed.len() as u64),
            why.join("; ").into(),
        ]);
    }
    rows
}

fn missed(register: &RegisterBits) -> String {
    let bits: Vec<String> = register.missed.iter().map(|missed| format!("bit {}", missed.bit)).collect();
    bits.join(", ")
}

fn integer(count: u64) -> Cell {
    Cell::Integer(count as i64)
}
