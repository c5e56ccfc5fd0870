//! Shared helpers of the integration tests.

pub mod answers;
pub mod bench;
pub mod cli;
pub mod fuzz;
pub mod reference;
pub mod rtl;
pub mod save_file;
pub mod waves;
