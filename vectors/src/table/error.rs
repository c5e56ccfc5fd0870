//! Why a table is refused.

use std::path::PathBuf;

use thiserror::Error;

use crate::text_file::TextError;

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
