//! The data path, bit for bit: integers only.
//!
//! ```text
//! (address, x) → ROM word ─┬→ front_end → stage 1 → … → stage d ───────┬→ clamp → intensity
//!                          └→ tail: divisor, quotient digits ──────────┘
//! ```
//!
//! Each file holds the arithmetic of one part, once, as small pure functions over a
//! [`Lane`](crate::rounding::Lane). They are joined in one place (`compose`); [`Datapath`] takes the same steps rank by
//! rank. The clocked simulator, the vectors and the reports all go through it.
//!
//! There is no floating point here, and no arithmetic outside the lanes: overflow cannot happen
//! because the width analysis ([`crate::budget`]) sized every line.
#![deny(clippy::float_arithmetic)]

mod altered;
mod block;
pub mod clamp;
mod compose;
mod flight;
pub mod formats;
pub mod front_end;
mod inside;
mod keep;
mod lanes;
mod parts;
mod ranks;
pub mod reach;
mod registers;
mod requests;
mod run;
mod schedule;
pub mod signals;
pub mod stage;
pub mod tail;

pub use block::Block;
pub use flight::{Flight, Logic};
pub use keep::Damage;
pub use parts::Datapath;
pub use requests::Requests;
pub use schedule::{FRONT_END, register_name};
pub use signals::{RankRegister, Signals, Status};
