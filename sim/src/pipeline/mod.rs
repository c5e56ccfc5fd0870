//! Registers, clock and handshake around the model's data path. Nothing is computed here.
//!
//! A cycle has two phases. *Combinational*: from the registers (`_q`) and the inputs follow the
//! outputs and what every register will take in (`_d`). *Clock*: `_d` becomes `_q`.
//!
//! Handshake rules:
//!
//! 1. A transfer takes place at a rising edge where valid and ready are both high and reset is low.
//! 2. A rank advances when it is empty or the rank after it advances; the last one when it is empty or
//!    `out_ready` is high. So bubbles collapse, and a stall holds every bit.
//! 3. `out_valid` depends on registers only, never on `out_ready` or `in_valid`.
//! 4. Reset clears the valid flags; `in_ready` is low while it is high. What was in flight is lost.
//! 5. A rank's data registers are loaded when it advances and a request is offered to it; a bubble does
//!    not change them. Reset does not gate that in ranks from 1 up; only their flags become 0.
//!
//! A configuration may have another rule than 2 ([`Handshake`]), another reset than that at the edge ([`Reset`]), and a
//! register slice at one end ([`Slice`]).
//!
//! [`Handshake`]: hw_model::handshake::Handshake
//! [`Reset`]: hw_model::handshake::Reset
//! [`Slice`]: crate::slice::Slice

mod clocked;
mod places;
mod ports;
mod ranks;

pub use clocked::{Clocked, Pipeline};
pub use ports::{Inputs, Outputs};
pub use ranks::{Rank, Ranks};
