//! `blysk serve`: who is answered, what, and how it ends.

mod answers;
mod browser;
mod client;
mod command;
mod limits;
mod refused;
