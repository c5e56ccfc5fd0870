//! The golden model where verification engineers work: what `docs/VERIFICATION.md` says works as printed, and every way
//! to ask the model gives the same bits.

mod cases;
mod equality;
mod page;
mod tools;

// The library is built with the tests, and lies beside them.
use blysk as _;
