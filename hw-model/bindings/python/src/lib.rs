//! `blysk._native`: the golden model as Python sees it. `help()` shows what is written here, and
//! `python/blysk/_native.pyi` has the types.
//!
//! Numbers are converted and checked here and computed in the crates below. Work over arrays runs without the
//! interpreter's lock.
#![deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]

mod answers;
mod arrays;
mod bound;
mod cycles;
mod errors;
mod facts;
mod files;
mod model;
mod out;
mod pipeline;
mod registers;
mod report;
mod tables;

use pyo3::prelude::*;

/// The native part of the package `blysk`.
#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use super::bound::{Claim, Worst};
    #[pymodule_export]
    use super::errors::{BlyskError, ConfigurationError, ExponentError, FileError, InputError};
    #[pymodule_export]
    use super::facts::{Format, Port, Probe, Register};
    #[pymodule_export]
    use super::files::{check, stimulus, write_rtl, write_vectors};
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::pipeline::{Outputs, Pipeline, Rank};
    #[pymodule_export]
    use super::registers::Registers;
    #[pymodule_export]
    use super::report::report;

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("RTL_SOURCES", super::facts::rtl_sources())?;
        module.add("STATUS_FLAGS", super::facts::status_flags())
    }
}
