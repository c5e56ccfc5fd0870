//! The golden model in a browser: a server for this machine alone, and the page that it shows.
//!
//! ```text
//! browser ─► guard (Host, Origin) ─► router ─► pool (few workers, a deadline) ─► answers ─► JSON, zip
//!                                                                                  │
//!                                                        vectors, sim, analysis, document: every number
//! ```
//!
//! Nothing is computed here: an answer asks the data path, the simulator, the sweeps. The script of the page draws what
//! it is answered, and computes nothing either.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod answers;
mod app;
mod configuration;
mod figures;
mod files;
mod guard;
mod known;
mod pool;
mod refusal;
mod router;
mod server;
mod sessions;
mod words;

pub use app::{Limits, Start};
pub use server::{ServeError, Server};
