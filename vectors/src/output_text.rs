//! Tables and reports as text: CSV and JSON, each in one way.

use std::io;

use serde::Serialize;

/// Rows as CSV, under a line with the names of their fields.
///
/// # Errors
/// When a row is no flat record.
pub fn csv<T: Serialize>(rows: &[T]) -> Result<Vec<u8>, csv::Error> {
    let mut csv = csv::Writer::from_writer(Vec::new());
    for row in rows {
        csv.serialize(row)?;
    }
    csv.into_inner().map_err(|error| csv::Error::from(error.into_error()))
}

/// A value as JSON, indented, with a line's end behind it.
///
/// # Errors
/// When it has no JSON: a key that is no text, or a serialiser of its own that fails.
pub fn json<T: Serialize + ?Sized>(value: &T) -> Result<String, serde_json::Error> {
    let mut text = serde_json::to_string_pretty(value)?;
    text.push('\n');
    Ok(text)
}

/// The I/O error inside an error of writing CSV, with its kind.
#[must_use]
pub fn io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        // A line of another length than the header: a mistake of the program.
        kind => io::Error::other(format!("{kind:?}")),
    }
}
