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
mod kinds;
mod punctuation;
mod reader;

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

pub use kinds::{
    ANSWER_LOG, CERTIFICATE, CONFIGURATION, MANIFEST, MEMORY, MESH, PARETO_TABLE, QUESTIONS, REGISTER_LOG, SCENE,
    STIMULUS, SYNTHESIS_TABLE, TextKind, VECTOR_TABLE,
};
pub(crate) use punctuation::why_other_count;
pub use punctuation::{decimal_comma, foreign_separator};
pub use reader::TextReader;

/// Why a file is no text that could be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TextProblem {
    /// The system refuses it.
    #[error("{0}")]
    Io(io::Error),
    /// A directory has no text.
    #[error("it is a directory; give the path of a file")]
    Directory,
    /// There is nothing in it.
    #[error("the file is empty; {0}")]
    Empty(&'static str),
    /// Characters of another size than UTF-8's.
    #[error(
        "it is {name}, and only UTF-8 is read; save it as UTF-8, or convert it with `iconv -f {name} -t UTF-8` \
         (PowerShell: `| Out-File -Encoding utf8`)"
    )]
    Encoding {
        /// The encoding, as `iconv` calls it.
        name: &'static str,
    },
    /// The file has more bytes than its kind may have.
    #[error("it has more than the {most} bytes that are read of a {noun}")]
    Long {
        /// What the file is.
        noun: &'static str,
        /// The most bytes that its kind may have.
        most: u64,
    },
    /// A line with too many bytes.
    #[error("line {line}: the line has more than {most} bytes; break it into shorter ones")]
    LongLine {
        /// The line, counted from 1.
        line: u64,
        /// The most bytes of a line.
        most: u64,
    },
    /// A byte of 0.
    #[error("line {line}: {NUL}")]
    Nul {
        /// The line, counted from 1.
        line: u64,
    },
    /// A byte that is not UTF-8.
    #[error("line {line}: the line is not UTF-8: {}", not_utf8(*byte, *value))]
    NotUtf8 {
        /// The line, counted from 1.
        line: u64,
        /// The place of the byte in its line, counted from 1.
        byte: u64,
        /// The value of the byte that is not UTF-8.
        value: u8,
    },
}

const NUL: &str = "there is a byte of 0: the file is no text";

fn not_utf8(byte: u64, value: u8) -> String {
    format!("its byte {byte} is 0x{value:02x}; save the file as UTF-8")
}

impl TextProblem {
    /// The line, where there is one, and what is wrong with it.
    fn in_line(&self) -> Option<(u64, String)> {
        let said = self.to_string();
        let line = match self {
            Self::LongLine { line, .. } | Self::Nul { line } | Self::NotUtf8 { line, .. } => *line,
            _ => return None,
        };
        let problem = said.strip_prefix(&format!("line {line}: ")).unwrap_or(&said);
        Some((line, problem.to_owned()))
    }

    /// What is wrong, to follow the name of a file: `:3: the line …` or ` cannot be read: …`.
    #[must_use]
    pub fn after_name(&self) -> String {
        match self.in_line() {
            Some((line, problem)) => format!(":{line}: {problem}"),
            None => format!(" cannot be read: {self}"),
        }
    }
}

impl From<io::Error> for TextProblem {
    /// What a [`TextReader`] found comes back out of the error in which it travelled.
    fn from(error: io::Error) -> Self {
        match error.downcast::<Self>() {
            Ok(problem) => problem,
            Err(error) if error.kind() == ErrorKind::IsADirectory => Self::Directory,
            Err(error) => Self::Io(error),
        }
    }
}

impl From<TextProblem> for io::Error {
    fn from(problem: TextProblem) -> Self {
        match problem {
            TextProblem::Io(error) => error,
            problem => Self::new(ErrorKind::InvalidData, problem),
        }
    }
}

/// Why a file cannot be read as text, with its name.
#[derive(Debug, Error)]
#[error("{}", self.said())]
pub struct TextError {
    /// What the file is.
    noun: &'static str,
    /// The path of the file.
    path: PathBuf,
    /// What is wrong with its text.
    problem: TextProblem,
}

impl TextError {
    /// The error of this file.
    pub fn new(path: &Path, kind: &TextKind, problem: impl Into<TextProblem>) -> Self {
        Self { noun: kind.noun, path: path.to_owned(), problem: problem.into() }
    }

    /// True where there is no such file.
    #[must_use]
    pub fn is_missing(&self) -> bool {
        matches!(&self.problem, TextProblem::Io(error) if error.kind() == ErrorKind::NotFound)
    }

    fn said(&self) -> String {
        let (noun, path) = (self.noun, self.path.display());
        match self.problem.in_line() {
            Some((line, problem)) => format!("{path}:{line}: {problem}"),
            None => format!("cannot read the {noun} {path}: {}", self.problem),
        }
    }
}

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

/// A reader for the text of the file at `path`. What it finds wrong comes as an [`io::Error`], which turns
/// into a [`TextProblem`].
///
/// # Errors
/// When the file cannot be opened, or is longer than its kind may be.
pub fn open(path: &Path, kind: TextKind) -> Result<TextReader<File>, TextError> {
    reader(path, kind).map_err(|problem| TextError::new(path, &kind, problem))
}

fn reader(path: &Path, kind: TextKind) -> Result<TextReader<File>, TextProblem> {
    let about = fs::metadata(path)?;
    if about.is_dir() {
        return Err(TextProblem::Directory);
    }
    // What is no regular file has no length; it is counted while it is read.
    if about.len() > kind.most_bytes {
        return Err(kind.too_long());
    }
    Ok(TextReader::new(File::open(path)?, kind))
}
