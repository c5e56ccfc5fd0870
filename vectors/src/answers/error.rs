//! Why answers cannot be judged.

use std::path::PathBuf;

use thiserror::Error;

use crate::table::TableError;
use crate::text_file::TextError;
use crate::verify::VerifyError;

/// Why answers cannot be judged.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum AnswersError {
    /// The bundle is not what was written.
    #[error(transparent)]
    Bundle(#[from] VerifyError),
    /// `vectors.csv` of the bundle cannot be read.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The log cannot be read, or is no text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A line of the log, or the line of column names.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The path of the log.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// A field of the log.
    #[error("{}:{line}: column `{column}`: {problem}", path.display())]
    Field {
        /// The path of the log.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The name of the column, as in the log's header.
        column: String,
        /// What is wrong, and what would be right.
        problem: String,
    },
    /// The log has no line below the column names.
    #[error("{} has no answers; write a line for each vector below the column names", .0.display())]
    Empty(PathBuf),
}
