//! `blysk serve`: who is answered, what, and how it ends.

mod answers;
mod client;
mod command;
mod limits;
mod refused;
