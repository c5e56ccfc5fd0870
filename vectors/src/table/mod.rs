//! `vectors.csv`: every case with what each stage is expected to hold.
//!
//! | columns                                 | meaning                                              |
//! |-----------------------------------------|------------------------------------------------------|
//! | index, kind                             | line of the memory files, why the case was chosen    |
//! | n, address, x_bits, x_hex, x_real       | the input; n is empty where no exponent leads there  |
//! | `<rank>.<register>`, `…_hex`            | each register, in the rank that computes it          |
//! | intensity_bits, …_hex, …_real           | the output                                           |
//! | status, flags                           | the status port as a number, and its flags by name   |
//! | reference, error_ulp                    | x^n, and intensity − x^n in output ulp               |
//!
//! A register that is only carried along is not repeated, nor are the ports. A real value is an
//! exact decimal; the reference has 17 significant digits, which an `f64` comes back from. Hex has
//! the register's width and a `0x`, so that a spreadsheet does not take `1e5` for a number.

mod read;
mod write;

use std::path::PathBuf;

use thiserror::Error;

use crate::text_file::TextError;

pub use read::{TableRow, read_columns, read_table};
pub use write::{TableWriter, hex};

/// Why a table is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableError {
    /// The file cannot be read, or is no text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The file is not CSV (with the line).
    #[error("cannot read {}: {cause}", path.display())]
    Csv {
        /// The path of the table.
        path: PathBuf,
        /// What is wrong with the CSV, with its line.
        cause: csv::Error,
    },
    /// A column is missing.
    #[error("{}: there is no column `{column}`", path.display())]
    Column {
        /// The path of the table.
        path: PathBuf,
        /// The name of the column that is missing.
        column: String,
    },
    /// More lines than a bundle has vectors.
    #[error("{} has more than {most} vectors, the most of a bundle; write several bundles", path.display())]
    Long {
        /// The path of the table.
        path: PathBuf,
        /// The most lines that a table may have.
        most: u64,
    },
    /// A field is not what its column holds.
    #[error("{}:{line}: column `{column}`: {text:?} is not {wanted}", path.display())]
    Field {
        /// The path of the table.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The name of the field's column.
        column: String,
        /// The field as the table has it.
        text: String,
        /// What it should be.
        wanted: &'static str,
    },
}
