//! Why a memory file is refused.

use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::limits::MOST_NUMBERS;
use crate::text_file::TextError;

/// Why a memory file is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MemoryError {
    /// The file cannot be read, or is no text.
    #[error(transparent)]
    Text(#[from] TextError),
    /// Something in a line.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The path of the memory file.
        path: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong with it.
        problem: LineProblem,
    },
    /// The file ends before every word is there.
    #[error(
        "{}: the word at address {address} is missing ({found} of {expected} words are there); \
         the file may have been cut short: write it again", path.display()
    )]
    Short {
        /// The path of the memory file.
        path: PathBuf,
        /// The first address without a word.
        address: usize,
        /// The number of words found.
        found: usize,
        /// The number of words that the reader was told to expect.
        expected: usize,
    },
}

/// What is wrong with a line of a memory file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LineProblem {
    /// A character that no number has.
    #[error("{0:?} is not a hex number; digits are 0-9, a-f, and _ between them")]
    Digit(String),
    /// `@` without a hex address.
    #[error("{0:?} is not an address; write @ and hex digits, for example @1f")]
    Address(String),
    /// The value does not fit the word.
    #[error("{text} does not fit a word of {width} bits")]
    TooWide {
        /// The number as written.
        text: String,
        /// Bits of a word.
        width: u32,
    },
    /// A digit is `x` or `z`.
    #[error("{0} has unknown bits (x or z), where a known value belongs")]
    Unknown(String),
    /// The word is beyond the memory's last address.
    #[error("the word for address {address} is one too many; the memory has {depth} words")]
    PastEnd {
        /// The address that the file gives, counted in words.
        address: u64,
        /// Words of the memory.
        depth: usize,
    },
    /// More numbers than any memory of a bundle has words.
    #[error("there are more than {} numbers and addresses, and no memory of a bundle has as many words", MOST_NUMBERS)]
    TooMany,
    /// A `/*` that is never closed.
    #[error("a comment begins here and does not end; close it with */")]
    OpenComment,
}

/// The error of a line.
pub(super) fn at_line(path: &Path, line: u64, problem: LineProblem) -> MemoryError {
    MemoryError::Line { path: path.to_owned(), line, problem }
}
