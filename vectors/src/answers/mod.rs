//! Judging answers: the log that a designer's own simulation wrote, against a bundle.
//!
//! | column              | holds                                                    | if left out          |
//! |---------------------|----------------------------------------------------------|----------------------|
//! | `index`             | which vector, counted from 0, in decimal                 | the lines' own order |
//! | `intensity`         | the bits of the port, in hex                             |                      |
//! | `status`            | likewise                                                 | not compared         |
//! | `<rank>.<register>` | the register's bits for this vector, in hex              | not compared         |
//!
//! The names of registers are those of the columns of `vectors.csv`, with or without `_hex`; the
//! registers that show a port (`fetch.x`, `clamp.intensity`), which have no column of their own there,
//! are known too. Hex is two's complement in the register's width, as `%h` prints it, or after `0x`.
//! The bundle is what counts, and not the model that made it.

mod error;
mod log;
mod verdict;

use std::path::Path;

use hw_model::datapath::register_name;
use hw_model::format::QFormat;

use crate::manifest::{Manifest, TABLE};
use crate::table::read_columns;
use crate::verify::verify;

pub use error::AnswersError;
pub use verdict::{Failure, Field, Got, Verdict};

use log::Log;
use verdict::Tally;

/// The log's name for the port, as the manifest's.
const INTENSITY: &str = "intensity";
const STATUS: &str = "status";

/// What a log may have in a column.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Column {
    name: String,
    format: QFormat,
    /// The rank that computes it.
    rank: usize,
    /// The column of the bundle's table with what it should hold, as an integer.
    table: String,
}

impl Column {
    fn is_port(&self) -> bool {
        self.name == INTENSITY || self.name == STATUS
    }
}

/// Compares the answers in the log at `log` with the bundle in `directory`. An answer that is missing,
/// unknown or another one is what the verdict is about, and no error.
///
/// # Errors
/// When the bundle is not what was written, or the log is none: the message names file, line and column.
pub fn check(directory: impl AsRef<Path>, log: &Path) -> Result<Verdict, AnswersError> {
    let directory = directory.as_ref();
    let bundle = verify(directory)?;
    let table = directory.join(TABLE);
    let mut log = Log::open(log, columns(&bundle.manifest), bundle.vectors.len())?;
    let wanted: Vec<&str> = log.columns().map(|column| column.table.as_str()).collect();
    let expected = read_columns(&table, &wanted)?;
    let mut tally = Tally::new(log.columns().filter(|column| !column.is_port()).count());
    while let Some(answer) = log.next_answer()? {
        let index = answer.index;
        tally.answer(&bundle.vectors[index], log.columns(), &expected[index], answer);
    }
    for index in log.unanswered() {
        tally.no_answer(&bundle.vectors[index]);
    }
    let ranks = bundle.manifest.hardware.ranks.iter().map(|rank| rank.name.as_str());
    Ok(tally.verdict(bundle.vectors.len() as u64, ranks, bundle.manifest.configuration.input))
}

/// The columns that a log may have, in the order in which a case passes through them: every register
/// where it is computed, then the ports.
fn columns(manifest: &Manifest) -> Vec<Column> {
    let ranks = &manifest.hardware.ranks;
    let last = ranks.len().saturating_sub(1);
    let registers = (0..).zip(ranks).flat_map(|(rank, list)| {
        let computed = list.registers.iter().filter(|register| register.computed);
        computed.map(move |register| {
            let name = register_name(rank, &list.name, &register.name);
            // The table does not say twice what a port shows.
            let table = match register.name.as_str() {
                "x" if rank == 0 => "x_bits",
                port if rank == last => port_column(port).unwrap_or(&name),
                _ => &name,
            };
            Column { table: table.to_owned(), name, format: register.format, rank }
        })
    });
    let ports = manifest.words.expected.fields.iter().rev().filter_map(|field| {
        let table = port_column(&field.name)?.to_owned();
        Some(Column { name: field.name.clone(), format: field.format, rank: last, table })
    });
    registers.chain(ports).collect()
}

/// The table's column for an output port.
fn port_column(name: &str) -> Option<&'static str> {
    match name {
        INTENSITY => Some("intensity_bits"),
        STATUS => Some("status"),
        _ => None,
    }
}
