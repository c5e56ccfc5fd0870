//! Python's exceptions, with the sentences of the crates below.

use std::fmt::Display;

use model::{Code, Error};
use numpy::BorrowError;
use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;

create_exception!(blysk, BlyskError, PyValueError, "What the model refuses; the message says what would be right.");
create_exception!(blysk, ConfigurationError, BlyskError, "A preset or a configuration that gives no hardware.");
create_exception!(blysk, ExponentError, BlyskError, "An exponent for which the ROM has no word.");
create_exception!(blysk, InputError, BlyskError, "An x, an address or an array that cannot be used.");
create_exception!(blysk, FileError, BlyskError, "Files of vectors or of a log that cannot be written, read or judged.");

/// The exception of an error of the model.
pub(crate) fn refused(error: Error) -> PyErr {
    let said = error.to_string();
    match error.code() {
        Code::NoPreset | Code::Configuration | Code::Design => ConfigurationError::new_err(said),
        Code::Exponent => ExponentError::new_err(said),
        _ => InputError::new_err(said),
    }
}

/// The exception of an argument that cannot be used.
pub(crate) fn input(error: impl Display) -> PyErr {
    InputError::new_err(error.to_string())
}

/// The exception of an array that two calls want at the same time, one of them to write it.
pub(crate) fn in_use(_: BorrowError) -> PyErr {
    InputError::new_err("another call is writing or reading an array of this one; give each thread an `out` of its own")
}

/// The exception of files.
pub(crate) fn file(error: impl Display) -> PyErr {
    FileError::new_err(error.to_string())
}
