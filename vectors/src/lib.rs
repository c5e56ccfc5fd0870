//! Cases for the highlight pipeline and the files they travel in.
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

pub mod answers;
pub mod bundle;
pub mod case;
pub mod checksum;
pub mod fault_table;
pub mod faults;
pub mod kind;
pub mod limits;
pub mod manifest;
pub mod memory_file;
pub mod negative_control;
pub mod packing;
mod records;
pub mod reference;
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
pub use stimulus_file::{Cycle, StimulusError, read_stimulus};
pub use verify::{Verified, VerifyError, verify};
pub use whole_file::{OutputError, OutputFile, OutputSet, Staging, WholeFile};
