//! Answers of the golden model to questions (n, x): one at a time, or a stream of lines.
//!
//! ```text
//! lines ─► Dialect::read ─► Question ─► Requests (64 side by side) ─► Answer ─► Dialect::write ─► lines
//! ```
//!
//! A testbench in any language can pipe to [`stream()`]: lines are answered as they come, and the answers are
//! flushed when no complete line is left to read, so that a program that waits for its answer gets it.

mod answer;
mod csv;
mod digits;
mod held;
mod hex;
mod lines;
mod list;
mod stream;

pub use answer::{Answer, Question};
pub use csv::Csv;
pub use held::Held;
pub use hex::Hex;
pub use list::questions;
pub use stream::{Dialect, StreamError, stream};
