//! The clocked highlight pipeline, its analyses, and the `blysk` command.

pub mod analysis;
pub mod pipeline;
pub mod run;
pub mod trace;
pub mod waves;
