//! The clocked highlight pipeline: registers, handshake, and what is recorded of them cycle by cycle.
//!
//! [`pipeline`] is one clock edge after another, [`run`](mod@run) drives it with a stimulus, [`trace`] and [`waves`] write
//! what is seen, [`agreement`] holds another simulation's log against it, and [`stream`] goes over many cycles in which
//! nothing stalls. Nothing between two registers is computed here.

pub mod agreement;
pub mod pipeline;
pub mod run;
pub mod stream;
pub mod trace;
pub mod waves;
