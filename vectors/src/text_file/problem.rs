//! What is wrong with a text.

use std::io::{self, ErrorKind};

use thiserror::Error;

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
    pub(super) fn in_line(&self) -> Option<(u64, String)> {
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
    /// What a [`TextReader`](super::TextReader) found comes back out of the error in which it travelled.
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
