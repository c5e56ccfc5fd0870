//! Text that comes from elsewhere: the one way in which the project reads an input file.
//!
//! | what a file has | what becomes of it |
//! |---|---|
//! | a UTF-8 mark (BOM) in front | it is skipped |
//! | line ends CRLF or CR | they are read as LF |
//! | UTF-16 or UTF-32, with a mark or without | refused, and named |
//! | a byte of 0 | refused with its line: this is no text |
//! | a byte that is not UTF-8 | refused with line and place, or read as `?` where only numbers count
//! ([`TextKind::lossy`]) |
//! | more bytes than its [`TextKind`] may have, or a longer line | refused as soon as they are read, whether they come
//! from a file or a stream |
//!
//! [`read()`] gives a whole file, [`open()`] a reader for files that are larger than the memory.

mod encoding;
mod error;
mod kinds;
mod problem;
mod punctuation;
mod reader;

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

pub use error::TextError;
pub use kinds::{
    ANSWER_LOG, CERTIFICATE, CONFIGURATION, JOB, MANIFEST, MATERIALS, MEMORY, MESH, MODEL, PARETO_TABLE, PORT_MAP,
    QUESTIONS, REGISTER_LOG, SCENE, SHARD_PLAN, SHARD_RESULT, STIMULUS, SYNTHESIS_TABLE, TextKind, VECTOR_TABLE,
};
pub use problem::TextProblem;
pub(crate) use punctuation::why_other_count;
pub use punctuation::{decimal_comma, foreign_separator};
pub use reader::TextReader;

/// The text of the file at `path`.
///
/// # Errors
/// When it cannot be read, is no text, or is longer than its kind may be.
pub fn read(path: &Path, kind: TextKind) -> Result<String, TextError> {
    text(path, kind).map_err(|problem| TextError::new(path, &kind, problem))
}

/// The same as [`read()`], without the name of the file in its error.
///
/// # Errors
/// As [`read()`].
pub fn text(path: &Path, kind: TextKind) -> Result<String, TextProblem> {
    let mut text = String::new();
    reader(path, kind)?.read_to_string(&mut text)?;
    match kind.when_empty {
        Some(advice) if text.is_empty() => Err(TextProblem::Empty(advice)),
        _ => Ok(text),
    }
}

/// The bytes of the file at `path`, which need not be text; held to the length of its kind.
///
/// # Errors
/// When it cannot be read, is empty, or is longer than its kind may be.
pub fn bytes(path: &Path, kind: TextKind) -> Result<Vec<u8>, TextProblem> {
    let mut bytes = Vec::new();
    // What is no regular file has no length: one byte more shows that there is too much.
    opened(path, kind)?.take(kind.most_bytes + 1).read_to_end(&mut bytes)?;
    match kind.when_empty {
        _ if bytes.len() as u64 > kind.most_bytes => Err(kind.too_long()),
        Some(advice) if bytes.is_empty() => Err(TextProblem::Empty(advice)),
        _ => Ok(bytes),
    }
}

/// A reader for the text of the file at `path`. What it finds wrong comes as an [`io::Error`](std::io::Error), which turns
/// into a [`TextProblem`].
///
/// # Errors
/// When the file cannot be opened, or is longer than its kind may be.
pub fn open(path: &Path, kind: TextKind) -> Result<TextReader<File>, TextError> {
    reader(path, kind).map_err(|problem| TextError::new(path, &kind, problem))
}

fn reader(path: &Path, kind: TextKind) -> Result<TextReader<File>, TextProblem> {
    Ok(TextReader::new(opened(path, kind)?, kind))
}

fn opened(path: &Path, kind: TextKind) -> Result<File, TextProblem> {
    let about = fs::metadata(path)?;
    if about.is_dir() {
        return Err(TextProblem::Directory);
    }
    // What is no regular file has no length; it is counted while it is read.
    if about.len() > kind.most_bytes {
        return Err(kind.too_long());
    }
    Ok(File::open(path)?)
}
