//! What is wrong with a text, and with which file.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::kinds::TextKind;
use super::problem::TextProblem;

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
