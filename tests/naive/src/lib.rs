//! The pipeline once more, written from its description: what keeps the golden model honest.
//!
//! [`Naive`] computes every register of one input in exact rationals. [`Comparison`](comparison::Comparison) holds the
//! golden model against it, over presets and over the configurations that [`configurations`] draws. The crate knows
//! `hw-model` and nothing above it, so that its tests are built in seconds: the mutants of the datapath are many.

pub mod comparison;
pub mod configurations;
mod model;

pub use model::*;
