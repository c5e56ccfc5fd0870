//! What the highlight pipeline computes, bit for bit.
//!
//! Pure: no files, no clock, no randomness, no threads, no command line.

pub mod exponents;
pub mod fit;
pub mod format;
pub mod highlight;
pub mod rounding;
