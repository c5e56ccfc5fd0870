//! The `blysk` command.

fn main() {}
