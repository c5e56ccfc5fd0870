//! Why nothing was written.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why nothing was written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The directory could not be made, or is something else.
    #[error("cannot use the directory {}: {cause}; {}", path.display(), advice(cause))]
    Directory {
        /// The path of the directory.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}: {cause}; {}", shown(path), advice(cause))]
    Write {
        /// The file, under the name it would have had.
        path: PathBuf,
        /// What the system said.
        cause: io::Error,
    },
    /// The destination is a directory, a disc or a socket: nothing that a file may replace.
    #[error("{} is not a regular file; give the path of a file", .0.display())]
    NotAFile(PathBuf),
    /// The destination is a link that leads nowhere.
    #[error(
        "{} is a link to {}, which does not exist; make that first, or give another path",
        path.display(), to.display()
    )]
    Dangling {
        /// The path of the link.
        path: PathBuf,
        /// The path that the link leads to, where there is nothing.
        to: PathBuf,
    },
    /// The path has no file name, or the name of a file in a set has directories in it.
    #[error("{} is not the name of a file; give a path that ends in one", .0.display())]
    NoName(PathBuf),
    /// An output is a file that the same command reads.
    #[error(
        "{} is an input of this command ({}), which would be lost; give the output another path",
        path.display(), input.display()
    )]
    Input {
        /// The path of the output.
        path: PathBuf,
        /// The path of the input that the output would write over.
        input: PathBuf,
    },
    /// Two outputs are one file.
    #[error("{} is the same file as another output; give each its own", .0.display())]
    Twice(PathBuf),
    /// A file of the set was begun and not kept: a mistake of the program, not of its user.
    #[error("{} was begun but not finished, so nothing was written", .0.display())]
    Unfinished(PathBuf),
    /// Neither could the set be written, nor the old one be put back.
    #[error("{cause}; what was in {} is now in {}", path.display(), aside.display())]
    NotUndone {
        /// Why the set could not be written.
        cause: Box<OutputError>,
        /// A file that could not be put back.
        path: PathBuf,
        /// Where its old contents are.
        aside: PathBuf,
    },
}

/// A path as messages have it.
fn shown(path: &Path) -> String {
    if path == Path::new("-") { "standard output".to_owned() } else { path.display().to_string() }
}

fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => "choose a place that you may write to",
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "free some space or choose another place",
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists | ErrorKind::DirectoryNotEmpty => {
            "a file is in the way: choose another name or move it"
        }
        _ => "check the path and the disc behind it",
    }
}
