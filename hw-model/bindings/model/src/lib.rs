//! The golden model and its clocked pipeline, as the bindings of other languages call them: values that own what they
//! need, arrays in and out, and one type of error.
//!
//! ```
//! use model::{Clocked, Inputs, Model};
//!
//! let model = Model::preset("compact")?;
//! assert_eq!(model.highlight(64.0, 0.99)?, 0.5257568359375);
//!
//! let (address, x) = (model.address(64.0)?, model.x_bits(0.99)?);
//! let answer = model.evaluate(address, x)?;
//! for (probe, bits) in model.probes().iter().zip(model.registers(address, x)?) {
//!     assert!(probe.register.format.holds(bits.into()), "{}", probe.path);
//! }
//!
//! let mut pipeline = Clocked::new(&model);
//! let request = Inputs { in_valid: true, address, x, out_ready: true, ..Inputs::default() };
//! for _ in 0..model.latency() {
//!     assert!(!pipeline.tick(&request)?.out_valid);
//! }
//! assert_eq!(pipeline.tick(&request)?.intensity, answer.intensity);
//! # Ok::<(), model::Error>(())
//! ```
//!
//! Nothing is computed here: a [`Model`] asks the data path of its design, and [`Clocked`] is the simulator's pipeline.
//! Numbers from outside are checked, and refused with an [`Error`].
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

mod arrays;
mod clocked;
mod difference;
mod error;
mod handle;
mod scoreboard;

pub use arrays::{Addresses, XBits};
pub use clocked::Clocked;
pub use difference::Difference;
pub use error::{Code, Error};
pub use handle::{Answer, Model};
pub use hw_model::datapath::Status;
pub use scoreboard::{Counts, Scoreboard, Seen, Verdict};
pub use sim::pipeline::{Inputs, Outputs, Rank};
pub use vectors::rtl::probes::{Port, Probe};
