//! Consecutive x through the verilated RTL, against the golden model.

mod build;
mod compare;
mod error;

pub use build::{PROGRAM, build, emit};
pub use compare::{Counts, compare};
pub use error::{RtlError, WORD_BITS};
