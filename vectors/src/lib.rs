//! Cases for the highlight pipeline and the files they travel in.
//!
//! ```
//! use hw_model::design::Design;
//! use vectors::{Bundle, Strategy};
//!
//! # let place = tempfile::tempdir()?;
//! # let directory = place.path().join("vectors");
//! let design = Design::preset("compact")?;
//! Bundle::new(&design, Strategy::Even, 64, 1, "my program")?.write_to(&directory)?;
//! assert_eq!(vectors::verify(&directory)?.vectors.len(), 64); // read back, and every answer found again
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A testbench reads `stimulus.mem`, `expected.mem` and `rom.mem` with `$readmemh`; [`check()`] judges a log of
//! answers.
//!
//! Generators ([`stimulus`]) choose cases and know nothing of checkers; a [`Bundle`] adds the golden
//! model's answers and writes the files; [`verify()`] reads them back, and [`check()`] judges by them
//! what a user's own hardware answered. Text formats of Verilog are known in this crate only.
//!
//! Everything written goes through [`whole_file`]: files appear whole, or not at all. Everything read comes through
//! [`text_file`].
//!
//! The errors say all they know in their message; what the system said is their `cause` and not
//! their `source()`, so that a program that prints a chain of errors does not say it twice.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable))]

pub mod answers;
pub mod bundle;
pub mod case;
pub mod checksum;
pub mod configuration_file;
pub mod decimal;
pub mod digits;
pub mod evaluate;
pub mod fault_table;
pub mod faults;
pub mod kind;
pub mod limits;
pub mod manifest;
pub mod memory_file;
pub mod negative_control;
pub mod output_text;
pub mod packing;
pub mod progress;
mod records;
pub mod reference;
pub mod rom_image;
pub mod rtl;
pub mod stimulus;
pub mod stimulus_file;
pub mod table;
pub mod text_file;
pub mod verify;
pub mod whole_file;

pub use answers::{AnswersError, Verdict, check};
pub use bundle::{Bundle, BundleError};
pub use case::{Case, Sample, Strategy};
pub use kind::Kind;
pub use manifest::Manifest;
pub use stimulus_file::{StimulusError, StimulusLine, read_stimulus};
pub use verify::{Verified, VerifyError, verify};
pub use whole_file::{OutputError, OutputFile, OutputSet, Staging, WholeFile};
