//! The clocked highlight pipeline, its analyses, and the `blysk` command.

pub mod analysis;
