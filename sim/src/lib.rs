//! The clocked highlight pipeline: registers, handshake, and what is recorded of them cycle by cycle.
//!
//! ```
//! use hw_model::design::Design;
//! use sim::pipeline::{Inputs, Pipeline};
//!
//! let design = Design::preset("compact")?;
//! let mut pipeline = Pipeline::new(design.datapath());
//! let (address, x) = (63, 8_304_722); // n = 64, x = 0.99
//! let request = Inputs { in_valid: true, address, x, out_ready: true, ..Inputs::default() };
//! for _ in 0..design.datapath().latency() {
//!     assert!(!pipeline.tick(&request).out_valid); // one cycle for each rank of registers
//! }
//! assert_eq!(pipeline.tick(&request).intensity, design.intensity_bits(address, x)?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`pipeline`] is one clock edge after another, [`run`](mod@run) drives it with a stimulus, [`trace`] and [`waves`]
//! write what is seen, [`agreement`] holds another simulation's log against it, and [`stream`] goes over many cycles in
//! which nothing stalls; [`coverage`] tells what vectors exercise. Nothing between two registers is computed here. The
//! golden model for a testbench in another language is [`vectors::evaluate`].
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod agreement;
pub mod coverage;
pub mod pipeline;
pub mod run;
pub mod slice;
pub mod stream;
pub mod trace;
pub mod waves;
