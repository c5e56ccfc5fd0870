//! Cases for the highlight pipeline and the files they travel in.
//!
//! Generators ([`stimulus`]) choose cases and know nothing of checkers; [`bundle`] adds the golden
//! model's answers and writes the files. Text formats of Verilog are known in this crate only.

pub mod case;
pub mod checksum;
pub mod kind;
pub mod memory_file;
pub mod packing;
pub mod reference;
pub mod stimulus;
pub mod table;
pub mod whole_file;

pub use case::{Case, Sample, Strategy};
pub use kind::Kind;
