//! The clocked highlight pipeline, its analyses, and the `blysk` command.
//!
//! ```
//! use hw_model::design::Design;
//! use sim::pipeline::{Inputs, Pipeline};
//!
//! let design = Design::preset("compact")?;
//! let mut pipeline = Pipeline::new(design.datapath());
//! let (address, x) = (63, 8_304_722); // n = 64, x = 0.99
//! let request = Inputs { in_valid: true, address, x, out_ready: true, ..Inputs::default() };
//! for _ in 0..design.datapath().rank_count() {
//!     assert!(!pipeline.tick(&request).out_valid); // as many cycles as there are ranks
//! }
//! assert_eq!(pipeline.tick(&request).intensity, design.intensity_bits(address, x)?);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`pipeline`] is registers, clock and handshake; [`run`](mod@run) drives it with a stimulus, [`trace`] and [`waves`]
//! record it. The golden model for a testbench in another language is [`evaluate`].

pub mod agreement;
pub mod analysis;
pub mod certify;
pub mod cmd;
pub mod document;
pub mod evaluate;
pub mod interval;
pub mod pipeline;
pub mod plot;
pub mod render;
pub mod report;
pub mod run;
pub mod scene;
pub mod seal;
pub mod specialise;
pub mod stream;
pub mod trace;
pub mod waves;
