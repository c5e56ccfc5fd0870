//! Coefficients as source of other languages, for a shader or a program: a table with a row for each exponent, and the
//! function of x that reads it.
//!
//! | file | holds |
//! |---|---|
//! | `approximation.rs` | what is chosen, and its real function for one exponent |
//! | `piecewise.rs` | that function in f32, operation by operation as the source has it |
//! | `measured.rs` | the error of the function in f32 |
//! | `language.rs` | how a language writes declarations, choices and tables |
//! | `text.rs` | the source |
//!
//! What the comments of a source say of its error is measured with `piecewise.rs`, whose operations a compiler that
//! neither fuses nor reorders them gives bit for bit.

mod approximation;
mod language;
mod measured;
mod piecewise;
mod text;

pub use approximation::{Approximation, RealPieces};
pub use language::Language;
pub use measured::{Measured, Worst, measured};
pub use piecewise::{Piecewise, SourceError};
pub use text::source;
