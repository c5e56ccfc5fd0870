//! Why RTL cannot be built, or does not answer.

use std::path::PathBuf;

use thiserror::Error;
use vectors::OutputError;
use vectors::bundle::BundleError;

/// A result of the harness has this many bits.
pub const WORD_BITS: u32 = 32;

/// Why RTL cannot be built, or does not answer.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RtlError {
    /// The vectors of the emitted RTL cannot be chosen.
    #[error(transparent)]
    Bundle(#[from] BundleError),
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A program cannot be run.
    #[error("cannot run {}: {cause}; Verilator and a C++ compiler are needed (scripts/setup)", program.display())]
    NoProgram {
        /// The program.
        program: PathBuf,
        /// What the system said.
        cause: std::io::Error,
    },
    /// Verilator or the compiler refuses the RTL.
    #[error("verilator: {0}")]
    Build(String),
    /// An answer has more bits than the harness writes.
    #[error("status and intensity have {bits} bits, and the harness writes {WORD_BITS}; use a narrower output format")]
    Wide {
        /// The bits of an answer.
        bits: u32,
    },
    /// The harness gave fewer results than it was asked for.
    #[error("address {address}, x from {x}: results are missing: {cause}")]
    Short {
        /// The address of the row.
        address: u32,
        /// The first x whose result is missing, about.
        x: i64,
        /// What the system said.
        cause: std::io::Error,
    },
    /// The harness gave more results than it was asked for, or failed at its end.
    #[error("address {address}: {bytes} bytes more than there are results; {status}")]
    Surplus {
        /// The address of the row.
        address: u32,
        /// The bytes that are too many.
        bytes: usize,
        /// How the harness ended.
        status: String,
    },
}
