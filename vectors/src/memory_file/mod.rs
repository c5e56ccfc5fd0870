//! Memory images as Verilog's `$readmemh` reads them.
//!
//! One word a line, in hex digits of a fixed number, after a header of `//` comments that says what
//! a word is made of. Reading follows the language: white space between numbers, `//` and `/* */`
//! comments, `_` inside a number, `@` with a hex address. The digits `x`, `z` and `?`, which a
//! simulator writes for values it does not know, are read as *unknown* and never as numbers.

mod error;
mod read;
mod write;

pub use error::{LineProblem, MemoryError};
pub(crate) use read::value;
pub use read::{Entry, Value, parse, read_words};
pub(crate) use write::comment;
pub use write::{Header, write_header, write_word};
