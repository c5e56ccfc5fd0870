//! Work that outgrows one machine: cut into shards, run anywhere, merged to the bytes that one machine gives.
//!
//! A [`Job`](job::Job) says what is to be done. It is cut into *pieces*, whose number and order depend on the job alone;
//! a [`Plan`](plan::Plan) gives each *shard* a run of consecutive pieces. [`run()`](run::run) measures the pieces of one
//! shard, and [`merge()`](merge::merge) puts what was found together in the order of the pieces. So the merged report is
//! the same, bit for bit, for any number of shards.
//!
//! A shard is pure: it reads the plan, and writes one file, whole or not at all. A result that is there is believed
//! only if it names the job by its digest and the version of this program; so a shard may be run twice. How far a
//! shard has come is kept in a checkpoint, which is a result of fewer pieces: a shard that was killed goes on from
//! there.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod error;
pub mod job;
pub mod kind;
mod kinds;
pub mod merge;
pub mod merged;
pub mod part;
pub mod place;
pub mod plan;
pub mod recipe;
pub mod refused;
pub mod result;
pub mod rtl;
pub mod run;
pub mod status;

pub use error::ShardError;
