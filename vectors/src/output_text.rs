//! Tables as text: CSV.

use std::io;

/// The I/O error inside an error of writing CSV, with its kind.
#[must_use]
pub fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        // A line of another length than the header: a mistake of the program.
        kind => io::Error::other(format!("{kind:?}")),
    }
}
