//! The clocked highlight pipeline, its analyses, and the `blysk` command.
