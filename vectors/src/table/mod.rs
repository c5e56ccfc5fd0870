//! `vectors.csv`: every case with what each stage is expected to hold.
//!
//! | columns                                 | meaning                                              |
//! |-----------------------------------------|------------------------------------------------------|
//! | index, kind                             | line of the memory files, why the case was chosen    |
//! | n, address, x_bits, x_hex, x_real       | the input; n is empty where no exponent leads there  |
//! | `<rank>.<register>`, `…_hex`            | each register, in the rank that computes it          |
//! | intensity_bits, …_hex, …_real           | the output                                           |
//! | status, flags                           | the status port as a number, and its flags by name   |
//! | reference, error_ulp                    | x^n, and intensity − x^n in output ulp               |
//!
//! A register that is only carried along is not repeated, nor are the ports. A real value is an
//! exact decimal; the reference has 17 significant digits, which an `f64` comes back from. Hex has
//! the register's width and a `0x`, so that a spreadsheet does not take `1e5` for a number.

mod error;
mod read;
mod write;

pub use error::TableError;
pub use read::{TableRow, read_columns, read_table};
pub use write::{TableWriter, hex};
