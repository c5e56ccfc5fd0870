//! Rigorous bounds, and certificates of them that can be checked without trusting the search.
//!
//! Methods with real coefficients: the maximum of the error over the continuous x, between two numbers,
//! for one exponent or for every real n ≥ 1 at once. [`curve`] writes the methods in variables in which
//! they stay smooth for n → ∞, `error.rs` bounds the error over a box by intervals, [`search`] finds the
//! boxes, [`check`] looks at them again. Configurations: [`hardware`], whose bounds a sweep outside of this crate
//! finds.

pub mod certificate;
pub mod check;
pub mod claim;
pub mod curve;
mod error;
pub mod fault;
pub mod hardware;
mod hardware_check;
mod partition;
pub mod search;
