//! Wrong hardware: what a bundle of vectors must be able to tell from the right one.
//!
//! A [`Fault`] is a small mistake in one rank: what that rank takes in is not what it should be, and
//! the ranks behind it go on with it as they always do. So a faulty pipeline needs no arithmetic of
//! its own: it is the data path, with a row, a line, a register or a choice exchanged ([`Faulty`]).
//! What no longer fits a register wraps there, as in RTL.
//!
//! | faults                    | where                                                             |
//! |---------------------------|-------------------------------------------------------------------|
//! | [`Fault::Field`]          | a stored field of a row, one unit more or less                    |
//! | [`Fault::Swap`]           | two neighbouring rows, exchanged                                  |
//! | [`Fault::Rounding`]       | each line that rounds, in each of the other modes                 |
//! | [`Fault::Register`]       | each computed data register, without its top bit, or its lowest 0 |
//! | [`Fault::Logic`]          | cut, shift, clamps, regions, flags, the last quotient bit         |
//! | [`HANDSHAKE`]             | nothing that a vector on its own can show                         |
//!
//! A vector *kills* a fault when the ports show another intensity or another status. A fault that no
//! input kills is *equivalent*: the hardware is not wrong.

pub mod compact;
pub mod cover;
mod evaluate;
pub(crate) mod fault;
mod list;
mod rows;
mod screen;

pub use compact::{Compact, FaultFate, OneByOne, Workers, exhaust};
pub use evaluate::{Faulty, Model};
pub use fault::{Defect, Fault, FieldFault, HANDSHAKE, Logic, line_name};
pub use list::{field_faults, pipeline_faults};
pub use rows::{Mask, RowFaults};
pub use screen::Screen;
