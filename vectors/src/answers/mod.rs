//! Judging answers: the log that a designer's own simulation wrote, against a bundle.
//!
//! | column              | holds                                                    | if left out          |
//! |---------------------|----------------------------------------------------------|----------------------|
//! | `index`             | which vector, counted from 0, in decimal                 | the lines' own order |
//! | `intensity`         | the bits of the port, in hex                             |                      |
//! | `status`            | likewise                                                 | not compared         |
//! | `<rank>.<register>` | the register's bits for this vector, in hex              | not compared         |
//!
//! The names of registers are those of the columns of `vectors.csv`, with or without `_hex`. Hex is
//! two's complement in the register's width, as `%h` prints it, or after `0x`. The bundle is what
//! counts, and not the model that made it.

mod error;
mod log;
mod verdict;

use std::path::Path;

use hw_model::format::QFormat;

use crate::manifest::{Manifest, TABLE};
use crate::packing::WordField;
use crate::reference::Expected;
use crate::table::{column_names, read_columns};
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
    let known = columns(&bundle.manifest, &column_names(&table)?);
    let mut log = Log::open(log, known, bundle.vectors.len())?;
    let registers = read_columns(&table, &log.registers())?;
    let mut tally = Tally::new(log.registers().len());
    while let Some(answer) = log.next_answer()? {
        let row = &bundle.vectors[answer.index];
        let expected = expected(&registers[answer.index], row.expected);
        tally.answer(row, log.columns(), expected, answer);
    }
    for index in log.unanswered() {
        tally.no_answer(&bundle.vectors[index]);
    }
    let ranks = bundle.manifest.hardware.ranks.iter().map(|rank| rank.name.as_str());
    Ok(tally.verdict(bundle.vectors.len() as u64, ranks, bundle.manifest.configuration.input))
}

/// What the columns of a log should hold for a vector: registers as they come, then the ports.
fn expected(registers: &[i64], ports: Expected) -> impl Iterator<Item = i64> {
    registers.iter().copied().chain([ports.intensity, ports.status.into()])
}

/// The columns that a log may have, in the order in which a case passes through them: the registers
/// that the table has, then the ports.
fn columns(manifest: &Manifest, table: &[String]) -> Vec<Column> {
    let ranks = (0..).zip(&manifest.hardware.ranks);
    let registers = ranks.flat_map(|(rank, list)| {
        list.registers.iter().map(move |register| Column {
            name: format!("{}.{}", list.name, register.name),
            format: register.format,
            rank,
        })
    });
    let last = manifest.hardware.ranks.len().saturating_sub(1);
    let ports = [INTENSITY, STATUS].into_iter().filter_map(|name| {
        let format = field(&manifest.words.expected.fields, name)?.format;
        Some(Column { name: name.to_owned(), format, rank: last })
    });
    registers.filter(|column| table.contains(&column.name)).chain(ports).collect()
}

fn field<'a>(fields: &'a [WordField], name: &str) -> Option<&'a WordField> {
    fields.iter().find(|field| field.name == name)
}
