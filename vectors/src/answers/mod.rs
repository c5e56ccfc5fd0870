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

mod column;
mod error;
mod log;
mod told;
mod verdict;

use std::path::Path;

use crate::manifest::TABLE;
use crate::table::read_columns;
use crate::verify::verify;

pub use column::Got;
pub use error::AnswersError;
pub use verdict::{Failure, Field, Verdict};

use column::columns;
use log::Log;
use verdict::Tally;

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
